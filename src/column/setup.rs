//! What a column is told: the laws of the fluid, and what drives it.

use super::ColumnError;
use crate::closures::mixing_length::MixingLength;
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::side_wall::SideWall;

/// The published forms of the viscous stress. The discrete equation of each is in [`super::fluid`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViscousForm {
    /// Revil-Baudard & Chauchat (2013), eq. (13)-(17): stresses by the gradient of the mixture velocity
    /// `U = eps u_f + phi u_p`; the fluid takes `eps d(tau)/dz`, the grains `phi d(tau)/dz`.
    Mixture,
    /// Maurin et al. (2015), eq. (2)-(4) and (19): stresses by the gradient of the fluid velocity, of which the fluid takes
    /// `d(eps tau)/dz`.
    Fluid,
    /// The kinetic model, eq. (2.7): `d/dz[rho_f eps (nu + nu_t) du_f/dz]`.
    Effective,
}

/// When an iteration ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newton {
    /// largest residual of a cell over the largest force in the column, both per area of the bed
    pub tolerance: f64,
    /// iterations after which the step fails
    pub iterations: usize,
}

impl Default for Newton {
    /// 1e-13 and 100.
    fn default() -> Self {
        Self { tolerance: 1e-13, iterations: 100 }
    }
}

/// The laws of the fluid: what does not change from step to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// density rho_f [kg/m3]
    pub rho: f64,
    /// viscosity of the clear fluid [Pa s]
    pub eta: f64,
    /// effective viscosity eta_e of the mixture
    pub viscosity: MixtureViscosity,
    /// form of the viscous stress
    pub form: ViscousForm,
    /// turbulence
    pub mixing_length: MixingLength,
    /// friction of the side walls
    pub side_wall: SideWall,
    /// distance of the side walls W \[m]; infinite without them
    pub width: f64,
    /// end of the iteration
    pub newton: Newton,
}

impl Setup {
    /// A clear laminar fluid of density `rho` [kg/m3] and viscosity `eta` [Pa s], without side walls.
    #[must_use]
    pub fn laminar(rho: f64, eta: f64) -> Self {
        Self {
            rho,
            eta,
            viscosity: MixtureViscosity::Clear,
            form: ViscousForm::Fluid,
            mixing_length: MixingLength::None,
            side_wall: SideWall::None,
            width: f64::INFINITY,
            newton: Newton::default(),
        }
    }

    pub(super) fn check(&self) -> Result<(), ColumnError> {
        positive("density [kg/m3]", self.rho)?;
        positive("viscosity [Pa s]", self.eta)?;
        if self.side_wall != SideWall::None {
            positive("width [m]", self.width)?;
        }
        positive("tolerance", self.newton.tolerance)
    }
}

/// What holds the bottom of the column, face 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bottom {
    /// A smooth wall at rest; turbulence vanishes there.
    NoSlip,
    /// A fully rough wall, `u = (u_*/kappa) ln(z/z_0)` between face 0 and the centre of cell 0, z counted from face 0.
    Rough {
        /// roughness length \[m]
        z_0: f64,
        /// von Karman's constant
        kappa: f64,
    },
    /// A level in the flow, as the top of a bed that is solved elsewhere.
    Flow {
        /// velocity there [m/s]: the one whose gradient the viscous form takes, of the mixture or of the fluid
        velocity: f64,
        /// mixing length there \[m], from what lies below; the law adds to it
        mixing_length: f64,
    },
    /// A stress T(0) \[Pa], positive where the fluid drags what lies below. All of it acts on the fluid.
    Stress(f64),
}

/// What holds the top of the column, its last face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Top {
    /// No stress.
    FreeSurface,
    /// A stress T(H) \[Pa], positive where it drives the fluid, negative where a lid holds it back. All of it acts on the fluid.
    Stress(f64),
    /// A smooth lid at rest; turbulence vanishes at it.
    NoSlip,
    /// A smooth lid that moves with a velocity [m/s].
    Lid(f64),
}

/// What drives the fluid during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forcing {
    /// driving force per volume of fluid [Pa/m]: `rho_f g sin(slope)`, or the fall of pressure `-dp/dx`, or their sum
    pub drive: f64,
    /// the bottom
    pub bottom: Bottom,
    /// the top
    pub top: Top,
}

impl Forcing {
    /// Whether a boundary holds the velocity, and not only the stress.
    pub(super) fn holds(&self) -> bool {
        !matches!((self.bottom, self.top), (Bottom::Stress(_), Top::FreeSurface | Top::Stress(_)))
    }

    /// `lowest` is the distance \[m] of the lowest centre from the bottom.
    pub(super) fn check(&self, lowest: f64) -> Result<(), ColumnError> {
        finite("drive [Pa/m]", self.drive)?;
        match self.bottom {
            Bottom::NoSlip => {}
            Bottom::Rough { z_0, kappa } => {
                positive("roughness length [m]", z_0)?;
                positive("kappa of the wall", kappa)?;
                if z_0 >= lowest {
                    return Err(ColumnError::RoughnessAboveCell { z_0, distance: lowest });
                }
            }
            Bottom::Flow { velocity, mixing_length } => {
                finite("velocity at the bottom [m/s]", velocity)?;
                if !(mixing_length.is_finite() && mixing_length >= 0.0) {
                    let what = "mixing length at the bottom [m]";
                    return Err(ColumnError::Value { what, value: mixing_length, allowed: "finite and at least 0" });
                }
            }
            Bottom::Stress(tau) => finite("stress at the bottom [Pa]", tau)?,
        }
        match self.top {
            Top::FreeSurface | Top::NoSlip => Ok(()),
            Top::Stress(tau) => finite("stress at the top [Pa]", tau),
            Top::Lid(u) => finite("velocity of the lid [m/s]", u),
        }
    }
}

fn finite(what: &'static str, value: f64) -> Result<(), ColumnError> {
    if value.is_finite() { Ok(()) } else { Err(ColumnError::Value { what, value, allowed: "finite" }) }
}

fn positive(what: &'static str, value: f64) -> Result<(), ColumnError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(ColumnError::Value { what, value, allowed: "finite and more than 0" })
    }
}
