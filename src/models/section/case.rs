//! The tables that only flows in two-dimensional sections have.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::models::exact::bed::{BedClosures, Form};
use crate::models::yielding::RegularisationTable;
use crate::part;

/// A square cavity under a lid that slides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CavityFlow {
    /// Side H of the cavity.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 1e4))]
    pub height: f64,
    /// Drive: velocity of the lid.
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 1e5))]
    pub lid_velocity: f64,
}

/// How the convex minimum is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Newton's method with the stress as an extra unknown: regularised, or with the exact yield by a smoothing that is taken down until nothing changes.
    #[default]
    Newton,
    /// Accelerated ascent of the dual with the exact yield: one factorisation, few digits.
    FirstOrder,
}

/// Cells of a cavity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CavityGrid {
    /// Cells from the bottom to the lid and across; an even number.
    #[serde(default = "cavity_cells")]
    #[schemars(extend("minimum" = 8, "maximum" = 512, "multipleOf" = 2))]
    pub cells: usize,
    /// Size of the cells at the lid and at the side walls over the mean one; 1: equal cells.
    #[serde(default = "one")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.001, "maximum" = 1.0))]
    pub finest: f64,
}

impl Default for CavityGrid {
    fn default() -> Self {
        Self { cells: cavity_cells(), finest: one() }
    }
}

fn cavity_cells() -> usize {
    64
}

/// Elements of a section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SectionGrid {
    /// Elements from the bottom to the top; half as many across half of a section as wide as high.
    #[serde(default = "cells")]
    #[schemars(extend("minimum" = 8, "maximum" = 512))]
    pub cells: usize,
    /// Whether a row of elements ends on the yield surface of a bed.
    #[serde(default = "yes")]
    pub yield_row: bool,
    /// Size of the elements at the walls and at the bed level over the mean one; 1: equal elements, but near the stop of a Bingham fluid.
    #[serde(default = "one")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.001, "maximum" = 1.0))]
    pub finest: f64,
    /// Elements along one height of the flow: the whole three-dimensional duct beside its section. Left out, the section alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 2, "maximum" = 64))]
    pub along: Option<usize>,
}

impl Default for SectionGrid {
    fn default() -> Self {
        Self { cells: cells(), yield_row: true, finest: one(), along: None }
    }
}

/// When the first-order method ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SectionSolver {
    /// Duality gap over the work of the drive at which the first-order method ends.
    #[serde(default = "tolerance")]
    #[schemars(extend("x-unit" = "1", "minimum" = 1e-14, "maximum" = 0.1))]
    pub tolerance: f64,
    /// Most iterations of the first-order method.
    #[serde(default = "iterations")]
    #[schemars(extend("minimum" = 1, "maximum" = 1_000_000))]
    pub iterations: usize,
}

impl Default for SectionSolver {
    fn default() -> Self {
        Self { tolerance: tolerance(), iterations: iterations() }
    }
}

fn cells() -> usize {
    32
}
fn yes() -> bool {
    true
}
fn one() -> f64 {
    1.0
}
fn tolerance() -> f64 {
    1e-8
}
fn iterations() -> usize {
    20_000
}

part! {
    /// Yield-stress fluid along a duct, in its cross-section.
    pub struct DuctTable {
        /// How the minimum is found.
        #[serde(default)]
        method: Method,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Elements of the section.
        #[serde(default)]
        grid: SectionGrid,
        /// The first-order method.
        #[serde(default)]
        solver: SectionSolver,
    }
}

part! {
    /// Laminar flow along a duct over a bed of grains, in its cross-section.
    pub struct DuctBedTable {
        /// One velocity for fluid and grains, or two.
        #[serde(default)]
        form: Form,
        /// How the minimum is found.
        #[serde(default)]
        method: Method,
        /// Laws.
        #[serde(default)]
        closures: BedClosures,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Elements of the section.
        #[serde(default)]
        grid: SectionGrid,
        /// The first-order method.
        #[serde(default)]
        solver: SectionSolver,
    }
}

part! {
    /// Slow flow of a yield-stress fluid in a square cavity under a sliding lid.
    pub struct CavityTable {
        /// The cavity and its lid.
        geometry: CavityFlow,
        /// How the minimum is found.
        #[serde(default)]
        method: Method,
        /// How the yield stress is smoothed.
        #[serde(default)]
        regularisation: RegularisationTable,
        /// Cells of the cavity.
        #[serde(default)]
        grid: CavityGrid,
        /// The first-order method.
        #[serde(default)]
        solver: SectionSolver,
    }
}
