//! The physical flow, whatever solves it: fluid, grains, bed at rest, the flow over it and what drives it. Values in SI.
//!
//! A scene says nothing of how it is solved. Its kinds keep what does not belong together apart:
//!
//! | kind | flow | models |
//! |---|---|---|
//! | [`BedScene`] | over a bed of grains | laminar and its closed form, sections over a bed, sheet flow, two fluids, grains in a fluid |
//! | [`ChannelScene`] | without grains | Bingham plane, duct, log law |
//! | [`GranularScene`] | of grains without a fluid that drives them | film, chute, bed at rest |
//! | [`BenchmarkScene`] | whose geometry is a matter of the model | cavity, shear cell, impact, verification cases |
//!
//! What follows from a scene stands here once: its numbers ([`Scene::numbers`]), its amount of grains, and in what two scenes
//! differ ([`SceneRecord::differences`]).

mod bed;
mod channel;
mod drive;
mod granular;
mod number;

pub use bed::{Bed, BedFlow, BedScene, Section, Top};
pub use channel::{BenchmarkScene, ChannelFlow, ChannelScene, Material};
pub use granular::{GranularFlow, GranularScene};
pub use number::{Given, SceneNumber};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::case::{Fault, FlowTables};
use crate::result::{SceneRecord, flatten};

/// The grains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Grains {
    /// Diameter of the grains.
    #[schemars(extend("x-unit" = "m", "exclusiveMinimum" = 0.0, "maximum" = 10.0))]
    pub diameter: f64,
    /// Density of the grains.
    #[schemars(extend("x-unit" = "kg/m3", "exclusiveMinimum" = 0.0, "maximum" = 30000.0))]
    pub density: f64,
    /// Restitution coefficient of two grains; left out, it is 0.7.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 1.0))]
    pub restitution: Option<f64>,
    /// Friction coefficient between two grains; left out, it is 0.4.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "1", "minimum" = 0.0, "maximum" = 10.0))]
    pub friction: Option<f64>,
    /// Settling velocity of the grains; left out, it is that of a sphere alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m/s", "exclusiveMinimum" = 0.0, "maximum" = 100.0))]
    pub settling_velocity: Option<f64>,
}

impl Grains {
    /// Friction coefficient between two grains: given, or that of glass beads (Maurin et al. 2015).
    #[must_use]
    pub fn friction(&self) -> Given {
        self.friction.map_or(Given::Derived(0.4), Given::Given)
    }

    /// Restitution coefficient of two grains: given, or that of glass beads in the reference flow of Chassagne et al. (2023).
    #[must_use]
    pub fn restitution(&self) -> Given {
        self.restitution.map_or(Given::Derived(0.7), Given::Given)
    }

    /// Grains of which nothing but this is known.
    #[must_use]
    pub fn new(diameter: f64, density: f64) -> Self {
        Self { diameter, density, restitution: None, friction: None, settling_velocity: None }
    }
}

/// The physical flow.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "scene", rename_all = "kebab-case")]
#[non_exhaustive]
#[expect(clippy::large_enum_variant, reason = "a run has one scene")]
pub enum Scene {
    /// over a bed of grains
    Bed(BedScene),
    /// without grains
    Channel(ChannelScene),
    /// of grains without a fluid that drives them
    Granular(GranularScene),
    /// whose geometry is a matter of the model
    Benchmark(BenchmarkScene),
}

macro_rules! kinds {
    ($($kind:ident($scene:ident) = $word:literal),*) => {
        $(impl FlowTables for $scene {
            const KIND: &'static str = $word;

            fn faults(&self) -> Vec<(&'static str, Fault)> {
                $scene::faults(self)
            }

            fn given(&self) -> Vec<&'static str> {
                $scene::given(self)
            }

            fn top(&self) -> Option<&'static str> {
                $scene::top(self)
            }
        }

        impl From<$scene> for Scene {
            fn from(scene: $scene) -> Self {
                Self::$kind(scene)
            }
        })*
    };
}

kinds!(
    Bed(BedScene) = "bed",
    Channel(ChannelScene) = "channel",
    Granular(GranularScene) = "granular",
    Benchmark(BenchmarkScene) = "benchmark"
);

