//! Limits, round ticks and their labels.

use crate::result::{Axis, Scale};

/// An axis laid along pixels.
#[derive(Clone, Debug)]
pub(super) struct Ruler {
    /// first and last value
    pub limits: (f64, f64),
    scale: Scale,
    /// positions of the first and the last value
    pub span: (f64, f64),
    /// ascending
    pub ticks: Vec<Tick>,
    /// labels show values over ten to this power
    pub exponent: i32,
}

/// A mark on an axis; without a label it is a short one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// value
    pub at: f64,
    /// text; empty for a minor tick
    pub label: String,
}

impl Ruler {
    /// Lays `axis` along `span`, with limits that hold `values` and at most `labels` labelled ticks.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>, span: (f64, f64), labels: usize) -> Self {
        let limits = limits(axis, values);
        let (ticks, exponent) = match axis.scale {
            _ if !axis.names.is_empty() => (named_ticks(&axis.names), 0),
            Scale::Linear => linear_ticks(limits, labels),
            Scale::Log => (log_ticks(limits, labels), 0),
        };
        Self { limits, scale: axis.scale, span, ticks, exponent }
    }

    /// Position of a value.
    pub fn at(&self, value: f64) -> f64 {
        let (low, high) = self.limits;
        let share = match self.scale {
            Scale::Linear => (value - low) / (high - low),
            Scale::Log => (value / low).ln() / (high / low).ln(),
        };
        self.span.0 + share * (self.span.1 - self.span.0)
    }

    /// Whether a value lies between the limits.
    pub fn holds(&self, value: f64) -> bool {
        (self.limits.0..=self.limits.1).contains(&value)
    }
}

/// `velocity (10³ mm/s)`.
pub(super) fn caption(axis: &Axis, exponent: i32) -> String {
    let unit = if axis.unit == "1" { "" } else { axis.unit.as_str() };
    let factor = if exponent == 0 { String::new() } else { power_of_ten(exponent) };
    match format!("{factor} {unit}").trim() {
        "" => axis.title.clone(),
        inside => format!("{} ({inside})", axis.title),
    }
}

/// Share of the range that is left free beyond the data, at ends that are not zero.
const HEAD_ROOM: f64 = 0.05;

/// Ends of the axis: known ends, widened to the data; zero where the data start near it; never two equal numbers.
fn limits(axis: &Axis, values: impl Iterator<Item = f64>) -> (f64, f64) {
    if !axis.names.is_empty() {
        return (-0.5, axis.names.len() as f64 - 0.5);
    }
    let range = values.filter(|&v| axis.holds(v)).fold(None, |range, v| match range {
        None => Some((v, v)),
        Some((low, high)) => Some((v.min(low), v.max(high))),
    });
    let known = axis.ends.filter(|&(low, high)| low < high && axis.holds(low) && axis.holds(high));
    match (known, range, axis.scale) {
        (Some(ends), None, _) => ends,
        (Some((a, b)), Some((low, high)), scale) => {
            let (free_low, free_high) = free(scale, low, high);
            // round-off beyond a wall is no reason to move it
            let slack = 1e-9 * (b - a);
            (if low < a - slack { free_low } else { a }, if high > b + slack { free_high } else { b })
        }
        (None, Some((low, high)), scale) => free(scale, low, high),
        (None, None, Scale::Linear) => (0.0, 1.0),
        (None, None, Scale::Log) => (1.0, 10.0),
    }
}

fn free(scale: Scale, low: f64, high: f64) -> (f64, f64) {
    match scale {
        Scale::Linear => free_linear(low, high),
        Scale::Log => {
            let (a, b) = (decade(low), decade(high));
            let b = if 10f64.powi(b) < high * (1.0 - 1e-9) { b + 1 } else { b };
            // powers of ten are rounded: the data are not
            (10f64.powi(a).min(low), 10f64.powi(if b > a { b } else { a + 1 }).max(high))
        }
    }
}

/// Exponent of the power of ten at or below a positive value.
fn decade(value: f64) -> i32 {
    (value.log10() + 1e-9).floor() as i32
}

fn free_linear(low: f64, high: f64) -> (f64, f64) {
    let size = low.abs().max(high.abs());
    if size < 1e-280 {
        return (-1.0, 1.0);
    }
    let (low, high) = if high - low > 1e-6 * size { (low, high) } else { (low.min(0.0), high.max(0.0)) };
    let (from_zero, to_zero) = (low >= 0.0 && low < 0.3 * high, high <= 0.0 && high > 0.3 * low);
    let room = HEAD_ROOM * (high - low);
    (if from_zero { 0.0 } else { low - room }, if to_zero { 0.0 } else { high + room })
}

