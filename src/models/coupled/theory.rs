//! Grains as the reference of kinetic theory: what a coupled flow says of each of its laws, beside the laws themselves.
//!
//! | column | from the grains | laws at their state |
//! |---|---|---|
//! | `radial_distribution` | `g₀ = (p/(ρ_p φ T) - 1)/(2 φ (1 + e))` | with and without friction |
//! | `viscosity_factor` | `F₂ = τ_p/(ρ_p d T^½ \|du_p/dz\|)` | with and without saltation |
//! | `conductivity_factor` | `F₃ = -q/(ρ_p d T^½ dT/dz)` | with and without saltation |
//! | `contact_loss_factor` | `F₄ = d/(ρ_p T^(3/2))` times what the budget leaves | with e_eff and with e |
//! | `drag_loss_factor` | `d/(ρ_p T^(3/2))` times its work on the fluctuations | quadratic and linear |
//!
//! Source: Chassagne et al. (2023), eq. (2.16), (2.27)-(2.30), (3.1) and figures 4 to 7.

use super::Coupled;
use crate::closures::kinetic::drag_work::Damping;
use crate::closures::kinetic::radial::{AtContact, PHI_MAX};
use crate::closures::kinetic::{FrictionalCollisional, GarzoDufty, Kinetic};
use crate::result::{Profile, Quantity, TableError, quantity as q};

/// Solid fractions and inertial numbers at which grains are asked: a few that fly by, and those at rest, have nothing to say.
const PHI: (f64, f64) = (3e-3, 0.995 * PHI_MAX);
const INERTIAL: (f64, f64) = (1e-3, 1e2);
const TEMPERATURE: (f64, f64) = (1e-12, 1e12);

/// A number of the grains and its standard error.
pub(super) type Measured = Option<(f64, Option<f64>)>;

/// The profile of grains as kinetic theory reads it.
pub(super) struct Assessment<'a> {
    pub profile: &'a Profile,
    z: Vec<f64>,
}

impl<'a> Assessment<'a> {
    pub fn of(profile: &'a Profile) -> Self {
        Self { profile, z: profile.axis() }
    }

    pub fn at(&self, quantity: &Quantity, row: usize) -> Option<f64> {
        self.profile.get(quantity)?.get(row).copied().flatten()
    }

    /// A column and its standard error.
    pub fn mean(&self, quantity: &Quantity, row: usize) -> Measured {
        let error = || self.profile.errors(quantity)?.get(row).copied().flatten();
        Some((self.at(quantity, row)?, error()))
    }

    /// The levels with grains that move and meet.
    pub fn rows(&self) -> Vec<usize> {
        let within =
            |row: usize, quantity, (low, high)| self.at(quantity, row).is_some_and(|x| (low..high).contains(&x));
        let asked = |row: &usize| {
            within(*row, &q::PHI, PHI)
                && within(*row, &q::INERTIAL_NUMBER, INERTIAL)
                && within(*row, &q::GRANULAR_TEMPERATURE, TEMPERATURE)
        };
        (0..self.z.len()).filter(asked).collect()
    }

    /// Slope over one diameter `d` \[m].
    fn slope(&self, quantity: &Quantity, row: usize, d: f64) -> Option<f64> {
        let dz = self.z.get(1)? - self.z[0];
        let half = ((0.5 * d / dz).round() as usize).max(1);
        let (below, above) = (row.checked_sub(half)?, row + half);
        Some((self.at(quantity, above)? - self.at(quantity, below)?) / (self.z.get(above)? - self.z[below]))
    }

    /// `x/below` with the relative errors of x and, to the power `n`, of `y`.
    pub fn over(x: Measured, below: Option<f64>, y: Measured, n: f64) -> Measured {
        let ((x, error), below, (y, spread)) = (x?, below?, y?);
        let share = |error: f64, spread: f64| (error / x).hypot(n * spread / y).abs();
        let error = error.zip(spread).map(|(error, spread)| share(error, spread) * (x / below).abs());
        Some((x / below, error))
    }
}

