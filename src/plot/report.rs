//! The page of a run: the answer first, then its first figure, the numbers, what to doubt, the other figures, the equations and the origin. One file, no
//! network, nothing that needs its script; light and dark as the reader has it.

use std::fmt::Write as _;

use crate::result::Verdict;
use crate::result::quantity::{self, RESULTS};
use crate::result::{Animation, Reported, Statement, Status, Summary};
use crate::units::{CommonUnits, readable, significant};

use super::animation::animation_html;
use super::answer::{answer, subscripts};
use super::shell::{foot, head, typeset};
use super::stated::{flow, statement};
use super::svg::{escape, svg};
use crate::result::Figure;

/// What the page shows.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    /// numbers, balances, warnings, cost, provenance
    pub summary: &'a Summary,
    /// in order
    pub figures: &'a [Figure],
    /// a drawing as SVG with its caption, if there is one
    pub drawing: Option<(&'a str, &'a str)>,
    /// the animation of its grains, which takes the place of the drawing where it can be played
    pub animation: Option<&'a Animation>,
    /// the equations solved, and the laws in them
    pub statement: &'a Statement,
    /// the resolved case
    pub case_toml: &'a str,
    /// remarks, one paragraph each
    pub notes: &'a [String],
}

/// The page as one self-contained HTML document. Everything that comes from a user is escaped; a figure that cannot
/// be drawn is replaced by the reason.
#[must_use]
pub fn report_html(page: &Page<'_>) -> String {
    let summary = page.summary;
    let case = escape(&summary.case);
    let mut html = head(&summary.case, &summary.provenance.bedload);
    let (word, class) = match summary.status {
        Status::Done => ("done", "good"),
        Status::Running => ("running", "warn"),
        Status::Failed => ("failed", "bad"),
        Status::Stopped => ("stopped by the user", "warn"),
    };
    let doubts = match summary.validity.len() {
        0 => String::new(),
        1 => " <a class=\"badge warn\" href=\"#validity\">1 closure outside its range</a>".to_owned(),
        n => format!(" <a class=\"badge warn\" href=\"#validity\">{n} closures outside their range</a>"),
    };
    html += &format!(
        "<header><h1>{case}</h1><p class=\"sub\">{} <span class=\"badge {class}\">{word}</span>{doubts}</p></header>\n",
        escape(&summary.model)
    );
    html += &error(summary, !page.figures.is_empty());
    html += &regime(summary);
    html += &answer(&summary.answer(), true);
    let (first, others) = page.figures.split_at(page.figures.len().min(1));
    html += &figures(first);
    html += &results(summary);
    html += &balances(summary);
    html += &validity(summary);
    html += &page.animation.map(animation_html).unwrap_or_default();
    if let Some((drawing, caption)) = page.drawing {
        html += &format!(
            "<figure id=\"drawing\"><div class=\"wide\">{drawing}</div><figcaption>{}</figcaption></figure>\n",
            escape(caption)
        );
    }
    html += &figures(others);
    for note in page.notes {
        html += &format!("<p class=\"note\">{}</p>\n", escape(note));
    }
    html += &summary.scene.as_ref().map(flow).unwrap_or_default();
    html += &statement(page.statement);
    html += &origin(summary);
    html += &format!(
        "<details><summary>Resolved case, every default filled in</summary><pre>{}</pre></details>\n",
        escape(page.case_toml.trim_end())
    );
    html + &foot()
}

/// What went wrong, before everything else, and whether a state was drawn nevertheless.
fn error(summary: &Summary, drawn: bool) -> String {
    let Some(error) = &summary.error else { return String::new() };
    let mut html = format!(
        "<section class=\"alert bad\" role=\"alert\"><h2><code>{}</code></h2><p>{}</p>",
        escape(&error.code),
        escape(&error.message)
    );
    let line = error.line.map(|line| format!("line {line}"));
    let place = [error.path.clone(), line].into_iter().flatten().collect::<Vec<_>>().join(", ");
    for (name, text) in [("Where", Some(&place)), ("Allowed", error.allowed.as_ref()), ("Hint", error.hint.as_ref())] {
        if let Some(text) = text.filter(|t| !t.is_empty()) {
            html += &format!("<p><b>{name}:</b> {}</p>", escape(text));
        }
    }
    if drawn {
        html += "<p>What follows is the last good state.</p>";
    }
    html + "</section>\n"
}

