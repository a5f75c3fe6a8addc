//! Numerical methods that know no physics.

pub mod banded;
pub mod block_thomas;
pub mod dual;
pub mod least_squares;
pub mod levels;
pub mod quadrature;
pub mod root;
pub mod sparse;
pub mod sum;
pub mod thomas;
