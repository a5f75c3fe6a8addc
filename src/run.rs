//! From a problem to an outcome: the one entry point that the command line and every study call.

use crate::closures::contact::linear_spring;
use crate::closures::dilatancy::{phi_i, phi_iv};
use crate::closures::drag::{carman_kozeny, dallavalle, dallavalle_grain};
use crate::closures::{Info, friction, mixing_length, wall};
use crate::continuum::exact::{bagnold, bingham, log_law, ouriemi};
use crate::continuum::{laminar, shear_cell, sheet_flow, two_fluid};
use crate::discrete::{bed as grain_bed, couple, impact, trials};
use crate::problem::{Contents, DuctFlow, Model, Problem, RegularisedBed, State};
use crate::result::{Failure, Outcome, Profile, SolveError, Status, Watch, quantity as q};
use crate::section;

/// Relative residual of a balance from which on a closed form has lost its digits: its value is round-off otherwise.
const LARGEST_IMBALANCE: f64 = 1e-3;

/// Mean velocity against the drive, over the velocity scale of the model, that round-off may leave where nothing moves.
const AT_REST: f64 = 1e-9;

/// Solves `problem`. `watch` sees the progress and may ask to stop; it cannot change the result.
///
/// # Errors
/// [`Failure`]: why the method failed, with the numbers that say so and the last good state. A result that is not a
/// finite number is a failure, too, and so are a balance that does not close and a mean flow against a steady drive.
pub fn run(problem: &Problem, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let outcome = match &problem.model {
        Model::Ouriemi(bed) => ouriemi::run(bed, problem.cells, watch),
        Model::BinghamPlane(plane) => bingham::run(plane, problem.cells, watch),
        Model::BagnoldFilm(film) => bagnold::run(film, problem.cells, watch),
        Model::LogLaw(wall) => log_law::run(wall, problem.cells, watch),
        Model::Laminar(bed) => laminar::run(bed, problem.cells, watch),
        Model::Bingham(plane) => laminar::run_bingham(plane, problem.cells, watch),
        Model::SheetFlow(flow) => sheet_flow::run(flow, problem.cells, watch),
        Model::TwoFluid(flow) => two_fluid::run(flow, problem.cells, watch),
        Model::ShearCell(cell) => shear_cell::run(cell, problem.cells, watch),
        Model::Duct(flow) => section::run(flow, problem.cells, watch),
        Model::Cavity(flow) => section::run_cavity(flow, problem.cells, watch),
        Model::Grains(bed) => grain_bed::run(bed, watch),
        Model::Coupled(flow) => couple::run(flow, watch),
        Model::Impact(one) => impact::run(one, watch),
        Model::Trial(trial) => trials::run(trial, watch),
    };
    let outcome = outcome?.trusted(LARGEST_IMBALANCE)?;
    match uphill(&problem.model, &outcome) {
        None => Ok(outcome),
        Some(error) => Err(Failure { error, last: Some(Box::new(outcome)) }),
    }
}

/// Why a flow under a steady drive along x is none: it goes the other way. Grains in a fluid look for themselves, on the way;
/// waves have no such direction.
fn uphill(model: &Model, outcome: &Outcome) -> Option<SolveError> {
    let (scale, over_s, hint) = match model {
        Model::TwoFluid(flow) if flow.beta > 0.0 && flow.oscillation.is_none() => {
            let (over, hint) = match flow.state {
                State::Steady => (None, "model.state = \"transient\", which follows the flow from rest"),
                State::Transient => (Some([flow.pace.0; 2]), "a smaller solver.tolerance, or more grid.cells"),
            };
            (flow.velocity_scale(), over, hint)
        }
        Model::SheetFlow(flow) => (flow.velocity_scale(), None, "another model.method, or more grid.cells"),
        Model::Laminar(problem) => (problem.bed.velocity_scale(), None, "more grid.cells"),
        Model::Bingham(problem) => (problem.plane.shear_scale() * problem.plane.h, None, "more grid.cells"),
        Model::Duct(flow) => (flow.shear_scale() * flow.h, None, "more grid.cells"),
        _ => return None,
    };
    let velocity_m_s = mean_velocity(outcome).filter(|u| outcome.status == Status::Done && *u < -AT_REST * scale)?;
    Some(SolveError::FlowsUphill { velocity_m_s, over_s, hint })
}

/// Mean velocity of the fluid over its height [m/s]: as reported, from its discharge, or from its profile.
fn mean_velocity(outcome: &Outcome) -> Option<f64> {
    let result = |quantity: &q::Quantity| outcome.results.get(quantity.name);
    let discharge = || Some(result(&q::FLUID_DISCHARGE)? / result(&q::FLOW_HEIGHT)?);
    result(&q::MEAN_VELOCITY).or_else(discharge).or_else(|| over_height(outcome.profile.as_ref()?))
}

/// Mean of the velocity of the mixture between the lowest and the highest level, by the trapezoidal rule [m/s].
fn over_height(profile: &Profile) -> Option<f64> {
    let (z, u) = (profile.axis(), profile.get(&q::U_MIXTURE)?);
    let known: Vec<(f64, f64)> = z.iter().zip(u).filter_map(|(z, u)| Some((*z, (*u)?))).collect();
    let height = known.last()?.0 - known.first()?.0;
    let sum: f64 = known.windows(2).map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1)).sum();
    (height > 0.0).then(|| sum / height)
}

