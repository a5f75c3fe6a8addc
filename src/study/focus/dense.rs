//! Dense granular flows: sheet flow, two fluids, grains between two walls.

use super::super::orders::Law;
use super::{Focus, Meshes, Number, ONE_KIND, Sizes, Smoothed, number};
use crate::problem::{ShearCell, SheetFlow, State, TwoFluid};
use crate::result::quantity as q;

const RATE: Number = number(&q::TRANSPORT_RATE, "transport_rate");

pub(super) fn sheet_flow(flow: &SheetFlow) -> Focus {
    // The pseudo-time iteration needs a creep.
    const EXACT: &[&str] = &["model.method=newton", "regularisation.law=none", "regularisation.lambda="];
    // Under the exact yield the cells hold the moving grains only.
    const NUMBERS: &[Number] = &[
        Number { stated: Some(&q::REGULARISATION_RATE), ..RATE },
        number(&q::SHEET_THICKNESS, "sheet_thickness"),
        number(&q::PHI_INTERFACE, "phi_interface"),
    ];
    Focus {
        velocity: &q::U_PARTICLE,
        velocity_unit: flow.velocity_scale(),
        numbers: NUMBERS,
        bed: false,
        paper_rms: false,
        sizes: Some(Sizes {
            key: "regularisation.lambda",
            unit: "1/s",
            formula: "λ",
            symbols: "",
            shear_unit: 1.0,
            exact: EXACT,
            changes: &[],
            laws: &[Smoothed { name: "simple", changes: &["regularisation.law=simple"], falls: None }],
            decades: (1, 10),
            shown: &[1e-2, 1e-4, 1e-6, 1e-8],
            slopes_from: 1e-2,
            creep: true,
            rule: None,
            remarks: &[(
                "mesh",
                "the exact yield has one of its own: thickness and solid fraction keep its error, the rate is on one mesh",
            )],
        }),
        meshes: Some(Meshes {
            cells: &[40, 80, 160, 320, 640, 1280],
            reference: 2560,
            changes: EXACT,
            kinds: ONE_KIND,
            remarks: &[("yield", "exact")],
        }),
        partner: None,
    }
}

pub(super) fn two_fluid(flow: &TwoFluid) -> Focus {
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
            shown: &[1e-2, 1e-4, 1e-6],
            slopes_from: 1e-1,
            creep: false,
            rule: None,
            remarks: &[],
        }),
        meshes: Some(if steady { meshes } else { in_time }),
        partner: None,
    }
}

pub(super) fn shear_cell(cell: &ShearCell) -> Focus {
    const NUMBERS: &[Number] = &[
        number(&q::WALL_PRESSURE, "wall_pressure"),
        number(&q::WALL_SHEAR, "wall_shear"),
        number(&q::WALL_HEAT, "wall_heat"),
    ];
    Focus {
        velocity: &q::U_PARTICLE,
        velocity_unit: cell.temperature[0].max(cell.temperature[1]).sqrt(),
        numbers: NUMBERS,
        bed: false,
        paper_rms: false,
        sizes: None,
        meshes: Some(Meshes {
            cells: &[25, 50, 100, 200, 400],
            reference: 800,
            changes: &[],
            kinds: ONE_KIND,
            remarks: &[],
        }),
        partner: None,
    }
}
