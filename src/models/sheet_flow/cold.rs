//! The flow from a first guess: a coarse mesh first, without the term that makes the equations change type; then the wanted mesh with
//! it; then the regularisation.

use super::bed::{STRIDE, State};
use super::column::{Floor, Setting};
use super::flow::Flow;
use super::iteration::StepControl;
use super::mesh::Mesh;
use super::newton::{Column, NotConverged, Reason};
use super::start::{Guess, TOP, mobile_volume};
use crate::closures::friction::{FrictionLaw, MuI};
use crate::models::sheet_flow::BedLevel;

/// A coarse mesh and the first guess on it.
#[derive(Clone, Copy)]
pub(super) struct CoarseGuess {
    floor: Floor,
    cells: usize,
    /// share of the range of the friction at which the grains shear
    friction: f64,
}

impl CoarseGuess {
    const fn new(floor: Floor, cells: usize, friction: f64) -> Self {
        Self { floor, cells, friction }
    }

    /// The column on this mesh, of `cells` cells at most, with its state.
    fn start<F: FrictionLaw>(self, flow: Flow<F>, setting: Setting, cells: usize) -> (Column<F>, State) {
        let Self { floor, cells: own, friction } = self;
        Column::start(flow, setting, own.min(cells), Guess { floor, friction, mobile: None })
    }
}

/// Tried in turn: on meshes of the moving grains, then on those of the whole bed, where the yield level finds itself.
pub(super) const GUESSES: [CoarseGuess; 10] = [
    CoarseGuess::new(Floor::Yield, 60, 0.8),
    CoarseGuess::new(Floor::Yield, 60, 0.9),
    CoarseGuess::new(Floor::Bottom, 80, 0.8),
    CoarseGuess::new(Floor::Bottom, 80, 0.9),
    CoarseGuess::new(Floor::Bottom, 80, 0.6),
    CoarseGuess::new(Floor::Bottom, 50, 0.8),
    CoarseGuess::new(Floor::Bottom, 120, 0.8),
    CoarseGuess::new(Floor::Bottom, 120, 0.5),
    CoarseGuess::new(Floor::Bottom, 200, 0.7),
    CoarseGuess::new(Floor::Bottom, 160, 0.9),
];
/// The first guess of the iteration.
pub const REST: Guess = Guess { floor: Floor::Bottom, friction: 0.8, mobile: None };
/// I_0 and b that are easy, and the steps from there to those of the flow.
const EASY: (f64, f64) = (0.3, 0.75);
const EASING: u8 = 6;
/// All of a bed may move if the balance of the moving layer estimates this share of its grains to.
const CREDIBLE: f64 = 0.4;
/// Relative residual at which a coarse solution is good enough to start from.
const ROUGH: f64 = 1e-5;
/// Smallest share of the stress that grains carry where they come to rest, in a solution that is one of the flow: there it is
/// 0.94 and more, and in spurious ones, where the viscosity of packed grains carries the rest, below 0.01.
pub const CARRIED: f64 = 0.5;
/// A cut that is short by less than this share is long enough.
pub(super) const ROUNDING: f64 = 0.02;
/// The cut lies this far below the change of type.
pub const BEYOND: f64 = 1.2;
/// Slip of the first guess in grains that creep, in units of the largest slip.
const SEEPAGE: f64 = 1e-4;
/// Regularisation, scaled, and step control of the iteration where no first guess of Newton's method leads anywhere.
const DETOUR: (f64, StepControl) = (1e-5, StepControl { dt: 1.0, tolerance: 1e-6, max_iterations: 20_000 });
/// Steps in which the bed level rises, as a share of the height above it.
const STEP: f64 = 0.03;
/// Factor between regularisations, where one step from the exact yield is too long.
const LADDER: f64 = 100.0;
/// Smallest rung of that ladder, scaled.
const LOWEST: f64 = 1e-16;

