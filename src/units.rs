//! Physical quantities as text: `"6 mm"`, `"0.05 m2/s"`, `"100 Pa/m"`, and back again.
//! Inside the library every number is SI. A unit is a product of powers of SI symbols; decimal prefixes are
//! kept as an exponent of ten and applied to the decimal text, so that `"6.5 mm"` is exactly the same `f64` as `6.5e-3`.

mod common;
mod readable;

use std::fmt;

pub use common::CommonUnits;
pub use readable::{
    ROUND_OFF, readable, readable_error, readable_known, readable_mean, readable_unit, significant, stated,
};

/// Powers of metre, kilogram, second and radian. A ratio is a pure number; an angle is none: its tangent and its sine are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    /// power of the metre
    pub length: i32,
    /// power of the kilogram
    pub mass: i32,
    /// power of the second
    pub time: i32,
    /// power of the radian
    pub angle: i32,
}

impl Dimension {
    const fn new(length: i32, mass: i32, time: i32) -> Self {
        Self { length, mass, time, angle: 0 }
    }

    /// That of an angle.
    pub const ANGLE: Self = Self { angle: 1, ..Self::new(0, 0, 0) };
    /// That of a pure number.
    pub const NONE: Self = Self::new(0, 0, 0);

    fn times(self, other: Self, power: i32) -> Self {
        Self {
            length: self.length + power * other.length,
            mass: self.mass + power * other.mass,
            time: self.time + power * other.time,
            angle: self.angle + power * other.angle,
        }
    }

    /// The usual name of the dimension, where it has one.
    fn name(self) -> Option<&'static str> {
        NAMES.iter().find(|(d, _)| *d == self).map(|(_, n)| *n)
    }
}

const NAMES: &[(Dimension, &str)] = &[
    (Dimension::NONE, "a pure number"),
    (Dimension::ANGLE, "an angle"),
    (Dimension { time: -1, ..Dimension::ANGLE }, "an angular velocity"),
    (Dimension::new(1, 0, 0), "a length"),
    (Dimension::new(2, 0, 0), "an area"),
    (Dimension::new(0, 0, 1), "a time"),
    (Dimension::new(0, 1, 0), "a mass"),
    (Dimension::new(-3, 1, 0), "a density"),
    (Dimension::new(1, 0, -1), "a velocity"),
    (Dimension::new(1, 0, -2), "an acceleration"),
    (Dimension::new(-1, 1, -2), "a pressure or stress"),
    (Dimension::new(-2, 1, -2), "a pressure gradient"),
    (Dimension::new(-1, 1, -1), "a dynamic viscosity"),
    (Dimension::new(2, 0, -1), "a kinematic viscosity or volume flux"),
    (Dimension::new(0, 0, -1), "a rate"),
    (Dimension::new(1, 1, -2), "a force"),
    (Dimension::new(0, 1, -2), "a stiffness"),
];

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(name) = self.name() {
            return f.write_str(name);
        }
        let powers = [("m", self.length), ("kg", self.mass), ("s", self.time), ("rad", self.angle)];
        let text: Vec<String> = powers
            .iter()
            .filter(|(_, p)| *p != 0)
            .map(|(s, p)| if *p == 1 { (*s).into() } else { format!("{s}{p}") })
            .collect();
        f.write_str(&text.join(" "))
    }
}

/// A unit: `scale * 10^exponent` SI units of `dimension`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    exponent: i32,
    scale: f64,
    /// what it measures
    pub dimension: Dimension,
}

