//! Where no first guess leads to a flow: the drive falls from a stronger flow, or rises from a weaker one, each solution from the one
//! before. So a flow near its edge is found, and where there is none, the edge says why: below it no layer of grains moves, above it
//! all of them do.
//!
//! With the exact yield the layer ends in a fold: under a drive that falls, thickness and rate go like the root of what is left, and below
//! no layer balances. Creep rounds the fold by less than a thousandth of the drive.

use super::bed::State;
use super::cold::{CARRIED, Exact, Solved, deepen, direct};
use super::column::{Floor, Setting};
use super::flow::Flow;
use super::layers::Layers;
use super::newton::{Column, NotConverged};
use crate::closures::friction::FrictionLaw;

/// Drives from which a flow is followed down to the wanted one, and up to it, over it.
const STRONGER: [f64; 8] = [1.1, 1.3, 1.7, 2.4, 3.5, 6.0, 10.0, 16.0];
const WEAKER: [f64; 3] = [0.95, 0.8, 0.6];
/// First and smallest step of the logarithm of the drive.
const WALK: (f64, f64) = (0.04, 1e-4);
/// Iterations after which no other start is tried.
const MOST_ITERATIONS: usize = 8000;
/// A layer thinner than this many grains is none.
const ONE_GRAIN: f64 = 1.0;
/// A layer at whose edge it is no thicker than this many grains ends there.
const ABOUT_ONE: f64 = 1.3;

/// What following the flow over its drive found.
pub enum Found<F> {
    /// the flow
    Flow(Box<Solved<F>>),
    /// no layer of grains moves below this share of the wanted drive, more than 1
    NoLayer(f64),
    /// all grains move above this share of the wanted drive, less than 1
    AllMove(f64),
    /// no flow to start from
    Nothing,
}

/// A flow on the way: column, solution, depth of the change of type, logarithm of its drive over the wanted one.
type Stage<F> = (Exact<F>, f64);

impl Setting {
    /// The same under `factor` times the drive.
    fn driven(&self, factor: f64) -> Self {
        Self { tau_b: self.tau_b.map(|tau_b| tau_b * factor), sine: self.sine.map(|sine| sine * factor), ..*self }
    }
}

/// Looks for the flow from stronger and weaker ones.
pub fn follow<F: FrictionLaw>(flow: Flow<F>, setting: Setting, cells: usize, history: &mut Vec<f64>) -> Found<F> {
    let first = history.len();
    for factor in STRONGER {
        if history.len() > first + MOST_ITERATIONS {
            break;
        }
        let Ok(start) = direct(flow, setting.driven(factor), cells, history) else { continue };
        let ((column, state, change_of_type), at) = walk(&flow, setting, (start.clone(), factor.ln()), history);
        if at <= 0.0 && flow.lambda == 0.0 {
            return Found::Flow(Box::new(Solved {
                column,
                state,
                exact: None,
                history: history.clone(),
                change_of_type,
                edge: None,
            }));
        }
        // At the edge the layer is down to a grain; a method that ends before that says nothing.
        let ends = thickness(&column, &state).is_some_and(|thickness| thickness < ABOUT_ONE);
        let (least, (column, state, depth)) = (at, start);
        let lambda = flow.lambda.max(flow.creep);
        let Ok((column, state, _)) = column.creep(&state, lambda, history) else {
            if ends {
                return Found::NoLayer(least.exp());
            }
            continue;
        };
        let start = ((column, state, depth), factor.ln());
        let ((column, state, change_of_type), at) = walk(&flow, setting, start, history);
        if at > 0.0 && ends {
            return Found::NoLayer(least.exp());
        }
        if at > 0.0 {
            continue;
        }
        let edge = (least > 0.0).then(|| least.exp() * state.tau_b);
        return Found::Flow(Box::new(Solved {
            column,
            state,
            exact: None,
            history: history.clone(),
            change_of_type,
            edge,
        }));
    }
    for factor in WEAKER {
        let Ok(start) = direct(flow, setting.driven(factor), cells, history) else { continue };
        let ((column, state, change_of_type), at) = walk(&flow, setting, (start, factor.ln()), history);
        if at < 0.0 {
            // Near the bottom, or at the end of the method?
            return if state.rest < NEARLY * (state.m + state.rest) {
                Found::AllMove(at.exp())
            } else {
                Found::Nothing
            };
        }
        if flow.lambda == 0.0 {
            return Found::Flow(Box::new(Solved {
                column,
                state,
                exact: None,
                history: history.clone(),
                change_of_type,
                edge: None,
            }));
        }
        break;
    }
    Found::Nothing
}

/// All grains move where less than this share of them is left at rest at the end of the way.
const NEARLY: f64 = 0.05;

/// Follows a flow to the wanted drive, or as far as there is one.
fn walk<F: FrictionLaw>(flow: &Flow<F>, setting: Setting, start: Stage<F>, history: &mut Vec<f64>) -> Stage<F> {
    let ((mut column, mut state, mut depth), mut at) = start;
    let (sign, mut step) = (at.signum(), WALK.0);
    while at * sign > 0.0 && step >= WALK.1 {
        let to = sign * (at * sign - step).max(0.0);
        let mut next = column.clone();
        next.setting = setting.driven(to.exp());
        // A cut that was deeper at first may have to stay so.
        let found = deepen(&mut next, flow.cut, depth, state.clone(), history).or_else(|_| {
            next.flow = column.flow;
            deepen(&mut next, column.flow.cut, depth, state.clone(), history)
        });
        match found {
            Ok((found, deep)) if is_layer(&next, &found) => (column, state, depth, at) = (next, found, deep, to),
            Ok(_) | Err(NotConverged { .. }) => step *= 0.5,
        }
    }
    ((column, state, depth), at)
}

/// Whether a solution has a layer of moving grains over grains at rest. Grains that creep have one where its thickness is defined.
fn is_layer<F: FrictionLaw>(column: &Column<F>, state: &State) -> bool {
    let exact = column.floor == Floor::Yield;
    let rests = !exact || (state.rest > 0.0 && column.carried(state) >= CARRIED);
    rests && thickness(column, state).is_some_and(|thickness| thickness >= ONE_GRAIN)
}

/// Thickness of the moving layer in grains; `None` where all of the bed is looser than at rest.
fn thickness<F: FrictionLaw>(column: &Column<F>, state: &State) -> Option<f64> {
    let layers = Layers::new(column, state);
    layers.sheet(&column.flow).map(|sheet| layers.z[0] - sheet.bottom)
}

/// Whether a solution with the exact yield moves less than one layer of grains, which is none.
pub fn too_thin<F: FrictionLaw>(column: &Column<F>, state: &State) -> bool {
    column.floor == Floor::Yield && thickness(column, state).is_some_and(|thickness| thickness < ONE_GRAIN)
}

impl<F: FrictionLaw> Solved<F> {
    /// Largest relative change of the transport rate `psi` between the cut of the run, the least one that the change of type
    /// allows, and twice the cut; `None` if neither leads to a solution.
    #[must_use]
    pub fn cut_effect(&self, psi: f64) -> Option<f64> {
        let cut = self.column.flow.cut;
        let effect = |cut: f64| {
            let mut column = self.column.clone();
            let (state, _) = deepen(&mut column, cut, self.change_of_type, self.state.clone(), &mut Vec::new()).ok()?;
            is_layer(&column, &state).then(|| (Layers::new(&column, &state).psi() / psi - 1.0).abs())
        };
        [effect(0.0), effect(2.0 * cut)].into_iter().flatten().reduce(f64::max)
    }
}
