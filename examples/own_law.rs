//! A law from outside the crate in a model of the program: sheet flow of grains whose friction rises with a power of the inertial
//! number. The law states its curve; the solver finds the inverse, and its derivatives come from dual numbers.
//!
//! `cargo run --release --example own_law`; `docs/adding-a-law.md` walks through it.

use std::error::Error;

use bedload::closures::friction::{FrictionLaw, INERTIAL_RANGE};
use bedload::closures::role::Law;
use bedload::closures::{Info, Standing};
use bedload::models::sheet_flow::SheetFlow;
use bedload::numerics::dual::Real;
use bedload::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Catalogue entry.
static INFO: Info = Info {
    family: "friction",
    law: "power",
    equation: "μ(I) = μ_s + (μ_2 - μ_s)/((I_0/I)^n + 1)",
    source: "the example: Jop, Forterre & Pouliquen (2006) for n = 1",
    ranges: &[INERTIAL_RANGE],
    standing: Standing::Experimental,
};

/// Friction that rises with a power of the inertial number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Power {
    /// Friction coefficient at vanishing inertial number.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 2.0))]
    pub mu_s: f64,
    /// Friction coefficient at large inertial number; more than mu_s.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 3.0))]
    pub mu_2: f64,
    /// Inertial number at which the friction is half-way between mu_s and mu_2.
    #[schemars(extend("x-unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub i_0: f64,
    /// Exponent n of the rise; 1 is mu(I) as published.
    #[schemars(extend("x-unit" = "1", "minimum" = 0.2, "maximum" = 2.0))]
    pub n: f64,
}

impl Law for Power {
    const INFO: &'static Info = &INFO;
}

/// That of spheres (Maurin et al. 2016), as mu(I) has it.
impl Default for Power {
    fn default() -> Self {
        Self { mu_s: 0.35, mu_2: 0.97, i_0: 0.69, n: 1.0 }
    }
}

impl FrictionLaw for Power {
    fn mu<T: Real>(&self, i: T) -> T {
        let rise = i.powf(self.n);
        rise * (self.mu_2 - self.mu_s) / (rise + self.i_0.powf(self.n)) + self.mu_s
    }

    fn least(&self) -> f64 {
        self.mu_s
    }

    fn most(&self) -> f64 {
        self.mu_2
    }

    fn half_way(&self) -> f64 {
        self.i_0
    }

    fn with_half_way(self, i_0: f64) -> Self {
        Self { i_0, ..self }
    }

    fn constants(&self) -> Vec<(&'static str, f64)> {
        vec![("μ_s", self.mu_s), ("μ_2", self.mu_2), ("I_0", self.i_0), ("n", self.n)]
    }
}

/// The models of the program, with the sheet flow of this law in place of that of mu(I).
pub fn registry() -> Registry {
    builtin().with(Entry::of::<OnMesh<SheetFlow<Power>>>())
}

/// The reference flow with this law: `n` of the rise.
pub fn reference(n: f64) -> Result<Problem, Box<dyn Error>> {
    let friction = format!("closures.friction={{ law = \"power\", mu_s = 0.35, mu_2 = 0.97, i_0 = 0.69, n = {n} }}");
    Ok(registry().load("flow_theta06-sheet-flow", &[friction])?.1)
}

/// Transport rates over the exponent.
#[allow(dead_code, reason = "a test includes this file as a module")]
fn main() -> Result<(), Box<dyn Error>> {
    for n in [0.5, 0.75, 1.0] {
        let outcome = Simulation::new(&reference(n)?).run()?;
        let rate = outcome.results.get(quantity::TRANSPORT_RATE.name).ok_or("no rate")?;
        println!("n = {n}: {rate:.4e} m2/s");
    }
    Ok(())
}
