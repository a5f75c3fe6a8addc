//! Grains in a fluid: Maurin et al. (2015). The grains are those of [`super::engine`], the fluid that of [`crate::column`].
//!
//! ```text
//!  grains ─► exchange.look (averages: φ, drag, what was given) ─► exchange.advance (column) ─► felt ─► grains
//!                                                     record (samples, blocks) ─► outcome
//! ```

mod direction;
mod exchange;
mod felt;
mod hold;
mod limits;
mod outcome;
mod record;
mod run;
mod scene;
#[cfg(test)]
mod tests;

pub use exchange::Exchange;
pub use felt::{Dragged, Felt};
pub use run::{accepts, equations, run};
