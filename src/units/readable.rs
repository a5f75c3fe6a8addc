//! Numbers as a reader expects them: few digits, a decimal multiple of the unit, an error with two digits.

/// Error over a value that is round-off.
pub const ROUND_OFF: f64 = 1e-9;

/// `value` with `digits` significant digits, in decimal or scientific notation, whichever a reader expects.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let text = format!("{value:.*e}", digits.max(1) - 1);
    let exponent: i32 = text.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    if (-4..6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        format!("{value:.decimals$}")
    } else {
        text
    }
}

/// An `equation` with the `constants` in it: symbol, value in SI, and unit, which a pure number has not.
#[must_use]
pub fn stated(equation: &str, constants: &[(&str, f64, &str)]) -> String {
    let mut text = equation.to_owned();
    for (i, (symbol, value, unit)) in constants.iter().enumerate() {
        let (lead, gap) = (if i == 0 { ",  " } else { ", " }, if unit.is_empty() { "" } else { " " });
        text += &format!("{lead}{symbol} = {}{gap}{unit}", significant(*value, 5));
    }
    text
}

/// A decimal multiple of `unit` in which a number of size `magnitude` is easy to read: factor from SI and its symbol.
#[must_use]
pub fn readable_unit(magnitude: f64, unit: &'static str) -> (f64, &'static str) {
    let size = magnitude.abs();
    match unit {
        "m" if size > 0.0 && size < 1e-4 => (1e6, "\u{b5}m"),
        "m" if size > 0.0 && size < 0.1 => (1e3, "mm"),
        "m/s" if size > 0.0 && size < 1e-4 => (1e6, "\u{b5}m/s"),
        "m/s" if size > 0.0 && size < 0.1 => (1e3, "mm/s"),
        "m²/s" if size > 0.0 && size < 1e-3 => (1e6, "mm²/s"),
        "Pa" if size > 0.0 && size < 0.01 => (1e3, "mPa"),
        "Pa" if size >= 1e4 => (1e-3, "kPa"),
        _ => (1.0, unit),
    }
}

/// `value` in a readable multiple of `unit` with four significant digits, such as `12.10 mm`.
#[must_use]
pub fn readable(value: f64, unit: &'static str) -> String {
    shown_in(value, readable_unit(value, unit))
}

/// `value` in a multiple of its unit, with four digits.
pub(super) fn shown_in(value: f64, (factor, symbol): (f64, &'static str)) -> String {
    let number = significant(value * factor, 4);
    if symbol.is_empty() || symbol == "1" { number } else { format!("{number} {symbol}") }
}

/// How well `value` is known: `± 3.2 %`, or the error itself where the value is no larger; `None` for an error that is none,
/// 0 or round-off.
#[must_use]
pub fn readable_error(value: f64, error: f64, unit: &'static str) -> Option<String> {
    if !(error.is_finite() && error > ROUND_OFF * value.abs()) {
        return None;
    }
    let share = 100.0 * error / value.abs();
    Some(if share < 100.0 {
        format!("± {} %", significant(share, 2))
    } else {
        format!("± {}", readable(error, unit))
    })
}

/// `value` with four digits and how well it is known, as `12.10 mm ± 3.2 %`.
#[must_use]
pub fn readable_known(value: f64, error: Option<f64>, unit: &'static str) -> String {
    let error = error.and_then(|error| readable_error(value, error, unit));
    readable(value, unit) + &error.map_or_else(String::new, |error| format!(" {error}"))
}

/// `value ± error` in a readable multiple of `unit`, the error with two digits, such as `12.10 ± 0.12 mm`.
#[must_use]
pub fn readable_mean(value: f64, error: f64, unit: &'static str) -> String {
    mean_in(value, error, readable_unit(value, unit))
}

/// `value ± error` in a multiple of its unit.
pub(super) fn mean_in(value: f64, error: f64, (factor, symbol): (f64, &'static str)) -> String {
    // An error of round-off is none.
    let error = if error.abs() < ROUND_OFF * value.abs() { 0.0 } else { error };
    let (value, error) = (value * factor, error * factor);
    let exponent = error.abs().log10().floor();
    // Two digits of the error, unless that would be none of the value, or more than anyone reads.
    let decimals = (1.0 - exponent).clamp(0.0, 12.0);
    let number = if (1e-4..1e6).contains(&value.abs()) && exponent.is_finite() && error < value.abs() {
        format!("{value:.*} ± {error:.*}", decimals as usize, decimals as usize)
    } else {
        format!("{} ± {}", significant(value, 4), significant(error, 2))
    };
    if symbol.is_empty() || symbol == "1" { number } else { format!("{number} {symbol}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_and_its_error_share_unit_and_digits() {
        assert_eq!(readable_mean(0.01275, 8.252e-5, "m²/s"), "0.012750 ± 0.000083 m²/s");
        assert_eq!(readable_mean(0.01210, 1.2e-4, "m"), "12.10 ± 0.12 mm");
        assert_eq!(readable_mean(26.38, 0.8, "1/s"), "26.38 ± 0.80 1/s");
        assert_eq!(readable_mean(2.0, 30.0, "1"), "2.000 ± 30");
        assert_eq!(readable_mean(0.0, 0.0, "1"), "0 ± 0");
        assert_eq!(readable_mean(5.0, 0.0, "1"), "5.000 ± 0");
        assert_eq!(readable_mean(0.023_394_999, 1e-18, "m"), "23.39 ± 0 mm");
    }

    #[test]
    fn an_error_is_a_share_of_what_is_larger_and_none_is_not_shown() {
        let shown = |value, error| readable_error(value, error, "m²/s");
        assert_eq!(shown(0.01275, 8.252e-5).as_deref(), Some("± 0.65 %"));
        assert_eq!(shown(-2.0, 1.0).as_deref(), Some("± 50 %"));
        // A bed at rest.
        assert_eq!(shown(1e-6, 1.511e-5).as_deref(), Some("± 15.11 mm²/s"));
        assert_eq!(shown(0.0, 1.511e-5).as_deref(), Some("± 15.11 mm²/s"));
        assert_eq!(readable_known(0.0121, Some(1.2e-4), "m"), "12.10 mm ± 0.99 %");
        assert_eq!(readable_known(0.0121, None, "m"), "12.10 mm");
        for (value, error) in [(1.0, 0.0), (1.0, 1e-12), (0.0, 0.0), (1.0, f64::NAN), (1.0, f64::INFINITY)] {
            assert_eq!(shown(value, error), None, "{value} ± {error}");
        }
    }

    #[test]
    fn numbers_are_displayed_as_a_reader_expects() {
        assert_eq!(readable(0.012_103_4, "m"), "12.10 mm");
        assert_eq!(significant(3.310_3e-5, 4), "3.310e-5");
        assert_eq!(significant(0.056_759, 4), "0.05676");
        assert_eq!(readable(0.43, "1"), "0.4300");
    }
}
