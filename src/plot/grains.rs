//! A side view of grains, coloured by their velocity.

use std::fmt::Write;

use crate::result::{Animation, SideView};
use crate::units::readable;

/// Colours from slow to fast; all tell apart from light and dark pages, and without colour by their lightness.
const COLOURS: [[f64; 3]; 4] = [[68.0, 58.0, 120.0], [49.0, 122.0, 142.0], [94.0, 190.0, 112.0], [240.0, 210.0, 50.0]];
/// Width of the drawing \[px].
const WIDTH: f64 = 720.0;

/// The drawing; none if there is nothing to draw.
#[must_use]
pub fn grains_svg(view: &SideView) -> Option<String> {
    let mut rows: Vec<[f64; 4]> = view.grains.iter().copied().filter(|row| row.iter().all(|v| v.is_finite())).collect();
    let span = |rows: &[[f64; 4]], of: &dyn Fn(&[f64; 4]) -> [f64; 2]| {
        rows.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), [low, high]| (a.min(low), b.max(high)))
    };
    let (left, whole) = span(&rows, &|g| [g[0] - g[2], g[0] + g[2]]);
    let (bottom, top) = span(&rows, &|g| [g[1] - g[2], g[1] + g[2]]);
    if !(whole > left && top > bottom) {
        return None;
    }
    rows.retain(|g| g[0] + g[2] <= left + Animation::LONGEST * (top - bottom));
    let (_, right) = span(&rows, &|g| [g[0] - g[2], g[0] + g[2]]);
    let (slow, fast) = span(&rows, &|g| [g[3], g[3]]);
    let part = if right < whole {
        format!(", the first {} of {}", readable(right - left, "m"), readable(whole - left, "m"))
    } else {
        String::new()
    };
    let scale = WIDTH / (right - left).max(top - bottom);
    let (width, height) = (scale * (right - left), scale * (top - bottom));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.1} {:.1}\" role=\"img\" \
         aria-label=\"side view of {} grains{part}, velocity from {} to {}\">\n",
        height + 30.0,
        rows.len(),
        readable(slow, "m/s"),
        readable(fast, "m/s")
    );
    for [x, z, r, u] in &rows {
        let share = if fast > slow { (u - slow) / (fast - slow) } else { 0.0 };
        let _ = writeln!(
            svg,
            "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{:.2}\" fill=\"{}\" stroke=\"#000\" stroke-opacity=\"0.35\"/>",
            scale * (x - left),
            scale * (top - z),
            scale * r,
            colour(share)
        );
    }
    svg += &scale_bar(width, height, (slow, fast), &part);
    Some(svg + "</svg>")
}

/// The colours from slow to fast under a drawing, with the two velocities [m/s] and what else there is to say.
pub(super) fn scale_bar(width: f64, height: f64, (slow, fast): (f64, f64), note: &str) -> String {
    let mut svg = String::new();
    for step in 0..60 {
        let at = 0.3 * width * f64::from(step) / 60.0;
        let _ = writeln!(
            svg,
            "<rect x=\"{at:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"8\" fill=\"{}\"/>",
            height + 8.0,
            0.3 * width / 60.0 + 0.5,
            colour(f64::from(step) / 59.0)
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"13\" fill=\"currentColor\">velocity {} to {}{note}</text>",
        0.3 * width + 8.0,
        height + 17.0,
        readable(slow, "m/s"),
        readable(fast, "m/s")
    );
    svg
}

/// The colours from slow to fast, for the script that plays an animation.
pub(super) fn colours() -> String {
    let last = COLOURS.len() - 1;
    (0..=last).map(|i| colour(i as f64 / last as f64)).collect::<Vec<_>>().join(" ")
}

/// Colour of a share of the largest velocity.
pub(super) fn colour(share: f64) -> String {
    let [r, g, b] = shade(share);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The same in red, green and blue.
pub(super) fn shade(share: f64) -> [u8; 3] {
    let at = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let i = (at as usize).min(COLOURS.len() - 2);
    let part = at - i as f64;
    let mix = |k: usize| (COLOURS[i][k] + part * (COLOURS[i + 1][k] - COLOURS[i][k])).round() as u8;
    [mix(0), mix(1), mix(2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_grain_is_a_circle_and_nothing_is_no_drawing() {
        let table = "x_m,z_m,radius_m,u_particle_m_s\n0,0,0.003,0\n0.006,0,0.003,0.5\n";
        let view = SideView::read(table.as_bytes()).unwrap().unwrap();
        let svg = grains_svg(&view).unwrap();
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains("#443a78") && svg.contains("#f0d232"), "slow and fast differ");
        assert!(grains_svg(&SideView::default()).is_none());
        assert_eq!(SideView::read(view.csv().as_bytes()).unwrap(), Some(view));
        assert_eq!(SideView::read("x_m\n1\n".as_bytes()).unwrap(), None);
    }

    #[test]
    fn of_a_long_bed_the_beginning_is_drawn_and_said() {
        let grains = (0..1000).map(|i| [0.006 * f64::from(i), 0.0, 0.003, 0.1]).collect();
        let svg = grains_svg(&SideView { grains }).unwrap();
        assert_eq!(svg.matches("<circle").count(), 12);
        assert!(svg.contains("the first 72.00 mm of 6.000 m"), "{}", &svg[..200]);
    }
}
