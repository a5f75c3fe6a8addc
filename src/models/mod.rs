//! The models: one folder each, and one line each in the registry.

mod bed_error;
mod bed_fault;
mod premises;
#[cfg(test)]
mod tests;
mod touching;
mod yielding;

use crate::dem::GrainBed;
use crate::model::{Entry, OnMesh, Registry};

pub use bed_error::BedError;
pub use bed_fault::BedFault;
pub use touching::{GrainCell, Spring, SpringLaw};
use touching::{derived, layers, load};
pub use yielding::{RegularisationSize, RegularisationTable, YieldGrid};

/// The models of a program, from least to most: a line each, its folder and its types. `also` adds to a folder that is named
/// already.
macro_rules! models {
    (@folder also) => {};
    (@folder $folder:ident) => { pub mod $folder; };
    ($($folder:ident: $($model:ty),+;)*) => {
        $(models!(@folder $folder);)*

        /// The models of this program, from least to most.
        #[must_use]
        pub fn builtin() -> Registry {
            Registry::default() $($(.with(Entry::of::<$model>()))+)*
        }
    };
}

models! {
    exact: OnMesh<exact::bed::LaminarBed>, OnMesh<exact::bingham::BinghamPlane>, OnMesh<exact::bagnold::GranularFilm>,
        OnMesh<exact::log_law::RoughWall>;
    laminar: OnMesh<laminar::RegularisedBed>;
    bingham: OnMesh<bingham::RegularisedPlane>;
    section: section::Duct, section::DuctBed, OnMesh<section::CavityFlow>;
    sheet_flow: OnMesh<sheet_flow::SheetFlow>;
    two_fluid: OnMesh<two_fluid::TwoFluid>;
    shear_cell: OnMesh<shear_cell::ShearCell>;
    grains: GrainBed;
    coupled: coupled::Coupled;
    also: grains::Impact, grains::Verification;
}