/// A solved column.
#[derive(Clone, Debug)]
pub struct Solved<F = MuI> {
    /// the discrete column; its cut is the one that was used
    pub column: Column<F>,
    /// its solution
    pub state: State,
    /// the solution with the exact yield on the same mesh, where there is a regularisation and it was computed
    pub exact: Option<State>,
    /// residuals, of all stages
    pub history: Vec<f64>,
    /// solid volume under the interface down to which the equations change type
    pub change_of_type: f64,
    /// stress on the bed at which the exact yield ends, where the flow is beyond that
    pub edge: Option<f64>,
}

/// A column with the exact yield, its solution, and the depth of the change of type.
pub type Exact<F> = (Column<F>, State, f64);

/// The exact yield on a coarse mesh, at the given bed level and without the term that makes the equations change type: from
/// the state of `guess`, or for `None` by some steps of the iteration, which is slow and goes where Newton does not.
pub(super) fn coarse<F: FrictionLaw>(
    flow: Flow<F>,
    setting: Setting,
    guess: Option<CoarseGuess>,
    cells: usize,
    history: &mut Vec<f64>,
) -> Result<(Column<F>, State), NotConverged> {
    let open = Flow { cut: f64::INFINITY, lambda: 0.0, ..flow };
    // The amount of grains is found last.
    let setting = Setting { bed_level: BedLevel::InFlow, ..setting };
    if guess.is_none()
        && let Ok(eased) = ease(open, setting, cells, history)
    {
        return Ok(eased);
    }
    let (mut column, mut state) = guess.unwrap_or(CoarseGuess::new(Floor::Bottom, 80, 0.8)).start(open, setting, cells);
    if guess.is_none() {
        column.flow.lambda = DETOUR.0;
        state = column.iterate(state, &DETOUR.1, history, |_, _| false)?;
        state = column.newton_to(state, ROUGH, history)?;
        column.flow.lambda = 0.0;
    }
    let state = column.newton_to(state, ROUGH, history)?;
    Ok((column, state))
}

/// The coarse solution from that of grains which resist and spread more readily: small I_0 and b are what Newton's method
/// finds hard.
fn ease<F: FrictionLaw>(
    flow: Flow<F>,
    setting: Setting,
    cells: usize,
    history: &mut Vec<f64>,
) -> Result<(Column<F>, State), NotConverged> {
    let (i_0, b) = (flow.friction.half_way(), flow.dilatancy.b);
    let eased = |share: f64| {
        let mut eased = flow;
        eased.friction = flow.friction.with_half_way(i_0 * (EASY.0 / i_0).max(1.0).powf(share));
        eased.dilatancy.b = b * (EASY.1 / b).max(1.0).powf(share);
        eased
    };
    let (mut column, mut state) = GUESSES[0].start(eased(1.0), setting, cells);
    for k in (0..=EASING).rev() {
        column.flow = eased(f64::from(k) / f64::from(EASING));
        state = column.newton_to(state, ROUGH, history)?;
    }
    Ok((column, state))
}

