//! Ouriemi's bed in SI: profile, numbers, balances, and the equations with their numbers.

use super::{Scaled, Solution, solve};
use crate::closures::drag::{CarmanKozeny, carman_kozeny};
use crate::closures::friction::coulomb;
use crate::closures::mixture_viscosity::RelativeViscosity;
use crate::models::exact::bed::{Drive, LaminarBed};
use crate::models::exact::bed_results::BedNumbers;
use crate::models::exact::{Column, balance, outcome, tabulate};
use crate::numerics::levels::{between_walls, graded};
use crate::numerics::quadrature::simpson;
use crate::result::{Balance, Failure, Outcome, Watch, quantity as q};
use crate::units::{significant, stated};

/// Evaluates the closed form for `bed` on about `cells` levels.
///
/// # Errors
/// As [`super::solve`].
pub fn run(bed: &LaminarBed, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    let mut history = Vec::new();
    let solution = solve(bed, |r| history.push(r))?;
    let profile = tabulate(levels(&solution, bed, cells), &columns(&solution, bed), watch)?;
    let numbers = numbers(&solution, bed.phi);
    outcome(profile, history, numbers.results(bed), balances(&solution), numbers.validity(bed))
}

/// The walls and the centres of cells \[m] whose faces lie on the yield level and the bed level, so that no level lies on a
/// jump; fine where the seepage of the two-fluid form meets the wall and the yield level.
fn levels(solution: &Solution, bed: &LaminarBed, cells: usize) -> Vec<f64> {
    let Scaled { h_p, k, e, .. } = solution.scaled;
    let finest = k.map_or(f64::INFINITY, |k| 0.25 * (k * e).sqrt());
    let mobile = if solution.moves() { cells / 4 } else { 0 };
    let still = cells / 2 - mobile;
    let (wall, middle) = (still / 2, 0.5 * solution.h_c);
    let mut faces: Vec<f64> = graded(0.0, middle, wall, finest).into_iter().rev().map(|z| middle - z).collect();
    let mut extend = |a: f64, b: f64, n: usize, finest: f64| faces.extend(graded(a, b, n, finest).into_iter().skip(1));
    extend(middle, solution.h_c, still - wall, finest);
    if mobile > 0 {
        extend(solution.h_c, h_p, mobile, f64::INFINITY);
    }
    extend(h_p, 1.0, cells - still - mobile, f64::INFINITY);
    between_walls(&faces).into_iter().map(|z| z * bed.h).collect()
}

fn columns<'a>(solution: &'a Solution, bed: &'a LaminarBed) -> Vec<Column<'a>> {
    let (h, stress, velocity) = (bed.h, bed.stress_scale(), bed.velocity_scale());
    let in_bed = move |z: f64| z <= bed.h_p;
    let fluid = move |z: f64| {
        let mixture = solution.mixture(z / h);
        velocity * if in_bed(z) { (mixture - bed.phi * solution.particle(z / h)) / (1.0 - bed.phi) } else { mixture }
    };
    let grains = move |value: f64, z: f64| in_bed(z).then_some(value);
    let pressure = move |z: f64| bed.phi * (bed.h_p - z) / h * stress;
    let mut columns: Vec<Column<'a>> = vec![
        (&q::PHI, Box::new(move |z| Some(if in_bed(z) { bed.phi } else { 0.0 }))),
        (&q::U_FLUID, Box::new(move |z| Some(fluid(z)))),
        (&q::U_PARTICLE, Box::new(move |z| grains(velocity * solution.particle(z / h), z))),
        (&q::U_MIXTURE, Box::new(move |z| Some(velocity * solution.mixture(z / h)))),
        (
            &q::FLUX,
            Box::new(move |z| Some(if in_bed(z) { bed.phi * velocity * solution.particle(z / h) } else { 0.0 })),
        ),
        (&q::TAU_VISCOUS, Box::new(move |z| Some(stress * solution.fluid_stress(z / h)))),
        (
            &q::TAU_PARTICLE,
            Box::new(move |z| Some(if in_bed(z) { stress * solution.particle_stress(z / h) } else { 0.0 })),
        ),
        (&q::P_PARTICLE, Box::new(move |z| Some(if in_bed(z) { pressure(z) } else { 0.0 }))),
        (&q::SHEAR_RATE, Box::new(move |z| grains(velocity / h * solution.shear_rate(z / h), z))),
    ];
    if bed.drag.is_none() {
        // One velocity: the phases are not told apart.
        columns.retain(|(quantity, _)| ![q::U_FLUID.name].contains(&quantity.name));
    }
    columns
}

