//! What the flows in a section say of their studies.

use super::{CavityFlow, Contents, DuctFlow};
use crate::model::{Focus, Meshes, Number, ONE_KIND, Rule, Rung, Sizes, StudyPlan, number};
use crate::models::yielding::{LAMBDAS, OVER_A_BED, PLANES, SCALED, finest, first_layer, regularised};
use crate::result::quantity as q;

/// In a section Newton's method alone takes a regularisation.
const IN_SECTION: Sizes = Sizes { changes: &["method=newton", "regularisation.lambda="], ..SCALED };

const SECTION: Meshes = Meshes {
    cells: &[12, 24, 48, 96],
    reference: 192,
    kinds: &[("node on the yield level", &["grid.yield_row=true"]), ("no node there", &["grid.yield_row=false"])],
    ..PLANES
};

const CAVITY: Meshes = Meshes { kinds: ONE_KIND, ..SECTION };

/// The flow along a whole duct is that of its section, which can be refined much further.
const WHOLE_DUCT: Meshes = Meshes {
    changes: &["regularisation.law=none", "regularisation.lambda=", "regularisation.lambda_scaled=", "grid.along="],
    remarks: &[
        ("yield", "exact"),
        ("whole duct", "its section alone, whose flow is the same: section_deviation says how closely"),
    ],
    ..SECTION
};

pub(super) fn plan(focus: Focus, whole: bool) -> StudyPlan {
    let newton = "method=newton".to_owned();
    let exact = focus.sizes.map(|sizes| sizes.exactly()).unwrap_or_default();
    let rungs = match focus.sizes {
        // The whole duct costs so much that its rungs are few.
        _ if whole => [8, 12, 16, 20].map(|cells| Rung::cells("whole duct", cells, &[])).to_vec(),
        Some(sizes) => {
            let newton = [vec![newton.clone()], exact.clone()].concat();
            let first = [vec!["method=first-order".to_owned()], exact.clone()].concat();
            let dual = [12, 24, 48].map(|cells| Rung::cells("first-order", cells, &first));
            let newton = [8, 12, 24, 48, 96].map(|cells| Rung::cells("Newton, exact yield", cells, &newton));
            [newton.to_vec(), dual.to_vec(), regularised(&sizes, 2, &LAMBDAS, &[12, 24, 48])].concat()
        }
        None => Vec::new(),
    };
    let changes = [vec![newton], exact, vec!["grid.along=".into()]].concat();
    StudyPlan { focus: Some(focus), rungs, finest: finest(128, changes) }
}

pub(super) fn duct(flow: &DuctFlow) -> Focus {
    const FLOW: &[Number] = &[number(&q::FLOW_RATE, "flow_rate")];
    const BED: &[Number] = &[number(&q::BED_FLUX, "bed_flux")];
    let (numbers, formula, symbols, tau_0, bingham) = match &flow.contents {
        Contents::Bingham { tau_0, .. } => (FLOW, "λ η/(G H)", "", *tau_0, "τ_0 H/(η U_m)"),
        Contents::Bed(bed) => (BED, "λ η/(Δρ g H)", " (Δρ = ρ_p - ρ_f)", first_layer(bed), OVER_A_BED),
    };
    Focus {
        velocity: &q::U_MIXTURE,
        velocity_unit: flow.shear_scale() * flow.h,
        numbers,
        bed: false,
        paper_rms: true,
        sizes: Some(Sizes {
            formula,
            symbols,
            shear_unit: flow.shear_scale(),
            rule: Some(Rule { yield_velocity: tau_0 * flow.h / flow.viscosity(), bingham }),
            ..IN_SECTION
        }),
        meshes: Some(if flow.along.is_some() { WHOLE_DUCT } else { SECTION }),
    }
}

pub(super) fn cavity(flow: &CavityFlow) -> Focus {
    const NUMBERS: &[Number] = &[number(&q::STREAM_MAX, "stream_function")];
    Focus {
        velocity: &q::U_MIXTURE,
        velocity_unit: flow.lid,
        numbers: NUMBERS,
        bed: false,
        paper_rms: true,
        sizes: Some(Sizes {
            formula: "λ H/U",
            shear_unit: flow.lid / flow.h,
            rule: Some(Rule { yield_velocity: flow.tau_0 * flow.h / flow.eta, bingham: "τ_0 H/(η U)" }),
            ..IN_SECTION
        }),
        meshes: Some(CAVITY),
    }
}