/// Multiples of 1, 2 or 5 times a power of ten, with the same decimals at each.
fn linear_ticks((low, high): (f64, f64), labels: usize) -> (Vec<Tick>, i32) {
    let size = low.abs().max(high.abs());
    let exponent = if (1e-2..1e5).contains(&size) { 0 } else { decade(size) };
    let unit = 10f64.powi(exponent);
    let (a, b) = (low / unit, high / unit);
    let coarse = (b - a) / labels.max(1) as f64;
    let mut power = decade(coarse);
    let leading = match coarse / 10f64.powi(power) {
        m if m <= 1.0 + 1e-9 => 1,
        m if m <= 2.0 + 1e-9 => 2,
        m if m <= 5.0 + 1e-9 => 5,
        _ => {
            power += 1;
            1
        }
    };
    let value = |k: i64| {
        let whole = (k * leading) as f64;
        if power < 0 { whole / 10f64.powi(-power) } else { whole * 10f64.powi(power) }
    };
    let step = value(1);
    let decimals = usize::try_from(-power).unwrap_or(0);
    let (first, last) = ((a / step - 1e-9).ceil() as i64, (b / step + 1e-9).floor() as i64);
    let ticks = (first..=last)
        .map(|k| {
            let label = if k == 0 { "0".into() } else { format!("{:.decimals$}", value(k)).replace('-', "\u{2212}") };
            Tick { at: (value(k) * unit).clamp(low, high), label }
        })
        .collect();
    (ticks, exponent)
}

/// A tick for each name.
fn named_ticks(names: &[String]) -> Vec<Tick> {
    names.iter().enumerate().map(|(i, name)| Tick { at: i as f64, label: name.clone() }).collect()
}

/// Powers of ten with labels, and the multiples between them where there is room.
fn log_ticks((low, high): (f64, f64), labels: usize) -> Vec<Tick> {
    let (first, last) = (decade(low), decade(high));
    let count = (last - first + 1).max(1);
    let every = (count + labels.max(2) as i32 - 1) / labels.max(2) as i32;
    let plain = first >= -2 && last <= 4;
    let text = |digit: i32, power: i32| match plain {
        true if power < 0 => format!("{:.*}", (-power) as usize, f64::from(digit) * 10f64.powi(power)),
        true => format!("{}", f64::from(digit) * 10f64.powi(power)),
        false if digit == 1 => power_of_ten(power),
        false => format!("{digit}\u{d7}{}", power_of_ten(power)),
    };
    let mut ticks = Vec::new();
    for power in first..=last {
        for digit in 1..10 {
            let at = f64::from(digit) * 10f64.powi(power);
            let major = digit == 1 && (power - first) % every == 0;
            // one or two decades alone leave too few numbers to read values from
            let helper = count <= 2 && (digit == 2 || digit == 5);
            let shown = major || helper || every == 1 || digit == 1;
            if shown && at >= low * (1.0 - 1e-9) && at <= high * (1.0 + 1e-9) {
                let label = if major || helper { text(digit, power) } else { String::new() };
                ticks.push(Tick { at: at.clamp(low, high), label });
            }
        }
    }
    ticks
}

