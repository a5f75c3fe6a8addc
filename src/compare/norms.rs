//! How far two profiles lie from each other, at levels that both have.
//!
//! A norm is taken at the levels of the coarser of the two (the one whose defined levels lie further apart in their
//! overlap; the reference where both are as far), the finer one interpolated linearly to them. Levels where either is
//! undefined are left out, and so are those at which the finer one would be interpolated across the top of its grains,
//! where the solid fraction and what it weighs jump. Sums are weighted by the height that each level stands for, half-way
//! to its neighbours, so that a norm does not depend on how a mesh is graded:
//!
//! ```text
//! L2 relative  = sqrt(Σ w (b - a)²) / sqrt(Σ w a²)     a the reference, b the other
//! L∞           = max |b - a|
//! bias         = Σ w (b - a) / Σ w
//! RMS in sigma = sqrt(mean of ((b - a)/σ)²)            at the levels of the data, each counting once
//! ```

use crate::result::Profile;
use crate::result::quantity::{self, Quantity};

/// Which of two profiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// the one that the other is compared with
    Reference,
    /// the other one
    Other,
}

/// Norms of the deviation b - a of a column from that of the reference, in the unit of the column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// levels that both define, and at which the norms are taken
    pub levels: usize,
    /// whose levels they are
    pub coarser: Side,
    /// lowest and highest of them
    pub between: (f64, f64),
    /// L2 norm relative to that of the reference; `None` where the reference is zero and the other is not
    pub l2_relative: Option<f64>,
    /// largest magnitude
    pub linf: f64,
    /// elevation of the largest magnitude
    pub linf_at: f64,
    /// largest magnitude relative to that of the reference; `None` where the reference is zero and the other is not
    pub linf_relative: Option<f64>,
    /// mean of the signed deviation
    pub bias: f64,
    /// root mean square over the levels, each counting once
    pub rms: f64,
}

/// Deviation in units of the standard error of the data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sigmas {
    /// root mean square of the deviation in sigmas
    pub rms: f64,
    /// levels with an error at which the other profile is defined
    pub levels: usize,
}

/// Norms of `other` against `reference`; `None` if a column is missing or no level is common.
#[must_use]
pub fn deviation(reference: &Profile, other: &Profile, quantity: &Quantity) -> Option<Deviation> {
    let (a, b) = (defined(reference, quantity)?, defined(other, quantity)?);
    let (low, high) = (ends(&a)?.0.max(ends(&b)?.0), ends(&a)?.1.min(ends(&b)?.1));
    let inside = |z: f64| z >= low && z <= high;
    let present = |levels: &[(f64, f64)]| levels.iter().any(|(z, _)| inside(*z));
    let other_is_coarser = spacing(&b, low, high) > spacing(&a, low, high);
    let (coarser, coarse, fine) = if present(&b) && (other_is_coarser || !present(&a)) {
        (Side::Other, other, reference)
    } else {
        (Side::Reference, reference, other)
    };
    let values = coarse.get(quantity)?;
    let levels: Vec<(f64, Option<f64>)> =
        coarse.axis().into_iter().zip(values.iter().copied()).filter(|(z, _)| inside(*z)).collect();
    let weights = weights(&levels.iter().map(|l| l.0).collect::<Vec<_>>());
    let (mut used, mut total, mut bias, mut square, mut scale, mut plain) = (0_u32, 0.0, 0.0, 0.0, 0.0, 0.0);
    let (mut linf, mut linf_at, mut largest, mut between) = (0.0_f64, low, 0.0_f64, None);
    for (&(z, value), w) in levels.iter().zip(weights) {
        let (Some(here), Some(there)) = (value, interpolated(fine, quantity, z)) else { continue };
        let (a, b) = if coarser == Side::Reference { (here, there) } else { (there, here) };
        let d = b - a;
        used += 1;
        total += w;
        bias += w * d;
        square += w * d * d;
        plain += d * d;
        scale += w * a * a;
        largest = largest.max(a.abs());
        if d.abs() > linf || used == 1 {
            (linf, linf_at) = (d.abs(), z);
        }
        between = Some((between.map_or(z, |(first, _)| first), z));
    }
    Some(Deviation {
        levels: used as usize,
        coarser,
        between: between?,
        l2_relative: relative(square.sqrt(), scale.sqrt()),
        linf,
        linf_at,
        linf_relative: relative(linf, largest),
        bias: if total > 0.0 { bias / total } else { 0.0 },
        rms: (plain / f64::from(used)).sqrt(),
    })
}

