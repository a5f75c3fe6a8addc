//! Values of a swept key, as they are typed: `key=a,b,c`, `key=from:to:count`, `key=from:to:count:log`.
//!
//! A unit after the last value holds for all that have none: `flow.pressure_gradient=50:500:10 Pa/m`. Words are values,
//! too: `form=mixed,two-fluid`.

use super::StudyError;

/// A key and the values that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// `table.key`, or a key of the model
    pub key: String,
    /// each as it is given to `--set`
    pub values: Vec<String>,
    /// whether they are evenly spaced in their logarithm
    pub log: bool,
}

/// More points than this are a mistake.
pub const MAX_POINTS: usize = 10_000;

/// Reads one `--over` argument.
///
/// # Errors
/// [`StudyError::BadOver`] with what is wrong.
pub fn parse(argument: &str) -> Result<Varied, StudyError> {
    let bad = |reason: String| StudyError::BadOver { argument: argument.into(), reason };
    let Some((key, rest)) = argument.split_once('=') else { return Err(bad("it has no =".into())) };
    let (key, rest) = (key.trim().to_owned(), rest.trim());
    if key.is_empty() {
        return Err(bad("it names no key".into()));
    }
    let items = split(rest, ',');
    if let Some(empty) = items.iter().position(|item| item.is_empty()) {
        return Err(bad(format!("value {} is empty", empty + 1)));
    }
    let parts = split(rest, ':');
    if items.len() == 1 && parts.len() > 1 {
        let (values, log) = range(&parts).map_err(bad)?;
        return Ok(Varied { key, values, log });
    }
    let unit = items.last().and_then(|last| number_and_unit(last)).map_or("", |(_, unit)| unit);
    let values = items.iter().map(|item| match number_and_unit(item) {
        Some((_, "")) if !unit.is_empty() => format!("{item} {unit}"),
        _ => (*item).to_owned(),
    });
    Ok(Varied { key, values: values.collect(), log: false })
}

/// `from:to:count` with an optional `log`, and a unit after any of them.
fn range(parts: &[&str]) -> Result<(Vec<String>, bool), String> {
    let (&[from, to, count], mode) = (
        match parts {
            [from, to, count] | [from, to, count, _] => &[*from, *to, *count],
            _ => return Err("a range is from:to:count or from:to:count:log".into()),
        },
        parts.get(3),
    );
    let number = |text: &'static str, part| number_and_unit(part).ok_or(format!("{text} = \"{part}\" is not a number"));
    let ((a, unit_a), (b, unit_b), (n, unit_n)) = (number("from", from)?, number("to", to)?, number("count", count)?);
    let unit_mode = match mode.map(|mode| mode.strip_prefix("log").map(str::trim)) {
        None => "",
        Some(Some(unit)) => unit,
        Some(None) => return Err(format!("\"{}\" is not log", mode.unwrap_or(&""))),
    };
    let mut units: Vec<&str> = [unit_a, unit_b, unit_n, unit_mode].into_iter().filter(|u| !u.is_empty()).collect();
    units.dedup();
    if units.len() > 1 {
        return Err(format!("it has two units, {}", units.join(" and ")));
    }
    if n.fract() != 0.0 || !(2.0..=MAX_POINTS as f64).contains(&n) {
        return Err(format!("{n} is not a count from 2 to {MAX_POINTS}"));
    }
    let log = mode.is_some();
    if log && !(a > 0.0 && b > 0.0) {
        return Err("a logarithmic range lies above 0".into());
    }
    let last = n as usize - 1;
    let value = |i: usize| {
        let share = i as f64 / last as f64;
        let x = match i {
            0 => a,
            i if i == last => b,
            _ if log => a * (b / a).powf(share),
            _ => a + (b - a) * share,
        };
        let unit = units.first().map(|unit| format!(" {unit}")).unwrap_or_default();
        plain(x) + &unit
    };
    Ok(((0..=last).map(value).collect(), log))
}

/// Twelve digits, without the round-off of the spacing.
fn plain(x: f64) -> String {
    let x: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    if x == 0.0 || (1e-4..1e15).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}

/// Splits at `at` outside quotes, brackets and braces.
fn split(text: &str, at: char) -> Vec<&str> {
    let (mut pieces, mut start, mut depth, mut quoted) = (Vec::new(), 0, 0_usize, false);
    for (i, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '{' | '[' => depth += 1,
            '}' | ']' => depth = depth.saturating_sub(1),
            c if c == at && depth == 0 && !quoted => {
                pieces.push(text[start..i].trim());
                start = i + c.len_utf8();
            }
            _ => {}
        }
    }
    pieces.push(text[start..].trim());
    pieces
}

/// A finite number at the beginning of `text`, and what follows it.
#[must_use]
pub fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c))).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let number = number.parse().ok().filter(|x: &f64| x.is_finite())?;
    Some((number, unit.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(argument: &str) -> Vec<String> {
        parse(argument).unwrap().values
    }

    #[test]
    fn lists_ranges_and_units() {
        assert_eq!(values("a.b=1,2.5, 3e-4"), ["1", "2.5", "3e-4"]);
        assert_eq!(values("a.b=1,2 mm"), ["1 mm", "2 mm"]);
        assert_eq!(values("a.b=1 cm,2 mm"), ["1 cm", "2 mm"]);
        assert_eq!(values("a.b=mixed,two-fluid"), ["mixed", "two-fluid"]);
        assert_eq!(values("a.b={ law = \"x\", c = 1 },none"), ["{ law = \"x\", c = 1 }", "none"]);
        assert_eq!(values("a.b=0.1:0.4:4"), ["0.1", "0.2", "0.3", "0.4"]);
        assert_eq!(values("a.b=50:150:3 Pa/m"), ["50 Pa/m", "100 Pa/m", "150 Pa/m"]);
        assert_eq!(values("a.b=50 Pa/m:150 Pa/m:2"), ["50 Pa/m", "150 Pa/m"]);
        assert_eq!(values("a.b=1e-6:1e-2:3:log 1/s"), ["1e-6 1/s", "0.0001 1/s", "0.01 1/s"]);
        assert_eq!(values("a.b=7"), ["7"]);
        assert!(parse("a.b=1:100:3:log").unwrap().log && !parse("a.b=1:100:3").unwrap().log);
    }

    #[test]
    fn what_is_wrong_is_reported() {
        for (argument, words) in [
            ("a.b", "no ="),
            ("=1,2", "names no key"),
            ("a.b=1,,2", "value 2 is empty"),
            ("a.b=", "value 1 is empty"),
            ("a.b=1:2", "a range is"),
            ("a.b=1:2:1", "not a count"),
            ("a.b=1:2:2.5", "not a count"),
            ("a.b=1:2:20000", "not a count"),
            ("a.b=1:x:3", "to = \"x\" is not a number"),
            ("a.b=1:2:3:lin", "\"lin\" is not log"),
            ("a.b=0:2:3:log", "above 0"),
            ("a.b=1 m:2 mm:3", "two units, m and mm"),
        ] {
            let said = parse(argument).unwrap_err().to_string();
            assert!(said.contains(words), "{argument}: {said}");
        }
    }
}
