//! What a laminar bed says of its studies.

use super::RegularisedBed;
use crate::model::{ClosedForm, Focus, Number, Rule, Sizes, StudyPlan, number};
use crate::models::exact::bed::LaminarBed;
use crate::models::exact::ouriemi;
use crate::models::yielding::{OVER_A_BED, PLANES, SCALED, finest, first_layer, plane};
use crate::result::quantity::{self as q, U_PARTICLE};
use crate::result::{Profile, Quiet, Results};

/// Levels of a closed form whose profile is not used.
const LEVELS: usize = 24;

pub(super) fn plan(bed: &LaminarBed, cells: usize) -> StudyPlan {
    let focus = focus(bed);
    let sizes = focus.sizes;
    StudyPlan {
        rungs: sizes.as_ref().map(plane).unwrap_or_default(),
        finest: finest(4 * cells.max(400), sizes.map(|sizes| sizes.exactly()).unwrap_or_default()),
        focus: Some(focus),
    }
}

fn focus(bed: &LaminarBed) -> Focus {
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
    }
}

/// The exact yield with constant friction.
struct Exact {
    bed: LaminarBed,
    solution: ouriemi::Solution,
    results: Results,
}

pub(super) fn closed_form(RegularisedBed { bed, .. }: &RegularisedBed) -> Option<Box<dyn ClosedForm>> {
    let solution = ouriemi::solve(bed, |_| {}).ok().filter(|_| bed.rise.is_none())?;
    let results = ouriemi::run(bed, LEVELS, &mut Quiet).ok()?.results;
    Some(Box::new(Exact { bed: *bed, solution, results }))
}

impl ClosedForm for Exact {
    fn results(&self) -> &Results {
        &self.results
    }

    fn at(&self, run: &Profile) -> Option<Profile> {
        let levels = run.axis();
        let mut profile = Profile::new(levels.clone()).ok()?;
        // The top of the grains may lie an ulp above the bed level.
        let (bed, top) = (&self.bed, self.bed.h_p);
        let grains = |z: f64| bed.velocity_scale() * self.solution.particle(z.min(top) / bed.h);
        let defined = run.get(&U_PARTICLE)?.iter().map(Option::is_some);
        let values = levels.iter().zip(defined).map(|(&z, defined)| defined.then(|| grains(z)));
        profile.push(&U_PARTICLE, values.collect()).ok()?;
        Some(profile)
    }
}