impl Scene {
    /// `bed`, `channel`, `granular` or `benchmark`.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Bed(_) => BedScene::KIND,
            Self::Channel(_) => ChannelScene::KIND,
            Self::Granular(_) => GranularScene::KIND,
            Self::Benchmark(_) => BenchmarkScene::KIND,
        }
    }

    /// Its numbers, as far as the scene alone fixes them.
    #[must_use]
    pub fn numbers(&self) -> Vec<SceneNumber> {
        let numbers = match self {
            Self::Bed(bed) => bed.numbers(),
            Self::Channel(channel) => channel.numbers(),
            Self::Granular(granular) => granular.numbers(),
            Self::Benchmark(_) => Vec::new(),
        };
        numbers.into_iter().filter(|number| number.value.is_finite()).collect()
    }

    /// What it does not say and follows, by key: value, and where it comes from.
    #[must_use]
    pub fn derived(&self) -> Vec<(&'static str, f64, &'static str)> {
        let of_grains = |grains: &Grains| {
            vec![
                ("grains.friction", grains.friction(), "glass beads: Maurin et al. (2015)"),
                ("grains.restitution", grains.restitution(), "glass beads: Chassagne et al. (2023)"),
            ]
        };
        let packing = |bed: &Bed| ("bed.phi", bed.phi(), "a random packing of spheres with friction");
        let all = match self {
            Self::Bed(scene) => {
                let mut all = of_grains(&scene.grains);
                let sphere = "a sphere alone: Cheng (2009)";
                all.extend([packing(&scene.bed), ("grains.settling_velocity", scene.settling_velocity(), sphere)]);
                let surface = scene.flow.top == Top::FreeSurface;
                if let (None, Some(depth), true) = (scene.flow.depth, scene.depth(), surface) {
                    all.push(("flow.depth", Given::Derived(depth), "the stress wanted on the bed at this slope"));
                }
                if let (None, Some(angle), true) = (scene.flow.slope, scene.slope(), surface) {
                    let sine = Given::Derived(angle.sin());
                    all.push(("sine of flow.slope", sine, "the stress wanted on the bed under this depth"));
                }
                all
            }
            Self::Granular(scene) => [of_grains(&scene.grains), vec![packing(&scene.bed)]].concat(),
            Self::Channel(_) => Vec::new(),
            Self::Benchmark(scene) => scene.grains.as_ref().map(of_grains).unwrap_or_default(),
        };
        let derived = |(key, given, from)| match given {
            Given::Derived(value) => Some((key, value, from)),
            Given::Given(_) => None,
        };
        all.into_iter().filter_map(derived).collect()
    }

    /// Shields number of what drives a flow over a bed, where the scene alone fixes it.
    #[must_use]
    pub fn shields_drive(&self) -> Option<f64> {
        match self {
            Self::Bed(scene) => scene.shields_drive().filter(|theta| theta.is_finite()),
            _ => None,
        }
    }

    /// That Shields number with its friction velocity [m/s].
    #[must_use]
    pub fn drive(&self) -> Option<(f64, f64)> {
        let Self::Bed(scene) = self else { return None };
        self.shields_drive().zip(scene.u_star_drive())
    }

    /// Solid volume of the bed at rest per area \[m], without pores; `None` where the scene does not say.
    #[must_use]
    pub fn solid_volume(&self) -> Option<f64> {
        match self {
            Self::Bed(BedScene { bed, .. }) | Self::Granular(GranularScene { bed, .. }) => bed.solid_volume(),
            Self::Channel(_) | Self::Benchmark(_) => None,
        }
    }

    /// The scene as `summary.json` keeps it.
    #[must_use]
    pub fn record(&self) -> SceneRecord {
        let mut inputs = Map::new();
        if let Ok(Value::Object(tables)) = serde_json::to_value(self) {
            flatten("", &Value::Object(tables), &mut inputs);
        }
        inputs.shift_remove("scene");
        let numbers = self.numbers().into_iter().map(|number| {
            let SceneNumber { name, value, definition } = number;
            (name.to_owned(), json!({ "value": value, "definition": definition }))
        });
        let numbers = numbers.collect();
        SceneRecord { kind: self.kind().to_owned(), inputs, numbers, solid_volume_m: self.solid_volume() }
    }
}

#[cfg(test)]
mod tests;
