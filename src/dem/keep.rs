//! What every run of grains shares: the law of its case, and why its files cannot be used.

use super::law::LinearSpring;
use crate::closures::contact::{self, Tension, restitution};
use crate::result::{CheckpointError, SolveError};
use crate::units::significant;

/// The law of the case.
///
/// # Errors
/// [`SolveError`] if no damping gives its restitution coefficient.
pub fn law(contact: &contact::LinearSpring) -> Result<LinearSpring, SolveError> {
    LinearSpring::new(contact.k_n, contact.k_s, contact.mu, contact.e_n, contact.tension).map_err(|error| {
        SolveError::Grains {
            code: "restitution",
            message: error.to_string(),
            hint: "a restitution coefficient (closures.contact.e_n) in (0, 1]",
        }
    })
}

/// A checkpoint that cannot be used.
#[must_use]
pub fn refused(error: CheckpointError) -> SolveError {
    SolveError::Grains {
        code: "checkpoint",
        message: format!("the checkpoint cannot be used: {error}"),
        hint: "--force starts again",
    }
}

/// A file of the run that cannot be written.
#[must_use]
pub fn unwritable(error: &std::io::Error) -> SolveError {
    SolveError::Grains {
        code: "file",
        message: format!("a file of the grains cannot be written: {error}"),
        hint: "free some space, or give another folder with --out",
    }
}

/// The law of contact with its numbers.
#[must_use]
pub fn contact_equations(contact: &contact::LinearSpring) -> String {
    let n = |x: f64| significant(x, 5);
    let zeta = restitution::damping_ratio(contact.e_n, contact.tension).map_or_else(|_| "-".into(), n);
    format!(
        "motion         m dv/dt = Σ f + m g,  (2/5) m R² dω/dt = Σ l × f,  leapfrog\n\
         normal         f_n = k_n δ - c v_n{},  k_n = {} N/m,  c = 2 ζ sqrt(m k_n),  ζ = {} for e_n = {}\n\
         tangential     ds/dt = v_t in the plane of contact,  |f_t| = min(k_s |s|, μ max(f_n, 0)),  k_s = {} N/m,  μ = {}\n\
         mass           1/m = 1/m_1 + 1/m_2, of the pair; 0 for fixed grains and walls\n",
        if contact.tension == Tension::Cut { " ≥ 0" } else { "" },
        n(contact.k_n),
        zeta,
        n(contact.e_n),
        n(contact.k_s),
        n(contact.mu),
    )
}
