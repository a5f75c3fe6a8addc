//! Random numbers by name: a stream is a function of its keys, so no draw depends on what was drawn before.

/// A stream of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stream(u64);

impl Stream {
    /// The stream of the keys, such as (seed, step, grain).
    #[must_use]
    pub fn new(keys: [u64; 3]) -> Self {
        let mut state = 0;
        for key in keys {
            state = mix(state ^ key.wrapping_add(GOLDEN));
        }
        Self(state)
    }

    /// The next number, uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        (mix(self.0) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Two independent normal numbers of mean 0 and variance 1 (Box & Muller 1958, doi:10.1214/aoms/1177706645).
    pub fn normal_pair(&mut self) -> [f64; 2] {
        // 1 - u is in (0, 1]: its logarithm is finite.
        let length = (-2.0 * libm::log(1.0 - self.uniform())).sqrt();
        let angle = 2.0 * std::f64::consts::PI * self.uniform();
        [length * libm::cos(angle), length * libm::sin(angle)]
    }
}

/// The odd word nearest to 2^64 over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The finaliser of SplitMix64 (Steele, Lea & Flood 2014, doi:10.1145/2714064.2660195).
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_a_uniform_number() {
        let n = 100_000;
        let draws: Vec<f64> = (0..n).map(|i| Stream::new([1, 2, i]).uniform()).collect();
        let mean = draws.iter().sum::<f64>() / n as f64;
        let square = draws.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n as f64;
        assert!((mean - 0.5).abs() < 4e-3 && (square - 1.0 / 12.0).abs() < 2e-3, "{mean} {square}");
        assert_eq!(Stream::new([1, 2, 3]).uniform(), Stream::new([1, 2, 3]).uniform());
    }
}
