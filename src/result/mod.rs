//! What a run returns: profiles over z, series over iterations or time, named numbers, and where all of it came from.
//! These are the only types that plots, reports, tables and comparisons accept.

mod animation;
mod answer;
mod checkpoint;
mod class;
mod codes;
mod context;
mod estimate;
mod failure;
mod field;
pub mod figure;
mod outcome;
mod provenance;
pub mod quantity;
mod regime;
mod scene;
mod statement;
mod summary;
mod table;
mod watch;

pub use animation::{Animation, base64};
pub use checkpoint::CheckpointError;
pub use class::Class;
pub(crate) use codes::codes;
pub use context::{Checkpoints, Context, Frames};
pub use estimate::{Estimate, Unknown};
pub use failure::{Failure, MethodError, NumericalError, SolveError};
pub use field::{Field, SideView};
pub use figure::{Axis, Curve, Dash, Figure, Level, Marker, Panel, Scale};
pub use outcome::Outcome;
pub use provenance::Provenance;
pub use quantity::Quantity;
pub use regime::{Limits, Premise, Rule, Verdict};
pub use scene::{Difference, SceneRecord, differences, flatten};
pub use statement::{Head, StatedLaw, Statement};
pub use summary::{Balance, Cost, ErrorReport, Reported, Results, Status, Summary, Validity};
pub use table::{Profile, Series, Table, TableError, Values, read_columns};
pub use watch::{Quiet, Snapshot, Watch};
