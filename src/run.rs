//! From a problem to an outcome: the one entry point that the command line and every study call.

use crate::closures::contact::linear_spring;
use crate::closures::dilatancy::{phi_i, phi_iv};
use crate::closures::drag::{carman_kozeny, dallavalle, dallavalle_grain};
use crate::closures::{Info, friction, mixing_length, wall};
use crate::continuum::exact::{bagnold, bingham, log_law, ouriemi};
use crate::continuum::{laminar, shear_cell, sheet_flow, two_fluid};
use crate::discrete::{bed as grain_bed, couple, impact, trials};
use crate::problem::{Contents, DuctFlow, Model, Problem, RegularisedBed};
use crate::result::{Failure, Outcome, Watch};
use crate::section;

/// Relative residual of a balance from which on a closed form has lost its digits: its value is round-off otherwise.
const LARGEST_IMBALANCE: f64 = 1e-3;

/// Solves `problem`. `watch` sees the progress and may ask to stop; it cannot change the result.
///
/// # Errors
/// [`Failure`]: why the method failed, with the numbers that say so and the last good state. A result that is not a
/// finite number is a failure, too, and so is a balance that does not close.
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
    outcome?.trusted(LARGEST_IMBALANCE)
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