/// Why a text is not the quantity that was asked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UnitError {
    /// no number at the start
    #[error("no number at the start of \"{text}\"")]
    NoNumber {
        /// the whole text
        text: String,
    },
    /// `6,5 mm`
    #[error("\"{text}\" has a comma: the decimal sign is a point")]
    DecimalComma {
        /// the whole text
        text: String,
    },
    /// overflow, `nan`, `inf`
    #[error("\"{text}\" is not a finite number")]
    NotFinite {
        /// the whole text
        text: String,
    },
    /// a number in quotes where a dimension is needed
    #[error("\"{text}\" has no unit")]
    NoUnit {
        /// the whole text
        text: String,
    },
    /// a symbol that no table has
    #[error("unknown unit \"{symbol}\"")]
    UnknownUnit {
        /// the symbol
        symbol: String,
        /// a symbol that it may stand for
        nearest: Option<String>,
    },
    /// a unit of another dimension
    #[error("\"{unit}\" is {found}, not {expected}")]
    WrongDimension {
        /// the unit as written
        unit: String,
        /// its dimension
        found: Dimension,
        /// the wanted dimension
        expected: Dimension,
    },
}

/// Symbols that take a decimal prefix; the gram carries 10^-3 since the kilogram is the base unit.
const PREFIXABLE: &[(&str, i32, Dimension)] = &[
    ("m", 0, Dimension::new(1, 0, 0)),
    ("s", 0, Dimension::new(0, 0, 1)),
    ("g", -3, Dimension::new(0, 1, 0)),
    ("N", 0, Dimension::new(1, 1, -2)),
    ("Pa", 0, Dimension::new(-1, 1, -2)),
    ("Hz", 0, Dimension::new(0, 0, -1)),
];

const PREFIXES: &[(&str, i32)] =
    &[("k", 3), ("M", 6), ("c", -2), ("m", -3), ("u", -6), ("\u{b5}", -6), ("\u{3bc}", -6), ("n", -9)];

const FIXED: &[(&str, f64, i32, Dimension)] = &[
    ("min", 60.0, 0, Dimension::new(0, 0, 1)),
    ("h", 3600.0, 0, Dimension::new(0, 0, 1)),
    ("t", 1.0, 3, Dimension::new(0, 1, 0)),
    ("rad", 1.0, 0, Dimension::ANGLE),
    ("deg", std::f64::consts::PI / 180.0, 0, Dimension::ANGLE),
    ("\u{b0}", std::f64::consts::PI / 180.0, 0, Dimension::ANGLE),
    ("%", 1.0, -2, Dimension::NONE),
    ("1", 1.0, 0, Dimension::NONE),
];

fn symbol(text: &str) -> Option<Unit> {
    if let Some(&(_, scale, exponent, dimension)) = FIXED.iter().find(|u| u.0 == text) {
        return Some(Unit { exponent, scale, dimension });
    }
    let base = |name: &str| PREFIXABLE.iter().find(|u| u.0 == name).map(|&(_, e, d)| (e, d));
    if let Some((exponent, dimension)) = base(text) {
        return Some(Unit { exponent, scale: 1.0, dimension });
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let (exponent, dimension) = base(text.strip_prefix(prefix)?)?;
        Some(Unit { exponent: exponent + power, scale: 1.0, dimension })
    })
}

fn nearest_symbol(text: &str) -> Option<String> {
    const COMMON: &[&str] =
        &["m", "mm", "cm", "um", "s", "ms", "min", "h", "kg", "g", "N", "Pa", "kPa", "mPa", "deg", "%"];
    let lower = text.to_lowercase();
    COMMON
        .iter()
        .map(|c| (strsim::damerau_levenshtein(&lower, &c.to_lowercase()), *c))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, c)| *distance < c.len().max(2))
        .map(|(_, c)| c.to_owned())
}

