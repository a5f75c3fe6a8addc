//! The closed form of a problem that is solved numerically, as what its solution is measured against.

use super::focus::{Focus, Partner};
use crate::continuum::exact::{bingham, ouriemi};
use crate::problem::{LaminarBed, Model, Problem};
use crate::result::quantity::{U_MIXTURE, U_PARTICLE};
use crate::result::{Profile, Quiet, Results};

/// Levels of a closed form whose profile is not used.
const LEVELS: usize = 24;

/// The solution of the exact yield, to round-off.
#[derive(Clone, Debug)]
pub(super) struct ClosedForm {
    velocity: Velocity,
    results: Results,
}

#[derive(Clone, Debug)]
enum Velocity {
    Bed(Box<(LaminarBed, ouriemi::Solution)>),
    Plane(bingham::Solution),
}

impl ClosedForm {
    /// The closed form of the exact yield of `problem`, if it has one and that can be evaluated.
    pub fn of(problem: &Problem) -> Option<Self> {
        let (model, velocity) = match Focus::of(problem)?.partner? {
            Partner::Bed(bed) => {
                let solution = ouriemi::solve(&bed, |_| {}).ok()?;
                (Model::Ouriemi(*bed), Velocity::Bed(Box::new((*bed, solution))))
            }
            Partner::Plane(plane) => {
                let solution = bingham::Solution::new(&plane, |_| {}).ok()?;
                (Model::BinghamPlane(plane), Velocity::Plane(solution))
            }
        };
        let outcome = crate::run(&Problem { model, cells: LEVELS, ..problem.clone() }, &mut Quiet).ok()?;
        Some(Self { velocity, results: outcome.results })
    }

    /// Its numbers [SI].
    pub fn results(&self) -> &Results {
        &self.results
    }

    /// The velocity at the levels of `run`.
    pub fn at(&self, run: &Profile) -> Option<Profile> {
        let levels = run.axis();
        let mut profile = Profile::new(levels.clone()).ok()?;
        match &self.velocity {
            Velocity::Bed(bed) => {
                let (bed, solution) = bed.as_ref();
                // The top of the grains may lie an ulp above the bed level.
                let grains = |z: f64| bed.velocity_scale() * solution.particle(z.min(bed.h_p) / bed.h);
                let defined = run.get(&U_PARTICLE)?.iter().map(Option::is_some);
                let values = levels.iter().zip(defined).map(|(&z, defined)| defined.then(|| grains(z)));
                profile.push(&U_PARTICLE, values.collect()).ok()?;
            }
            Velocity::Plane(solution) => {
                profile.push(&U_MIXTURE, levels.iter().map(|&z| Some(solution.velocity(z))).collect()).ok()?;
            }
        }
        Some(profile)
    }
}