/// `10⁻³`.
fn power_of_ten(exponent: i32) -> String {
    const DIGITS: [char; 10] = [
        '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}', '\u{2078}',
        '\u{2079}',
    ];
    let digits = exponent.to_string();
    let raised = digits.chars().map(|c| c.to_digit(10).and_then(|d| DIGITS.get(d as usize)).copied());
    format!("10{}", raised.map(|c| c.unwrap_or('\u{207b}')).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, values: &[f64], count: usize) -> (Vec<String>, i32) {
        let ruler = Ruler::new(axis, values.iter().copied(), (0.0, 100.0), count);
        (ruler.ticks.into_iter().map(|t| t.label).filter(|l| !l.is_empty()).collect(), ruler.exponent)
    }

    #[test]
    fn ticks_are_round_and_their_decimals_agree() {
        let axis = Axis::linear("x", "m");
        assert_eq!(labels(&axis, &[0.0, 0.6], 4).0, ["0", "0.2", "0.4", "0.6"]);
        assert_eq!(labels(&axis, &[-0.12, 0.3], 5).0, ["\u{2212}0.1", "0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(&axis, &[0.0, 65.0], 4).0, ["0", "20", "40", "60"]);
        assert_eq!(labels(&axis, &[0.0, 7.3e-6], 4), (["0", "2", "4", "6"].map(String::from).to_vec(), -6));
        assert_eq!(labels(&axis, &[0.0, 2.4e7], 3), (["0", "1", "2"].map(String::from).to_vec(), 7));
        assert_eq!(labels(&axis, &[1000.0, 1000.5], 3).0, ["1000.0", "1000.2", "1000.4"]);
    }

    #[test]
    fn degenerate_ranges_still_give_an_axis() {
        let axis = Axis::linear("x", "m");
        for values in [
            &[][..],
            &[0.0],
            &[0.0, 0.0],
            &[0.3],
            &[-7.0],
            &[1e-300],
            &[5e-324, 1e-310],
            &[1e279, -1e279],
            &[f64::NAN, f64::INFINITY, 1.0],
            &[0.1, 0.1 + 1e-17],
            &[1e9, 1e9 + 1e-3],
        ] {
            for axis in [&axis, &Axis::log("x", "m")] {
                let ruler = Ruler::new(axis, values.iter().copied(), (10.0, 110.0), 5);
                let (low, high) = ruler.limits;
                assert!(low < high && low.is_finite() && high.is_finite(), "{values:?}");
                assert!((2..40).contains(&ruler.ticks.len()), "{values:?}: {:?}", ruler.ticks);
                assert!(ruler.ticks.iter().all(|t| (10.0..=110.0001).contains(&ruler.at(t.at))), "{values:?}");
                assert!(values.iter().filter(|v| axis.holds(**v)).all(|&v| ruler.holds(v)), "{values:?}");
            }
        }
        assert_eq!(limits(&axis, [0.0, 0.0].into_iter()), (-1.0, 1.0));
    }

    #[test]
    fn zero_is_an_end_only_where_the_data_start_there() {
        let axis = Axis::linear("x", "m");
        assert_eq!(limits(&axis, [0.0, 1.0].into_iter()), (0.0, 1.05));
        assert_eq!(limits(&axis, [-1.0, 0.0].into_iter()), (-1.05, 0.0));
        assert!(limits(&axis, [0.9, 1.0].into_iter()).0 > 0.8);
        let walls = Axis { ends: Some((0.0, 65.0)), ..axis };
        assert_eq!(limits(&walls, [0.2, 64.8].into_iter()), (0.0, 65.0));
        assert!(limits(&walls, [0.2, 70.0].into_iter()).1 > 70.0);
    }

    #[test]
    fn kinds_stand_at_their_names_whatever_the_data() {
        let axis = Axis::named("class", ["holds", "fails"].map(String::from).to_vec());
        let ruler = Ruler::new(&axis, [0.0].into_iter(), (0.0, 100.0), 7);
        assert_eq!(ruler.limits, (-0.5, 1.5));
        assert_eq!(
            ruler.ticks.iter().map(|t| (t.at, t.label.as_str())).collect::<Vec<_>>(),
            [(0.0, "holds"), (1.0, "fails")]
        );
    }

    #[test]
    fn logarithmic_axes_end_at_decades() {
        let axis = Axis::log("z", "m");
        let ruler = Ruler::new(&axis, [1e-4, 0.1].into_iter(), (0.0, 3.0), 6);
        assert_eq!(ruler.limits, (1e-4, 0.1));
        assert!((ruler.at(1e-3) - 1.0).abs() < 1e-9);
        assert_eq!(
            labels(&axis, &[1e-4, 0.1], 6).0,
            ["10\u{207b}\u{2074}", "10\u{207b}\u{b3}", "10\u{207b}\u{b2}", "10\u{207b}\u{b9}"]
        );
        assert_eq!(labels(&axis, &[0.02, 30.0], 6).0, ["0.01", "0.1", "1", "10", "100"]);
        assert_eq!(labels(&axis, &[2.0, 3.0], 6).0, ["1", "2", "5", "10"]);
        assert!(labels(&axis, &[1e-20, 1.0], 6).0.len() <= 6);
    }

    #[test]
    fn factors_stand_before_the_unit() {
        assert_eq!(caption(&Axis::linear("u", "mm/s"), 0), "u (mm/s)");
        assert_eq!(caption(&Axis::linear("u", "mm/s"), -6), "u (10\u{207b}\u{2076} mm/s)");
        assert_eq!(caption(&Axis::linear("\u{3c6}", "1"), 0), "\u{3c6}");
        assert_eq!(caption(&Axis::linear("q", "1"), 12), "q (10\u{b9}\u{b2})");
    }
}
