//! What a Bingham fluid between two planes says of its studies.

use crate::model::{ClosedForm, Focus, Number, Rule, Sizes, StudyPlan, number};
use crate::models::exact::bingham::{self, BinghamDrive, BinghamPlane};
use crate::models::yielding::{PLANES, SCALED, finest, plane};
use crate::result::quantity::{self as q, U_MIXTURE};
use crate::result::{Profile, Quiet, Results};

/// Levels of a closed form whose profile is not used.
const LEVELS: usize = 24;

pub(super) fn plan(flow: &BinghamPlane, cells: usize) -> StudyPlan {
    let focus = focus(flow);
    let sizes = focus.sizes;
    StudyPlan {
        rungs: sizes.as_ref().map(plane).unwrap_or_default(),
        finest: finest(4 * cells.max(400), sizes.map(|sizes| sizes.exactly()).unwrap_or_default()),
        focus: Some(focus),
    }
}

fn focus(plane: &BinghamPlane) -> Focus {
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
    }
}

/// The exact yield.
struct Exact {
    solution: bingham::Solution,
    results: Results,
}

pub(super) fn closed_form(plane: &BinghamPlane) -> Option<Box<dyn ClosedForm>> {
    let solution = bingham::Solution::new(plane, |_| {}).ok()?;
    let results = bingham::run(plane, LEVELS, &mut Quiet).ok()?.results;
    Some(Box::new(Exact { solution, results }))
}

impl ClosedForm for Exact {
    fn results(&self) -> &Results {
        &self.results
    }

    fn at(&self, run: &Profile) -> Option<Profile> {
        let levels = run.axis();
        let mut profile = Profile::new(levels.clone()).ok()?;
        profile.push(&U_MIXTURE, levels.iter().map(|&z| Some(self.solution.velocity(z))).collect()).ok()?;
        Some(profile)
    }
}
