//! Random cases: bytes, texts that look like TOML, and shipped cases that were tampered with.

use bedload::case::shipped;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// A case as text, and what `--set` changes in it.
#[derive(Clone, Debug)]
pub struct Input {
    pub text: String,
    pub overrides: Vec<String>,
}

/// Values that ask for trouble.
const EXTREMES: &[&str] = &[
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "-5e-324",
    "0",
    "-0.0",
    "0.0",
    "1",
    "-1",
    "1e999",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "-9223372036854775808",
    "99999999999999999999999",
    "0xffffffffffffffffffff",
    "0b1",
    "1_000",
    "true",
    "1979-05-27T07:32:00Z",
    "07:32:00",
    "\"\"",
    "\"nan m\"",
    "\"inf\"",
    "\"1e999 m\"",
    "\"-1e-999 m\"",
    "\"6,5 mm\"",
    "\"1e308 km\"",
    "\"5e-324 mm\"",
    "\"1 m-9\"",
    "\"1 m^999\"",
    "\"1 (((m\"",
    "\"1 %\"",
    "\"90 deg\"",
    "\"\u{2212}5 \u{b5}m\"",
    "\"5 m\u{b2}/s\"",
    "\"\\u0000\"",
    "\"\\u001b[2J\"",
    "\"\u{202e}x\"",
    "\"\u{1f30a}\u{1f3d6}\"",
    "\"e\u{301}\"",
    "[]",
    "[1, 2]",
    "[[[[[[[[]]]]]]]]",
    "{}",
    "{ a = 1 }",
    "{ law = \"none\" }",
    "{ law = \"rough\", k_s = 1 }",
    "'''\n'''",
    "\"mixed\"",
    "\"two-fluid\"",
    "\"exact\"",
    "\"ouriemi\"",
    "\"log-law\"",
    "\"mu-i\"",
    "\"coulomb\"",
    "\"boyer\"",
    "\"tangent\"",
    "\"sine\"",
];

/// Pieces of TOML, right and wrong.
const PIECES: &[&str] = &[
    "[",
    "]",
    "[[",
    "]]",
    "=",
    " = ",
    "\n",
    ",",
    ".",
    "\"",
    "'",
    "\"\"\"",
    "'''",
    "#",
    "{",
    "}",
    "\\",
    "\\u",
    "\r\n",
    "\t",
    " ",
    "format",
    "format = 2\n",
    "scene = \"bed\"\n",
    "[case]\n",
    "[fluid]\n",
    "[grains]\n",
    "[bed]\n",
    "[flow]\n",
    "[sheet-flow]\n",
    "[coupled.cell]\n",
    "[model]\n",
    "[grid]\n",
    "[[check]]\n",
    "[laminar.closures]\n",
    "friction = { law = \"coulomb\" }\n",
    "[a.b.c]\n",
    "[laminar.closures.friction]\n",
    "format = 1\n",
    "12.5 d",
    "title",
    "density",
    "viscosity",
    "diameter",
    "thickness",
    "phi",
    "depth",
    "top",
    "shields",
    "slope",
    "u_star",
    "scene",
    "top = \"plane\"\n",
    "law = \"none\"\n",
    "law",
    "cells",
    "\u{0}",
    "\u{1b}[31m",
    "\u{feff}",
    "\u{9b}",
    "\u{e9}",
    "\u{1f30a}",
    "a",
    "0",
    "-",
];

