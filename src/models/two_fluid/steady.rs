//! The steady flow: a coarse column marches from a guess through pseudo-time until Newton's method takes over, and hands its
//! solution to the wanted column. The equations are those of the transient with a vanishing rate.

use super::face::Mobilised;
use super::newton::{Left, NotConverged, StepControl};
use super::start::Start;
use super::state::{HEAT, LOGIT, Unknowns};
use super::system::{Column, Linear, Memory, carried};

/// Cells on which the march goes, and factors of the thickness of the guess, tried in turn.
const GUESSES: [(usize, f64); 4] = [(80, 1.0), (120, 1.0), (80, 1.6), (120, 0.6)];
/// Drives from which the flow is followed down to the wanted one, over it.
const STRONGER: [f64; 3] = [1.5, 2.5, 4.0];
/// Shields numbers below which a bed is tried at rest first, and below which a stronger flow is tried before the wanted one:
/// near the threshold flows are unstable, and marches do not settle.
pub const WEAK: [f64; 2] = [0.05, 0.35];
/// First, smallest and largest step of pseudo-time, in the time in which grains fall.
const STEPS: [f64; 3] = [0.06, 1e-6, 2e2];
/// Most iterations of one march.
const MAX_ITERATIONS_OF_MARCH: usize = 1300;
/// Iterations after which no other way is tried.
const MAX_ITERATIONS_IN_ALL: usize = 4000;
/// Step control of a step of the march, of the last solution, and of its refinement.
const ROUGH: StepControl = StepControl { tolerance: 1e-2, force: f64::INFINITY, max_iterations: 8 };
const FINE: StepControl = StepControl { tolerance: 1e-8, force: BALANCED, max_iterations: 40 };
/// Force that a cell of a steady flow may miss.
pub const BALANCED: f64 = 1e-8;
/// First and smallest step of the logarithm of the drive.
const WALK: (f64, f64) = (0.05, 1e-3);

/// A steady flow.
#[derive(Clone, Debug)]
pub struct Steady {
    /// its state
    pub state: Vec<Unknowns>,
    /// friction of enduring contacts that is mobilised at each face
    pub mobilised: Vec<Mobilised>,
    /// residuals of the last Newton iterations, of all stages
    pub history: Vec<f64>,
    /// Newton iterations of all stages
    pub iterations: usize,
}

/// The column in fewer cells.
#[must_use]
pub fn coarser(column: &Column, cells: usize) -> Column {
    let cells = cells.min(column.cells());
    Column { widths: column.spacing.widths(cells), ..column.clone() }
}

/// The column in fewer cells with its steady flow, near the steady flow `state` on all of them; `None` if there is none.
#[must_use]
pub fn on_cells(column: &Column, state: &[Unknowns], cells: usize) -> Option<(Column, Vec<Unknowns>)> {
    let coarse = coarser(column, cells);
    let from = coarse.transfer(column, state);
    let (mut iterations, mut history) = (0, Vec::new());
    let settled = settle(&coarse, &mut from.clone(), &mut Linear::new(coarse.cells()), &mut history);
    let state = match settled {
        Ok((state, _)) => state,
        Err(_) => march(&coarse, from, &mut iterations, &mut history, &mut |_| false).ok()?,
    };
    Some((coarse, state))
}

/// How far a march with the step `dt` is, from 0 to 1.
fn share(dt: f64) -> f64 {
    (dt / STEPS[0]).max(1.0).ln() / (STEPS[2] / STEPS[0]).ln()
}

/// One step of backward Euler from `state`.
#[must_use]
pub fn euler(column: &Column, state: &[Unknowns], dt: f64) -> Memory {
    let past = state.iter().map(|x| carried(&column.laws, x).map(|q| -q / dt)).collect();
    Memory { rate: 1.0 / dt, past }
}

