//! The models: one folder each, and one line each in the registry.

mod bed_error;
mod bed_fault;
mod premises;
#[cfg(test)]
mod tests;
mod touching;
mod yielding;

use crate::case::Fault;
use crate::dem::GrainBed;
use crate::model::{Entry, Faults, OnMesh, Registry};
use crate::scene::BedFlow;

pub use bed_error::BedError;
pub use bed_fault::BedFault;
pub use touching::{GrainCell, Spring, SpringLaw};
use touching::{layers, touching};
pub use yielding::{RegularisationSize, RegularisationTable, YieldGrid};

/// A value of the flow that this model cannot do without.
fn needed(path: &str, value: Option<f64>, faults: &mut Faults) -> Option<f64> {
    if value.is_none() {
        let (table, key) = path.split_once('.').unwrap_or(("", path));
        let name = format!("{key} in [{table}]");
        let description = "this model needs it".to_owned();
        faults
            .push((path, Fault::Missing { what: "key", name, description, allowed: "a number with its unit".into() }));
    }
    value
}

/// Refuses what drives or bounds a flow and is none of what the model solves: left out in silence it would be another flow.
fn solves(model: &str, flow: &BedFlow, solved: &[&str], tops: &[&str], faults: &mut Faults) {
    let given = [
        ("oscillation", flow.oscillation.is_some()),
        ("pressure_gradient", flow.pressure_gradient.is_some()),
        ("section", flow.section.is_some()),
        ("shields", flow.shields.is_some()),
        ("slope", flow.slope.is_some()),
        ("u_star", flow.u_star.is_some()),
    ];
    let refused = |name: &str, allowed: &[&str]| Fault::NotUsed {
        what: "key",
        name: name.into(),
        model: model.into(),
        users: vec!["other models of this kind of flow".into()],
        allowed: allowed.iter().map(|&name| name.to_owned()).collect(),
    };
    for (name, _) in given.into_iter().filter(|(name, given)| *given && !solved.contains(name)) {
        faults.push((format!("flow.{name}"), refused(name, solved)));
    }
    if !tops.contains(&flow.top.name()) {
        faults.push(("flow.top", refused(&format!("top = {}", flow.top.name()), tops)));
    }
}

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
