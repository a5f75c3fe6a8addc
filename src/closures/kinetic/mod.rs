//! Stresses and fluctuations of grains that collide: kinetic theory, what friction and drag change in it, and the stresses of
//! enduring contacts.

pub mod drag_work;
pub mod elastic;
pub mod garzo_dufty;
pub mod granular;
pub mod inertial;
pub mod radial;
pub mod restitution;
pub mod saltation;
pub mod static_friction;

pub use drag_work::DragWork;
pub use elastic::{Elastic, JohnsonJackson};
pub use granular::{FRICTIONAL_COLLISIONAL, FrictionalCollisional, GarzoDufty, Granular, Kinetic, Limit};
pub use inertial::{Inertial, PHI_C};
pub use radial::Radial;
pub use restitution::Dissipation;
pub use saltation::Saltation;
pub use static_friction::StaticFriction;
