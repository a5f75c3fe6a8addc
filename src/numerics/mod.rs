//! Numerical methods that know no physics.

pub mod levels;
pub mod quadrature;
pub mod root;
pub mod thomas;
