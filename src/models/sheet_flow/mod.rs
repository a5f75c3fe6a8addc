//! Sheet flow in two layers: a suspension in a turbulent flow, over a bed that shears as dense granular flow.
//!
//! [`suspension`] is the layer above the interface, [`bed`] the one below it, [`column`] what joins them. The unknowns of the
//! bed live on shares of its solid volume, where the particle pressure is known and cells keep their grains; the mobilised
//! friction r = tau_p/P_p is one of them, so that a bed at rest is an ordinary case. `docs/sheet-flow.md` derives all of it.
//! Source: Revil-Baudard & Chauchat (2013), J. Geophys. Res. Oceans 118, 619-634.

pub mod bed;
pub mod case;
pub mod column;
mod equations;
mod error;
mod figures;
pub mod flow;
pub mod iteration;
pub mod layers;
pub mod linear;
pub mod mesh;
pub mod newton;
mod outcome;
mod problem;
mod profile;
pub mod solve;
pub mod start;
mod study;
pub mod suspension;
#[cfg(test)]
mod tests;

pub use case::{BedReading, SheetMethod};
pub use equations::equations;
pub use error::{SheetFlowError, SheetFlowFault};
pub use outcome::run;
pub use problem::SheetFlow;
