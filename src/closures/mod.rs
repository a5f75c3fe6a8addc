//! Laws: parameters and pure local functions. No grids, no time, no files.
//!
//! A closure is a struct of its parameters, the same in the case file, in the problem and in the solver. A role states its
//! laws in its `mod.rs`, a line each ([`role`]); a case file names one by `law = "..."`. Each law's file holds the equation, its
//! symbols with units, the source, the range of validity, the implementation, and tests of its limits.
//! `docs/adding-a-law.md` walks through one.

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
pub mod role;
pub mod settling;
pub mod side_wall;
pub mod suspension;
pub mod threshold;
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

/// A constant of a law: its symbol in the equation, its value in SI, and its unit, which a pure number has not.
pub type Constant = (&'static str, f64, &'static str);

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

/// The laws of each role, in the order of the catalogue.
static ROLES: &[&[&Info]] = &[
    friction::LAWS,
    rearrangement::LAWS,
    mixture_viscosity::LAWS,
    dilatancy::LAWS,
    drag::LAWS,
    fluctuation::LAWS,
    mixing_length::LAWS,
    suspension::LAWS,
    lid::LAWS,
    wall::LAWS,
    side_wall::LAWS,
    contact::LAWS,
    kinetic::LAWS,
    kinetic::radial::LAWS,
    kinetic::dissipation::LAWS,
    kinetic::saltation::LAWS,
    kinetic::drag_work::LAWS,
    kinetic::elastic::LAWS,
    kinetic::static_friction::LAWS,
    dispersion::LAWS,
];

/// All laws of all roles.
pub fn catalogue() -> impl Iterator<Item = &'static Info> {
    ROLES.iter().copied().flatten().copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_law_is_listed_twice() {
        for (i, a) in catalogue().enumerate() {
            assert!(catalogue().skip(i + 1).all(|b| (a.family, a.law) != (b.family, b.law)), "{}/{}", a.family, a.law);
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
