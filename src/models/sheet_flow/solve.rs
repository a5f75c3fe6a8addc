//! From nothing to the solution: from first guesses, from flows under other drives, or by some steps of the iteration, which is slow
//! and goes where Newton does not.

use super::cold::{BEYOND, CARRIED, GUESSES, REST, ROUNDING, Solved, coarse, refine};
use super::column::Setting;
use super::continuation::{Found, follow, too_thin};
use super::flow::Flow;
use super::iteration::StepControl;
use super::newton::{Column, NotConverged, Reason};
use crate::closures::friction::FrictionLaw;

/// Solves the column on `cells` cells.
///
/// # Errors
/// [`NotConverged`] with the smallest residual if no way leads to a solution.
pub fn solve<F: FrictionLaw>(flow: Flow<F>, setting: Setting, cells: usize) -> Result<Solved<F>, NotConverged> {
    let mut history = Vec::new();
    let mut last = NotConverged::new(f64::INFINITY, 0);
    for guess in GUESSES.into_iter().map(Some).chain([None]) {
        if guess.is_none() {
            // Where everything seems to move, another guess may know better; other drives and the iteration do not.
            if matches!(last.reason, Some(Reason::AllMove(_))) {
                break;
            }
            match follow(flow, setting, cells, &mut history) {
                Found::Flow(solved) => return Ok(*solved),
                Found::NoLayer(least) => last.reason = Some(Reason::NoLayer(least)),
                Found::AllMove(most) => last.reason = Some(Reason::AllMove(Some(most))),
                Found::Nothing => {}
            }
            if last.reason.is_some() {
                break;
            }
        }
        let attempt = coarse(flow, setting, guess, cells, &mut history)
            .and_then(|from| refine(flow, setting, cells, &from, &mut history));
        match attempt {
            Ok((_, state, _)) if state.rest < 0.0 => {
                last = NotConverged { reason: Some(Reason::AllMove(None)), ..NotConverged::new(0.0, history.len()) };
            }
            Ok((column, state, _)) if column.carried(&state) < CARRIED => {
                let reason = last.reason.or(Some(Reason::Jammed(column.carried(&state))));
                last = NotConverged { reason, ..NotConverged::new(0.0, history.len()) };
            }
            // Less than a layer of grains is none; where one begins, following the flow says.
            Ok((column, state, _)) if too_thin(&column, &state) => {}
            Ok((column, state, change_of_type)) if flow.lambda == 0.0 => {
                return Ok(Solved { column, state, exact: None, history, change_of_type, edge: None });
            }
            Ok((column, state, change_of_type)) => {
                let (column, state, exact) = column.creep(&state, flow.lambda, &mut history)?;
                return Ok(Solved { column, state, exact, history, change_of_type, edge: None });
            }
            Err(failed) => {
                let open = match last.reason {
                    None => failed.residual < last.residual || failed.reason.is_some(),
                    Some(Reason::Jammed(_)) => failed.reason.is_some(),
                    Some(_) => false,
                };
                if open {
                    last = failed;
                }
                if let Some(Reason::RunsAway(_)) = failed.reason {
                    return Err(NotConverged { iterations: history.len(), ..failed });
                }
            }
        }
    }
    Err(NotConverged { iterations: history.len(), ..last })
}

/// Iterates the column on `cells` cells from a first guess, with a cut as deep as it turns out to be needed.
///
/// # Errors
/// As [`Column::iterate`].
pub fn iterate<F: FrictionLaw>(
    flow: Flow<F>,
    setting: Setting,
    cells: usize,
    control: &StepControl,
    mut stop: impl FnMut(usize, f64) -> bool,
) -> Result<Solved<F>, NotConverged> {
    let mut history = Vec::new();
    let (mut column, guess) = Column::start(flow, setting, cells, REST);
    let mut state = column.iterate(guess, control, &mut history, &mut stop)?;
    let mut change_of_type = column.change_of_type(&state);
    while BEYOND * change_of_type > column.flow.cut * (1.0 + ROUNDING) {
        column.flow.cut = BEYOND * change_of_type;
        state = column.iterate(state, control, &mut history, &mut stop)?;
        change_of_type = column.change_of_type(&state);
    }
    // Where a flow has a moving layer, its grains carry mu_s P_p and more; in jammed ones they carry none.
    let yields = (0..column.mesh.cells()).any(|c| state.r(c) > column.flow.friction.least());
    if !yields {
        return Err(NotConverged {
            reason: Some(Reason::Jammed(column.carried(&state))),
            ..NotConverged::new(0.0, history.len())
        });
    }
    Ok(Solved { column, state, exact: None, history, change_of_type, edge: None })
}
