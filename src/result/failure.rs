//! Why a method failed, with the numbers that say so, and the last good state.

use super::{Outcome, TableError};

/// Why a method failed, with the numbers that say so.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The grains yield down to the bottom, which the model cannot hold.
    #[error(
        "the whole bed moves: the mobile layer would be {mobile_depth_m:.6} m deep where the bed is {bed_m:.6} m (z = 0 is reached)"
    )]
    WholeBedMoves {
        /// depth to which the grains would move \[m]
        mobile_depth_m: f64,
        /// thickness of the bed \[m]
        bed_m: f64,
        /// largest drive with a static layer [Pa/m]
        limit_pa_m: f64,
    },
    /// The drive exceeds the friction at every depth.
    #[error(
        "no part of the bed can stay at rest: the drive is {drive:.6} of the submerged weight, friction holds less than {limit:.6}"
    )]
    NoStaticBed {
        /// dimensionless drive f = -dp/dx/((rho_p - rho_f) g)
        drive: f64,
        /// mu_s phi
        limit: f64,
    },
    /// A bed that the flow sets in motion down to its bottom.
    #[error(
        "the whole bed moves: at a Shields number of {shields:.4} the grains yield down to the bottom of the bed, {bed_m:.6} m below its top"
    )]
    NothingAtRest {
        /// thickness of the bed in the flow \[m]
        bed_m: f64,
        /// Shields number
        shields: f64,
    },
    /// A solution of the discrete equations that is none of the flow.
    #[error(
        "only a solution with locked grains was found: where they come to rest they carry {carried:.4} of the stress, and the viscosity of packed grains the rest"
    )]
    Locked {
        /// share of the stress
        carried: f64,
    },
    /// A suspension that takes the bed away.
    #[error(
        "the suspension takes the bed away: it would hold {suspended_m:.6} m of solid volume, the bed has {bed_m:.6} m"
    )]
    BedSuspended {
        /// solid volume in suspension, per area \[m]
        suspended_m: f64,
        /// solid volume of the bed at rest, per area \[m]
        bed_m: f64,
    },
    /// A bed whose loosening feeds itself.
    #[error(
        "no level of the bed holds its grains: from {rest_m:.6} m at rest it was raised to {reached_m:.6} m, where nothing stays at rest; a looser bed leaves a thinner, steeper flow, which loosens it more"
    )]
    BedRunsAway {
        /// bed level at rest \[m]
        rest_m: f64,
        /// level up to which it was raised \[m]
        reached_m: f64,
    },
    /// A lid that would have to drive the flow.
    #[error("the lid would have to push: its stress comes out as {stress_pa:.6} Pa against the flow, less than none")]
    LidPushes {
        /// stress that the lid takes from the fluid \[Pa]
        stress_pa: f64,
    },
    /// A granular film that accelerates without end.
    #[error("no steady film: tan(slope) = {tangent:.6} is not below mu_2 = {mu_2:.6}")]
    NoSteadyFilm {
        /// tangent of the slope
        tangent: f64,
        /// largest friction coefficient of the material
        mu_2: f64,
    },
    /// Equations that are not those of a boundary value problem right under the interface.
    #[error(
        "the equations change type down to {depth_m:.3e} m of grains under the interface; the buoyancy of the viscous stress is left out in {cut_m:.3e} m alone"
    )]
    ChangeOfType {
        /// solid volume per area under the interface down to which they do \[m]
        depth_m: f64,
        /// that in which the term is left out \[m]
        cut_m: f64,
    },
    /// A wanted value that no drive gives.
    #[error("no drive gives {quantity} = {wanted:.6}: with a static bed it stays below {largest:.6}")]
    OutOfReach {
        /// what was asked for
        quantity: &'static str,
        /// the wanted value
        wanted: f64,
        /// largest value that the model reaches
        largest: f64,
    },
    /// A scalar equation whose root was not found.
    #[error(
        "the root of {equation} was not found after {iterations} iterations: residual {residual:.3e} between {low:.6e} and {high:.6e}"
    )]
    NoRoot {
        /// the equation
        equation: &'static str,
        /// evaluations made
        iterations: usize,
        /// last relative residual
        residual: f64,
        /// lower end of the bracket
        low: f64,
        /// upper end of the bracket
        high: f64,
    },
    /// An iteration that does not reach round-off.
    #[error("not converged: the relative residual is {residual:.3e} after {iterations} iterations")]
    NotConverged {
        /// relative residual
        residual: f64,
        /// iterations made
        iterations: usize,
    },
    /// A two-fluid flow that no way of the method leads to.
    #[error(
        "no steady flow was found at a Shields number of {shields:.4}: the smallest residual is {residual:.3e} after {iterations} iterations"
    )]
    NoSteadyFlow {
        /// smallest residual of the steady equations
        residual: f64,
        /// iterations made, of all ways
        iterations: usize,
        /// nominal Shields number
        shields: f64,
    },
    /// A flow in time that cannot go on.
    #[error(
        "stuck at t = {time_s:.6} s: no step is short enough, the last one was {step_s:.3e} s with the residual {residual:.3e}"
    )]
    StuckInTime {
        /// simulated time \[s]
        time_s: f64,
        /// last step \[s]
        step_s: f64,
        /// residual of the step, or its error
        residual: f64,
    },
    /// A convex minimum that the method does not find.
    #[error(
        "the {method} method ends {change:.3e} (relative) from its goal after {iterations} iterations, at lambda = {lambda_1_s:.3e} 1/s"
    )]
    Unsettled {
        /// the method
        method: &'static str,
        /// last relative change of the velocity, or duality gap
        change: f64,
        /// iterations made
        iterations: usize,
        /// smoothing of the yield stress [1/s]
        lambda_1_s: f64,
    },
    /// A result that is not a finite number.
    #[error("{column} is not finite in row {row}")]
    NotFinite {
        /// column name
        column: &'static str,
        /// row, from 0
        row: usize,
    },
    /// A number or a balance that leaves the range of floating-point numbers.
    #[error("{name} cannot be computed: a number on the way is larger or smaller than any that the machine has")]
    NotRepresentable {
        /// result, balance or variable
        name: String,
    },
    /// A global balance that does not close.
    #[error(
        "the balance {balance} is off by {relative:.3e} of its scale, more than {limit:.0e}: the numbers cannot be trusted"
    )]
    Unbalanced {
        /// what is balanced
        balance: String,
        /// relative residual
        relative: f64,
        /// largest accepted magnitude
        limit: f64,
    },
    /// A steady drive, and a fluid that flows against it.
    #[error("the fluid flows uphill: its mean velocity is {velocity_m_s:.4} m/s, against the drive{}", when(*.over_s))]
    FlowsUphill {
        /// mean velocity of the fluid, negative [m/s]
        velocity_m_s: f64,
        /// time over which it is the mean \[s]; `None` for a steady flow
        over_s: Option<[f64; 2]>,
        /// what a user can change
        hint: &'static str,
    },
    /// Grains that cannot go on.
    #[error("{message}")]
    Grains {
        /// stable identifier of the kind
        code: &'static str,
        /// grain, place and step, with the numbers
        message: String,
        /// what a user can change
        hint: &'static str,
    },
    /// Columns of unequal length: a defect of the program.
    #[error("{column} has the wrong number of rows")]
    Inconsistent {
        /// column name
        column: &'static str,
    },
}