/// The numbers that the closed form comes down to.
fn numbers(solution: &Solution, phi: f64) -> BedNumbers {
    let Scaled { f, h_p, .. } = solution.scaled;
    BedNumbers {
        f,
        flux: phi * solution.flux(),
        phi_interface: phi,
        discharge: solution.discharge(),
        tau: solution.tau_interface,
        h_c: solution.h_c,
        largest: solution.largest_velocity(),
        slip: if solution.moves() { solution.slip() } else { solution.mixture(h_p) },
        shear: solution.shear_rate(h_p),
    }
}

fn balances(solution: &Solution) -> Vec<Balance> {
    let Scaled { f, h_p, .. } = solution.scaled;
    let walls = solution.fluid_stress(0.0) + solution.particle_stress(0.0) - solution.fluid_stress(1.0);
    let mut balances =
        vec![balance("momentum", walls / f - 1.0, "stress at the two walls against the drive over the height")];
    if solution.moves() {
        let integral = simpson(|z| solution.particle(z), solution.h_c, h_p, 8);
        let how = "Simpson integral of the grain velocity against the closed form";
        balances.push(balance("transport_rate", integral / solution.flux() - 1.0, how));
    }
    balances
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(bed: &LaminarBed) -> String {
    let n = |x: f64| significant(x, 5);
    let (e, resistance) = (bed.viscosity.relative(bed.phi), bed.friction.stress(bed.phi));
    let weight = (bed.rho_p - bed.rho_f) * bed.g;
    let h_p = bed.h_p / bed.h;
    let drive = match bed.drive {
        Drive::PressureGradient(p) => format!("f = -dp/dx/((ρ_p - ρ_f) g) = {}", n(p / weight)),
        Drive::Wanted(what, value) => what.equation(value),
    };
    let mut text = format!(
        "Newtonian fluid over a Coulomb bed between two planes, {form} form.\n\n\
         units              H = {h} m,  (ρ_p - ρ_f) g H = {stress} Pa,  (ρ_p - ρ_f) g H²/η = {velocity} m/s\n\
         drive              {drive}\n\
         particle pressure  P_p = φ (h_p - z),  φ = {phi},  h_p = {h_p}\n\
         friction           {friction} where the grains shear,  μ_s φ = {resistance}\n\
         viscosity          {viscosity},  e = η_e/η = {e}\n\n\
         clear fluid  h_p < z < 1     U'' + f = 0,  U(1) = 0\n",
        form = bed.form_name(),
        h = n(bed.h),
        stress = n(bed.stress_scale()),
        velocity = n(bed.velocity_scale()),
        phi = n(bed.phi),
        h_p = n(h_p),
        friction = coulomb::INFO.equation,
        resistance = n(resistance),
        viscosity = viscosity_text(bed),
        e = n(e),
    );
    if let Some(law) = bed.drag {
        let k = law.permeability(bed.phi, bed.d / bed.h);
        text += &format!(
            "mobile bed   h_c < z < h_p   e U'' + f - μ_s φ = 0,  U - u_p = K μ_s φ = {slip}\n\
             static bed   0 < z < h_c     e U'' + f - U/K = 0,  u_p = 0,  U(0) = 0\n\
             drag         {drag}\n\
             yield level  h_c from K μ_s φ + s Y + B Y²/2 + e (s + B Y) D - f D²/2 = 0,\n\
             \u{20}            s = U'(h_c) of the static layer,  Y = h_p - h_c,  D = 1 - h_p = {d},\n\
             \u{20}            B = (μ_s φ - f)/e\n\
             flux         q_p = φ (s Y²/2 + B Y³/6);  no grain moves while U(h_p) < K μ_s φ\n",
            slip = n(k * resistance),
            drag = drag_text(bed, law),
            d = n(1.0 - h_p),
        );
    } else {
        text += &format!(
            "mobile bed   h_c < z < h_p   e U'' + f - μ_s φ = 0\n\
             static bed   0 < z < h_c     U = 0\n\
             yield level  Y = h_p - h_c = D (-e + sqrt(e² + f/B)),  B = (μ_s φ - f)/e,  D = 1 - h_p = {d}\n\
             flux         q_p = φ B Y³/6\n",
            d = n(1.0 - h_p),
        );
    }
    text
}

/// The law of the viscosity, with its constants.
pub(in crate::models) fn viscosity_text(bed: &LaminarBed) -> String {
    stated(bed.viscosity.info().equation, &bed.viscosity.constants())
}

/// The law of the drag, with the permeability of the bed that it gives.
pub(in crate::models) fn drag_text(bed: &LaminarBed, law: CarmanKozeny) -> String {
    let n = |x: f64| significant(x, 5);
    let k = law.permeability(bed.phi, bed.d / bed.h);
    format!(
        "{},  ε = 1 - φ,  in these units K = {},  Brinkman length sqrt(K e) = {} d",
        stated(carman_kozeny::INFO.equation, &[("k_CK", law.k_ck, "")]),
        n(k),
        n((k * bed.viscosity.relative(bed.phi)).sqrt() * bed.h / bed.d)
    )
}