/// Adds the coefficients of the grains and those of the laws at their state.
///
/// # Errors
/// [`TableError`] if the columns do not go with the profile.
pub(super) fn push(flow: &Coupled, profile: &mut Profile) -> Result<(), TableError> {
    let made: Vec<(&'static Quantity, Vec<Option<f64>>)> = {
        let comparison = Comparison::of(flow, profile);
        let rows = comparison.grains.rows();
        let column = |of: &dyn Fn(usize) -> Option<f64>| -> Vec<Option<f64>> {
            let mut values = vec![None; profile.rows()];
            rows.iter().for_each(|&row| values[row] = of(row).filter(|x| x.is_finite()));
            values
        };
        let (new, old) = (comparison.proposed, comparison.classical);
        let mut made: Vec<(&'static Quantity, Vec<Option<f64>>)> = vec![
            (&q::RADIAL_THEORY, column(&|row| comparison.radial(new, row))),
            (&q::RADIAL_CLASSICAL, column(&|row| comparison.radial(old, row))),
            (&q::VISCOSITY_FACTOR_THEORY, column(&|row| Some(comparison.transport(new, row)?.0))),
            (&q::VISCOSITY_FACTOR_CLASSICAL, column(&|row| Some(comparison.transport(old, row)?.0))),
            (&q::CONDUCTIVITY_FACTOR_THEORY, column(&|row| Some(comparison.transport(new, row)?.1))),
            (&q::CONDUCTIVITY_FACTOR_CLASSICAL, column(&|row| Some(comparison.transport(old, row)?.1))),
            (&q::CONTACT_FACTOR_THEORY, column(&|row| comparison.dissipation(new, row))),
            (&q::CONTACT_FACTOR_CLASSICAL, column(&|row| comparison.dissipation(old, row))),
            (&q::DRAG_FACTOR_THEORY, column(&|row| comparison.drag_work(new, row))),
            (&q::DRAG_FACTOR_CLASSICAL, column(&|row| comparison.drag_work(old, row))),
        ];
        let measured: [(_, _, &dyn Fn(usize) -> Measured); 5] = [
            (&q::VISCOSITY_FACTOR, &q::VISCOSITY_FACTOR_STDERR, &|row| comparison.viscosity(row)),
            (&q::CONDUCTIVITY_FACTOR, &q::CONDUCTIVITY_FACTOR_STDERR, &|row| comparison.conductivity(row)),
            (&q::CONTACT_FACTOR, &q::CONTACT_FACTOR_STDERR, &|row| comparison.loss(&q::CONTACT_LOSS, row)),
            (&q::CONTACT_FACTOR_DIRECT, &q::CONTACT_FACTOR_DIRECT_STDERR, &|row| {
                comparison.loss(&q::CONTACT_LOSS_DIRECT, row)
            }),
            (&q::DRAG_FACTOR, &q::DRAG_FACTOR_STDERR, &|row| comparison.loss(&q::DRAG_LOSS, row)),
        ];
        for (value, error, of) in measured {
            made.push((value, column(&|row| Some(of(row)?.0))));
            made.push((error, column(&|row| of(row)?.1)));
        }
        made
    };
    made.into_iter().try_for_each(|(quantity, values)| profile.push(quantity, values))
}

/// The grains, the flow that they are in, and the two theories of them.
struct Comparison<'a> {
    grains: Assessment<'a>,
    flow: &'a Coupled,
    proposed: Kinetic,
    classical: Kinetic,
}

impl<'a> Comparison<'a> {
    fn of(flow: &'a Coupled, profile: &'a Profile) -> Self {
        let (e, mu_p) = (flow.bed.contact.e_n, flow.bed.contact.mu);
        Self {
            grains: Assessment::of(profile),
            flow,
            proposed: FrictionalCollisional::default().kinetic(e, mu_p),
            classical: GarzoDufty::default().kinetic(e, mu_p),
        }
    }

