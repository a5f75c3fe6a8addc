//! What a model says of its own studies: the velocity and the numbers that are assessed, how its yield is smoothed, over which
//! meshes it converges, the settings that answer one case from cheap to dear. Plain data of one problem: whoever reads it knows no
//! model.
//!
//! A change is `table.key=value` as after `--set`, good for any case of the model.

use crate::result::quantity::Quantity;
use crate::result::{Profile, Results};

/// What a problem says of its studies.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct StudyPlan {
    /// what is measured, and what is refined; `None` for a closed form, and for grains
    pub focus: Option<Focus>,
    /// the settings that answer the case, from cheap and coarse to dear and fine; none: it is solved as it stands
    pub rungs: Vec<Rung>,
    /// what is much finer than all rungs: in words, and as changes. `None` where refining has no end that can be paid for
    pub finest: Option<(String, Vec<String>)>,
}

/// A setting of a ladder.
#[derive(Clone, Debug)]
pub struct Rung {
    /// the curve that it lies on
    pub series: &'static str,
    /// the setting in words
    pub setting: String,
    /// what is changed in the case
    pub changes: Vec<String>,
}

impl Rung {
    /// A mesh of so many cells, with more changes.
    #[must_use]
    pub fn cells(series: &'static str, cells: usize, more: &[String]) -> Self {
        let changes = [&[format!("grid.cells={cells}")], more].concat();
        Self { series, setting: format!("{cells} cells"), changes }
    }
}

/// The solution of a problem under the exact yield, to round-off.
pub trait ClosedForm: Send {
    /// Its numbers \[SI].
    fn results(&self) -> &Results;
    /// The velocity that is measured, at the levels of `run`.
    fn at(&self, run: &Profile) -> Option<Profile>;
}

/// What a study of a model measures and what it varies.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Focus {
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
}

impl Focus {
    /// A velocity with its unit [m/s] and numbers, refined over `meshes`.
    #[must_use]
    pub fn on_meshes(
        velocity: &'static Quantity,
        velocity_unit: f64,
        numbers: &'static [Number],
        meshes: Meshes,
    ) -> Self {
        Self { velocity, velocity_unit, numbers, bed: false, paper_rms: false, sizes: None, meshes: Some(meshes) }
    }
}

impl From<Focus> for StudyPlan {
    /// What is measured and refined, without a ladder.
    fn from(focus: Focus) -> Self {
        Self { focus: Some(focus), ..Self::default() }
    }
}

/// A number besides the velocity.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// what it is
    pub quantity: &'static Quantity,
    /// its name in columns: `error_transport_rate`
    pub short: &'static str,
    /// its error against the exact yield as a run states it, where the exact yield on as many cells has another mesh
    pub stated: Option<&'static Quantity>,
}

/// Sizes of a regularisation over which a model converges.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
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
    pub reported: &'static [f64],
    /// slopes are reported from this size down
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
pub struct Smoothed {
    /// its name
    pub name: &'static str,
    /// changes that set it, but for the size
    pub changes: &'static [&'static str],
    /// how the error of the velocity goes with the size, where that is known
    pub falls: Option<Law>,
}

/// The rule of Chauchat & Medale (2010), section 3.2: lambda = min(1e-4, 1e-4/Bn).
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// yield stress times height over viscosity [m/s], which over a velocity is the Bingham number
    pub yield_velocity: f64,
    /// the Bingham number in words
    pub bingham: &'static str,
}

/// Meshes over which a model converges.
#[derive(Clone, Copy, Debug)]
pub struct Meshes {
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

/// A number whose error is measured.
#[must_use]
pub const fn number(quantity: &'static Quantity, short: &'static str) -> Number {
    Number { quantity, short, stated: None }
}

/// Meshes of one kind.
pub const ONE_KIND: &[(&str, &[&str])] = &[("mesh", &[])];

fn owned(changes: &[&str]) -> Vec<String> {
    changes.iter().map(|&change| change.to_owned()).collect()
}

impl Sizes {
    /// Changes that set a law with a size.
    #[must_use]
    pub fn set(&self, law: &Smoothed, size: &str) -> Vec<String> {
        [owned(self.changes), owned(law.changes), vec![format!("{}={size}", self.key)]].concat()
    }