/// From the coarse mesh to the wanted one, with the term, and to the wanted bed level.
pub(super) fn refine<F: FrictionLaw>(
    flow: Flow<F>,
    setting: Setting,
    cells: usize,
    (coarse, rough): &(Column<F>, State),
    history: &mut Vec<f64>,
) -> Result<Exact<F>, NotConverged> {
    let exact = Flow { lambda: 0.0, ..flow };
    // Some coarse solutions have jammed or loose layers that are no part of the flow: the balance of the layer tells.
    let estimate = mobile_volume(&coarse.flow, rough.tau_b, rough.sine);
    let credible = estimate > CREDIBLE * flow.dilatancy.phi_max * setting.level;
    let all_move = NotConverged {
        reason: credible.then_some(Reason::AllMove(None)),
        ..NotConverged::new(f64::INFINITY, history.len())
    };
    let mobile = coarse.yield_volume(rough).ok_or(all_move)?;
    let rest = match setting.bed_level {
        BedLevel::InFlow => rough.m + rough.rest - mobile,
        BedLevel::AtRest => flow.dilatancy.phi_max * setting.level - mobile,
    };
    if rest <= 0.0 {
        return Err(all_move);
    }
    let from = Guess { floor: Floor::Yield, friction: REST.friction, mobile: Some(mobile) };
    let (mut column, _) = Column::start(exact, setting, cells, from);
    let cut = column.flow.cut.max(BEYOND * coarse.change_of_type(rough));
    column.flow.cut = cut;
    let start = coarse.transfer(rough, &column.mesh, (mobile, rest));
    let mut attempt = column.newton(start.clone(), history);
    if attempt.is_err() {
        // The mesh first, the term then.
        column.flow.cut = f64::INFINITY;
        let open = column.newton(start.clone(), history);
        column.flow.cut = cut;
        attempt = open.and_then(|state| column.newton(state, history));
    }
    let mut state = match attempt {
        Err(_) if setting.bed_level == BedLevel::AtRest => column.rise(start, history)?,
        other => other?,
    };
    let mut depth = column.change_of_type(&state);
    while BEYOND * depth > column.flow.cut * (1.0 + ROUNDING) {
        column.flow.cut = BEYOND * depth;
        state = column.newton(state, history)?;
        depth = column.change_of_type(&state);
    }
    Ok((column, state, depth))
}

/// The exact yield from the first of the guesses that leads to a flow.
///
/// # Errors
/// [`NotConverged`] if none does.
pub fn direct<F: FrictionLaw>(
    flow: Flow<F>,
    setting: Setting,
    cells: usize,
    history: &mut Vec<f64>,
) -> Result<Exact<F>, NotConverged> {
    let mut last = NotConverged::new(f64::INFINITY, 0);
    for guess in GUESSES {
        let attempt = coarse(flow, setting, Some(guess), cells, history)
            .and_then(|from| refine(flow, setting, cells, &from, history));
        match attempt {
            Ok((column, state, depth)) if state.rest >= 0.0 && column.carried(&state) >= CARRIED => {
                return Ok((column, state, depth));
            }
            Ok(_) => {}
            Err(failed) => last = failed,
        }
    }
    Err(last)
}

/// The solution from `start` with the cut `least`, or the deeper one that a change of type down to `depth` needs.
///
/// # Errors
/// As [`Column::newton`].
pub fn deepen<F: FrictionLaw>(
    column: &mut Column<F>,
    least: f64,
    mut depth: f64,
    start: State,
    history: &mut Vec<f64>,
) -> Result<(State, f64), NotConverged> {
    column.flow.cut = least.max(BEYOND * depth);
    let mut state = column.newton(start, history)?;
    depth = column.change_of_type(&state);
    while BEYOND * depth > column.flow.cut * (1.0 + ROUNDING) {
        column.flow.cut = BEYOND * depth;
        state = column.newton(state, history)?;
        depth = column.change_of_type(&state);
    }
    Ok((state, depth))
}

impl<F: FrictionLaw> Column<F> {
    /// The same column with the exact yield.
    #[must_use]
    pub fn exact_yield(&self) -> Self {
        Self { flow: Flow { lambda: 0.0, ..self.flow }, ..self.clone() }
    }

    /// Solid volume under the interface down to which the coefficient of the highest derivative, `P_p + phi dtau_f/dr` at a
    /// given total stress, is negative; 0 where it is positive everywhere.
    #[must_use]
    pub fn change_of_type(&self, state: &State) -> f64 {
        let negative = |c: &usize| {
            let cell = super::linear::local_cell(&self.flow, &self.mesh, state, *c);
            let pressure = cell.pressure.value;
            let slope = cell.tau_f.slope[2] - pressure * cell.tau_f.slope[3];
            pressure + cell.phi.value * slope < 0.0
        };
        (0..self.mesh.cells()).rev().find(negative).map_or(0.0, |c| state.m * self.mesh.nodes[c + 1])
    }

