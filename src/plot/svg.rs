//! A figure as inline SVG: plotters draws it large on its integer grid, classes replace the colours, so that the page
//! that shows it decides about light and dark.

use std::fmt::Write as _;

use plotters::prelude::{IntoDrawingArea, SVGBackend};

use super::canvas::{LINE_HEIGHT, Medium, width};
use super::draw::draw;
use super::layout::Layout;
use super::{PlotError, live, theme};
use crate::result::Figure;

/// Grid steps per unit of the figure.
pub(super) const GRID: f64 = 10.0;

/// Smallest and largest magnification: text between 8 and 15 pixels.
const SMALLEST: f64 = 0.72;
const LARGEST: f64 = 1.15;

/// Size over which plotters divides the size of a font when it writes it to SVG.
const PLOTTERS_SIZE_OVER_EM: f64 = 1.24;

/// Draws `figure` as an `<svg>` element without a fixed width. Its colours are the CSS variables `--ink`, `--faint`,
/// `--tint`, `--paper` and `--c0` to `--c6`, and those of a light theme where a page does not define them.
///
/// # Errors
/// [`PlotError::Font`] or [`PlotError::Drawing`], neither of which depends on the data.
pub fn svg(figure: &Figure) -> Result<String, PlotError> {
    let layout = Layout::new(figure)?;
    let medium = Medium { scale: GRID, ascent: 0.0, dashes_later: true, paint: theme::sentinel };
    let size = ((layout.size.0 * GRID).ceil() as u32, (layout.size.1 * GRID).ceil() as u32);
    let mut raw = String::new();
    {
        let area = SVGBackend::with_string(&mut raw, size).into_drawing_area();
        draw(&area, medium, figure, &layout)?;
        area.present().map_err(PlotError::drawing)?;
    }
    let mut out = format!(
        "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" style=\"min-width:{:.0}px;max-width:{:.0}px\" \
         role=\"img\" font-size=\"{:.0}\"><title>{}</title><style>{}</style>\n{}",
        size.0,
        size.1,
        layout.size.0 * SMALLEST,
        layout.size.0 * LARGEST,
        theme::SMALL * GRID,
        escape(&figure.caption),
        theme::rules(GRID),
        live::panes(figure, &layout),
    );
    let body = raw.split_once('>').map_or("", |(_, body)| body);
    let mut parts = body.split_inclusive('>').peekable();
    while let Some(part) = parts.next() {
        // text stands before a tag; there it is escaped already
        let (text, tag) = part.split_once('<').unwrap_or((part, ""));
        out.push_str(text.trim_matches('\n'));
        if !tag.is_empty() {
            match bracket(tag) {
                Some(Some((part, at))) => out += &live::open(part, at, figure, &layout),
                Some(None) => out += "</g>\n",
                None => {
                    let words = parts.peek().and_then(|next| next.split('<').next()).unwrap_or_default();
                    restyle(tag, words.trim_matches('\n'), &mut out);
                }
            }
        }
    }
    Ok(match out.rfind("</svg>") {
        Some(end) => format!("{}{}{}", &out[..end], notes(figure, &layout), &out[end..]),
        None => out,
    })
}

/// What a reader sees who points at a point, over the drawing.
fn notes(figure: &Figure, layout: &Layout) -> String {
    let mut out = String::new();
    for (panel, frame) in figure.panels.iter().zip(&layout.frames) {
        for curve in &panel.curves {
            for (point, note) in curve.points.iter().zip(&curve.notes) {
                let Some((x, y)) = point.filter(|&(x, y)| panel.x.holds(x) && figure.y.holds(y)) else { continue };
                let _ = writeln!(
                    out,
                    "<circle class=\"hit\" cx=\"{:.0}\" cy=\"{:.0}\" r=\"{:.0}\" fill=\"transparent\"><title>{}</title></circle>",
                    GRID * frame.x.at(x),
                    GRID * layout.y.at(y),
                    6.0 * GRID,
                    escape(note)
                );
            }
        }
    }
    out
}

