//! Where z starts and in which units a comparison is made.

use serde::{Deserialize, Serialize};

use super::{CompareError, Subject};
use crate::result::quantity::{self, COLUMNS, Quantity};
use crate::result::{Profile, TableError};

/// Where z is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Align {
    /// at the bottom of the sediment, as every model reports it: nothing moves
    #[default]
    Bottom,
    /// at the bed level: `bed_level_m` of each goes to 0
    Bed,
    /// wherever each one has it, with no claim that this is the same place: nothing moves
    None,
}

impl Align {
    /// What z = 0 is, in words.
    #[must_use]
    pub fn datum(self) -> &'static str {
        match self {
            Self::Bottom => "z = 0 at the bottom of the sediment",
            Self::Bed => "z = 0 at each one's bed level",
            Self::None => "z = 0 where each one has it",
        }
    }
}

/// The units by which `--scale` divides one subject. Every unit of the catalogue is a product of powers of the three.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Scales {
    /// flow height H \[m]
    pub length_m: f64,
    /// mean velocity U_m [m/s], if it is reported
    pub velocity_m_s: Option<f64>,
    /// fluid shear stress at the bed level, at the lowest level where there is no bed \[Pa], if the profile has one
    pub stress_pa: Option<f64>,
}

/// Units of the catalogue as powers of length, velocity and stress, and how they are written when divided.
const UNITS: &[(&str, [i32; 3], &str)] = &[
    ("1", [0, 0, 0], "1"),
    ("m", [1, 0, 0], "H"),
    ("m/s", [0, 1, 0], "Uₘ"),
    ("m²/s", [1, 1, 0], "Uₘ H"),
    ("m²/s²", [0, 2, 0], "Uₘ²"),
    ("1/s", [-1, 1, 0], "Uₘ/H"),
    ("Pa", [0, 0, 1], "τ(hₚ)"),
    ("Pa/m", [-1, 0, 1], "τ(hₚ)/H"),
    ("kg/(m s)", [1, -1, 1], "τ(hₚ) H/Uₘ"),
    ("s", [1, -1, 0], "H/Uₘ"),
    ("J", [3, 0, 1], "τ(hₚ) H³"),
    ("m²", [2, 0, 0], "H²"),
    ("m³/s", [2, 1, 0], "Uₘ H²"),
    ("kg/s", [2, -1, 1], "τ(hₚ) H²/Uₘ"),
    ("W/m³", [-1, 1, 1], "τ(hₚ) Uₘ/H"),
    ("W/m²", [0, 1, 1], "τ(hₚ) Uₘ"),
];

/// How a unit of the catalogue is written when it is divided: `Uₘ` for `m/s`.
#[must_use]
pub fn scaled_unit(quantity: &Quantity) -> &'static str {
    UNITS.iter().find(|(unit, ..)| *unit == quantity.unit).map_or("?", |(.., symbol)| symbol)
}

impl Scales {
    /// The scales of `subject`: `flow_height_m`, `mean_velocity_m_s`, and the fluid stress at the bed of its profile.
    ///
    /// # Errors
    /// [`CompareError::NoNumber`] without a positive flow height.
    pub(super) fn of(subject: &Subject) -> Result<Self, CompareError> {
        let positive = |quantity: &'static Quantity| subject.results.get(quantity.name).filter(|x| *x > 0.0);
        let length_m = positive(&quantity::FLOW_HEIGHT).ok_or_else(|| subject.lacks(&quantity::FLOW_HEIGHT, SCALE))?;
        Ok(Self { length_m, velocity_m_s: positive(&quantity::MEAN_VELOCITY), stress_pa: bed_stress(subject) })
    }

    /// Size in SI of the unit in which `quantity` is compared, if the scales that it takes are known.
    #[must_use]
    pub fn of_quantity(&self, quantity: &Quantity) -> Option<f64> {
        let (_, powers, _) = UNITS.iter().find(|(unit, ..)| *unit == quantity.unit)?;
        let scales = [Some(self.length_m), self.velocity_m_s, self.stress_pa];
        powers.iter().zip(scales).try_fold(1.0, |size, (&power, scale)| match power {
            0 => Some(size),
            power => Some(size * scale?.powi(power)),
        })
    }
}

/// What a number is needed for.
const SCALE: &str = "--scale";
const BED: &str = "--align bed";

/// Fluid shear stress, viscous and turbulent, at the bed level \[Pa]; at the lowest level where no bed level is reported.
fn bed_stress(subject: &Subject) -> Option<f64> {
    let z = match subject.results.get(quantity::BED_LEVEL.name) {
        Some(z) => z,
        None => *subject.profile.axis().first()?,
    };
    let parts = [&quantity::TAU_VISCOUS, &quantity::TAU_REYNOLDS];
    let present: Vec<_> = parts.into_iter().filter(|q| subject.profile.get(q).is_some()).collect();
    let sum = present.iter().try_fold(0.0, |sum, q| Some(sum + subject.profile.at(q, z)?))?;
    (sum > 0.0).then_some(sum)
}

/// A subject in the frame of the comparison.
#[derive(Clone, Debug)]
pub struct View {
    /// what was taken from z \[m]
    pub shift_m: f64,
    /// what the values were divided by
    pub scales: Option<Scales>,
    /// columns in the frame
    pub profile: Profile,
    /// their standard errors, where they have any
    pub errors: Option<Profile>,
    /// bed level in the frame
    pub bed: Option<f64>,
}

