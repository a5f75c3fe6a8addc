//! What every page begins and ends with: its style in light and dark, its one script, and the rule that nothing else runs.

use sha2::{Digest, Sha256};

use crate::result::base64;

use super::svg::escape;
use super::theme;

/// The script of every page: it makes figures answer to a pointer and plays animations. A page without it says the same.
const SCRIPT: &str = concat!(include_str!("animation.js"), include_str!("report.js"));

/// Everything before the content: title, style in light and dark. `version` of bedload made it.
pub(super) fn head(title: &str, version: &str) -> String {
    // A second line of defence after the escaping: the browser loads nothing and runs no other script than this one.
    let policy = format!(
        "default-src 'none'; style-src 'unsafe-inline'; script-src 'sha256-{}'",
        base64(Sha256::digest(SCRIPT.as_bytes()))
    );
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
         <meta name=\"color-scheme\" content=\"light dark\"><meta name=\"generator\" content=\"bedload {}\">\
         <title>{} · bedload</title>\n<style>:root{{{}}}\n@media(prefers-color-scheme:dark){{:root{{{}}}}}\n\
         @media print{{:root{{{}}}}}\n{}</style></head>\n<body><main>\n",
        escape(version),
        escape(title),
        theme::variables(false),
        theme::variables(true),
        theme::variables(false),
        include_str!("report.css"),
    )
}

/// Everything after the content.
pub(super) fn foot() -> String {
    format!("</main>\n<script>{SCRIPT}</script></body></html>\n")
}

/// `3.310e-5 m²/s` as it is printed: 3.310 × 10 to the −5.
pub(super) fn typeset(number: &str) -> String {
    let (mantissa, unit) = number.split_once(' ').unwrap_or((number, ""));
    let minus = |text: &str| escape(text).replace('-', "−");
    let figures = match mantissa.split_once('e') {
        Some((digits, power)) => format!("{} × 10<sup>{}</sup>", minus(digits), minus(power)),
        None => minus(mantissa),
    };
    if unit.is_empty() { figures } else { format!("{figures}&nbsp;{}", escape(unit)) }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The only script of a page is ours.
    #[track_caller]
    pub fn has_one_script(html: &str) {
        assert_eq!((html.matches("<script").count(), html.matches("</script").count()), (1, 1));
        assert!(html.contains(&foot()));
    }

    #[test]
    fn the_script_is_whole_and_loads_nothing() {
        has_one_script(&(head("t", "v") + &foot()));
        for word in ["http", "import", "fetch", "eval", "innerHTML", "<!--"] {
            assert!(!SCRIPT.contains(word), "{word}");
        }
    }
}
