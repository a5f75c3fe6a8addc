//! What a page says of the flow and of the equations, besides numbers.

use super::shell::typeset;
use super::svg::escape;
use crate::result::{SceneRecord, Statement};
use crate::units::significant;

/// What the flow alone fixes.
pub(super) fn flow(scene: &SceneRecord) -> String {
    if scene.numbers.is_empty() {
        return String::new();
    }
    let mut html = String::from(
        "<section id=\"flow\"><h2>Numbers of the flow</h2><div class=\"wide\"><table><thead><tr><th>number, in SI</th>\
         <th class=\"num\">value</th><th>what it is</th></tr></thead><tbody>",
    );
    for (name, number) in &scene.numbers {
        let value = number["value"].as_f64().unwrap_or(f64::NAN);
        html += &format!(
            "<tr><td><code>{}</code></td><td class=\"num\" title=\"{value:?}\">{}</td><td>{}</td></tr>",
            escape(name),
            typeset(&significant(value, 4)),
            escape(number["definition"].as_str().unwrap_or_default()),
        );
    }
    html + "</tbody></table></div></section>\n"
}

/// Equations and laws.
pub(super) fn statement(statement: &Statement) -> String {
    let mut html = String::new();
    if !statement.equations.trim().is_empty() {
        html += &format!(
            "<section><h2>Equations solved</h2><pre class=\"equations\">{}</pre></section>\n",
            escape(statement.equations.trim_end())
        );
    }
    if !statement.laws.is_empty() {
        html += "<section><h2>Laws</h2><div class=\"wide\"><table><thead><tr><th>law</th><th>equation</th><th>given for</th>\
                 <th>source</th></tr></thead><tbody>";
        for law in &statement.laws {
            html += &format!(
                "<tr><td><code>{}/{}</code></td><td>{}</td><td>{}</td><td>{}</td></tr>",
                escape(&law.family),
                escape(&law.law),
                escape(&law.equation),
                escape(&law.ranges.join("; ")),
                escape(&law.source)
            );
        }
        html += "</tbody></table></div></section>\n";
    }
    html
}