    /// Changes that give the exact yield.
    #[must_use]
    pub fn exactly(&self) -> Vec<String> {
        owned(self.exact)
    }

    /// A size with its unit, for readers.
    #[must_use]
    pub fn text(&self, size: &str) -> String {
        if self.unit == "1" { size.to_owned() } else { format!("{size} {}", self.unit) }
    }
}

impl Meshes {
    /// Changes that make a mesh of a kind.
    #[must_use]
    pub fn set(&self, cells: usize, kind: &[&str]) -> Vec<String> {
        [vec![format!("grid.cells={cells}")], owned(kind), owned(self.changes)].concat()
    }
}

/// How the error of a regularised yield stress goes with its size lambda, s being the shear rate of the flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// C (lambda/s) ln(s/lambda): the ratio R of the law falls short of 1 like lambda/gamma, which acts at every depth
    Logarithmic,
    /// C lambda/s: it falls short of 1 faster than that
    Linear,
}

impl Law {
    /// The law with C = 1, for lambda below s.
    #[must_use]
    pub fn at(self, lambda: f64, s: f64) -> f64 {
        match self {
            Self::Logarithmic => lambda / s * (s / lambda).ln(),
            Self::Linear => lambda / s,
        }
    }

    /// As a formula.
    #[must_use]
    pub fn formula(self) -> &'static str {
        match self {
            Self::Logarithmic => "(λ/s) ln(s/λ)",
            Self::Linear => "λ/s",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, shipped};
    use crate::model::Problem;
    use crate::models::builtin;

    /// The shipped cases that have something to refine.
    fn cases() -> impl Iterator<Item = (&'static str, Focus)> {
        let registry = builtin();
        shipped::names().filter_map(move |name| {
            let (_, problem) = registry.load(name, &[]).unwrap();
            Some((name, problem.solver().study().focus?))
        })
    }

    #[test]
    fn every_case_accepts_what_its_model_says_of_its_study() {
        let registry = builtin();
        let load = |name: &str, changes: Vec<String>| -> (Case, Problem) {
            registry.load(name, &changes).unwrap_or_else(|error| panic!("{name} {changes:?}: {error}"))
        };
        let mut seen = Vec::new();
        for (name, focus) in cases() {
            if let Some(sizes) = focus.sizes {
                let (from, to) = sizes.decades;
                for (law, decade) in sizes.laws.iter().flat_map(|law| [from, to].map(|decade| (law, decade))) {
                    load(name, sizes.set(law, &format!("1e-{decade}")));
                }
                load(name, sizes.exactly());
                assert!(sizes.reported.iter().chain([&sizes.slopes_from]).all(|size| *size <= 0.1 && *size >= 1e-10));
            }
            if let Some(meshes) = focus.meshes {
                assert!(meshes.cells.is_sorted() && meshes.cells.last() < Some(&meshes.reference), "{name}");
                for (_, kind) in meshes.kinds {
                    for cells in meshes.cells.iter().chain([&meshes.reference]) {
                        let (case, problem) = load(name, meshes.set(*cells, kind));
                        assert_eq!(problem.cells(), *cells, "{name}");
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
        let registry = builtin();
        let text = |problem: &Problem| format!("{:?}", problem.solver());
        for (name, focus) in cases() {
            let Some(sizes) = focus.sizes.filter(|sizes| !sizes.exact.is_empty()) else { continue };
            let smoothed = sizes.laws.first().map(|law| sizes.set(law, "1e-3")).unwrap_or_default();
            let (_, with) = registry.load(name, &smoothed).unwrap();
            let (_, exact) = registry.load(name, &[smoothed, sizes.exactly()].concat()).unwrap();
            let (_, alone) = registry.load(name, &sizes.exactly()).unwrap();
            assert!(text(&with) != text(&exact) && text(&exact) == text(&alone), "{name}");
        }
    }
}
