//! What every run of grains shares: the law of its case.

use super::error::RunError;
use super::law::LinearSpring;
use crate::closures::contact::{self, Tension, linear_spring, restitution};
use crate::units::significant;

/// The law of the case.
///
/// # Errors
/// [`RunError::Restitution`] if no damping gives its restitution coefficient.
pub fn law(contact: &contact::LinearSpring) -> Result<LinearSpring, RunError> {
    LinearSpring::new(contact.k_n, contact.k_s, contact.mu, contact.e_n, contact.tension).map_err(RunError::Restitution)
}

/// The law of contact with its numbers.
#[must_use]
pub fn contact_equations(contact: &contact::LinearSpring) -> String {
    let n = |x: f64| significant(x, 5);
    let zeta = restitution::damping_ratio(contact.e_n, contact.tension).map_or_else(|_| "-".into(), n);
    format!(
        "motion         m dv/dt = Σ f + m g,  (2/5) m R² dω/dt = Σ l × f,  leapfrog\n\
         contact        {}{}\n\
         constants      k_n = {} N/m, e_n = {}, ζ = {}, k_s = {} N/m, μ = {}\n\
         tangential     ds/dt = v_t in the plane of contact\n\
         mass           1/m = 1/m_1 + 1/m_2, of the pair; 0 for fixed grains and walls\n",
        linear_spring::INFO.equation,
        if contact.tension == Tension::Cut { ",  f_n ≥ 0" } else { "" },
        n(contact.k_n),
        n(contact.e_n),
        zeta,
        n(contact.k_s),
        n(contact.mu),
    )
}
