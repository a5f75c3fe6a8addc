//! What colliding grains in a fluid say of their studies.

use super::{State, TwoFluid};
use crate::model::{Focus, Law, Meshes, Number, ONE_KIND, Rung, Sizes, Smoothed, StudyPlan, number};
use crate::result::quantity as q;

const RATE: Number = number(&q::TRANSPORT_RATE, "transport_rate");

/// The closures of both columns of Chassagne et al. (2023) on some meshes.
pub(super) fn plan(flow: &TwoFluid) -> StudyPlan {
    let law = |law: &'static str| {
        let set = [format!("closures.granular.law={law}")];
        [60, 120, 240, 480].map(|cells| Rung::cells(law, cells, &set)).to_vec()
    };
    StudyPlan {
        focus: Some(focus(flow)),
        rungs: [law("frictional-collisional"), law("garzo-dufty")].concat(),
        finest: Some(("960 cells".into(), vec!["grid.cells=960".into()])),
    }
}

fn focus(flow: &TwoFluid) -> Focus {
    const STEADY: &[Number] = &[RATE, number(&q::LAYER_THICKNESS, "layer_thickness")];
    const IN_TIME: &[Number] = &[RATE, number(&q::BED_LEVEL, "bed_level")];
    const GRADED: &[(&str, &[&str])] = &[("cells as in the case", &[]), ("cells of equal height", &["grid.fine="])];
    let steady = flow.state == State::Steady;
    let meshes = Meshes {
        cells: &[60, 120, 240, 480],
        reference: 960,
        changes: &[],
        kinds: if flow.fine.is_some() { GRADED } else { ONE_KIND },
        remarks: &[],
    };
    let in_time = Meshes {
        cells: &[30, 60, 120],
        reference: 240,
        remarks: &[("in time", "compared at the end of the run: what swings or bursts there has no order")],
        ..meshes
    };
    Focus {
        velocity: &q::U_PARTICLE,
        velocity_unit: flow.velocity_scale(),
        numbers: if steady { STEADY } else { IN_TIME },
        bed: false,
        paper_rms: false,
        sizes: Some(Sizes {
            key: "regularisation.shear_rate",
            unit: "1/s",
            formula: "λ",
            symbols: "",
            shear_unit: 1.0,
            // There is always a creep.
            exact: &[],
            changes: &[],
            laws: &[Smoothed { name: "bercovier-engelman", changes: &[], falls: Some(Law::Linear) }],
            decades: if steady { (1, 9) } else { (1, 6) },
            reported: &[1e-2, 1e-4, 1e-6],
            slopes_from: 1e-1,
            creep: false,
            rule: None,
            remarks: &[],
        }),
        meshes: Some(if steady { meshes } else { in_time }),
    }
}