/// RMS deviation in sigmas, at the levels of the profile that has errors (of `other` where both have; the variances then
/// add); `None` if neither has errors at a common level.
#[must_use]
pub fn sigmas(
    (reference, reference_errors): (&Profile, Option<&Profile>),
    (other, other_errors): (&Profile, Option<&Profile>),
    quantity: &Quantity,
) -> Option<Sigmas> {
    let has = |errors: Option<&Profile>| errors.is_some_and(|e| e.get(quantity).is_some());
    let data = if has(other_errors) { other } else { reference };
    let mut squares = Vec::new();
    for (z, value) in data.axis().into_iter().zip(data.get(quantity)?) {
        let there = interpolated(if std::ptr::eq(data, other) { reference } else { other }, quantity, z);
        let variances: Vec<f64> = [reference_errors, other_errors]
            .into_iter()
            .filter_map(|errors| errors?.at(quantity, z))
            .map(|sigma| sigma * sigma)
            .collect();
        if let (Some(here), Some(there), false) = (value, there, variances.is_empty()) {
            squares.push((here - there).powi(2) / variances.iter().sum::<f64>());
        }
    }
    let levels = squares.len();
    (levels > 0).then(|| Sigmas { rms: (squares.iter().sum::<f64>() / levels as f64).sqrt(), levels })
}

/// Elevation and value of the rows that have one.
fn defined(profile: &Profile, quantity: &Quantity) -> Option<Vec<(f64, f64)>> {
    let values = profile.get(quantity)?;
    Some(profile.axis().into_iter().zip(values).filter_map(|(z, value)| Some((z, (*value)?))).collect())
}

fn ends(levels: &[(f64, f64)]) -> Option<(f64, f64)> {
    Some((levels.first()?.0, levels.last()?.0))
}

/// Mean distance of the levels between the last one at or below `low` and the first at or above `high`; infinite for a
/// single level.
fn spacing(levels: &[(f64, f64)], low: f64, high: f64) -> f64 {
    let first = levels.partition_point(|(z, _)| *z <= low).saturating_sub(1);
    let last = levels.partition_point(|(z, _)| *z < high).min(levels.len().saturating_sub(1));
    match (levels.get(first), levels.get(last)) {
        (Some(a), Some(b)) if last > first => (b.0 - a.0) / (last - first) as f64,
        _ => f64::INFINITY,
    }
}

/// Linear interpolation, except across the top of the grains for a column that jumps there.
#[must_use]
pub fn interpolated(profile: &Profile, quantity: &Quantity, z: f64) -> Option<f64> {
    let jumps = [quantity::PHI.name, quantity::FLUX.name, quantity::U_MIXTURE.name].contains(&quantity.name);
    if let (true, Some(phi)) = (jumps, profile.get(&quantity::PHI)) {
        let levels = profile.axis();
        let above = levels.partition_point(|&level| level < z);
        let between = levels.get(above).is_some_and(|&level| level > z);
        let phi_at = |row: Option<usize>| row.and_then(|row| phi.get(row).copied().flatten());
        let grains_below = phi_at(above.checked_sub(1)).is_some_and(|phi| phi > 0.0);
        if between && grains_below && phi_at(Some(above)) == Some(0.0) {
            return None;
        }
    }
    profile.at(quantity, z)
}

/// The height that each level stands for: from half-way to the level below to half-way to the one above. Where all levels
/// are one, each weighs 1.
fn weights(z: &[f64]) -> Vec<f64> {
    let at = |i: usize| z.get(i).copied();
    let heights: Vec<f64> = (0..z.len())
        .map(|i| {
            let below = i.checked_sub(1).and_then(at).or(at(i));
            let above = at(i + 1).or(at(i));
            above.zip(below).map_or(0.0, |(above, below)| 0.5 * (above - below))
        })
        .collect();
    if heights.iter().sum::<f64>() > 0.0 { heights } else { vec![1.0; z.len()] }
}