/// Follows the flow from `state` until it is steady. `stop` is asked before each step.
///
/// # Errors
/// [`NotConverged`] if the steps become too small or too many.
pub fn march(
    column: &Column,
    mut state: Vec<Unknowns>,
    iterations: &mut usize,
    history: &mut Vec<f64>,
    stop: &mut impl FnMut(f64) -> bool,
) -> Result<Vec<Unknowns>, NotConverged> {
    let mut linear = Linear::new(column.cells());
    let [mut dt, least, most] = STEPS.map(|step| step * column.laws.fall());
    let start = *iterations;
    // Until Newton's method has tried the steady equations, the march is what ends.
    let mut best: Option<NotConverged> = None;
    while *iterations - start < MAX_ITERATIONS_OF_MARCH && dt > least && !stop(share(dt / column.laws.fall())) {
        let mut next = state.clone();
        match column.newton(&mut next, &euler(column, &state, dt), &mut linear, ROUGH) {
            Ok((made, norm)) => {
                *iterations += made;
                history.push(norm);
                state = next;
                if made <= 3 {
                    dt *= 3.0;
                } else if made <= 5 {
                    dt *= 1.5;
                }
            }
            Err(failed) => {
                *iterations += failed.iterations;
                dt *= 0.25;
            }
        }
        if dt > most {
            match settle(column, &mut state.clone(), &mut linear, history) {
                Ok((state, made)) => {
                    *iterations += made;
                    return Ok(state);
                }
                Err(failed) => {
                    *iterations += failed.iterations;
                    best = Some(NotConverged::closer(best, failed));
                    dt *= 0.1;
                }
            }
        }
    }
    let march = NotConverged {
        residual: history.last().copied().unwrap_or(f64::INFINITY),
        iterations: 0,
        left: Left::March(dt / column.laws.fall()),
    };
    Err(NotConverged { iterations: *iterations, ..best.unwrap_or(march) })
}

/// The steady flow near `state`.
fn settle(
    column: &Column,
    state: &mut Vec<Unknowns>,
    linear: &mut Linear,
    history: &mut Vec<f64>,
) -> Result<(Vec<Unknowns>, usize), NotConverged> {
    let (made, norm) = column.newton(state, &Memory::steady(column.cells()), linear, FINE)?;
    history.push(norm);
    Ok((std::mem::take(state), made))
}

/// The steady flow of `column` over a bed of the solid fraction `phi` at rest, driven with the Shields number `shields`.
///
/// # Errors
/// [`NotConverged`] with the smallest residual if no way leads to a steady flow.
pub fn solve(
    column: &Column,
    phi: f64,
    shields: f64,
    mut stop: impl FnMut(f64) -> bool,
) -> Result<Steady, NotConverged> {
    let (mut iterations, mut history) = (0, Vec::new());
    let mut best: Option<NotConverged> = None;
    for (cells, start, factor) in ways(shields) {
        if stop(0.0) || iterations > MAX_ITERATIONS_IN_ALL {
            break;
        }
        let (coarse, driven) = (coarser(column, cells), column.driven(factor));
        let guess = coarse.from(phi, start);
        let found = march(&coarse.driven(factor), guess, &mut iterations, &mut history, &mut stop)
            .and_then(|rough| refine(&driven, &coarse.driven(factor), &rough, &mut iterations, &mut history, &mut stop))
            .and_then(|state| walk(column, state, factor, &mut iterations, &mut history, &mut stop));
        match found {
            Ok(mut state) => {
                // Once more, for the friction of the contacts at rest.
                let mut linear = Linear::new(column.cells());
                let (state, made) = settle(column, &mut state, &mut linear, &mut history)?;
                return Ok(Steady { state, mobilised: linear.mobilised, history, iterations: iterations + made });
            }
            Err(failed) => best = Some(NotConverged::closer(best, failed)),
        }
    }
    let untried = NotConverged { residual: f64::INFINITY, iterations, left: Left::Residual };
    Err(NotConverged { iterations, ..best.unwrap_or(untried) })
}

