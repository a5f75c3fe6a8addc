//! Materials with a yield stress: laminar beds, Bingham fluids, sections of ducts and cavities.

use super::super::orders::Law;
use super::{Focus, Meshes, Number, ONE_KIND, Partner, Rule, Sizes, Smoothed, number};
use crate::problem::{BinghamDrive, BinghamPlane, CavityFlow, Contents, DuctFlow, LaminarBed};
use crate::result::quantity as q;

const EXACT: &[&str] = &["regularisation.law=none", "regularisation.lambda=", "regularisation.lambda_scaled="];

/// Sizes in the model's unit of shear rate.
const SCALED: Sizes = Sizes {
    key: "regularisation.lambda_scaled",
    unit: "1",
    formula: "λ",
    symbols: "",
    shear_unit: 1.0,
    exact: EXACT,
    changes: &["regularisation.lambda="],
    laws: &[
        Smoothed { name: "simple", changes: &["regularisation.law=simple"], falls: Some(Law::Logarithmic) },
        Smoothed {
            name: "bercovier-engelman",
            changes: &["regularisation.law=bercovier-engelman"],
            falls: Some(Law::Linear),
        },
        Smoothed { name: "papanastasiou", changes: &["regularisation.law=papanastasiou"], falls: Some(Law::Linear) },
    ],
    decades: (1, 12),
    shown: &[1e-4, 1e-6, 1e-10],
    slopes_from: 1e-4,
    creep: false,
    rule: None,
    remarks: &[],
};

/// In a section Newton's method alone takes a regularisation.
const IN_SECTION: Sizes = Sizes { changes: &["model.method=newton", "regularisation.lambda="], ..SCALED };

/// Multiples of 12, so that the cells of every layer double with the mesh.
const PLANES: Meshes = Meshes {
    cells: &[24, 48, 96, 192, 384, 768, 1536],
    reference: 3072,
    changes: EXACT,
    kinds: &[("node on the yield level", &["grid.yield_node=true"]), ("no node there", &["grid.yield_node=false"])],
    remarks: &[("yield", "exact")],
};

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

const OVER_A_BED: &str = "μ_s (ρ_p - ρ_f) g d H/(η U_m)";

/// Yield stress of the first layer of grains, as in section 3.2 of the paper [Pa].
fn first_layer(bed: &LaminarBed) -> f64 {
    bed.friction.mu_s * (bed.rho_p - bed.rho_f) * bed.g * bed.d
}

pub(super) fn laminar(bed: &LaminarBed) -> Focus {
    const NUMBERS: &[Number] = &[number(&q::TRANSPORT_RATE, "transport_rate")];
    Focus {
        velocity: &q::U_PARTICLE,
        velocity_unit: bed.velocity_scale(),
        numbers: NUMBERS,
        bed: true,
        paper_rms: true,
        sizes: Some(Sizes {
            formula: "λ η/(Δρ g H)",
            symbols: " (Δρ = ρ_p - ρ_f)",
            shear_unit: bed.velocity_scale() / bed.h,
            rule: Some(Rule { yield_velocity: first_layer(bed) * bed.h / bed.eta, bingham: OVER_A_BED }),
            ..SCALED
        }),
        meshes: Some(PLANES),
        partner: bed.rise.is_none().then(|| Partner::Bed(Box::new(*bed))),
    }
}

pub(super) fn bingham(plane: &BinghamPlane) -> Focus {
    const NUMBERS: &[Number] = &[number(&q::PLUG_VELOCITY, "plug_velocity")];
    Focus {
        velocity: &q::U_MIXTURE,
        velocity_unit: plane.shear_scale() * plane.h,
        numbers: NUMBERS,
        bed: false,
        paper_rms: true,
        sizes: Some(Sizes {
            formula: match plane.drive {
                BinghamDrive::MeanVelocity(_) => "λ H/Uₘ",
                BinghamDrive::PressureGradient(_) => "λ η/(G H)",
            },
            shear_unit: plane.shear_scale(),
            rule: Some(Rule { yield_velocity: plane.tau_0 * plane.h / plane.eta, bingham: "τ_0 H/(η U_m)" }),
            ..SCALED
        }),
        meshes: Some(PLANES),
        partner: Some(Partner::Plane(*plane)),
    }
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
        partner: None,
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
        partner: None,
    }
}
