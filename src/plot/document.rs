//! A page of tables and figures that is not that of a run: the same style, the same escaping.

use super::answer::answer;
use super::report::{figures, pairs};
use super::shell::{foot, head, typeset};
use super::svg::escape;
use crate::result::Figure;

/// What a page shows, from top to bottom.
#[derive(Clone, Copy, Debug)]
pub struct Document<'a> {
    /// its heading
    pub title: &'a str,
    /// the line under it
    pub subtitle: &'a str,
    /// in order
    pub sections: &'a [Section<'a>],
}

/// One part of a page.
#[derive(Clone, Debug)]
pub enum Section<'a> {
    /// what was found, in a few lines: names and texts
    Answer(Vec<(String, String)>),
    /// a table
    Table {
        /// its heading
        heading: &'a str,
        /// a sentence before it; empty for none
        lead: String,
        /// heads of the columns
        head: Vec<String>,
        /// cells, as many in each row as there are heads
        rows: Vec<Vec<Cell>>,
    },
    /// what to doubt, one paragraph each; nothing is shown where there is none
    Warnings(Vec<String>),
    /// figures with their captions
    Figures(&'a [Figure]),
    /// titled lists of names and texts, side by side
    Facts(Vec<(&'a str, Vec<(String, String)>)>),
}

/// One cell of a table.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// words
    Text(String),
    /// a number with its unit, `3.310e-5 m²/s`, and all of its digits on hover
    Number {
        /// as it is shown
        shown: String,
        /// as it is known
        full: String,
    },
    /// nothing to show, and why
    Empty(&'static str),
}

/// The page as one self-contained HTML document. Everything that comes from a user is escaped; a figure that cannot be
/// drawn is replaced by the reason.
#[must_use]
pub fn document_html(page: &Document<'_>) -> String {
    let mut html = head(page.title, env!("CARGO_PKG_VERSION"));
    html +=
        &format!("<header><h1>{}</h1><p class=\"sub\">{}</p></header>\n", escape(page.title), escape(page.subtitle));
    for section in page.sections {
        html += &match section {
            Section::Table { heading, lead, head, rows } => table(heading, lead, head, rows),
            Section::Answer(lines) => answer(lines, false),
            Section::Warnings(texts) if texts.is_empty() => String::new(),
            Section::Warnings(texts) => {
                let texts: String = texts.iter().map(|t| format!("<p>{}</p>", escape(t))).collect();
                format!("<section class=\"alert warn\"><h2>To bear in mind</h2>{texts}</section>\n")
            }
            Section::Figures(drawn) => figures(drawn),
            Section::Facts(lists) => {
                let lists: String = lists.iter().map(|(title, rows)| pairs(title, rows)).collect();
                format!("<section class=\"origin\">{lists}</section>\n")
            }
        };
    }
    html + &foot()
}

/// Texts of fewer characters stay on one line.
const SHORT: usize = 32;

fn table(heading: &str, lead: &str, head: &[String], rows: &[Vec<Cell>]) -> String {
    let any = |i: usize, is: fn(&Cell) -> bool| rows.iter().filter_map(|row| row.get(i)).any(is);
    let numeric = |i| any(i, |cell| matches!(cell, Cell::Number { .. })) || !any(i, |c| matches!(c, Cell::Text(_)));
    let reported = |i| rows.is_empty() || any(i, |cell| !matches!(cell, Cell::Text(text) if text.is_empty()));
    let class = |i| if numeric(i) { " class=\"num\"" } else { "" };
    let named = head.iter().enumerate().filter(|(i, _)| reported(*i));
    let heads: String = named.map(|(i, name)| format!("<th{}>{}</th>", class(i), escape(name))).collect();
    let mut body = String::new();
    for row in rows {
        body += "<tr>";
        for (i, cell) in row.iter().enumerate().filter(|(i, _)| reported(*i)) {
            body += &match cell {
                Cell::Text(text) if !numeric(i) && text.chars().count() < SHORT => {
                    format!("<td class=\"short\">{}</td>", escape(text))
                }
                Cell::Text(text) => format!("<td{}>{}</td>", class(i), escape(text)),
                Cell::Number { shown, full } => {
                    format!("<td{} title=\"{}\">{}</td>", class(i), escape(full), typeset(shown))
                }
                Cell::Empty(why) => format!("<td{} title=\"{}\">–</td>", class(i), escape(why)),
            };
        }
        body += "</tr>\n";
    }
    let lead = if lead.is_empty() { String::new() } else { format!("<p class=\"sub\">{}</p>", escape(lead)) };
    format!(
        "<section><h2>{}</h2>{lead}<div class=\"wide\"><table><thead><tr>{heads}</tr></thead><tbody>\n{body}</tbody></table></div></section>\n",
        escape(heading)
    )
}

#[cfg(test)]
mod tests {
    use super::super::shell::tests::has_one_script;
    use super::*;

    #[test]
    fn numbers_are_typeset_with_all_digits_on_hover_and_users_are_escaped() {
        let hostile = "</title><script>alert(1)</script>";
        let rows = vec![vec![
            Cell::Text(hostile.into()),
            Cell::Number { shown: "-3.1e-5 m²/s".into(), full: "-3.14159e-5".into() },
            Cell::Empty("not reported"),
        ]];
        let sections = [
            Section::Table { heading: "Norms", lead: hostile.into(), head: vec![hostile.into(); 3], rows },
            Section::Warnings(vec![hostile.into()]),
            Section::Warnings(Vec::new()),
            Section::Facts(vec![("Origin", vec![("file".into(), hostile.into())])]),
        ];
        let html = document_html(&Document { title: hostile, subtitle: hostile, sections: &sections });
        has_one_script(&html);
        assert!(!html.contains("<script>alert") && html.starts_with("<!DOCTYPE html>") && html.ends_with("</html>\n"));
        assert!(html.contains("title=\"-3.14159e-5\">−3.1 × 10<sup>−5</sup>&nbsp;m²/s</td>"), "{html}");
        assert!(html.contains("<td class=\"num\" title=\"not reported\">–</td>"));
        assert_eq!(html.matches("class=\"alert warn\"").count(), 1);
    }

    #[test]
    fn a_column_that_says_nothing_is_left_out_and_short_texts_stay_on_one_line() {
        let row = |text: &str| vec![Cell::Text(String::new()), Cell::Text(text.into())];
        let html = table("t", "", &["series".into(), "what".into()], &[row("done"), row(&"long ".repeat(9))]);
        assert!(!html.contains("series") && html.contains("<td class=\"short\">done</td>"), "{html}");
        assert!(html.contains("<td>long long"));
    }
}