/// Whether a tag, given without its `<`, stands for the beginning of a part or, within, for its end.
fn bracket(tag: &str) -> Option<Option<(theme::Part, (usize, usize))>> {
    let (_, fill) = tag.strip_prefix("rect ")?.split_once("fill=\"")?;
    theme::bracket(fill.split_once('"')?.0)
}

/// A text of fewer characters keeps about its width in any font.
const SHORT: usize = 5;

/// Writes a tag, given without its `<`, with classes for sentinel colours and without what the classes imply. A longer text, `words`, gets
/// the width for which room was made, whatever font a browser puts in place of ours.
fn restyle(tag: &str, words: &str, out: &mut String) {
    let closed = tag.trim_end_matches('>');
    let (head, end) = closed.strip_suffix('/').map_or((closed, ">"), |head| (head, "/>\n"));
    let (name, mut rest) = head.split_once(' ').unwrap_or((head, ""));
    out.push('<');
    out.push_str(name);
    while let Some((key, value, after)) = attribute(rest) {
        rest = after;
        let written = match (key, theme::unseal(value)) {
            ("stroke", Some((colour, 0))) => write!(out, " class=\"s-{colour}\""),
            ("stroke", Some((colour, dash))) => write!(out, " class=\"s-{colour} d{dash}\""),
            ("fill", Some((colour, _))) => write!(out, " class=\"f-{colour}\""),
            ("fill" | "stroke", None) | ("opacity" | "font-family" | "dy", _) => Ok(()),
            ("text-anchor", _) if value == "start" => Ok(()),
            ("font-size", _) => {
                let em = value.parse::<f64>().unwrap_or(0.0) * PLOTTERS_SIZE_OVER_EM / LINE_HEIGHT;
                let words = unescaped(words);
                let long = (name == "text" && words.chars().count() > SHORT).then(|| width(&words, em).ok()).flatten();
                let usual = (em - theme::SMALL * GRID).abs() < 0.5;
                let size = if usual { Ok(()) } else { write!(out, " font-size=\"{em:.0}\"") };
                let fixed = |width: f64| write!(out, " textLength=\"{width:.0}\" lengthAdjust=\"spacingAndGlyphs\"");
                size.and_then(|()| long.map_or(Ok(()), fixed))
            }
            _ => write!(out, " {key}=\"{}\"", value.trim_end()),
        };
        debug_assert!(written.is_ok(), "writing to a string does not fail");
    }
    out.push_str(if name.starts_with('/') { ">\n" } else { end });
}

/// The first attribute of ` key="value" ...`, and what follows it.
fn attribute(text: &str) -> Option<(&str, &str, &str)> {
    let (key, rest) = text.split_once("=\"")?;
    let (value, rest) = rest.split_once('"')?;
    Some((key.trim(), value, rest))
}

/// A text as it was before plotters wrote it.
fn unescaped(text: &str) -> String {
    let signs = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    signs.iter().fold(text.to_owned(), |text, (written, sign)| text.replace(written, sign))
}

