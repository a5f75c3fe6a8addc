//! The discrete equations, their solutions, and what they must be.

mod column;
mod derivatives;
mod growth;
mod statements;
mod steady;
mod transient;

use super::outcome::column as scaled;
use super::system::Column;
use crate::model::{OnMesh, read};
use crate::models::two_fluid::TwoFluid;

/// The flow of a shipped case.
fn flow(case: &str, set: &[&str]) -> TwoFluid {
    let overrides: Vec<String> = set.iter().map(|argument| (*argument).to_owned()).collect();
    read::<OnMesh<TwoFluid>>(case, &overrides).unwrap().problem
}

/// The reference flow, with changes, on `cells` cells.
fn reference(set: &[&str], cells: usize) -> (TwoFluid, Column) {
    let flow = flow("flow_theta06-two-fluid", set);
    let column = scaled(&flow, cells).unwrap();
    (flow, column)
}

const CLASSICAL: &str = "closures.granular.law=garzo-dufty";
