//! A bed in a section in the terms that other models share: the flow, what it may not need, and when no other model has it.

use super::{Contents, DuctBed, DuctFlow, Outline};
use crate::closures::regularisation::Smoothing;
use crate::model::{Effort, Flow, LaminarScene, Model, Offer, OwnCase, Term, TermTest};

pub(super) fn flow(duct: &DuctFlow) -> Option<Flow> {
    let Contents::Bed(bed) = &duct.contents else { return None };
    Some(match bed.scene(DuctBed::INFO.name) {
        Flow::Laminar(scene) => Flow::Laminar(LaminarScene { walls: duct.outline != Outline::Planes, ..scene }),
        flow @ Flow::Turbulent(_) => flow,
    })
}

pub(super) fn terms(duct: &DuctFlow) -> Vec<Term> {
    let solve = |what, source, change: &[&str], left, free| {
        let change = change.iter().map(|&change| change.to_owned()).collect();
        Term { what, source, test: TermTest::Solve { change, left, free }, dropped: None }
    };
    let slip = if let Contents::Bed(bed) = &duct.contents { bed.slip() } else { None };
    let mut terms: Vec<Term> = slip.into_iter().collect();
    if duct.outline != Outline::Planes {
        // The flow along a whole duct is that of its section.
        let change = ["flow.section=", "grid.along=", "grid.yield_row=false"];
        let left = "a pair of planes at the same distance";
        let dropped: fn(&mut Flow) = |flow| {
            if let Flow::Laminar(scene) = flow {
                scene.walls = false;
            }
        };
        let walls = solve("side walls", "Chauchat & Medale (2010), section 4.1", &change, left, false);
        terms.push(Term { dropped: Some(dropped), ..walls });
    }
    if duct.regularisation.law != Smoothing::None {
        let exact = [
            "grid.along=",
            "method=newton",
            "regularisation.law=none",
            "regularisation.lambda=",
            "regularisation.lambda_scaled=",
        ];
        let source = "Chauchat & Medale (2010), section 3.2";
        terms.push(solve("smoothing of the yield", source, &exact, "the exact yield", true));
    }
    terms
}

pub(super) fn offer(flow: &Flow) -> Option<Offer> {
    let Flow::Laminar(scene) = flow else { return None };
    // Its friction is constant.
    (scene.walls && scene.mu_2.is_none() && !scene.dilates).then(|| Offer {
        effort: Effort::Seconds,
        because: "no other model has the side walls of the section".into(),
        off: "not known: no measured bed in such a section is at hand",
        case: OwnCase::Scene(Vec::new()),
    })
}
