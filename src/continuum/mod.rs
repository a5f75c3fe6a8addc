//! Continuum models of the flow and of the bed.

pub mod exact;
pub mod laminar;
