//! Sheet flow in two layers: a suspension in a turbulent flow, over a bed that shears as dense granular flow.
//!
//! `suspension` is the layer above the interface, `bed` the one below it, `column` what joins them. The unknowns of the
//! bed live on shares of its solid volume, where the particle pressure is known and cells keep their grains; the mobilised
//! friction r = tau_p/P_p is one of them, so that a bed at rest is an ordinary case. `docs/sheet-flow.md` derives all of it.
//! Source: Revil-Baudard & Chauchat (2013), J. Geophys. Res. Oceans 118, 619-634.

mod bed;
pub mod case;
mod cold;
mod column;
mod continuation;
mod equations;
mod error;
mod figures;
mod flow;
mod iteration;
mod layers;
mod linear;
mod mesh;
mod newton;
mod no_layer;
mod outcome;
mod problem;
mod profile;
mod solve;
mod start;
mod study;
mod suspension;
#[cfg(test)]
mod tests;

pub use case::{BedLevel, SheetMethod};
use equations::equations;
pub use error::{SheetFlowError, SheetFlowFault};
use outcome::run;
pub use problem::SheetFlow;

/// The solver in its own units: for `benches/sheet.rs` alone.
#[doc(hidden)]
pub mod bench {
    pub use super::cold::REST;
    pub use super::column::Setting;
    pub use super::flow::Flow;
    pub use super::iteration::StepControl;
    pub use super::layers::Layers;
    pub use super::newton::{Column, NotConverged};
    pub use super::solve::solve;
}