    fn temperature(&self, row: usize) -> Measured {
        self.grains.mean(&q::GRANULAR_TEMPERATURE, row)
    }

    fn viscosity(&self, row: usize) -> Measured {
        let t = self.temperature(row);
        let below = self.flow.bed.rho_p * self.flow.bed.d * t?.0.sqrt() * self.grains.at(&q::SHEAR_RATE, row)?;
        Assessment::over(self.grains.mean(&q::TAU_PARTICLE, row), Some(below), t, 0.5)
    }

    fn conductivity(&self, row: usize) -> Measured {
        let t = self.temperature(row);
        let slope = self.grains.slope(&q::GRANULAR_TEMPERATURE, row, self.flow.bed.d)?;
        let below = -self.flow.bed.rho_p * self.flow.bed.d * t?.0.sqrt() * slope;
        Assessment::over(self.grains.mean(&q::FLUCTUATION_FLUX, row), Some(below), t, 0.5)
    }

    /// A loss over `ρ_p T^(3/2)/d`; one from a budget without errors has that of the temperature.
    fn loss(&self, quantity: &Quantity, row: usize) -> Measured {
        let t = self.temperature(row);
        let below = self.flow.bed.rho_p / self.flow.bed.d * t?.0 * t?.0.sqrt();
        let (loss, error) = self.grains.mean(quantity, row)?;
        let known = self.grains.profile.errors(quantity).is_some();
        Assessment::over(Some((loss, if known { error } else { Some(0.0) })), Some(below), t, 1.5)
    }

    /// `K d/ρ_p` [m/s] and `C_∞/C_D` of the mean slip.
    fn drag(&self, row: usize) -> Option<(f64, f64)> {
        let slip = (self.grains.at(&q::U_FLUID, row)? - self.grains.at(&q::U_PARTICLE, row)?).abs();
        let viscous = self.flow.drag.viscous(self.flow.nu(), self.flow.bed.d);
        let (k, share) = self.flow.drag.per_volume(self.grains.at(&q::PHI, row)?, slip, viscous);
        Some((k * self.flow.rho_f / self.flow.bed.rho_p, share))
    }

    /// A law of solid fraction, its distance from the densest one, and the root of the temperature.
    fn law<T>(&self, row: usize, of: impl Fn(f64, f64, f64) -> T) -> Option<T> {
        let phi = self.grains.at(&q::PHI, row)?;
        Some(of(phi, PHI_MAX - phi, self.grains.at(&q::GRANULAR_TEMPERATURE, row)?.sqrt()))
    }

    fn radial(&self, theory: Kinetic, row: usize) -> Option<f64> {
        self.law(row, |phi, gap, _| theory.radial.contact(phi, gap, theory.a))
    }

    fn dissipation(&self, theory: Kinetic, row: usize) -> Option<f64> {
        self.law(row, |phi, gap, _| phi * theory.dissipation_per_grain(phi, gap))
    }

    /// Viscosity and conductivity.
    fn transport(&self, theory: Kinetic, row: usize) -> Option<(f64, f64)> {
        let (k, _) = self.drag(row)?;
        self.law(row, |phi, gap, root| theory.transport(phi, gap, root, k))
    }