    /// Share of the stress that the grains carry in the last of the cells of the moving grains; of the whole bed, in the one with the
    /// most mobilised friction.
    pub fn carried(&self, state: &State) -> f64 {
        let most = (0..self.mesh.cells()).max_by(|a, b| state.r(*a).total_cmp(&state.r(*b))).unwrap_or(0);
        let last = if self.floor == Floor::Yield { self.mesh.cells() - 1 } else { most };
        let pressure = super::linear::local_cell(&self.flow, &self.mesh, state, last).pressure.value;
        let grains = state.r(last) * pressure;
        let share = grains / (grains + state.s(last));
        if share.is_finite() { share } else { 0.0 }
    }

    /// Solid volume over the lowest place where the grains carry just mu_s P_p; `None` if they carry more down to the bottom.
    #[must_use]
    pub fn yield_volume(&self, state: &State) -> Option<f64> {
        if self.floor == Floor::Yield {
            return Some(state.m);
        }
        let mu_s = self.flow.friction.least();
        let c = (0..self.mesh.cells()).rev().find(|&c| state.r(c) > mu_s)?;
        if c + 1 == self.mesh.cells() {
            return None;
        }
        let (a, b) = (self.mesh.middles[c], self.mesh.middles[c + 1]);
        let share = (state.r(c) - mu_s) / (state.r(c) - state.r(c + 1));
        Some(state.m * (a + share * (b - a)))
    }

    /// The solution that conserves the grains, from the one at the level of the bed at rest: the level in the flow rises in
    /// small steps until the grains are all there.
    fn rise(&mut self, start: State, history: &mut Vec<f64>) -> Result<State, NotConverged> {
        let wanted = self.setting;
        let step = STEP * (wanted.height - wanted.level);
        self.setting.bed_level = BedLevel::InFlow;
        let mut state = self.newton(start, history)?;
        let found = loop {
            let missing = wanted.closing_residual(self, &state)[2];
            if missing >= 0.0 {
                break Ok(state);
            }
            self.setting.level += step;
            state = match self.newton(state, history) {
                Ok(next) if self.setting.level < wanted.height => next,
                _ => {
                    let residual = history.last().copied().unwrap_or(f64::INFINITY);
                    break Err(NotConverged {
                        residual,
                        iterations: history.len(),
                        reason: Some(Reason::RunsAway(self.setting.level)),
                    });
                }
            };
        };
        self.setting = wanted;
        self.newton(found?, history)
    }

    /// From the exact yield on the mesh of the moving grains to the regularisation `lambda` on that of the whole bed, at once
    /// or by smaller ones; the last is the exact yield there, if it was found.
    pub fn creep(
        &self,
        exact: &State,
        lambda: f64,
        history: &mut Vec<f64>,
    ) -> Result<(Self, State, Option<State>), NotConverged> {
        let whole = exact.m + exact.rest;
        let mesh = Mesh::bed(self.mesh.cells(), TOP / whole, exact.m / whole);
        let mut start = self.transfer(exact, &mesh, (whole, 0.0));
        let mut column = Self { mesh, floor: Floor::Bottom, ..self.clone() };
        let exact = column.newton(start.clone(), history).ok();
        start = exact.clone().unwrap_or(start);
        let n = column.mesh.cells();
        let largest = (0..n).map(|c| start.w(c)).fold(0.0, f64::max);
        for c in 0..n {
            let w = &mut start.x[STRIDE * c + 1];
            *w = w.max(SEEPAGE * largest);
        }
        column.flow.lambda = lambda;
        if let Ok(state) = column.newton(start.clone(), history) {
            return Ok((column, state, exact));
        }
        column.flow.lambda = LOWEST;
        while column.flow.lambda < lambda {
            start = column.newton(start, history)?;
            column.flow.lambda *= LADDER;
        }
        column.flow.lambda = lambda;
        let state = column.newton(start, history)?;
        Ok((column, state, exact))
    }
}