/// One act of vandalism on a text.
#[derive(Clone, Debug)]
enum Act {
    Delete(Index),
    Duplicate(Index),
    Swap(Index, Index),
    Flip(Index, u8),
    Cut(Index),
    Insert(Index, &'static str),
    Value(Index, &'static str),
    /// another power of ten of the number in a line, its unit kept
    Scale(Index, i32),
    Number(Index, f64),
    Long(Index, usize),
    Nest(Index, usize),
}

fn act() -> impl Strategy<Value = Act> {
    let line = any::<Index>;
    prop_oneof![
        1 => line().prop_map(Act::Delete),
        1 => line().prop_map(Act::Duplicate),
        1 => (line(), line()).prop_map(|(a, b)| Act::Swap(a, b)),
        1 => (line(), any::<u8>()).prop_map(|(i, mask)| Act::Flip(i, mask)),
        1 => line().prop_map(Act::Cut),
        1 => (line(), select(PIECES)).prop_map(|(i, piece)| Act::Insert(i, piece)),
        4 => (line(), select(EXTREMES)).prop_map(|(i, value)| Act::Value(i, value)),
        8 => (line(), -30..30).prop_map(|(i, power)| Act::Scale(i, power)),
        4 => (line(), -320.0..10.0).prop_map(|(i, exponent)| Act::Number(i, f64::powf(10.0, exponent))),
        1 => (line(), 1..20_000_usize).prop_map(|(i, n)| Act::Long(i, n)),
        1 => (line(), 1..600_usize).prop_map(|(i, n)| Act::Nest(i, n)),
    ]
}

/// A change that leaves most cases valid.
fn scale() -> impl Strategy<Value = Act> {
    (any::<Index>(), -4..5).prop_map(|(i, power)| Act::Scale(i, power))
}

/// The lines that hold a value.
fn values(lines: &[String]) -> Vec<usize> {
    let valued = |l: &String| l.contains(" = ") && !l.starts_with('#');
    lines.iter().enumerate().filter(|(_, l)| valued(l)).map(|(i, _)| i).collect()
}

/// `line` with another value.
fn with_value(line: &str, value: &str) -> String {
    line.split_once(" = ").map_or_else(|| value.into(), |(key, _)| format!("{key} = {value}"))
}

impl Act {
    fn on(&self, text: &str) -> String {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        if lines.is_empty() {
            return text.into();
        }
        let n = lines.len();
        let valued = values(&lines);
        let value = |i: &Index| if valued.is_empty() { 0 } else { valued[i.index(valued.len())] };
        match self {
            Self::Delete(i) => drop(lines.remove(i.index(n))),
            Self::Duplicate(i) => lines.insert(i.index(n), lines[i.index(n)].clone()),
            Self::Swap(a, b) => lines.swap(a.index(n), b.index(n)),
            Self::Flip(i, mask) => {
                let mut bytes = text.as_bytes().to_vec();
                bytes[i.index(text.len())] ^= mask;
                return String::from_utf8_lossy(&bytes).into_owned();
            }
            Self::Cut(i) => return String::from_utf8_lossy(&text.as_bytes()[..i.index(text.len())]).into_owned(),
            Self::Insert(i, piece) => {
                let mut chars: Vec<char> = text.chars().collect();
                let at = i.index(chars.len());
                chars.splice(at..at, piece.chars());
                return chars.into_iter().collect();
            }
            Self::Value(i, extreme) => lines[value(i)] = with_value(&lines[value(i)], extreme),
            Self::Number(i, x) => lines[value(i)] = with_value(&lines[value(i)], &format!("{x:e}")),
            Self::Scale(i, power) => {
                let line = &mut lines[value(i)];
                if let Some((key, rest)) = line.split_once(" = ") {
                    let (quote, rest) = rest.strip_prefix('"').map_or(("", rest), |rest| ("\"", rest));
                    let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
                    if end > 0 {
                        *line = format!("{key} = {quote}{}e{power}{}", &rest[..end], &rest[end..]);
                    }
                }
            }
            Self::Long(i, length) => {
                lines[value(i)] = with_value(&lines[value(i)], &format!("\"{}\"", "é".repeat(*length)))
            }
            Self::Nest(i, depth) => {
                let nested = format!("{}{}", "[".repeat(*depth), "]".repeat(*depth));
                lines[value(i)] = with_value(&lines[value(i)], &nested);
            }
        }
        lines.join("\n") + "\n"
    }
}

/// A shipped case without its checks, which every change would break.
fn shipped_text() -> impl Strategy<Value = String> {
    let names: Vec<&str> = shipped::names().collect();
    let boyer = "{ law = \"boyer\", phi_max = 0.62 }";
    (select(names), any::<bool>(), 0..4).prop_map(move |(name, whole, variant)| {
        let text = shipped::find(name).map_or("", |shipped| shipped.content);
        let text = if whole { text } else { text.split("\n[[").next().unwrap_or(text) };
        match variant {
            0 => text.replace("\"einstein\"", boyer),
            1 => text
                .replace("pressure_gradient = \"1471.5 Pa/m\"", "shields = 0.3")
                .replace("mean_velocity = \"1 m/s\"", "pressure_gradient = 50"),
            _ => text.to_owned(),
        }
    })
}

fn override_() -> impl Strategy<Value = String> {
    let keys = &[
        "bed.thickness",
        "bed.phi",
        "flow.depth",
        "flow.top",
        "scene",
        "flow.shields",
        "grid.cells",
        "check.0.at",
        "model",
        "closures.drag.law",
        "",
        "a.b.c",
        "fluid.density",
    ][..];
    (select(keys), select(EXTREMES)).prop_map(|(key, value)| format!("{key}={}", value.trim_matches('"')))
}

/// Bytes, pieces of TOML, and shipped cases with one to four changes.
pub fn input() -> impl Strategy<Value = Input> {
    let bytes = vec(any::<u8>(), 0..300).prop_map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let pieces = vec(select(PIECES), 0..80).prop_map(|pieces| pieces.concat());
    let mutated =
        (shipped_text(), vec(act(), 1..5)).prop_map(|(text, acts)| acts.iter().fold(text, |text, act| act.on(&text)));
    let scaled =
        (shipped_text(), vec(scale(), 1..4)).prop_map(|(text, acts)| acts.iter().fold(text, |text, act| act.on(&text)));
    let text = prop_oneof![1 => bytes, 2 => pieces, 12 => mutated, 5 => scaled];
    (text, prop_oneof![9 => Just(Vec::new()), 1 => vec(override_(), 1..3)])
        .prop_map(|(text, overrides)| Input { text, overrides })
}
