//! What a model says of its own convergence: the velocity and the numbers that are judged, how its yield is smoothed, and over
//! which meshes it converges. Plain data of one problem: whoever reads it knows no model.
//!
//! A change is `table.key=value` as after `--set`, good for any case of the model.

mod dense;
mod yielding;

use super::orders::Law;
use crate::problem::{BinghamPlane, LaminarBed, Model, Problem, RegularisedBed, RegularisedPlane};
use crate::result::quantity::Quantity;

/// What a study of a model measures and what it varies.
#[derive(Clone, Debug)]
pub(super) struct Focus {
    /// the velocity whose norms are taken
    pub velocity: &'static Quantity,
    /// unit of the root mean squares [m/s]
    pub velocity_unit: f64,
    /// numbers that a user would take from a run, the first of them first
    pub numbers: &'static [Number],
    /// whether the velocity of the grains at the bed level is one of the measures
    pub bed: bool,
    /// whether the root mean square of Chauchat & Medale (2010), divided by N outside the root, stands beside the true one
    pub paper_rms: bool,
    /// how its yield is smoothed
    pub sizes: Option<Sizes>,
    /// meshes over which it converges
    pub meshes: Option<Meshes>,
    /// what it is in closed form
    pub partner: Option<Partner>,
}

/// A number besides the velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number {
    /// what it is
    pub quantity: &'static Quantity,
    /// its name in columns: `error_transport_rate`
    pub short: &'static str,
    /// its error against the exact yield as a run states it, where the exact yield on as many cells has another mesh
    pub stated: Option<&'static Quantity>,
}

/// Sizes of a regularisation over which a model converges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    /// the key that is varied
    pub key: &'static str,
    /// its unit
    pub unit: &'static str,
    /// the size as a formula, in that unit
    pub formula: &'static str,
    /// symbols in the formula that need a word, after a space; else empty
    pub symbols: &'static str,
    /// what the unit is worth [1/s]
    pub shear_unit: f64,
    /// changes that give the exact yield; none where the model has no such thing
    pub exact: &'static [&'static str],
    /// changes of all laws
    pub changes: &'static [&'static str],
    /// laws of the smoothing, that of a published rule first
    pub laws: &'static [Smoothed],
    /// decades of the size, from and to, as powers of 1/10
    pub decades: (i32, i32),
    /// sizes at which words give the error
    pub shown: &'static [f64],
    /// slopes are told from this size down
    pub slopes_from: f64,
    /// whether the creep of what is at rest under the exact yield is one of the measures
    pub creep: bool,
    /// a published rule for the size
    pub rule: Option<Rule>,
    /// what else a reader has to know: label and text
    pub remarks: &'static [(&'static str, &'static str)],
}

/// A law of the smoothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Smoothed {
    /// its name
    pub name: &'static str,
    /// changes that set it, but for the size
    pub changes: &'static [&'static str],
    /// how the error of the velocity goes with the size, where that is known
    pub falls: Option<Law>,
}

/// The rule of Chauchat & Medale (2010), section 3.2: lambda = min(1e-4, 1e-4/Bn).
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    /// yield stress times height over viscosity [m/s], which over a velocity is the Bingham number
    pub yield_velocity: f64,
    /// the Bingham number in words
    pub bingham: &'static str,
}

/// Meshes over which a model converges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meshes {
    /// cells, from the coarsest on
    pub cells: &'static [usize],
    /// cells of the mesh that the others are measured against where there is no closed form
    pub reference: usize,
    /// changes on all meshes
    pub changes: &'static [&'static str],
    /// kinds of mesh, each with its changes; the reference is of the first kind
    pub kinds: &'static [(&'static str, &'static [&'static str])],
    /// what else a reader has to know: label and text
    pub remarks: &'static [(&'static str, &'static str)],
}

/// The closed form of a problem under the exact yield.
#[derive(Clone, Debug)]
pub(super) enum Partner {
    /// a Newtonian fluid over a Coulomb bed
    Bed(Box<LaminarBed>),
    /// a Bingham fluid between two planes
    Plane(BinghamPlane),
}

const fn number(quantity: &'static Quantity, short: &'static str) -> Number {
    Number { quantity, short, stated: None }
}

/// Meshes of one kind.
const ONE_KIND: &[(&str, &[&str])] = &[("mesh", &[])];

fn owned(changes: &[&str]) -> Vec<String> {
    changes.iter().map(|&change| change.to_owned()).collect()
}

