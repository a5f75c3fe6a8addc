//! Force between the fluid and the grains.

pub mod carman_kozeny;
pub mod dallavalle;
pub mod dallavalle_grain;
pub mod none;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Info;
pub use carman_kozeny::CarmanKozeny;
pub use dallavalle::Dallavalle;
pub use dallavalle_grain::{DallavalleGrain, GrainDrag};

/// Drag law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum Drag {
    /// The phases move together; nothing is computed.
    #[default]
    None,
    /// Darcy's law with the permeability of Carman and Kozeny.
    CarmanKozeny(CarmanKozeny),
    /// Drag of single grains, hindered by their neighbours.
    Dallavalle(Dallavalle),
}

impl Drag {
    /// Catalogue entry of the law.
    #[must_use]
    pub fn info(&self) -> &'static Info {
        match self {
            Self::None => &none::INFO,
            Self::CarmanKozeny(_) => &carman_kozeny::INFO,
            Self::Dallavalle(_) => &dallavalle::INFO,
        }
    }
}