/// The equations that are solved, with the numbers of `problem` filled in.
#[must_use]
pub fn equations(problem: &Problem) -> String {
    match &problem.model {
        Model::Ouriemi(bed) => ouriemi::equations(bed),
        Model::BinghamPlane(plane) => bingham::equations(plane),
        Model::BagnoldFilm(film) => bagnold::equations(film),
        Model::LogLaw(wall) => log_law::equations(wall),
        Model::Laminar(bed) => laminar::equations(bed),
        Model::Bingham(plane) => laminar::bingham_equations(plane),
        Model::SheetFlow(flow) => sheet_flow::equations(flow),
        Model::TwoFluid(flow) => two_fluid::equations(flow),
        Model::ShearCell(cell) => shear_cell::equations(cell),
        Model::Duct(flow) => section::equations(flow),
        Model::Cavity(flow) => section::cavity_equations(flow),
        Model::Grains(bed) => grain_bed::equations(bed),
        Model::Coupled(flow) => couple::equations(flow),
        Model::Impact(one) => impact::equations(one),
        Model::Trial(trial) => trials::equations(trial),
    }
}

/// The laws in those equations.
#[must_use]
pub fn closures(problem: &Problem) -> Vec<&'static Info> {
    match &problem.model {
        Model::Ouriemi(bed)
        | Model::Laminar(RegularisedBed { bed, .. })
        | Model::Duct(DuctFlow { contents: Contents::Bed(bed), .. }) => {
            let friction = if bed.rise.is_some() { &friction::mu_iv::INFO } else { &friction::coulomb::INFO };
            let mut laws = vec![friction, bed.viscosity.info()];
            laws.extend(bed.drag.map(|_| &carman_kozeny::INFO));
            laws.extend(bed.dilatancy.map(|_| &phi_iv::INFO));
            laws
        }
        Model::TwoFluid(flow) => {
            let mut laws = vec![flow.granular.info()];
            laws.extend(flow.granular.parts());
            laws.extend([flow.elastic.info(), flow.static_friction.info(), &dallavalle_grain::INFO]);
            laws.extend([flow.mixing_length.info(), flow.dispersion.info()]);
            laws
        }
        Model::ShearCell(cell) => {
            let mut laws = vec![cell.granular.info()];
            laws.extend(cell.granular.parts());
            laws
        }
        Model::BinghamPlane(_) | Model::Bingham(_) | Model::Duct(_) | Model::Cavity(_) => Vec::new(),
        Model::Grains(_) | Model::Impact(_) | Model::Trial(_) => vec![&linear_spring::INFO],
        Model::Coupled(flow) => vec![
            &linear_spring::INFO,
            &dallavalle_grain::INFO,
            flow.mixing_length.info(),
            flow.viscosity.info(),
            flow.side_wall.info(),
            flow.fluctuation.info(),
        ],
        Model::BagnoldFilm(_) => vec![&friction::mu_i::INFO],
        Model::SheetFlow(flow) => vec![
            &friction::mu_i::INFO,
            &phi_i::INFO,
            flow.rearrangement.info(),
            flow.viscosity.info(),
            &dallavalle::INFO,
            &mixing_length::li_sawamoto::INFO,
            flow.suspension.info(),
            flow.lid.info(),
        ],
        Model::LogLaw(_) => vec![&mixing_length::prandtl::INFO, &wall::rough::INFO],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;
    use crate::result::Quiet;

    fn problem(case: &str, sets: &[&str]) -> Problem {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Problem::new(&Case::load(case, &sets).unwrap()).unwrap()
    }

    #[test]
    fn a_mean_flow_against_a_steady_drive_is_a_failure_and_a_wave_is_none() {
        let steady = problem("sheet_1d_theta06", &[]);
        let mut outcome = run(&steady, &mut Quiet).unwrap();
        assert!(mean_velocity(&outcome).unwrap() > 0.5, "{:?}", mean_velocity(&outcome));
        assert_eq!(uphill(&steady.model, &outcome), None);
        let column = |sign: f64| {
            let profile = outcome.profile.as_ref().unwrap();
            let mut turned = Profile::new(profile.axis()).unwrap();
            let u = profile.get(&q::U_MIXTURE).unwrap();
            turned.push(&q::U_MIXTURE, u.iter().map(|u| u.map(|u| sign * u)).collect()).unwrap();
            turned
        };
        let (turned, kept) = (column(-1.0), column(1.0));
        outcome.profile = Some(kept);
        assert_eq!(uphill(&steady.model, &outcome), None);
        outcome.profile = Some(turned);
        let error = uphill(&steady.model, &outcome).unwrap();
        assert_eq!(error.code(), "flows-uphill");
        assert!(error.to_string().contains("against the drive"), "{error}");
        // A discharge stands before a profile.
        outcome.results.set(&q::FLUID_DISCHARGE, -0.25 * outcome.results.get(q::FLOW_HEIGHT.name).unwrap());
        for (case, at) in
            [("kinetic_1d_start", Some("at t = ")), ("kinetic_1d_theta06", Some("-0.25")), ("kinetic_1d_waves", None)]
        {
            let message = uphill(&problem(case, &[]).model, &outcome).map(|error| error.to_string());
            assert_eq!(message.is_some(), at.is_some(), "{case}: {message:?}");
            assert!(message.unwrap_or_default().contains(at.unwrap_or_default()), "{case}");
        }
        // A run that was stopped is judged by nobody.
        outcome.status = Status::Stopped;
        assert_eq!(uphill(&steady.model, &outcome), None);
    }
}