impl SolveError {
    /// An iteration that ended with a relative residual, which is no number where its scale left the range of them.
    #[must_use]
    pub fn not_converged(residual: f64, iterations: usize) -> Self {
        if residual.is_finite() {
            Self::NotConverged { residual, iterations }
        } else {
            Self::NotRepresentable { name: "the residual".into() }
        }
    }

    /// Stable identifier of the kind of failure, as in `summary.json`.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::WholeBedMoves { .. } => "whole-bed-moves",
            Self::NoStaticBed { .. } => "no-static-bed",
            Self::NothingAtRest { .. } => "nothing-at-rest",
            Self::Locked { .. } => "locked",
            Self::BedSuspended { .. } => "bed-suspended",
            Self::BedRunsAway { .. } => "bed-runs-away",
            Self::LidPushes { .. } => "lid-pushes",
            Self::NoSteadyFilm { .. } => "no-steady-film",
            Self::ChangeOfType { .. } => "change-of-type",
            Self::OutOfReach { .. } => "out-of-reach",
            Self::NoRoot { .. } => "no-root",
            Self::NotConverged { .. } => "not-converged",
            Self::NoSteadyFlow { .. } => "no-steady-flow",
            Self::StuckInTime { .. } => "stuck-in-time",
            Self::Unsettled { .. } => "unsettled",
            Self::NotFinite { .. } => "not-finite",
            Self::NotRepresentable { .. } => "not-representable",
            Self::Unbalanced { .. } => "unbalanced",
            Self::Inconsistent { .. } => "inconsistent",
            Self::FlowsUphill { .. } => "flows-uphill",
            Self::Grains { code, .. } => code,
        }
    }

    /// What a user can change.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::WholeBedMoves { limit_pa_m, .. } => {
                format!("drive it with less than {limit_pa_m:.4} Pa/m, or make the bed deeper (bed.level)")
            }
            Self::BedRunsAway { .. } => "lower the drive, or leave more room above the bed (flow.height)".into(),
            Self::Locked { .. } => "raise the Shields number: hardly a grain moves; or lower it, if the bed is about to move as a whole".into(),
            Self::NothingAtRest { .. } => "lower the drive or the slope, or make the bed deeper (bed.level)".into(),
            Self::BedSuspended { .. } => {
                "lower the drive, make the bed deeper (bed.level), or take grains that settle faster".into()
            }
            Self::LidPushes { .. } => "raise the slope, or ask for a lower Shields number".into(),
            Self::ChangeOfType { .. } => "regularisation.deepen_cut = true, or a larger regularisation.interface_cut".into(),
            Self::NoStaticBed { .. } => "lower the drive, or raise mu_s or phi".into(),
            Self::NoSteadyFilm { .. } => "lower the slope: a steady film needs mu_s < tan(slope) < mu_2".into(),
            Self::OutOfReach { .. } => "ask for less, raise mu_s, or leave more room above the bed".into(),
            Self::NoSteadyFlow { .. } => {
                "follow it in time (model.state = \"transient\"): near the threshold of motion the flow may have no steady state".into()
            }
            Self::StuckInTime { .. } => "the flow until then is kept; take more cells (grid.cells) or a larger solver.tolerance".into(),
            Self::NotFinite { .. } | Self::NotRepresentable { .. } | Self::Unbalanced { .. } => {
                "a value of the case is far from those of any flow: case.toml has all of them in SI".into()
            }
            Self::Unsettled { .. } => {
                "take model.method = \"newton\", raise solver.iterations or solver.tolerance, or change grid.cells"
                    .into()
            }
            Self::Grains { hint, .. } | Self::FlowsUphill { hint, .. } => (*hint).into(),
            Self::NoRoot { .. } | Self::NotConverged { .. } | Self::Inconsistent { .. } => {
                "the solver gave up on a case that was checked: please report it with case.toml".into()
            }
        }
    }
}

fn when(over: Option<[f64; 2]>) -> String {
    let Some([from, to]) = over else { return String::new() };
    if from < to { format!(", from t = {from:.4} s to {to:.4} s") } else { format!(", at t = {to:.4} s") }
}

impl From<TableError> for SolveError {
    fn from(error: TableError) -> Self {
        match error {
            TableError::NotFinite { column, row } => Self::NotFinite { column, row },
            TableError::Length { column, .. } => Self::Inconsistent { column },
            _ => Self::Inconsistent { column: "table" },
        }
    }
}

/// A failed run: the reason, and the last good state if there is one.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{error}")]
pub struct Failure {
    /// where, when and with what values
    pub error: SolveError,
    /// what was computed before
    pub last: Option<Box<Outcome>>,
}

impl From<SolveError> for Failure {
    fn from(error: SolveError) -> Self {
        // A search among numbers that are none says so.
        let error = match error {
            SolveError::NoRoot { equation, residual, low, high, .. }
                if !(residual.is_finite() && low.is_finite() && high.is_finite()) =>
            {
                SolveError::NotRepresentable { name: equation.into() }
            }
            other => other,
        };
        Self { error, last: None }
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Self {
        SolveError::from(error).into()
    }
}
