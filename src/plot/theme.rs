//! Colours, dash patterns and sizes: the one place that knows how a figure looks.

use plotters::style::RGBColor;

use crate::result::Dash;

/// What a stroke or an area is for; the theme gives it a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// text, frames and ticks
    Ink,
    /// levels and what stands back
    Faint,
    /// the bed
    Tint,
    /// what lies under everything
    Paper,
    /// a curve, by index into the palette
    Series(usize),
}

/// CSS variable, colour on white paper, colour on a dark screen. The curves are Okabe and Ito's palette, which the
/// colour-blind can tell apart, lightened where it would drown on a dark screen.
const COLOURS: &[(&str, u32, u32)] = &[
    ("ink", 0x1c2024, 0xe4e7ea),
    ("faint", 0x6b737b, 0x98a1aa),
    ("tint", 0xf3eee5, 0x2a2722),
    ("paper", 0xffffff, 0x15181b),
    ("c0", 0x1c2024, 0xe4e7ea),
    ("c1", 0x0072b2, 0x56b4e9),
    ("c2", 0xd55e00, 0xff8f45),
    ("c3", 0x009e73, 0x2fc79a),
    ("c4", 0xcc79a7, 0xe59ac4),
    ("c5", 0xe69f00, 0xf0c04a),
    ("c6", 0x56b4e9, 0x9ad4f5),
];

/// Entries of [`COLOURS`] before the first curve.
const FIRST_SERIES: usize = 4;

impl Role {
    /// Index into [`COLOURS`]; curves beyond the palette start again.
    fn index(self) -> usize {
        match self {
            Self::Ink => 0,
            Self::Faint => 1,
            Self::Tint => 2,
            Self::Paper => 3,
            Self::Series(k) => FIRST_SERIES + k % (COLOURS.len() - FIRST_SERIES),
        }
    }
}

/// The colour of a role on white paper.
pub(super) fn light(role: Role, _: Dash) -> RGBColor {
    let [_, r, g, b] = COLOURS.get(role.index()).map_or(0, |c| c.1).to_be_bytes();
    RGBColor(r, g, b)
}

/// A colour that stands for role and dash, to be replaced by a class when the drawing is done.
pub(super) fn sentinel(role: Role, dash: Dash) -> RGBColor {
    let pattern = PATTERNS.iter().position(|(d, _)| *d == dash).unwrap_or(0);
    RGBColor(role.index() as u8, pattern as u8, SEAL)
}

const SEAL: u8 = 0x5e;

/// Name of the colour and number of the pattern of a [`sentinel`] in the form `#RRGGBB`.
pub(super) fn unseal(hex: &str) -> Option<(&'static str, usize)> {
    let [_, index, pattern, seal] = u32::from_str_radix(hex.strip_prefix('#')?, 16).ok()?.to_be_bytes();
    let (name, ..) = COLOURS.get(usize::from(index))?;
    (seal == SEAL && usize::from(pattern) < PATTERNS.len()).then_some((*name, usize::from(pattern)))
}

/// What a page may want to find again in a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// a curve with its markers and bars
    Curve,
    /// its entry in the legend
    Key,
}

const CURVE_SEAL: u8 = 0x5f;
const KEY_SEAL: u8 = 0x60;

/// A colour that stands for the beginning of a part, to be replaced by a tag when the drawing is done.
pub(super) fn opening(part: Part, panel: usize, curve: usize) -> RGBColor {
    let seal = if part == Part::Key { KEY_SEAL } else { CURVE_SEAL };
    let narrow = |n: usize| u8::try_from(n).unwrap_or(u8::MAX);
    RGBColor(narrow(panel), narrow(curve), seal)
}

/// The same for its end.
pub(super) const CLOSING: RGBColor = RGBColor(0, 0, 0x61);

/// What an [`opening`] or [`CLOSING`] in the form `#RRGGBB` stands for: the part with panel and curve, or its end.
pub(super) fn bracket(hex: &str) -> Option<Option<(Part, (usize, usize))>> {
    let [_, panel, curve, seal] = u32::from_str_radix(hex.strip_prefix('#')?, 16).ok()?.to_be_bytes();
    let at = (usize::from(panel), usize::from(curve));
    match seal {
        CURVE_SEAL => Some(Some((Part::Curve, at))),
        KEY_SEAL => Some(Some((Part::Key, at))),
        seal if seal == CLOSING.2 => Some(None),
        _ => None,
    }
}

/// Name of the colour of a curve.
pub(super) fn series(colour: usize) -> &'static str {
    COLOURS.get(Role::Series(colour).index()).map_or("ink", |c| c.0)
}

/// Strokes and gaps of each dash, in units of the figure.
const PATTERNS: &[(Dash, &[f64])] = &[
    (Dash::Solid, &[]),
    (Dash::Dashed, &[6.5, 3.5]),
    (Dash::Dotted, &[1.6, 2.6]),
    (Dash::DashDotted, &[7.5, 2.6, 1.6, 2.6]),
];

/// Strokes and gaps of a dash; empty for an unbroken line.
pub(super) fn pattern(dash: Dash) -> &'static [f64] {
    PATTERNS.iter().find(|(d, _)| *d == dash).map_or(&[], |(_, p)| p)
}

/// CSS declarations of the variables: `--ink:#1c2024;...`.
pub(super) fn variables(dark: bool) -> String {
    COLOURS.iter().map(|(name, light, night)| format!("--{name}:#{:06x};", if dark { night } else { light })).collect()
}

/// Rules for the classes of an inline figure: colours by variable, with the light theme where nobody defines them.
pub(super) fn rules(scale: f64) -> String {
    let mut css = String::from(
        ".plot{display:block;font-family:\"Noto Sans\",\"Source Sans 3\",\"Segoe UI\",system-ui,sans-serif;font-variant-numeric:tabular-nums}\
         .plot [class^=s-]{fill:none;stroke-linejoin:round}",
    );
    for (name, light, _) in COLOURS {
        css += &format!(
            ".plot .s-{name}{{stroke:var(--{name},#{light:06x})}}.plot .f-{name}{{fill:var(--{name},#{light:06x})}}"
        );
    }
    for (i, (_, pattern)) in PATTERNS.iter().enumerate().skip(1) {
        let lengths: Vec<String> = pattern.iter().map(|p| format!("{:.0}", p * scale)).collect();
        css += &format!(".plot .d{i}{{stroke-dasharray:{}}}", lengths.join(" "));
    }
    css
}

/// Size of the text of labels and letters.
pub(super) const LABEL: f64 = 13.0;
/// Size of the text at ticks, in legends and at levels.
pub(super) const SMALL: f64 = 11.5;
/// Width of frames and ticks.
pub(super) const HAIR: f64 = 0.8;
/// Width of curves.
pub(super) const BOLD: f64 = 1.7;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentinel_is_recognised_and_nothing_else_is() {
        let RGBColor(r, g, b) = sentinel(Role::Series(2), Dash::Dotted);
        assert_eq!(unseal(&format!("#{r:02X}{g:02X}{b:02X}")), Some(("c2", 2)));
        assert_eq!(unseal("#FFFFFF"), None);
        assert_eq!(unseal("none"), None);
        assert_eq!(Role::Series(7).index(), Role::Series(0).index());
    }
}
