//! Stresses and fluctuations of grains that collide: kinetic theory, what friction and drag change in it, and the stresses of
//! enduring contacts.

pub mod dissipation;
pub mod drag_work;
pub mod elastic;
pub mod radial;
pub mod saltation;
pub mod static_friction;
pub mod theory;

use super::Info;
use super::role::role;
pub use dissipation::Dissipation;
pub use drag_work::DragWork;
pub use elastic::{Elastic, JohnsonJackson};
pub use inertial::PHI_C;
pub use radial::Radial;
pub use saltation::{Limit, Saltation};
pub use static_friction::StaticFriction;
pub use theory::{Kinetic, Moving};

role! {
    /// Stresses of grains that move.
    pub enum Granular {
        garzo_dufty::GarzoDufty(..),
        frictional_collisional::FrictionalCollisional(..),
        #[serde(rename = "mu-i")]
        inertial::Inertial(..),
    }

    /// What the laws of the stresses answer.
    pub trait Stresses {
        /// The law for grains of the restitution `e` and the friction `mu_p`, as a solver takes it.
        #[must_use]
        fn moving(&self, e: f64, mu_p: f64) -> Moving;
        /// Catalogue entries of the laws that it is made of.
        #[must_use]
        fn parts(&self) -> Vec<&'static Info>;
    }
}