/// What the model takes for granted and this flow does not give it; nothing where every premise holds.
fn regime(summary: &Summary) -> String {
    let broken = summary.premises(Verdict::Broken).count();
    if broken + summary.premises(Verdict::Doubtful).count() == 0 {
        return String::new();
    }
    let (class, title) = if broken > 0 {
        ("bad", "A premise of the model is broken")
    } else {
        ("warn", "A premise of the model is doubtful")
    };
    let mut html = format!(
        "<section class=\"alert {class}\" id=\"regime\"><h2>{title}</h2><div class=\"wide\"><table><thead><tr>\
         <th>premise</th><th>number</th><th class=\"num\">value</th><th>range</th><th>source</th></tr></thead><tbody>"
    );
    for verdict in [Verdict::Broken, Verdict::Doubtful] {
        for premise in summary.premises(verdict) {
            let why = if verdict == Verdict::Broken { format!("broken: {}", premise.why) } else { "doubtful".into() };
            html += &format!(
                "<tr><td>{}, <b>{}</b></td><td>{}</td><td class=\"num\">{}</td><td>{}</td><td>{}</td></tr>",
                escape(&premise.premise),
                escape(&why),
                escape(&premise.number),
                typeset(&significant(premise.value, 3)),
                escape(&premise.range),
                escape(&premise.source),
            );
        }
    }
    html + "</tbody></table></div></section>\n"
}

/// Closures outside their range.
fn validity(summary: &Summary) -> String {
    if summary.validity.is_empty() {
        return String::new();
    }
    let mut html = String::from(
        "<section class=\"alert warn\" id=\"validity\"><h2>Used outside the published range</h2><div class=\"wide\"><table><thead><tr>\
         <th>closure</th><th>variable</th><th class=\"num\">furthest value</th><th>range</th><th class=\"num\">at z</th>\
         </tr></thead><tbody>",
    );
    for v in &summary.validity {
        html += &format!(
            "<tr><td><code>{}</code></td><td>{}</td><td class=\"num\">{}</td><td>{}</td><td class=\"num\">{}</td></tr>",
            escape(&v.closure),
            escape(&v.variable),
            typeset(&significant(v.value, 4)),
            escape(&v.range),
            v.z_m.map_or_else(|| "–".into(), |z| typeset(&readable(z, "m"))),
        );
    }
    html + "</tbody></table></div></section>\n"
}

/// The named numbers, each in a readable unit, with all its digits on hover.
fn results(summary: &Summary) -> String {
    let mut rows = String::new();
    let sizes = |(name, reported): (&str, &Reported)| Some((reported.value?, quantity::find(RESULTS, name)?.unit));
    let units = CommonUnits::of(summary.results.iter().filter_map(sizes));
    for (name, reported) in summary.results.iter() {
        let known = quantity::find(RESULTS, name);
        let (title, symbol) = known.map_or((name, ""), |q| (q.title, q.symbol));
        let unit = known.map_or("1", |q| q.unit);
        rows += &format!(
            "<tr><th scope=\"row\" title=\"{}\">{}</th><td class=\"symbol\">{}</td><td class=\"num\" title=\"{}\">{}</td></tr>\n",
            escape(known.map_or("", |q| q.definition)),
            escape(title),
            subscripts(symbol),
            escape(&full(name, reported)),
            value(reported, unit, &units),
        );
    }
    if rows.is_empty() {
        return String::new();
    }
    format!("<section><h2>Results</h2><table class=\"results\"><tbody>\n{rows}</tbody></table></section>\n")
}