/// Where to start from, in turn: cells of the march, its first state, and the drive over the wanted one.
fn ways(shields: f64) -> Vec<(usize, Start, f64)> {
    let layer = |(cells, thickness): (usize, f64), factor: f64| {
        (cells, Start::Layer { shields: shields * factor, thickness }, factor)
    };
    let straight = layer(GUESSES[0], 1.0);
    let rest = (GUESSES[0].0, Start::Rest, 1.0);
    let others = GUESSES[1..].iter().map(|guess| layer(*guess, 1.0));
    let mut ways = Vec::new();
    if shields < WEAK[0] {
        ways.extend([rest, straight]);
    } else {
        let mut above: Vec<_> = STRONGER.into_iter().map(|factor| layer(GUESSES[0], factor)).collect();
        // From the first flow that is not weak itself.
        above.sort_by_key(|(_, _, factor)| shields * factor < WEAK[1]);
        let first = if shields < WEAK[1] { above.len() } else { 0 };
        above.insert(first, straight);
        ways.append(&mut above);
        ways.push(rest);
    }
    ways.extend(others);
    ways
}

impl Column {
    /// The same column under `factor` times the drive.
    #[must_use]
    pub fn driven(&self, factor: f64) -> Self {
        let mut driven = self.clone();
        driven.laws.drive = self.laws.drive.map(|drive| drive * factor);
        driven
    }
}

/// From the solution `rough` on the column `coarse` to that on `column`.
fn refine(
    column: &Column,
    coarse: &Column,
    rough: &[Unknowns],
    iterations: &mut usize,
    history: &mut Vec<f64>,
    stop: &mut impl FnMut(f64) -> bool,
) -> Result<Vec<Unknowns>, NotConverged> {
    if coarse.widths == column.widths {
        return Ok(rough.to_vec());
    }
    // Cells at most doubled at a time: what lies between is close enough for Newton's method.
    let next = if column.cells() > 2 * coarse.cells() { coarser(column, 2 * coarse.cells()) } else { column.clone() };
    let from = next.transfer(coarse, rough);
    let mut linear = Linear::new(next.cells());
    let state = match settle(&next, &mut from.clone(), &mut linear, history) {
        Ok((state, made)) => {
            *iterations += made;
            state
        }
        Err(failed) => {
            *iterations += failed.iterations;
            march(&next, from, iterations, history, stop)?
        }
    };
    refine(column, &next, &state, iterations, history, stop)
}

/// From the flow under `stronger` times the drive down to that of the column, along its line through the last two.
fn walk(
    column: &Column,
    mut state: Vec<Unknowns>,
    stronger: f64,
    iterations: &mut usize,
    history: &mut Vec<f64>,
    stop: &mut impl FnMut(f64) -> bool,
) -> Result<Vec<Unknowns>, NotConverged> {
    let mut linear = Linear::new(column.cells());
    let (mut at, mut step) = (stronger.ln(), WALK.0);
    let mut before: Option<(f64, Vec<Unknowns>)> = None;
    while at > 0.0 {
        let to = (at - step).max(0.0);
        let mut next = state.clone();
        if let Some((then, old)) = &before {
            let share = (to - at) / (at - then);
            for (x, old) in next.iter_mut().zip(old) {
                for k in LOGIT..=HEAT {
                    x[k] += share * (x[k] - old[k]);
                }
            }
            column.accumulate(&mut next);
        }
        match settle(&column.driven(to.exp()), &mut next, &mut linear, history) {
            Ok((found, made)) => {
                *iterations += made;
                before = Some((at, std::mem::replace(&mut state, found)));
                at = to;
                step *= if made <= 6 { 1.5 } else { 1.0 };
            }
            Err(failed) => {
                *iterations += failed.iterations;
                step *= 0.5;
                if step < WALK.1 || stop(0.0) {
                    return Err(failed);
                }
            }
        }
    }
    Ok(state)
}