impl View {
    /// Puts `subject` into the frame; `shared` are the columns that will be compared.
    ///
    /// # Errors
    /// [`CompareError::NoNumber`], [`CompareError::NoScale`] if a number is missing by which the frame is defined.
    pub(super) fn of(subject: &Subject, align: Align, scale: bool, shared: &[&Quantity]) -> Result<Self, CompareError> {
        let bed = subject.results.get(quantity::BED_LEVEL.name);
        let shift_m = match align {
            Align::Bed => bed.ok_or_else(|| subject.lacks(&quantity::BED_LEVEL, BED))?,
            Align::Bottom | Align::None => 0.0,
        };
        let scales = if scale { Some(Scales::of(subject)?) } else { None };
        let size = |quantity: &Quantity| scales.map_or(Some(1.0), |s| s.of_quantity(quantity));
        for quantity in shared.iter().filter(|q| subject.profile.get(q).is_some()) {
            if size(quantity).is_none() {
                let stress = scales.is_some_and(|s| s.velocity_m_s.is_some());
                let missing = if stress { "a fluid shear stress at the bed" } else { quantity::MEAN_VELOCITY.name };
                return Err(CompareError::NoScale { subject: subject.name.clone(), column: quantity.name, missing });
            }
        }
        let length = scales.map_or(1.0, |s| s.length_m);
        let move_z = |z: f64| (z - shift_m) / length;
        let moved = |table: &Profile| -> Result<Profile, TableError> {
            let mut moved = Profile::new(table.axis().into_iter().map(move_z).collect())?;
            for quantity in COLUMNS.iter().skip(1) {
                if let (Some(values), Some(size)) = (table.get(quantity), size(quantity)) {
                    moved.push(quantity, values.iter().map(|v| v.map(|v| v / size)).collect())?;
                }
            }
            Ok(moved)
        };
        let failed = |error| CompareError::NotFinite { subject: subject.name.clone(), error };
        Ok(Self {
            shift_m,
            scales,
            profile: moved(&subject.profile).map_err(failed)?,
            errors: subject.errors.as_ref().map(moved).transpose().map_err(failed)?,
            bed: bed.map(move_z),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::bed;
    use super::*;
    use crate::result::quantity::{PHI, RESULTS, SERIES, TAU_PARTICLE, U_MIXTURE};
    use approx::assert_relative_eq;

    #[test]
    fn every_unit_of_the_catalogue_has_a_scale() {
        for quantity in COLUMNS.iter().chain(RESULTS).chain(SERIES) {
            assert_ne!(scaled_unit(quantity), "?", "{} in {}", quantity.name, quantity.unit);
        }
        let scales = Scales { length_m: 2.0, velocity_m_s: Some(3.0), stress_pa: None };
        assert_eq!(scales.of_quantity(&quantity::SHEAR_RATE), Some(1.5));
        assert_eq!(scales.of_quantity(&quantity::TRANSPORT_RATE), Some(6.0));
        assert_eq!(scales.of_quantity(&quantity::PHI), Some(1.0));
        assert_eq!(scales.of_quantity(&quantity::DRIVE), None);
    }

    #[test]
    fn the_bed_goes_to_zero_and_nothing_else_changes() {
        let subject = bed("a", 0.25);
        let view = View::of(&subject, Align::Bed, false, &[]).unwrap();
        assert_eq!((view.shift_m, view.bed), (0.25, Some(0.0)));
        assert_eq!(view.profile.axis(), [-0.25, 0.0, 0.25, 0.75]);
        assert_eq!(view.profile.get(&U_MIXTURE), subject.profile.get(&U_MIXTURE));
        for align in [Align::Bottom, Align::None] {
            assert_eq!(View::of(&subject, align, false, &[]).unwrap().profile, subject.profile);
        }
        let mut nowhere = bed("b", 0.25);
        nowhere.results = crate::result::Results::default();
        let refused = View::of(&nowhere, Align::Bed, false, &[]);
        assert!(matches!(refused, Err(CompareError::NoNumber { quantity, .. }) if quantity.name == "bed_level_m"));
    }

    #[test]
    fn scaling_divides_by_height_mean_velocity_and_bed_stress() {
        // H = 1, U_m = 0.5; viscous stress at the bed level 0.25 lies on a level: 3
        let view = View::of(&bed("a", 0.25), Align::Bottom, true, &[&U_MIXTURE, &TAU_PARTICLE]).unwrap();
        assert_eq!(view.scales, Some(Scales { length_m: 1.0, velocity_m_s: Some(0.5), stress_pa: Some(3.0) }));
        assert_eq!(view.profile.get(&U_MIXTURE).unwrap()[2], Some(2.0));
        assert_relative_eq!(view.profile.get(&TAU_PARTICLE).unwrap()[0].unwrap(), 2.0);
        assert_eq!(view.profile.get(&PHI).unwrap()[0], Some(0.6));
    }

    #[test]
    fn a_missing_scale_is_refused_only_where_it_is_needed() {
        let mut subject = bed("a", 0.25);
        subject.results = crate::result::Results::default();
        assert!(matches!(View::of(&subject, Align::Bottom, true, &[]), Err(CompareError::NoNumber { .. })));
        subject.results.set(&quantity::FLOW_HEIGHT, 1.0);
        assert!(View::of(&subject, Align::Bottom, true, &[&PHI]).is_ok());
        let refused = View::of(&subject, Align::Bottom, true, &[&PHI, &U_MIXTURE]).unwrap_err();
        assert!(matches!(refused, CompareError::NoScale { column: "u_mixture_m_s", missing: "mean_velocity_m_s", .. }));
    }
}
