//! Flow in two-dimensional sections of a material with a yield stress: ducts, with or without a bed of grains, and a cavity.
//!
//! The developed flow along a duct needs only its cross-section, and a yield stress makes it a convex minimum (`program`),
//! which Newton's method (`newton`) or a first-order method (`dual`) finds, the yield exact or regularised. Quadratic
//! elements on structured meshes (`mesh`, `element`, `duct`); over a bed the mesh follows the yield surface (`fit`). The
//! plane flow in a `cavity` is the same kind of minimum in its discrete stream function.
//!
//! Units of the solvers: H, a stress S, S H/eta.

pub mod advice;
mod case;
mod cavity;
mod cavity_outcome;
mod description;
mod dual;
mod duct;
mod element;
mod error;
mod fit;
mod full;
mod mesh;
mod newton;
mod numbers;
mod outcome;
mod problem;
mod program;
mod solve;
mod study;
#[cfg(test)]
mod tests;

pub use case::Method;
use cavity_outcome::{equations as cavity_equations, run as run_cavity};
use description::equations;
pub use error::{SectionError, SectionFault};
use outcome::run;
pub use problem::{CavityFlow, Contents, Duct, DuctBed, DuctFlow, Outline, SectionMethod};