/// Text for HTML and SVG, in elements and in attributes.
pub(super) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // not allowed in XML, and of no meaning here
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::{profile_figures, samples};
    use super::*;
    use crate::result::{Axis, Curve, Dash, Level, Marker, Panel, Scale};

    fn sound(drawing: &str) {
        for word in ["NaN", "inf", "-2147483648", "2147483647", "5E\"", "<script"] {
            assert!(!drawing.contains(word), "{word} in {drawing}");
        }
        assert_eq!(drawing.matches("<text").count(), drawing.matches("</text>").count());
        assert!(drawing.starts_with("<svg") && drawing.trim_end().ends_with("</svg>"));
    }

    #[test]
    fn a_figure_is_small_scales_with_its_page_and_takes_its_colours() {
        let (profile, summary) = samples::laminar_bed();
        let drawing = svg(&profile_figures(&profile, &summary)[0]).unwrap();
        sound(&drawing);
        assert!(drawing.len() < 30_000, "{}", drawing.len());
        assert!(!drawing.contains(" width=\"7600\"") && drawing.contains("viewBox=\"0 0 7600 "));
        assert!(drawing.contains("role=\"img\"") && drawing.contains("class=\"s-c2 d1\""));
        assert!(drawing.contains(">velocity (mm/s)</text>") && drawing.contains(">bed level</text>"));
        assert!(drawing.contains("<title>bed_ouriemi-laminar-exact: (a) velocity"));
    }

    #[test]
    fn a_text_is_as_wide_as_its_room_in_any_font() {
        let mut figure = samples::convergence();
        figure.panels[0].curves[1].name = "Müller & Söhne <1948>".into();
        let drawing = svg(&figure).unwrap();
        let tag = drawing.split("<text").find(|tag| tag.contains(">Müller &amp; Söhne &lt;1948&gt;<")).unwrap();
        let given: f64 = tag.split_once("textLength=\"").unwrap().1.split('"').next().unwrap().parse().unwrap();
        let room = width("Müller & Söhne <1948>", theme::SMALL * GRID).unwrap();
        assert!((given / room - 1.0).abs() < 0.01, "{given} {room}");
        // Numbers at ticks are short.
        assert!(drawing.contains(">100</text>") && drawing.matches("textLength").count() < 8);
    }

    #[test]
    fn gaps_break_lines() {
        let (profile, summary) = samples::laminar_bed();
        let mut figure = profile_figures(&profile, &summary)[0].clone();
        let curves = |figure: &Figure| svg(figure).unwrap().matches("class=\"s-c0\"").count();
        let before = curves(&figure);
        figure.panels[0].curves[0].points[50] = None;
        figure.panels[0].curves[0].points[120] = Some((f64::NAN, 1.0));
        assert_eq!(curves(&figure), before + 2);
    }

    #[test]
    fn notes_are_what_a_reader_sees_who_points() {
        let mut figure = samples::convergence();
        let curve = &mut figure.panels[0].curves[0];
        curve.notes = vec!["24 cells: <1 %".into(); curve.points.len()];
        curve.marker = Some(Marker::Cross);
        let drawing = svg(&figure).unwrap();
        sound(&drawing);
        let drawn = figure.panels[0].curves[0].points.iter().flatten().count();
        assert_eq!(drawing.matches("<title>24 cells: &lt;1 %</title>").count(), drawn);
    }

    #[test]
    fn labels_of_users_stay_text() {
        let mut figure = samples::convergence();
        figure.caption = "</title><script>".into();
        figure.levels = vec![Level { y: 1e-3, label: "<script>\"&'".into() }];
        figure.panels[0].x.title = "<b class=\"#00005E\">".into();
        let drawing = svg(&figure).unwrap();
        assert!(!drawing.contains("<script") && !drawing.contains("<b "));
        assert!(drawing.contains("&lt;script&gt;&quot;&amp;&apos;</text>"));
    }

    #[test]
    fn whatever_the_numbers_there_is_a_figure() {
        let series: [&[(f64, f64)]; 7] = [
            &[],
            &[(1.0, 1.0)],
            &[(0.0, 0.0), (0.0, 0.0)],
            &[(1e-300, 1e-310), (2e-300, 5e-324)],
            &[(1e308, -1e308), (-1e308, 1e308)],
            &[(f64::NAN, 1.0), (1.0, f64::INFINITY)],
            &[(1e279, -1e279), (-1e279, 1e279), (0.0, 1.0)],
        ];
        for points in series {
            for scale in [Scale::Linear, Scale::Log] {
                let curve = Curve {
                    name: "curve".into(),
                    points: points.iter().copied().map(Some).collect(),
                    colour: 9,
                    line: Some(Dash::DashDotted),
                    marker: Some(Marker::Square),
                    errors: vec![Some(0.5), None, Some(f64::NAN)],
                    notes: vec!["note".into(); 3],
                    ..Curve::default()
                };
                let axis = Axis { scale, ..Axis::linear("x", "m") };
                let panel = Panel { x: axis.clone(), curves: vec![curve] };
                let mut figure = samples::convergence();
                figure.y = axis;
                figure.panels = vec![panel.clone(), panel];
                sound(&svg(&figure).unwrap());
                figure.panels.clear();
                sound(&svg(&figure).unwrap());
            }
        }
    }
}