impl Sizes {
    /// Changes that set a law with a size.
    pub fn set(&self, law: &Smoothed, size: &str) -> Vec<String> {
        [owned(self.changes), owned(law.changes), vec![format!("{}={size}", self.key)]].concat()
    }

    /// Changes that give the exact yield.
    pub fn exactly(&self) -> Vec<String> {
        owned(self.exact)
    }

    /// A size with its unit, for readers.
    pub fn text(&self, size: &str) -> String {
        if self.unit == "1" { size.to_owned() } else { format!("{size} {}", self.unit) }
    }
}

impl Meshes {
    /// Changes that make a mesh of a kind.
    pub fn set(&self, cells: usize, kind: &[&str]) -> Vec<String> {
        [vec![format!("grid.cells={cells}")], owned(kind), owned(self.changes)].concat()
    }
}

impl Focus {
    /// What there is to measure in `problem`; `None` for a model that is a closed form, or is solved grain by grain.
    pub fn of(problem: &Problem) -> Option<Self> {
        match &problem.model {
            Model::Laminar(RegularisedBed { bed, .. }) => Some(yielding::laminar(bed)),
            Model::Bingham(RegularisedPlane { plane, .. }) => Some(yielding::bingham(plane)),
            Model::Duct(flow) => Some(yielding::duct(flow)),
            Model::Cavity(flow) => Some(yielding::cavity(flow)),
            Model::SheetFlow(flow) => Some(dense::sheet_flow(flow)),
            Model::TwoFluid(flow) => Some(dense::two_fluid(flow)),
            Model::ShearCell(cell) => Some(dense::shear_cell(cell)),
            Model::Ouriemi(_)
            | Model::BinghamPlane(_)
            | Model::BagnoldFilm(_)
            | Model::LogLaw(_)
            | Model::Grains(_)
            | Model::Coupled(_)
            | Model::Impact(_)
            | Model::Trial(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::shipped;

    /// The shipped cases that have something to refine.
    fn cases() -> impl Iterator<Item = (&'static str, Focus)> {
        shipped::names().filter_map(|name| {
            let (_, problem) = Problem::load(name, &[]).unwrap();
            Some((name, Focus::of(&problem)?))
        })
    }

    #[test]
    fn every_case_accepts_what_its_model_says_of_its_study() {
        let load = |name: &str, changes: Vec<String>| {
            Problem::load(name, &changes).unwrap_or_else(|error| panic!("{name} {changes:?}: {error}"))
        };
        let mut seen = Vec::new();
        for (name, focus) in cases() {
            if let Some(sizes) = focus.sizes {
                let (from, to) = sizes.decades;
                for (law, decade) in sizes.laws.iter().flat_map(|law| [from, to].map(|decade| (law, decade))) {
                    load(name, sizes.set(law, &format!("1e-{decade}")));
                }
                load(name, sizes.exactly());
                assert!(sizes.shown.iter().chain([&sizes.slopes_from]).all(|size| *size <= 0.1 && *size >= 1e-10));
            }
            if let Some(meshes) = focus.meshes {
                assert!(meshes.cells.is_sorted() && meshes.cells.last() < Some(&meshes.reference), "{name}");
                for (_, kind) in meshes.kinds {
                    for cells in meshes.cells.iter().chain([&meshes.reference]) {
                        let (case, problem) = load(name, meshes.set(*cells, kind));
                        assert_eq!(problem.cells, *cells, "{name}");
                        seen.push(case.model);
                    }
                }
            }
        }
        seen.dedup();
        seen.sort_unstable();
        seen.dedup();
        assert_eq!(seen.len(), 8, "{seen:?}");
    }

    #[test]
    fn the_exact_yield_of_a_study_is_exact_whatever_the_case_says() {
        for (name, focus) in cases() {
            let Some(sizes) = focus.sizes.filter(|sizes| !sizes.exact.is_empty()) else { continue };
            let smoothed = sizes.laws.first().map(|law| sizes.set(law, "1e-3")).unwrap_or_default();
            let (_, with) = Problem::load(name, &smoothed).unwrap();
            let (_, exact) = Problem::load(name, &[smoothed, sizes.exactly()].concat()).unwrap();
            let (_, alone) = Problem::load(name, &sizes.exactly()).unwrap();
            assert!(with.model != exact.model && exact.model == alone.model, "{name}");
        }
    }
}
