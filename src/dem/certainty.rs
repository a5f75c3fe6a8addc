//! How well a mean over time is known: standard errors by block averages, and when there is none.
//!
//! The error of a mean of k independent blocks is itself known to 1/sqrt(2 (k - 1)), so that fewer than 8 blocks, 27 %, tell
//! nothing. A block of one sample cannot show how long samples stay alike: 16 samples are the least. And where the means of
//! neighbouring blocks follow each other, they are not independent, however many they are. A series of the correlation time T
//! has about n = t/(2 T) independent samples in the time t; twenty blocks of it are correlated by 0.33 where n is 20, 0.54
//! where it is 10, and 0.73 where it is 5: then the time is too short.

use crate::result::{Estimate, Unknown};
use crate::units::ROUND_OFF;

/// Fewest blocks of a standard error.
pub(crate) const MIN_BLOCKS: usize = 8;
/// Fewest samples: two in each block.
pub(crate) const MIN_SAMPLES: usize = 2 * MIN_BLOCKS;
/// Most blocks: what they are correlated by says whether the time is long enough.
const MAX_BLOCKS: usize = 20;
/// Largest correlation of the means of neighbouring blocks.
const ALIKE: f64 = 0.7;

/// Standard error of `mean`, the mean of independent blocks of the same length.
pub(crate) fn of_blocks(blocks: &[f64], mean: f64) -> Result<f64, Unknown> {
    if blocks.len() < MIN_BLOCKS {
        return Err(Unknown::TooFew);
    }
    let k = blocks.len() as f64;
    let square: f64 = blocks.iter().map(|x| (x - mean) * (x - mean)).sum();
    let error = (square / (k * (k - 1.0))).sqrt();
    if error > ROUND_OFF * mean.abs() { Ok(error) } else { Err(Unknown::Constant) }
}

/// Means of `count` blocks of a series.
pub(crate) fn blocks(series: &[f64], count: usize) -> Vec<f64> {
    let n = series.len();
    let part = |b: usize| &series[b * n / count..(b + 1) * n / count];
    (0..count).map(|b| part(b).iter().sum::<f64>() / part(b).len() as f64).collect()
}

/// Whether a series is long enough for a standard error of its mean; one that never changes is.
pub(crate) fn resolved(series: &[f64]) -> Result<(), Unknown> {
    if series.len() < MIN_SAMPLES {
        return Err(Unknown::TooFew);
    }
    let means = blocks(series, MAX_BLOCKS.min(series.len()));
    let mean = means.iter().sum::<f64>() / means.len() as f64;
    if of_blocks(&means, mean).is_err() {
        return Ok(());
    }
    let square: f64 = means.iter().map(|x| (x - mean) * (x - mean)).sum();
    let product: f64 = means.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum();
    if product > ALIKE * square { Err(Unknown::TooShort) } else { Ok(()) }
}

/// Mean of a series of correlated samples; its standard error is the largest of those by each number of blocks.
pub(crate) fn of_series(series: &[f64], counts: &[usize]) -> Option<Estimate> {
    if series.is_empty() {
        return None;
    }
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let by = |&count: &usize| of_blocks(&blocks(series, count), mean).ok();
    let largest = || {
        let errors = counts.iter().filter(|&&count| count <= series.len()).filter_map(by);
        errors.reduce(f64::max).ok_or(Unknown::Constant)
    };
    Some(Estimate { mean, stderr: resolved(series).and_then(|()| largest()) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runtime::rng::Stream;

    const COUNTS: &[usize] = &[8, 12, 20];

    /// An autoregressive series of correlation time `t` samples around 1.
    fn noise(n: u64, t: f64, seed: u64) -> Vec<f64> {
        let a = (-1.0 / t).exp();
        let mut x = 0.0;
        (0..n)
            .map(|i| {
                x = a * x + (1.0 - a * a).sqrt() * Stream::new([seed, 0, i]).normal_pair()[0];
                1.0 + 0.2 * x
            })
            .collect()
    }

    #[test]
    fn the_standard_error_covers_the_exact_mean_as_often_as_it_should() {
        // Variance of the mean of n values with correlation a: about 0.04 (1 + a)/(1 - a)/n.
        let inside = (0..200)
            .filter(|&seed| {
                let Estimate { mean, stderr } = of_series(&noise(1000, 5.0, seed + 10), COUNTS).unwrap();
                (mean - 1.0).abs() < 2.0 * stderr.unwrap()
            })
            .count();
        assert!(inside > 180, "{inside} of 200 within two standard errors");
        let error = of_series(&noise(1000, 5.0, 3), COUNTS).unwrap().stderr.unwrap();
        let a = (-0.2_f64).exp();
        let exact = (0.04 * (1.0 + a) / (1.0 - a) / 1000.0).sqrt();
        assert!((0.6..2.0).contains(&(error / exact)), "{error} {exact}");
    }

    #[test]
    fn too_few_samples_and_samples_that_are_all_the_same_give_no_error() {
        assert_eq!(of_series(&[], COUNTS), None);
        for n in 1..MIN_SAMPLES {
            let few = of_series(&noise(n as u64, 0.1, 5), COUNTS).unwrap();
            assert_eq!(few.stderr, Err(Unknown::TooFew), "{n} samples");
        }
        let enough = of_series(&noise(MIN_SAMPLES as u64, 0.1, 5), COUNTS).unwrap();
        assert!(enough.stderr.is_ok_and(|error| error > 0.0), "{enough:?}");
        for value in [0.0, 0.1, -3.0] {
            let same = of_series(&[value; 80], COUNTS).unwrap();
            assert_eq!(same.stderr, Err(Unknown::Constant), "{value}");
        }
        assert_eq!(of_blocks(&[1.0, 2.0, 1.0, 2.0, 1.0, 2.0, 1.0], 1.5), Err(Unknown::TooFew));
    }

    #[test]
    fn a_time_shorter_than_the_samples_stay_alike_gives_no_error() {
        let drift: Vec<f64> = (0..500).map(|i| 1.0 + 0.01 * f64::from(i)).collect();
        assert_eq!(of_series(&drift, COUNTS).unwrap().stderr, Err(Unknown::TooShort));
        let swing: Vec<f64> = (0..500).map(|i| (0.0125 * f64::from(i)).sin()).collect();
        assert_eq!(of_series(&swing, COUNTS).unwrap().stderr, Err(Unknown::TooShort));
        let without = |n: u64, t: f64| {
            let unknown = |seed: &u64| of_series(&noise(n, t, 1000 + seed), COUNTS).unwrap().stderr.is_err();
            (0..200).filter(unknown).count()
        };
        // One independent sample, twenty, a hundred.
        let (one, twenty, hundred) = (without(400, 200.0), without(400, 10.0), without(1000, 5.0));
        assert!(one > 100 && twenty < 10 && hundred == 0, "{one} {twenty} {hundred} of 200");
    }
}
