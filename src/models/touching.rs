//! What grains that touch have of the scene: friction and restitution; their stiffness is a matter of the model.

use crate::case::tables::Grains;
use crate::closures::contact::LinearSpring;
use crate::scene;

/// The grains of a case that has friction and restitution in the law of contact.
pub fn touching(grains: &Grains, contact: &LinearSpring) -> scene::Grains {
    let (restitution, friction) = (Some(contact.e_n), Some(contact.mu));
    scene::Grains { restitution, friction, ..scene::Grains::new(grains.diameter, grains.density) }
}

/// The law of contact with friction and restitution of the scene; `None` where it has none.
pub fn of_scene(contact: LinearSpring, grains: &scene::Grains) -> Option<LinearSpring> {
    Some(LinearSpring { e_n: grains.restitution?, mu: grains.friction?, ..contact })
}
