//! What a page says first: its answer in a few lines.

use super::shell::typeset;
use super::svg::escape;

/// What is known, in a few lines: names and texts. `symbols` are typeset: those of a run, where a study writes its keys.
pub(super) fn answer(lines: &[(String, String)], symbols: bool) -> String {
    let word = |word: &str| {
        let (core, rest) = word.split_at(word.trim_end_matches([',', ';', ':', '.', ')']).len());
        match word {
            _ if core.parse::<f64>().is_ok() => typeset(core) + &escape(rest),
            _ if symbols && word.contains('_') => subscripts(word),
            _ => escape(word),
        }
    };
    let part = |part: &str| part.split(' ').map(word).collect::<Vec<_>>().join(" ");
    let mut items = String::new();
    for (name, text) in lines {
        let parts: Vec<String> = text.split("  ").map(str::trim).filter(|p| !p.is_empty()).map(part).collect();
        items += &format!("<dt>{}</dt><dd>{}</dd>", escape(name), parts.join(" &emsp;"));
    }
    if items.is_empty() {
        items
    } else {
        format!("<section class=\"answer\" id=\"answer\"><dl>{items}</dl></section>\n")
    }
}

/// `u_max` with its index below the line.
pub(super) fn subscripts(symbol: &str) -> String {
    let (mut html, mut below) = (String::new(), false);
    for c in symbol.chars() {
        if below && !(c.is_alphanumeric() || c == '*') {
            html.push_str("</sub>");
            below = false;
        }
        if c == '_' {
            html.push_str("<sub>");
            below = true;
        } else {
            html.push_str(&escape(&if c == '-' { '−' } else { c }.to_string()));
        }
    }
    html + if below { "</sub>" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_symbols_of_an_answer_are_typeset() {
        let text = "Q 9.809e-6 m³/s   Q_p 2 m²/s".to_owned();
        assert!(
            answer(&[("rate".into(), text)], true)
                .contains("<dt>rate</dt><dd>Q 9.809 × 10<sup>−6</sup> m³/s &emsp;Q<sub>p</sub> 2 m²/s</dd>")
        );
        assert_eq!(subscripts("q_p/φ"), "q<sub>p</sub>/φ");
        assert_eq!(subscripts("u_*"), "u<sub>*</sub>");
        assert_eq!(subscripts("U - u_p"), "U − u<sub>p</sub>");
        assert_eq!(subscripts("z(u_max)"), "z(u<sub>max</sub>)");
    }
}
