//! The models: one folder each, and one line each in the registry.

mod bed_error;
mod bed_fault;
pub mod bingham;
pub mod coupled;
pub mod exact;
pub mod grains;
pub mod laminar;
mod premises;
pub mod section;
pub mod shear_cell;
pub mod sheet_flow;
#[cfg(test)]
mod tests;
pub mod two_fluid;
mod yielding;

pub use bed_error::BedError;
pub use bed_fault::BedFault;
pub use yielding::RegularisationSize;

use crate::dem::GrainBed;
use crate::model::{Entry, OnMesh, Registry};
pub use yielding::{RegularisationTable, YieldGrid};

/// The models of this program, from least to most.
#[must_use]
pub fn builtin() -> Registry {
    Registry::default()
        .with(Entry::of::<OnMesh<exact::bed::LaminarBed>>())
        .with(Entry::of::<OnMesh<exact::bingham::BinghamPlane>>())
        .with(Entry::of::<OnMesh<exact::bagnold::GranularFilm>>())
        .with(Entry::of::<OnMesh<exact::log_law::RoughWall>>())
        .with(Entry::of::<OnMesh<laminar::RegularisedBed>>())
        .with(Entry::of::<OnMesh<bingham::RegularisedPlane>>())
        .with(Entry::of::<section::Duct>())
        .with(Entry::of::<section::DuctBed>())
        .with(Entry::of::<OnMesh<section::CavityFlow>>())
        .with(Entry::of::<OnMesh<sheet_flow::SheetFlow>>())
        .with(Entry::of::<OnMesh<two_fluid::TwoFluid>>())
        .with(Entry::of::<OnMesh<shear_cell::ShearCell>>())
        .with(Entry::of::<GrainBed>())
        .with(Entry::of::<coupled::Coupled>())
        .with(Entry::of::<grains::Impact>())
        .with(Entry::of::<grains::Verification>())
}
