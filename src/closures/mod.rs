//! Laws: parameters and pure local functions. No grids, no time, no files.
//!
//! A closure is a struct of its parameters, the same in the case file, in the problem and in the solver. Each family is
//! an `enum` tagged by `law = "..."`; each file holds the equation, its symbols with units, the source, the range of
//! validity, the implementation, and tests of its limits. `docs/adding-a-law.md` walks through one.

pub mod contact;
pub mod dilatancy;
pub mod dispersion;
pub mod drag;
pub mod fluctuation;
pub mod friction;
pub mod kinetic;
pub mod lid;
pub mod mixing_length;
pub mod mixture_viscosity;
pub mod rearrangement;
pub mod regularisation;
pub mod side_wall;
pub mod suspension;
pub mod transport;
pub mod wall;

/// How far a closure has been tested here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// checked against its source or against an exact result
    Validated,
    /// implemented, not yet compared with anything
    Experimental,
}

/// The range of one variable within which the source gives the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// the variable, as in the profile or in words
    pub variable: &'static str,
    /// smallest value
    pub min: f64,
    /// largest value
    pub max: f64,
}

impl Range {
    /// Whether `value` is inside, the ends included.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        (self.min..=self.max).contains(&value)
    }
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { variable, min, max } = self;
        match (min.is_finite(), max.is_finite()) {
            (true, true) => write!(f, "{min} <= {variable} <= {max}"),
            (true, false) => write!(f, "{variable} >= {min}"),
            (false, true) => write!(f, "{variable} <= {max}"),
            (false, false) => write!(f, "any {variable}"),
        }
    }
}

/// What `bedload list closures` says of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Info {
    /// table of the case file: `closures.<family>`
    pub family: &'static str,
    /// value of `law`
    pub law: &'static str,
    /// the equation in the papers' symbols
    pub equation: &'static str,
    /// citation
    pub source: &'static str,
    /// where the source gives it
    pub ranges: &'static [Range],
    /// how far it has been tested here
    pub standing: Standing,
}

/// All laws of all families.
pub static CATALOGUE: &[&Info] = &[
    &friction::coulomb::INFO,
    &friction::mu_i::INFO,
    &friction::mu_iv::INFO,
    &rearrangement::THREE,
    &rearrangement::FREE_FALL,
    &mixture_viscosity::clear::INFO,
    &mixture_viscosity::einstein::INFO,
    &mixture_viscosity::boyer::INFO,
    &dilatancy::none::INFO,
    &dilatancy::phi_i::INFO,
    &dilatancy::phi_iv::INFO,
    &drag::none::INFO,
    &drag::carman_kozeny::INFO,
    &drag::dallavalle::INFO,
    &drag::dallavalle_grain::INFO,
    &fluctuation::none::INFO,
    &fluctuation::random_walk::INFO,
    &mixing_length::none::INFO,
    &mixing_length::prandtl::INFO,
    &mixing_length::li_sawamoto::INFO,
    &mixing_length::low_submergence::INFO,
    &suspension::NONE,
    &suspension::rouse::INFO,
    &lid::FREE_SURFACE,
    &lid::STRESS,
    &lid::SOLVED,
    &lid::colebrook_white::INFO,
    &wall::rough::INFO,
    &side_wall::none::INFO,
    &side_wall::graf_altinakar_published::INFO,
    &side_wall::graf_altinakar::INFO,
    &side_wall::blasius::INFO,
    &contact::linear_spring::INFO,
    &kinetic::garzo_dufty::INFO,
    &kinetic::granular::FRICTIONAL_COLLISIONAL,
    &kinetic::inertial::INFO,
    &kinetic::radial::CARNAHAN_STARLING,
    &kinetic::radial::TORQUATO,
    &kinetic::radial::CHIALVO_SUNDARESAN,
    &kinetic::radial::FRICTIONAL,
    &kinetic::restitution::PLAIN,
    &kinetic::restitution::JENKINS_ZHANG,
    &kinetic::saltation::INFO,
    &kinetic::drag_work::LINEAR,
    &kinetic::drag_work::QUADRATIC,
    &kinetic::elastic::NONE,
    &kinetic::elastic::JOHNSON_JACKSON,
    &kinetic::static_friction::FIT,
    &kinetic::static_friction::GIVEN,
    &dispersion::NONE,
    &dispersion::GRADIENT,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_law_is_listed_twice() {
        for (i, a) in CATALOGUE.iter().enumerate() {
            assert!(
                CATALOGUE[i + 1..].iter().all(|b| (a.family, a.law) != (b.family, b.law)),
                "{}/{}",
                a.family,
                a.law
            );
        }
    }

    #[test]
    fn the_ends_of_a_range_belong_to_it() {
        let range = Range { variable: "phi", min: 0.3, max: 0.585 };
        assert!([0.3, 0.5, 0.585].into_iter().all(|phi| range.contains(phi)));
        assert!([0.299, 0.586, f64::NAN].into_iter().all(|phi| !range.contains(phi)));
    }

    #[test]
    fn ranges_are_written_as_a_reader_expects() {
        let range = |min, max| Range { variable: "phi", min, max }.to_string();
        assert_eq!(range(0.0, 0.05), "0 <= phi <= 0.05");
        assert_eq!(range(f64::NEG_INFINITY, 1.0), "phi <= 1");
        assert_eq!(range(1.0, f64::INFINITY), "phi >= 1");
        assert_eq!(range(f64::NEG_INFINITY, f64::INFINITY), "any phi");
    }
}