/// Parses a unit such as `kg/m3`, `Pa s`, `m s-1`, `kg/(m s)`, `m²/s`.
///
/// # Errors
/// [`UnitError::UnknownUnit`] with the offending symbol.
pub fn parse_unit(text: &str) -> Result<Unit, UnitError> {
    let mut unit = Unit { exponent: 0, scale: 1.0, dimension: Dimension::default() };
    let chars: Vec<char> = text.chars().map(plain).collect();
    let unknown = |symbol: String| UnitError::UnknownUnit { nearest: nearest_symbol(&symbol), symbol };
    let (mut i, mut sign, mut group) = (0, 1, None);
    while i < chars.len() {
        match chars[i] {
            ' ' | '*' | '\u{b7}' | '.' => i += 1,
            '/' => {
                sign = -1;
                i += 1;
            }
            '(' if group.is_none() => {
                group = Some(sign);
                sign = 1;
                i += 1;
            }
            ')' if group.is_some() => {
                group = None;
                sign = 1;
                i += 1;
            }
            _ => {
                let start = i;
                while i < chars.len() && (chars[i].is_alphabetic() || "%\u{b0}".contains(chars[i])) {
                    i += 1;
                }
                if i == start && chars[i] == '1' {
                    i += 1;
                }
                let name: String = chars[start..i].iter().collect();
                if chars.get(i) == Some(&'^') {
                    i += 1;
                }
                let digits = i;
                while i < chars.len() && (chars[i].is_ascii_digit() || (i == digits && "-+".contains(chars[i]))) {
                    i += 1;
                }
                let exponent: String = chars[digits..i].iter().collect();
                if i == start {
                    return Err(unknown(chars[start..].iter().collect()));
                }
                let power: i32 = match exponent.as_str() {
                    "" => 1,
                    other => other
                        .parse()
                        .ok()
                        .filter(|p: &i32| p.abs() <= 9)
                        .ok_or_else(|| unknown(format!("{name}{other}")))?,
                };
                let factor = symbol(&name).ok_or_else(|| unknown(name))?;
                let power = power * sign * group.unwrap_or(1);
                unit.exponent += power * factor.exponent;
                unit.scale *= factor.scale.powi(power);
                unit.dimension = unit.dimension.times(factor.dimension, power);
                sign = 1;
            }
        }
    }
    if group.is_some() { Err(unknown("(".into())) } else { Ok(unit) }
}

/// Superscripts and the typographic minus as plain characters.
fn plain(c: char) -> char {
    match c {
        '\u{b9}' => '1',
        '\u{b2}' => '2',
        '\u{b3}' => '3',
        '\u{2074}' => '4',
        '\u{207b}' | '\u{2212}' => '-',
        '\u{22c5}' => '*',
        '\t' | '\u{a0}' => ' ',
        other => other,
    }
}

/// Parses `text` as a quantity measured in `unit` (an SI unit) and returns its SI value.
///
/// # Errors
/// [`UnitError`] says what is wrong: no number, no unit, an unknown unit, another dimension, not finite.
pub fn parse_quantity(text: &str, unit: &str) -> Result<f64, UnitError> {
    let trimmed: String = text.trim().chars().map(|c| if c == '\u{2212}' { '-' } else { c }).collect();
    let (mantissa, exponent, rest) = split_number(&trimmed).ok_or_else(|| {
        let lower = trimmed.to_lowercase();
        if ["nan", "inf", "+inf", "-inf", "+nan", "-nan"].iter().any(|n| lower.starts_with(n)) {
            UnitError::NotFinite { text: text.into() }
        } else {
            UnitError::NoNumber { text: text.into() }
        }
    })?;
    if rest.starts_with(',') {
        return Err(UnitError::DecimalComma { text: text.into() });
    }
    let expected = parse_unit(unit)?;
    let rest = rest.trim();
    if rest.is_empty() && expected.dimension != Dimension::NONE {
        return Err(UnitError::NoUnit { text: text.into() });
    }
    let found = parse_unit(rest)?;
    if found.dimension != expected.dimension {
        return Err(UnitError::WrongDimension {
            unit: rest.into(),
            found: found.dimension,
            expected: expected.dimension,
        });
    }
    let exponent = i64::from(found.exponent) + exponent;
    let value = format!("{mantissa}e{exponent}").parse::<f64>().unwrap_or(f64::NAN) * found.scale;
    if value.is_finite() { Ok(value) } else { Err(UnitError::NotFinite { text: text.into() }) }
}

