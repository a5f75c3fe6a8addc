//! Whether a bed can be at rest on its slope at all: the balance of all that lies on its bottom.
//!
//! Grains of the solid volume `phi T` on the bottom carry at most `mu_s P`, `P = (rho_p - rho_f) g cos(beta) phi T`. Along the slope pull the
//! fluid, `rho_f g sin(beta) (h + T)`, and the buoyant weight of the grains, `(rho_p - rho_f) g sin(beta) phi T`. Deep beds are the case h/T -> 0.

use super::TwoFluid;
use crate::closures::kinetic::Granular;
use crate::closures::kinetic::static_friction::Threshold;

impl TwoFluid {
    /// Friction of grains at rest: that of enduring contacts, or that of the inertial rheology.
    #[must_use]
    pub fn friction_at_rest(&self) -> f64 {
        match self.granular {
            Granular::Inertial(law) => law.mu_s,
            _ => self.static_friction.mu_s(self.mu_p),
        }
    }

    /// Friction that keeps the bed on its bottom, over that which its grains have: 1 and more, and all of it moves.
    #[must_use]
    pub fn pull_on_the_bottom(&self) -> f64 {
        self.beta.abs().tan() / self.steepest(self.thickness).tan()
    }

    /// Slope up to which a bed of the thickness `thickness` \[m] rests under this depth \[rad]; `f64::INFINITY`: a deep one.
    #[must_use]
    pub fn steepest(&self, thickness: f64) -> f64 {
        let grains = (self.rho_p - self.rho_f) * self.phi;
        (self.friction_at_rest() * grains / (self.rho_f * (self.depth / thickness + 1.0) + grains)).atan()
    }

    /// Thickness of a bed that rests on this slope under this depth \[m]; `None` on a slope on which none does.
    #[must_use]
    pub fn thickness_at_rest(&self) -> Option<f64> {
        let grains = (self.rho_p - self.rho_f) * self.phi;
        let slope = self.beta.abs().tan();
        let spare = self.friction_at_rest() * grains - (self.rho_f + grains) * slope;
        (spare > 0.0).then(|| self.rho_f * self.depth * slope / spare)
    }
}
