//! One impact, next to its closed form.

use super::case::Target;
use crate::closures::contact::{Tension, restitution};
use crate::dem::body::Nothing;
use crate::dem::domain::{Domain, Wall};
use crate::dem::engine::{Engine, Settings};
use crate::dem::grains::Grain;
use crate::dem::keep::{contact_equations, law};
use crate::models::grains::{Impact, ImpactError};
use crate::result::{Balance, Failure, Outcome, Results, SolveError, Status, Watch, quantity as q};
use crate::units::significant;

/// What an impact was, and what the closed forms say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// time step \[s]
    pub dt: f64,
    /// normal restitution
    pub restitution: f64,
    /// duration of the contact \[s]
    pub duration: f64,
    /// closed form of the duration \[s]
    pub expected_duration: f64,
    /// tangential velocity after, relative to the target, of the centre [m/s]
    pub tangential: f64,
    /// angular velocity after, positive rolling with the motion [1/s]
    pub spin: f64,
    /// tangential velocity by the gross-slip law [m/s]; none where the contact sticks
    pub gross_slip: Option<f64>,
    /// kinetic energy after over before, minus 1
    pub gained: f64,
    /// defect of the energy ledger over the energy before
    pub ledger: f64,
    /// steps made
    pub steps: u64,
}

/// Steps after which an impact that does not end is given up.
const MAX_STEPS: u64 = 2_000_000;

/// Follows one impact.
///
/// # Errors
/// [`SolveError`] if the grains cannot go on, or never part.
pub fn follow(impact: &Impact) -> Result<Found, SolveError> {
    follow_from(impact, 0.1)
}

/// Follows one impact that begins `touch` steps after the start, a share of one.
///
/// # Errors
/// As [`follow`].
pub fn follow_from(impact: &Impact, touch: f64) -> Result<Found, SolveError> {
    let law = law(&impact.contact)?;
    let r = 0.5 * impact.d;
    let (sin, cos) = impact.angle.sin_cos();
    let (u, v) = (impact.velocity * sin, impact.velocity * cos);
    let mut mover = Grain::at_rest([0.0, 0.0, 0.0], r, impact.rho_p);
    let mass = mover.mass();
    let reduced = if impact.target == Target::Mobile { 0.5 * mass } else { mass };
    let frequency = (impact.contact.k_n / reduced).sqrt();
    let expected_duration = restitution::duration(law.zeta, impact.contact.tension) / frequency;
    let dt = expected_duration / impact.steps_per_contact;
    mover.velocity = [u, 0.0, -v];
    // Rolling with the motion along x is a turn about +y.
    mover.spin = [0.0, impact.spin, 0.0];
    let mut domain = Domain::default();
    let mut grains = Vec::new();
    let gap = touch * v * dt;
    if impact.target == Target::Wall {
        domain.walls.push(Wall::through([0.0; 3], [0.0, 0.0, 1.0]));
        mover.position = [0.0, 0.0, r + gap];
    } else {
        let target = Grain::at_rest([0.0, 0.0, -r], r, impact.rho_p);
        grains.push(Grain { fixed: impact.target == Target::Fixed, ..target });
        mover.position = [0.0, 0.0, r + gap];
    }
    grains.push(mover);
    let depth = 2.0 * v / (frequency * r);
    let settings = Settings { largest_overlap: 0.9, ..Settings::new(dt, [0.0; 3], impact.d) };
    if depth > 1.8 {
        return Err(ImpactError::TooDeep { radii: depth }.into());
    }
    let mut engine = Engine::new(&grains, domain, law, settings, 1)?;
    let before = engine.grains().kinetic_energy();
    let (mut met, mut pushed) = (false, 0_u64);
    while engine.steps() < MAX_STEPS {
        // With the tension cut the force ends before the overlap does.
        let pushes = engine.contacts().any(|c| (0..3).map(|k| c.force[k] * c.normal[k]).sum::<f64>() > 0.0);
        let touches = engine.contacts().next().is_some();
        if met && !touches {
            break;
        }
        let counts = if impact.contact.tension == Tension::Kept { touches } else { pushes };
        pushed += u64::from(counts);
        met |= touches;
        engine.step(&Nothing)?;
    }
    if engine.steps() >= MAX_STEPS {
        return Err(ImpactError::NoParting { steps: MAX_STEPS }.into());
    }
    let all = engine.grains();
    let place = all.places();
    let mover = place[grains.len() - 1];
    let other = if impact.target == Target::Mobile { all.velocity(place[0]) } else { [0.0; 3] };
    let after = all.velocity(mover);
    let kinetic = all.kinetic_energy();
    let restitution = (after[2] - other[2]) / v;
    let mu = impact.contact.mu;
    // Gross slip: the tangential impulse is μ times the normal one, m (1 + e) v_n with the reduced mass m, and the relative
    // velocity changes by it over m. The contact point sticks when it has lost 7/2 of that change; three times as far
    // from it the springs play no part.
    let change = mu * (1.0 + impact.contact.e_n) * v;
    let slides = u - r * impact.spin;
    let gross = (slides.abs() > 3.0 * 3.5 * change).then(|| u - slides.signum() * change);
    Ok(Found {
        dt,
        restitution,
        duration: pushed as f64 * dt,
        expected_duration,
        tangential: after[0] - other[0],
        spin: all.spin(mover)[1],
        gross_slip: gross,
        gained: kinetic / before - 1.0,
        ledger: engine.ledger().defect(kinetic) / before,
        steps: engine.steps(),
    })
}

/// Follows the impact of a case.
///
/// # Errors
/// [`Failure`] if the grains cannot go on.
pub fn run(impact: &Impact, _: &mut dyn Watch) -> Result<Outcome, Failure> {
    let found = follow(impact)?;
    let mut results = Results::default();
    results.set(&q::RESTITUTION, found.restitution);
    results.set(&q::RESTITUTION_ERROR, found.restitution / impact.contact.e_n - 1.0);
    results.set(&q::CONTACT_TIME, found.duration);
    results.set(&q::CONTACT_TIME_ERROR, found.duration / found.expected_duration - 1.0);
    results.set(&q::TANGENTIAL_VELOCITY, found.tangential);
    results.set(&q::SPIN_AFTER, found.spin);
    match found.gross_slip {
        Some(expected) => results.set(&q::SLIP_ERROR, (found.tangential - expected) / impact.velocity),
        None => results.undefined(&q::SLIP_ERROR, "the contact does not slip throughout"),
    }
    results.set(&q::ENERGY_GAINED, found.gained);
    results.set(&q::TIME_STEP, found.dt);
    let balances = vec![Balance {
        name: "energy".into(),
        relative: found.ledger,
        how: "kinetic energy against the work of the contact, relative to the energy before".into(),
    }];
    Ok(Outcome {
        status: Status::Done,
        profile: None,
        series: None,
        results,
        balances,
        validity: Vec::new(),
        regularisation: serde_json::Map::new(),
        ..Outcome::stopped()
    })
}

/// The equations that are solved, with their numbers.
#[must_use]
pub fn equations(impact: &Impact) -> String {
    let n = |x: f64| significant(x, 5);
    let contact = &impact.contact;
    format!(
        "Impact of a sphere, d = {} m, ρ_p = {} kg/m³, at {} m/s, {} rad from the normal, on a {}.\n\n{}",
        n(impact.d),
        n(impact.rho_p),
        n(impact.velocity),
        n(impact.angle),
        match impact.target {
            Target::Wall => "wall",
            Target::Fixed => "fixed sphere",
            Target::Mobile => "mobile sphere",
        },
        contact_equations(contact)
    )
}
