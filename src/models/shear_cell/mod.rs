//! Grains that collide between two walls, without fluid or gravity: what is reported of the flow that `flow` solves.

pub mod case;
mod flow;
mod problem;
mod study;

use flow::{Flow, Node, guess};

use super::exact::{balance, outcome};
use crate::closures::kinetic::Stresses;
use crate::closures::kinetic::radial::AtContact;
use crate::result::{Failure, Outcome, Profile, Results, Snapshot, Watch, quantity as q};
use crate::units::significant;
pub use problem::ShearCell;

/// Solves the flow on `cells` intervals.
///
/// # Errors
/// [`NumericalError::NotConverged`](crate::result::NumericalError::NotConverged).
fn run(cell: &ShearCell, cells: usize, watch: &mut dyn Watch) -> Result<Outcome, Failure> {
    if watch.see(&Snapshot { stage: "shear cell", fraction: 0.0, quantity: None }).is_break() {
        return outcome(None, Vec::new(), Results::default(), Vec::new(), Vec::new());
    }
    let flow = guess(cell, cells).solve()?;
    let [work, entering, lost] = flow.energies();
    let scale = work.abs().max(entering.abs()).max(lost.abs()).max(f64::MIN_POSITIVE);
    let solids: f64 = flow.states().windows(2).map(|pair| 0.5 * (pair[0].phi + pair[1].phi)).sum();
    let balances = vec![
        balance("solids", solids / cells as f64 / cell.phi - 1.0, "grains against those that are wanted"),
        balance(
            "fluctuation_energy",
            (work + entering - lost) / scale,
            "work of the shear stress and what enters through the walls, against what contacts dissipate",
        ),
    ];
    let unit = cell.temperature[0].max(cell.temperature[1]);
    let stress = cell.rho_p * unit;
    let mut results = Results::default();
    results.set(&q::WALL_PRESSURE, stress * flow.ln_p.exp());
    results.set(&q::WALL_SHEAR, stress * flow.tau);
    results.set(&q::WALL_HEAT, stress * unit.sqrt() * entering);
    results.set(&q::EFFECTIVE_RESTITUTION, cell.kinetic.e_eff);
    results.set(&q::FLOW_HEIGHT, cell.h);
    results.set(&q::NEWTON_ITERATIONS, flow.history.len() as f64);
    let profile = profile(cell, &flow)?;
    outcome(Some(profile), flow.history, results, balances, Vec::new())
}

fn profile(cell: &ShearCell, flow: &Flow) -> Result<Profile, Failure> {
    let nodes = flow.states();
    let unit = cell.temperature[0].max(cell.temperature[1]);
    let velocity = unit.sqrt();
    let stress = cell.rho_p * unit;
    let mut v = 0.0;
    let mut velocities = vec![cell.velocity[0]];
    for pair in nodes.windows(2) {
        v += flow.between(&pair[0], &pair[1], flow.tau).shear * flow.h;
        velocities.push(cell.velocity[0] + v * velocity);
    }
    let p = stress * flow.ln_p.exp();
    let shear = |node: &Node<f64>| flow.between(node, node, flow.tau).shear.abs() * velocity / cell.d;
    let all = |of: &dyn Fn(&Node<f64>) -> f64| nodes.iter().map(|node| Some(of(node))).collect::<Vec<_>>();
    let mut profile = Profile::new((0..nodes.len()).map(|k| k as f64 * flow.h * cell.d).collect())?;
    profile.push(&q::PHI, all(&|node| node.phi))?;
    profile.push(&q::U_PARTICLE, velocities.into_iter().map(Some).collect())?;
    profile.push(&q::TAU_PARTICLE, all(&|_| stress * flow.tau))?;
    profile.push(&q::P_PARTICLE, all(&|_| p))?;
    profile.push(&q::SHEAR_RATE, all(&shear))?;
    profile.push(&q::INERTIAL_NUMBER, all(&|node| cell.d * shear(node) * (cell.rho_p / p).sqrt()))?;
    profile.push(&q::GRANULAR_TEMPERATURE, all(&|node| node.t * unit))?;
    profile.push(&q::RADIAL, all(&|node| cell.kinetic.radial.contact(node.phi, node.gap, cell.kinetic.a)))?;
    Ok(profile)
}

/// The equations that are solved, with their numbers.
#[must_use]
fn equations(cell: &ShearCell) -> String {
    let n = |x: f64| significant(x, 5);
    let parts: Vec<String> =
        cell.granular.parts().iter().map(|info| format!("              {}\n", info.equation)).collect();
    format!(
        "Grains that collide between two walls {h} m apart, d = {d} m, without fluid or gravity.\n\n\
         pressure      p_kin, the same at every height;  the mean of φ is {phi}\n\
         stress        τ = η u_p', the same at every height\n\
         heat          0 = τ u_p' - q' + Γ,  q = -κ T'\n\
         theory        {theory}\n\
         walls         u_p = {v0} and {v1} m/s,  T = {t0} and {t1} m²/s²\n\
         grains        e = {e}, e_eff = {e_eff};  nothing limits the flight of a grain but the others\n{parts}",
        h = n(cell.h),
        d = n(cell.d),
        phi = n(cell.phi),
        theory = cell.granular.info().equation,
        v0 = n(cell.velocity[0]),
        v1 = n(cell.velocity[1]),
        t0 = n(cell.temperature[0]),
        t1 = n(cell.temperature[1]),
        e = n(cell.kinetic.e),
        e_eff = n(cell.kinetic.e_eff),
        parts = parts.concat(),
    )
}