fn value(reported: &Reported, unit: &'static str, units: &CommonUnits) -> String {
    let Some(value) = reported.value else {
        return format!("<span class=\"none\">– {}</span>", escape(reported.reason.as_deref().unwrap_or("undefined")));
    };
    typeset(&match reported.stderr {
        Some(error) => units.readable_mean(value, error, unit),
        None if unit == "1" && is_count(value) => format!("{value}"),
        None => units.readable(value, unit),
    }) + &match &reported.reason {
        Some(reason) => format!(" <span class=\"none\">error unknown: {}</span>", escape(reason)),
        None => String::new(),
    }
}

/// Whether a number is whole, as those of grains and iterations are: it has no digits after the point to show.
fn is_count(x: f64) -> bool {
    x.fract() == 0.0 && (1.0..1e15).contains(&x)
}

/// `u_max_m_s = 0.31234567`.
fn full(name: &str, reported: &Reported) -> String {
    let mut text = format!("{name} = {}", reported.value.map_or_else(|| "null".into(), |v| format!("{v:?}")));
    if let Some(error) = reported.stderr {
        let written = write!(text, " ± {error:?}");
        debug_assert!(written.is_ok(), "writing to a string does not fail");
    }
    text
}

fn balances(summary: &Summary) -> String {
    if summary.balances.is_empty() {
        return String::new();
    }
    let mut html = String::from(
        "<section><h2>Balances</h2><div class=\"wide\"><table><thead><tr><th>of</th><th class=\"num\">relative residual</th>\
         <th>how</th></tr></thead><tbody>",
    );
    for b in &summary.balances {
        html += &format!(
            "<tr><td>{}</td><td class=\"num\" title=\"{:?}\">{}</td><td>{}</td></tr>",
            escape(&b.name.replace('_', " ")),
            b.relative,
            typeset(&significant(b.relative, 2)),
            escape(&b.how)
        );
    }
    html + "</tbody></table></div></section>\n"
}

pub(super) fn figures(figures: &[Figure]) -> String {
    let mut html = String::new();
    for figure in figures {
        let drawing = svg(figure).unwrap_or_else(|error| format!("<p>{}</p>", escape(&error.to_string())));
        html += &format!(
            "<figure id=\"{}\"><div class=\"wide\">{drawing}</div><figcaption>{}</figcaption></figure>\n",
            escape(&figure.stem),
            escape(&figure.caption)
        );
    }
    html
}

/// Small numbers, cost and provenance.
fn origin(summary: &Summary) -> String {
    let mut regularisation: Vec<(String, String)> = Vec::new();
    for (name, value) in &summary.regularisation {
        regularisation.push((name.clone(), value.as_str().map_or_else(|| value.to_string(), str::to_owned)));
    }
    let cost = &summary.cost;
    let mut costs = vec![
        ("solver".to_owned(), duration(cost.solve_s)),
        ("everything".to_owned(), duration(cost.total_s)),
        ("units of work".to_owned(), cost.work_units.to_string()),
    ];
    if let Some(memory) = cost.peak_memory_mb {
        costs.push(("peak memory".to_owned(), format!("{memory:.1} MB")));
    }
    let p = &summary.provenance;
    let facts = [
        ("bedload", format!("{} ({})", p.bedload, p.commit)),
        ("compiler", p.rustc.clone()),
        ("target", p.target.clone()),
        ("case", p.source.clone()),
        ("set", p.overrides.join("  ")),
        ("SHA-256 of the case", p.case_sha256.clone()),
        ("of its scene", p.scene_sha256.clone()),
        ("of its model", p.model_sha256.clone()),
        ("started", p.started_utc.clone()),
        ("threads", p.threads.to_string()),
    ];
    let facts: Vec<(String, String)> = facts.into_iter().map(|(k, v)| (k.to_owned(), v)).collect();
    let columns =
        [("Regularisation", regularisation), ("Cost", costs), ("Provenance", facts)].map(|(t, rows)| pairs(t, &rows));
    format!("<section class=\"origin\">{}</section>\n", columns.concat())
}