fn relative(size: f64, scale: f64) -> Option<f64> {
    match (size, scale) {
        (0.0, _) => Some(0.0),
        (_, 0.0) => None,
        _ => Some(size / scale),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::result::quantity::{PHI, U_MIXTURE};
    use approx::assert_relative_eq;

    fn profile(z: &[f64], u: &[Option<f64>]) -> Profile {
        let mut profile = Profile::new(z.to_vec()).unwrap();
        profile.push(&U_MIXTURE, u.to_vec()).unwrap();
        profile
    }

    fn full(z: &[f64], u: &[f64]) -> Profile {
        profile(z, &u.iter().copied().map(Some).collect::<Vec<_>>())
    }

    #[test]
    fn norms_by_hand_on_levels_of_unequal_height() {
        // weights 0.5, 1.5, 1; deviations 0, 2, -1
        let a = full(&[0.0, 1.0, 3.0], &[0.0, 1.0, 3.0]);
        let b = full(&[0.0, 1.0, 3.0], &[0.0, 3.0, 2.0]);
        let d = deviation(&a, &b, &U_MIXTURE).unwrap();
        assert_eq!((d.levels, d.coarser, d.between), (3, Side::Reference, (0.0, 3.0)));
        assert_relative_eq!(d.l2_relative.unwrap(), (7.0_f64 / 10.5).sqrt(), max_relative = 1e-15);
        assert_eq!((d.linf, d.linf_at), (2.0, 1.0));
        assert_relative_eq!(d.linf_relative.unwrap(), 2.0 / 3.0);
        assert_relative_eq!(d.bias, 2.0 / 3.0);
        assert_relative_eq!(d.rms, (5.0_f64 / 3.0).sqrt());
    }

    #[test]
    fn the_finer_one_is_interpolated_to_the_levels_of_the_coarser() {
        let coarse = full(&[0.25, 1.75], &[1.0, 1.0]);
        let fine = full(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 4.0, 9.0]);
        // fine at 0.25 and 1.75: 0.25 and 3.25
        let d = deviation(&coarse, &fine, &U_MIXTURE).unwrap();
        assert_eq!((d.levels, d.coarser), (2, Side::Reference));
        assert_relative_eq!(d.bias, 0.75);
        let turned = deviation(&fine, &coarse, &U_MIXTURE).unwrap();
        assert_eq!((turned.levels, turned.coarser, turned.linf, turned.linf_at), (2, Side::Other, 2.25, 1.75));
        assert_relative_eq!(turned.bias, -0.75);
        assert_relative_eq!(turned.l2_relative.unwrap(), (5.625_f64 / 10.625).sqrt());
    }

    #[test]
    fn coarser_means_further_apart_in_the_overlap() {
        // four levels against five, but a is twice as fine where both are
        let a = full(&[0.0, 0.5, 1.0, 9.0], &[1.0; 4]);
        let b = full(&[-3.0, -2.0, -1.0, 0.0, 1.0], &[2.0; 5]);
        let d = deviation(&a, &b, &U_MIXTURE).unwrap();
        assert_eq!((d.levels, d.coarser, d.between), (2, Side::Other, (0.0, 1.0)));
        // equally far apart, with ends at different places: the reference
        let c = full(&[0.5, 1.5], &[1.0; 2]);
        let d = full(&[0.0, 1.0, 2.0], &[1.0; 3]);
        assert_eq!(deviation(&c, &d, &U_MIXTURE).unwrap().levels, 2);
        assert_eq!(deviation(&d, &c, &U_MIXTURE).unwrap().coarser, Side::Reference);
        // the coarser one has no level in the overlap: the finer one's are taken
        let e = full(&[0.2, 0.3, 0.4], &[1.0; 3]);
        assert_eq!(deviation(&full(&[0.0, 1.0], &[1.0; 2]), &e, &U_MIXTURE).unwrap().levels, 3);
    }

    #[test]
    fn nothing_is_interpolated_across_the_top_of_the_grains() {
        let bed = |z: &[f64]| {
            let phi: Vec<f64> = z.iter().map(|&z| if z <= 1.0 { 0.6 } else { 0.0 }).collect();
            let mut profile = full(z, &vec![1.0; z.len()]);
            profile.push(&PHI, phi.into_iter().map(Some).collect()).unwrap();
            profile
        };
        let (coarse, fine) = (bed(&[0.0, 0.95, 2.0]), bed(&[0.0, 0.5, 0.9, 1.1, 1.5, 2.0]));
        for (a, b) in [(&coarse, &fine), (&fine, &coarse)] {
            let d = deviation(a, b, &PHI).unwrap();
            assert_eq!((d.levels, d.linf), (2, 0.0));
        }
        let on_a_level = bed(&[0.0, 0.5, 0.95, 1.05, 1.5, 2.0]);
        assert_eq!(deviation(&coarse, &on_a_level, &PHI).unwrap().levels, 3);
    }

    #[test]
    fn undefined_levels_are_left_out_and_gaps_are_not_bridged() {
        let a = full(&[0.0, 1.0, 2.0, 3.0], &[1.0; 4]);
        let b = profile(&[0.0, 1.0, 2.0, 3.0], &[Some(1.0), None, Some(9.0), Some(1.0)]);
        // b has three defined levels, so they are taken
        let d = deviation(&a, &b, &U_MIXTURE).unwrap();
        assert_eq!((d.levels, d.linf_at), (3, 2.0));
        // weights 0.5, (1), 1, 0.5
        assert_relative_eq!(d.bias, 4.0);
        // between 0 and 2 the finer one is undefined: 1.5 is not interpolated
        let coarse = full(&[0.0, 1.5, 3.0], &[1.0; 3]);
        let fine = profile(&[0.0, 1.0, 2.0, 2.5, 3.0], &[Some(1.0), None, Some(9.0), Some(9.0), Some(1.0)]);
        let d = deviation(&coarse, &fine, &U_MIXTURE).unwrap();
        assert_eq!((d.levels, d.linf), (2, 0.0));
    }

    #[test]
    fn identical_profiles_deviate_by_exactly_nothing() {
        let z: Vec<f64> = (0..57).map(|i| (f64::from(i) * 0.1).sin() + f64::from(i)).collect();
        let a = full(&z, &z.iter().map(|z| z.cos() / 3.0).collect::<Vec<_>>());
        let d = deviation(&a, &a.clone(), &U_MIXTURE).unwrap();
        assert_eq!((d.l2_relative, d.linf, d.linf_relative, d.bias), (Some(0.0), 0.0, Some(0.0), 0.0));
        let zero = full(&[0.0, 1.0], &[0.0, 0.0]);
        assert_eq!(deviation(&zero, &zero, &U_MIXTURE).unwrap().l2_relative, Some(0.0));
        assert_eq!(deviation(&zero, &full(&[0.0, 1.0], &[1.0, 0.0]), &U_MIXTURE).unwrap().l2_relative, None);
    }

    #[test]
    fn without_overlap_or_column_there_is_no_norm() {
        let a = full(&[0.0, 1.0], &[1.0, 1.0]);
        assert_eq!(deviation(&a, &full(&[2.0, 3.0], &[1.0, 1.0]), &U_MIXTURE), None);
        assert_eq!(deviation(&a, &a, &PHI), None);
        assert_eq!(deviation(&a, &profile(&[0.0, 1.0], &[None, None]), &U_MIXTURE), None);
        // one point inside the other's range is enough
        let one = deviation(&a, &full(&[0.25], &[3.0]), &U_MIXTURE).unwrap();
        assert_eq!((one.levels, one.bias, one.l2_relative), (1, 2.0, Some(2.0)));
        let outside = full(&[-1.0, 2.0], &[0.0, 3.0]);
        assert_eq!(deviation(&outside, &full(&[0.25], &[3.0]), &U_MIXTURE).unwrap().coarser, Side::Other);
    }

    #[test]
    fn deviations_in_sigmas_are_taken_at_the_data() {
        let model = full(&[0.0, 2.0], &[0.0, 2.0]);
        let data = full(&[0.5, 1.0, 1.5, 5.0], &[0.7, 1.0, 1.2, 9.0]);
        let errors = profile(&[0.5, 1.0, 1.5, 5.0], &[Some(0.1), None, Some(0.1), Some(0.1)]);
        // (0.2/0.1, -0.3/0.1): the second level has no error, the last lies above the model
        let s = sigmas((&model, None), (&data, Some(&errors)), &U_MIXTURE).unwrap();
        assert_eq!(s.levels, 2);
        assert_relative_eq!(s.rms, 6.5_f64.sqrt(), max_relative = 1e-12);
        assert_eq!(sigmas((&data, Some(&errors)), (&model, None), &U_MIXTURE).unwrap(), s);
        assert_eq!(sigmas((&model, None), (&data, None), &U_MIXTURE), None);
        // both uncertain: the variances add
        let both = sigmas((&data, Some(&errors)), (&full(&[0.5], &[0.9]), Some(&full(&[0.5], &[0.1]))), &U_MIXTURE);
        assert_relative_eq!(both.unwrap().rms, 2.0_f64.sqrt(), max_relative = 1e-12);
    }
}
