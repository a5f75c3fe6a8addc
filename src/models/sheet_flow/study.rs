//! What a sheet flow says of its studies.

use super::SheetFlow;
use crate::closures::friction::FrictionLaw;
use crate::model::{Focus, Meshes, Number, ONE_KIND, Rung, Sizes, Smoothed, StudyPlan, number};
use crate::models::yielding::{LAMBDAS, finest, regularised};
use crate::result::quantity as q;

pub(super) fn plan<F: FrictionLaw>(flow: &SheetFlow<F>, cells: usize) -> StudyPlan {
    let focus = focus(flow);
    let (rungs, exact) = focus.sizes.map(|sizes| (ladder(&sizes), sizes.exactly())).unwrap_or_default();
    StudyPlan { focus: Some(focus), rungs, finest: finest(8 * cells.max(300), exact) }
}

fn ladder(sizes: &Sizes) -> Vec<Rung> {
    let exact = [40, 75, 150, 300, 600, 1200];
    let exact = exact.map(|cells| Rung::cells("Newton, exact yield", cells, &sizes.exactly()));
    let smoothed = |series: &'static str, method: &str, meshes: &[usize]| -> Vec<Rung> {
        let all = regularised(sizes, 1, &LAMBDAS[..3], meshes).into_iter();
        let method = [format!("method={method}")];
        all.map(|rung| Rung { series, changes: [&method[..], &rung.changes].concat(), ..rung }).collect()
    };
    let newton = smoothed("Newton, regularised", "newton", &[75, 300]);
    [exact.to_vec(), newton, smoothed("iteration of the paper", "iteration", &[75, 150])].concat()
}

fn focus<F: FrictionLaw>(flow: &SheetFlow<F>) -> Focus {
    // The pseudo-time iteration needs a creep.
    const EXACT: &[&str] = &["method=newton", "regularisation.law=none", "regularisation.lambda="];
    // Under the exact yield the cells hold the moving grains only.
    const NUMBERS: &[Number] = &[
        Number { stated: Some(&q::REGULARISATION_RATE), ..number(&q::TRANSPORT_RATE, "transport_rate") },
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
            reported: &[1e-2, 1e-4, 1e-6, 1e-8],
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
    }
}
