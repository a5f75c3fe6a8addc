//! What a user of the library writes with: `use bedload::prelude::*`. Not used inside.

pub use crate::case::{Case, CaseError, CaseFault};
pub use crate::model::{
    Checked, Description, Entry, Faults, Model, ModelInfo, OnMesh, Problem, Registry, Simulation, Solve, checked, read,
};
pub use crate::models::builtin;
pub use crate::result::{
    Context, Failure, MethodError, Outcome, Profile, Quiet, Results, Series, Snapshot, SolveError, Status, Watch,
    quantity,
};
pub use crate::scene::{BedScene, BenchmarkScene, ChannelScene, GranularScene, Scene};
