//! Published laws of the transport rate of a bed over the Shields number, to draw beside what is computed.
//!
//! All are `Q* = a (theta - theta_c)^n`, with `Q* = q_p/(d sqrt((rho_p/rho_f - 1) g d))`; accepted laws differ by a factor of 3.
//!
//! | law | a | theta_c | n | range |
//! |---|---|---|---|---|
//! | Meyer-Peter & Müller (1948) | 8 | 0.047 | 1.5 | bedload, theta below 0.25 |
//! | Wong & Parker (2006), J. Hydraul. Eng. 132, 1159-1168 | 3.97 | 0.0495 | 1.5 | the same data, reanalysed |
//! | Wilson (1987), J. Hydraul. Eng. 113, 97-103 | 11.8 | 0.047 | 1.5 | sheet flow of sand in ducts |

/// A power law of the excess Shields number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransportLaw {
    /// its name
    pub name: &'static str,
    /// factor
    pub factor: f64,
    /// Shields number of incipient motion
    pub threshold: f64,
    /// exponent
    pub exponent: f64,
}

/// The laws.
pub static LAWS: [TransportLaw; 3] = [
    TransportLaw { name: "Wilson (1987)", factor: 11.8, threshold: 0.047, exponent: 1.5 },
    TransportLaw { name: "Meyer-Peter & Müller (1948)", factor: 8.0, threshold: 0.047, exponent: 1.5 },
    TransportLaw { name: "Wong & Parker (2006)", factor: 3.97, threshold: 0.0495, exponent: 1.5 },
];

impl TransportLaw {
    /// Dimensionless transport rate at the Shields number `theta`.
    #[must_use]
    pub fn rate(&self, theta: f64) -> f64 {
        self.factor * (theta - self.threshold).max(0.0).powf(self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn values_and_thresholds() {
        let at = |theta: f64| LAWS.map(|law| law.rate(theta));
        for (found, expect) in at(1.0).into_iter().zip([10.977_953, 7.442_680, 3.678_906]) {
            assert_relative_eq!(found, expect, max_relative = 1e-6);
        }
        assert_eq!(at(0.04), [0.0; 3]);
    }
}
