//! What can be wrong with a flow that has a closed form: its case, and the form itself.

use crate::case::CaseFault;
use crate::numerics::root::NoRoot;
use crate::result::{Class, MethodError, NumericalError, SolveError, codes};

/// Laws of a closed form that do not go with its flow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExactFault {
    /// More grains than fit.
    #[error("bed.phi = {phi} is not below phi_max = {phi_max} of the viscosity law")]
    Jammed {
        /// solid fraction
        phi: f64,
        /// solid fraction at which the grains jam
        phi_max: f64,
    },
    /// A wall rougher than the flow is high.
    #[error("the roughness length k_s/30 = {length} m is not below the flow height {height} m")]
    RoughnessAboveFlow {
        /// roughness length \[m]
        length: f64,
        /// flow height \[m]
        height: f64,
    },
}

codes!(ExactFault {
    Self::Jammed { .. } => "jammed",
    Self::RoughnessAboveFlow { .. } => "roughness-above-flow",
});

impl CaseFault for ExactFault {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn allowed(&self) -> Option<String> {
        match self {
            Self::Jammed { phi_max, .. } => Some(format!("less than {phi_max}")),
            Self::RoughnessAboveFlow { height, .. } => Some(format!("k_s less than {} m", 30.0 * height)),
        }
    }
}

/// Why a flow has no closed form.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExactError {
    /// A granular film that accelerates without end.
    #[error("no steady film: tan(slope) = {tangent:.6} is not below mu_2 = {mu_2:.6}")]
    NoSteadyFilm {
        /// tangent of the slope
        tangent: f64,
        /// largest friction coefficient of the material
        mu_2: f64,
    },
}

codes!(ExactError {
    Self::NoSteadyFilm { .. } => "no-steady-film",
});

impl MethodError for ExactError {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn class(&self) -> Class {
        Class::Unphysical
    }

    fn hint(&self) -> String {
        "lower the slope: a steady film needs mu_s < tan(slope) < mu_2".into()
    }
}

/// The error of a search for the root of `equation`. A search among numbers that are not finite is reported as one.
pub(in crate::models) fn no_root(equation: &'static str) -> impl Fn(NoRoot) -> SolveError {
    move |NoRoot { low, high, residual, evaluations }| {
        if residual.is_finite() && low.is_finite() && high.is_finite() {
            NumericalError::NoRoot { equation, iterations: evaluations, residual, low, high }.into()
        } else {
            NumericalError::NotRepresentable { name: equation.into() }.into()
        }
    }
}
