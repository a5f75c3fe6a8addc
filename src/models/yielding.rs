//! What the models with a yield stress share: the one size of its regularisation, and how they converge over it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::CaseFault;
use crate::case::tables::cells;
use crate::closures::regularisation::Smoothing;
use crate::model::{Faults, Law, Meshes, Rung, Sizes, Smoothed};
use crate::models::exact::bed::LaminarBed;
use crate::result::codes;

/// A regularisation without a size, with two, or a size without a law.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", match (*given, *exact) { (0, _) => "the regularisation has no size", (_, true) => "the exact yield (law = \"none\") has no size", _ => "the regularisation has two sizes" })]
pub struct RegularisationSize {
    /// sizes that were given
    pub given: usize,
    /// whether the law is `none`
    pub exact: bool,
    /// the keys of a size that the model has
    pub keys: &'static [&'static str],
}

codes!(RegularisationSize {
    Self { .. } => "regularisation-size",
});

impl CaseFault for RegularisationSize {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn allowed(&self) -> Option<String> {
        Some(match self.keys {
            [only] => format!("a {only} with a law; none with law = \"none\""),
            keys => format!("one of {} with a law; neither with law = \"none\"", keys.join(", ")),
        })
    }
}

/// How the yield stress is smoothed, and by how much: a size for every law but `none`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RegularisationTable {
    /// Law of the smoothing.
    #[serde(default)]
    pub law: Smoothing,
    /// Size: shear rate below which the material creeps instead of standing still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1/s", "exclusiveMinimum" = 0.0, "maximum" = 1e6))]
    pub lambda: Option<f64>,
    /// Size in the model's unit of shear rate: (rho_p - rho_f) g H/eta for a bed; for a Bingham fluid U_m/H, or G H/eta where the gradient G is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub lambda_scaled: Option<f64>,
}

/// Cells of a solver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct YieldGrid {
    /// Number of cells.
    #[serde(default = "cells")]
    #[schemars(extend("minimum" = 8, "maximum" = 1_000_000))]
    pub cells: usize,
    /// Whether a node is placed on the yield level, where the solution has a corner.
    #[serde(default = "yes")]
    pub yield_node: bool,
}

impl Default for YieldGrid {
    fn default() -> Self {
        Self { cells: cells(), yield_node: true }
    }
}

fn yes() -> bool {
    true
}

/// The size of a regularisation, as it was given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Size {
    /// [1/s]
    Rate(f64),
    /// in the unit of the model
    Scaled(f64),
}

impl Size {
    /// In units of the shear rate `unit` [1/s].
    pub(super) fn to_scaled(self, unit: f64) -> f64 {
        match self {
            Self::Rate(lambda) => lambda / unit,
            Self::Scaled(lambda) => lambda,
        }
    }
}

/// The one size that a law needs; 0 for the exact yield.
pub(super) fn size(table: &RegularisationTable, faults: &mut Faults) -> Option<Size> {
    match (table.law, table.lambda, table.lambda_scaled) {
        (Smoothing::None, None, None) => Some(Size::Scaled(0.0)),
        (Smoothing::Simple | Smoothing::BercovierEngelman | Smoothing::Papanastasiou, Some(lambda), None) => {
            Some(Size::Rate(lambda))
        }
        (Smoothing::Simple | Smoothing::BercovierEngelman | Smoothing::Papanastasiou, None, Some(lambda)) => {
            Some(Size::Scaled(lambda))
        }
        (law, a, b) => {
            let given = usize::from(a.is_some()) + usize::from(b.is_some());
            faults.push((
                "regularisation",
                RegularisationSize { given, exact: law == Smoothing::None, keys: &["lambda", "lambda_scaled"] },
            ));
            None
        }
    }
}

/// Changes that give the exact yield.
pub(super) const EXACT: &[&str] =
    &["regularisation.law=none", "regularisation.lambda=", "regularisation.lambda_scaled="];

/// Sizes in the model's unit of shear rate.
pub(super) const SCALED: Sizes = Sizes {
    key: "regularisation.lambda_scaled",
    unit: "1",
    formula: "λ",
    symbols: "",
    shear_unit: 1.0,
    exact: EXACT,
    changes: &["regularisation.lambda="],
    laws: &[
        Smoothed { name: "simple", changes: &["regularisation.law=simple"], falls: Some(Law::Logarithmic) },
        Smoothed {
            name: "bercovier-engelman",
            changes: &["regularisation.law=bercovier-engelman"],
            falls: Some(Law::Linear),
        },
        Smoothed { name: "papanastasiou", changes: &["regularisation.law=papanastasiou"], falls: Some(Law::Linear) },
    ],
    decades: (1, 12),
    reported: &[1e-4, 1e-6, 1e-10],
    slopes_from: 1e-4,
    creep: false,
    rule: None,
    remarks: &[],
};

/// Multiples of 12, so that the cells of every layer double with the mesh.
pub(super) const PLANES: Meshes = Meshes {
    cells: &[24, 48, 96, 192, 384, 768, 1536],
    reference: 3072,
    changes: EXACT,
    kinds: &[("node on the yield level", &["grid.yield_node=true"]), ("no node there", &["grid.yield_node=false"])],
    remarks: &[("yield", "exact")],
};

/// Bingham number of the first layer of grains.
pub(super) const OVER_A_BED: &str = "μ_s (ρ_p - ρ_f) g d H/(η U_m)";

/// Yield stress of the first layer of grains, as in section 3.2 of the paper \[Pa].
pub(super) fn first_layer(bed: &LaminarBed) -> f64 {
    bed.friction.mu_s * (bed.rho_p - bed.rho_f) * bed.g * bed.d
}

/// Sizes of the regularisation on a ladder.
pub(super) const LAMBDAS: [&str; 4] = ["1e-2", "1e-4", "1e-6", "1e-8"];

/// Each of the first laws with each size on some meshes.
pub(super) fn regularised(sizes: &Sizes, laws: usize, lambdas: &[&str], meshes: &[usize]) -> Vec<Rung> {
    let mut rungs = Vec::new();
    for law in sizes.laws.iter().take(laws) {
        for lambda in lambdas {
            for &cells in meshes {
                let rung = Rung::cells(law.name, cells, &sizes.set(law, lambda));
                rungs.push(Rung { setting: format!("λ = {}, {}", sizes.text(lambda), rung.setting), ..rung });
            }
        }
    }
    rungs
}

/// The ladder of a flow between two planes.
pub(super) fn plane(sizes: &Sizes) -> Vec<Rung> {
    let exact = [12, 24, 48, 96, 192, 384].map(|cells| Rung::cells("exact yield", cells, &sizes.exactly()));
    [exact.to_vec(), regularised(sizes, 3, &LAMBDAS, &[24, 96, 384])].concat()
}

/// The exact yield on a mesh much finer than all others.
pub(super) fn finest(cells: usize, changes: Vec<String>) -> Option<(String, Vec<String>)> {
    Some((format!("exact yield, {cells} cells"), [vec![format!("grid.cells={cells}")], changes].concat()))
}