    fn drag_work(&self, theory: Kinetic, row: usize) -> Option<f64> {
        let (k, share) = self.drag(row)?;
        self.law(row, |phi, _, root| theory.drag_work.factor(share) * phi * (1.0 - phi) * k / root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::coupled::tests::flow;

    /// Levels a diameter apart around one with grains that move, and the flow that they are of.
    fn assessed() -> (Coupled, Profile) {
        let flow = flow();
        let d = flow.bed.d;
        let mut profile = Profile::new((0..5).map(|i| f64::from(i) * d).collect()).unwrap();
        let mut push = |quantity, values: [f64; 5]| profile.push(quantity, values.map(Some).to_vec()).unwrap();
        push(&q::PHI, [0.3; 5]);
        push(&q::INERTIAL_NUMBER, [1e-4, 0.5, 0.5, 0.5, 1e3]);
        push(&q::GRANULAR_TEMPERATURE, [0.01, 0.04, 0.09, 0.16, 0.25]);
        push(&q::GRANULAR_TEMPERATURE_STDERR, [0.0, 0.0, 0.009, 0.0, 0.0]);
        push(&q::U_FLUID, [0.5; 5]);
        push(&q::U_PARTICLE, [0.3; 5]);
        push(&q::SHEAR_RATE, [5.0; 5]);
        push(&q::TAU_PARTICLE, [6.0; 5]);
        push(&q::TAU_PARTICLE_STDERR, [0.6; 5]);
        push(&q::CONTACT_LOSS, [30.0; 5]);
        push(&q::CONTACT_LOSS_STDERR, [3.0; 5]);
        push(&q::CONTACT_LOSS_DIRECT, [30.0; 5]);
        push(&q::FLUCTUATION_FLUX, [2.0; 5]);
        super::push(&flow, &mut profile).unwrap();
        (flow, profile)
    }

    #[test]
    fn coefficients_are_their_definitions_and_errors_add_as_independent_ones() {
        let (flow, profile) = assessed();
        let (rho, d) = (flow.bed.rho_p, flow.bed.d);
        let at = |quantity| profile.get(quantity).unwrap()[2].unwrap();
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b.abs(), "{a} {b}");
        // T = 0.09, its root 0.3, its slope (0.16 - 0.04)/2d.
        near(at(&q::VISCOSITY_FACTOR), 6.0 / (rho * d * 0.3 * 5.0));
        near(at(&q::CONDUCTIVITY_FACTOR), -2.0 / (rho * 0.3 * 0.06));
        near(at(&q::CONTACT_FACTOR), 30.0 * d / (rho * 0.027));
        near(at(&q::VISCOSITY_FACTOR_STDERR), at(&q::VISCOSITY_FACTOR) * 0.1_f64.hypot(0.05));
        near(at(&q::CONTACT_FACTOR_STDERR), at(&q::CONTACT_FACTOR) * 0.1_f64.hypot(0.15));
        near(at(&q::CONTACT_FACTOR_DIRECT_STDERR), at(&q::CONTACT_FACTOR_DIRECT) * 0.15);
        // What was not measured has no number.
        assert!(profile.get(&q::DRAG_FACTOR).unwrap().iter().all(Option::is_none));
    }

    #[test]
    fn laws_stand_where_grains_move_and_those_of_smooth_grains_differ() {
        let (_, profile) = assessed();
        for (theory, classical) in [
            (&q::RADIAL_THEORY, &q::RADIAL_CLASSICAL),
            (&q::VISCOSITY_FACTOR_THEORY, &q::VISCOSITY_FACTOR_CLASSICAL),
            (&q::CONDUCTIVITY_FACTOR_THEORY, &q::CONDUCTIVITY_FACTOR_CLASSICAL),
            (&q::CONTACT_FACTOR_THEORY, &q::CONTACT_FACTOR_CLASSICAL),
            (&q::DRAG_FACTOR_THEORY, &q::DRAG_FACTOR_CLASSICAL),
        ] {
            let [new, old] = [theory, classical].map(|column| profile.get(column).unwrap().to_vec());
            assert_eq!(new.iter().map(Option::is_some).collect::<Vec<_>>(), [false, true, true, true, false]);
            assert!(new[2].unwrap() > 0.0 && new[2] != old[2], "{}: {new:?} {old:?}", theory.name);
        }
        // e_eff < e: contacts take more.
        let loss = |column| profile.get(column).unwrap()[2].unwrap();
        assert!(loss(&q::CONTACT_FACTOR_THEORY) > loss(&q::CONTACT_FACTOR_CLASSICAL));
        let figures = super::super::figures::figures("case", &profile);
        assert!(figures.is_empty(), "three levels are not enough for a figure");
    }
}