/// Splits `-1.5e3 mm` into mantissa text, decimal exponent and the rest.
fn split_number(text: &str) -> Option<(&str, i64, &str)> {
    let bytes = text.as_bytes();
    let mut i = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let whole = digits(i);
    i += whole;
    let mut fraction = 0;
    if bytes.get(i) == Some(&b'.') {
        fraction = digits(i + 1);
        i += 1 + fraction;
    }
    if whole + fraction == 0 {
        return None;
    }
    let mantissa = &text[..i];
    if matches!(bytes.get(i), Some(b'e' | b'E')) {
        let signed = i + 1 + usize::from(matches!(bytes.get(i + 1), Some(b'+' | b'-')));
        let n = if signed < bytes.len() { digits(signed) } else { 0 };
        if n > 0 {
            let exponent = text[i + 1..signed + n].parse::<i64>().unwrap_or(i64::from(i32::MAX));
            return Some((mantissa, exponent.clamp(-100_000, 100_000), &text[signed + n..]));
        }
    }
    Some((mantissa, 0, &text[i..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_are_applied_to_the_decimal_text() {
        assert_eq!(parse_quantity("6.5 mm", "m"), Ok(6.5e-3));
        assert_eq!(parse_quantity("6.5mm", "m"), Ok(6.5e-3));
        assert_eq!(parse_quantity("2.6e1 um", "m"), Ok(2.6e-5));
        assert_eq!(parse_quantity("1.19 g/cm3", "kg/m3"), Ok(1190.0));
        assert_eq!(parse_quantity("1 mPa s", "Pa s"), Ok(1e-3));
        assert_eq!(parse_quantity("0.27 kg/(m s)", "Pa s"), Ok(0.27));
        assert_eq!(parse_quantity("5 m s^-2", "m/s2"), Ok(5.0));
        assert_eq!(parse_quantity("10 %", "1"), Ok(0.1));
        assert_eq!(parse_quantity("0.43", "1"), Ok(0.43));
        assert_eq!(parse_quantity("1 m²/s", "m2/s"), Ok(1.0));
        assert_eq!(parse_quantity("2 min", "s"), Ok(120.0));
    }

    #[test]
    fn an_angle_is_no_pure_number() {
        assert_eq!(parse_quantity("180 deg", "rad"), Ok(std::f64::consts::PI));
        assert_eq!(parse_quantity("180 \u{b0}", "rad"), Ok(std::f64::consts::PI));
        assert_eq!(parse_quantity("90 deg/s", "rad/s"), Ok(std::f64::consts::FRAC_PI_2));
        for (text, unit) in [("24 deg", "1"), ("0.4 rad", "1"), ("5 %", "rad"), ("0.4 1", "rad"), ("3 rad/s", "1/s")] {
            assert!(matches!(parse_quantity(text, unit), Err(UnitError::WrongDimension { .. })), "{text} as {unit}");
        }
        assert_eq!(Dimension::ANGLE.to_string(), "an angle");
        assert_eq!(parse_unit("N m/rad").map(|unit| unit.dimension.to_string()), Ok("m2 kg s-2 rad-1".into()));
    }

    #[test]
    fn what_is_wrong_is_reported() {
        assert!(matches!(parse_quantity("6,5 mm", "m"), Err(UnitError::DecimalComma { .. })));
        assert!(matches!(parse_quantity("mm", "m"), Err(UnitError::NoNumber { .. })));
        assert!(matches!(parse_quantity("6", "m"), Err(UnitError::NoUnit { .. })));
        assert!(matches!(parse_quantity("6 kg", "m"), Err(UnitError::WrongDimension { .. })));
        assert!(matches!(parse_quantity("inf m", "m"), Err(UnitError::NotFinite { .. })));
        assert!(matches!(parse_quantity("1e999 m", "m"), Err(UnitError::NotFinite { .. })));
        assert_eq!(
            parse_quantity("6 furlong", "m"),
            Err(UnitError::UnknownUnit { symbol: "furlong".into(), nearest: None })
        );
        let Err(UnitError::UnknownUnit { nearest, .. }) = parse_quantity("6 MM", "m") else { panic!("not refused") };
        assert_eq!(nearest.as_deref(), Some("mm"));
    }
}