/// A titled list of names and texts; texts that are empty are left out.
pub(super) fn pairs(title: &str, rows: &[(String, String)]) -> String {
    let mut items = String::new();
    for (name, text) in rows.iter().filter(|(_, text)| !text.is_empty()) {
        items += &format!("<dt>{}</dt><dd>{}</dd>", escape(name), escape(text));
    }
    if items.is_empty() { items } else { format!("<div><h2>{title}</h2><dl>{items}</dl></div>") }
}

/// `2.1 ms`.
fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 1.0 => format!("{:.1} ms", s * 1e3),
        s if s < 120.0 => format!("{s:.1} s"),
        s => format!("{:.1} min", s / 60.0),
    }
}

#[cfg(test)]
mod tests {
    use super::super::shell::tests::has_one_script;
    use super::super::{profile_figures, samples};
    use super::*;
    use crate::result::StatedLaw;

    #[test]
    fn numbers_and_symbols_are_typeset() {
        assert_eq!(typeset("3.310e-5 kg/(m s)"), "3.310 × 10<sup>−5</sup>&nbsp;kg/(m s)");
        assert_eq!(typeset("-0.25"), "−0.25");
        assert_eq!(duration(2.1e-4), "210 µs");
        let shown = [730.0, 0.0, 0.5]
            .map(|x| value(&Reported { value: Some(x), stderr: None, reason: None }, "1", &CommonUnits::default()));
        assert_eq!(shown, ["730", "0", "0.5000"].map(str::to_owned));
    }

    #[test]
    fn the_page_says_the_answer_first_then_a_figure_then_the_tables_and_every_digit_on_hover() {
        let (profile, summary) = samples::laminar_bed();
        let figures = profile_figures(&profile, &summary);
        let toml = "format = 1";
        let html = report_html(&Page {
            summary: &summary,
            figures: &figures,
            drawing: None,
            animation: None,
            statement: &Statement { equations: "τ = η du/dz".into(), laws: Vec::new() },
            case_toml: toml,
            notes: &[],
        });
        let order = [
            "<h1>",
            "1 closure outside",
            "id=\"answer\"",
            "<dt>transport rate</dt>",
            "<figure",
            "<h2>Results",
            "<h2>Balances",
            "Used outside",
            "Equations solved",
            "<h2>Cost",
            "<details",
        ];
        let places: Vec<usize> = order.iter().map(|text| html.find(text).unwrap()).collect();
        assert!(places.is_sorted(), "{places:?}");
        assert!(html.find("<table").unwrap() > html.find("</figure>").unwrap(), "a table before the first figure");
        assert!(html.contains("transport_rate_m2_s = 3.3103e-5") && html.contains("33.10&nbsp;mm²/s"));
        assert!(html.contains("the phases move together"));
        assert_eq!(html.matches("http://").count(), html.matches("http://www.w3.org/2000/svg").count());
        assert!(!html.contains("https:"));
    }

    #[test]
    fn nothing_from_a_user_becomes_markup() {
        let summary = samples::hostile_failure();
        let figures = profile_figures(&samples::laminar_bed().0, &summary);
        let hostile = "</pre><script>alert(1)</script>";
        let law = StatedLaw { equation: hostile.into(), source: hostile.into(), ..StatedLaw::default() };
        let html = report_html(&Page {
            summary: &summary,
            figures: &figures,
            drawing: None,
            animation: None,
            statement: &Statement { equations: hostile.into(), laws: vec![law] },
            case_toml: hostile,
            notes: &[hostile.into()],
        });
        has_one_script(&html);
        assert!(!html.contains("<script>alert") && !html.contains("<img"));
        assert!(html.contains("&lt;script&gt;"));
        let alert = html.find("no-static-bed").unwrap();
        assert!(alert < html.find("<h2>Results").unwrap());
        assert!(html.contains("lower the drive, or raise mu_s or phi") && html.contains("badge bad"));
    }
}
