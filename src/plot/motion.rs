//! The film of the grains: a canvas that the script of the page plays.

use crate::result::Motion;
use crate::units::significant;

use super::grains::colours;
use super::svg::escape;

/// The film as a figure that stays hidden where no script plays it.
#[must_use]
pub(super) fn motion_html(motion: &Motion) -> String {
    let Motion { begin_s, interval_s, pictures, grains, .. } = motion;
    let end = begin_s + interval_s * pictures.saturating_sub(1) as f64;
    let caption = format!(
        "The {grains} grains that were nearest to the viewer when the film began, from {} s to {} s of the flow in {pictures} pictures, \
         coloured by their velocity along the flow; between pictures they move straight on.",
        significant(*begin_s, 4),
        significant(end, 4)
    );
    format!(
        "<figure id=\"motion\" hidden><canvas role=\"img\" aria-label=\"{caption}\" data-begin=\"{begin_s}\" data-interval=\"{interval_s}\" \
         data-pictures=\"{pictures}\" data-grains=\"{grains}\" data-radius=\"{}\" data-length=\"{}\" data-shown=\"{}\" data-bottom=\"{}\" data-top=\"{}\" \
         data-colours=\"{}\" data-places=\"{}\"></canvas>\
         <div class=\"player\"><button type=\"button\">Pause</button>\
         <input type=\"range\" min=\"0\" max=\"{}\" step=\"any\" value=\"0\" aria-label=\"time\"><output></output></div>\
         <figcaption>{caption}</figcaption></figure>\n",
        motion.radius_m,
        motion.length_m,
        motion.shown_m,
        motion.bottom_m,
        motion.top_m,
        colours(),
        escape(&motion.places),
        pictures.saturating_sub(1)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::result::base64;

    #[test]
    fn the_film_says_what_it_shows() {
        let motion = Motion {
            format: Motion::FORMAT,
            begin_s: 2.0,
            interval_s: 0.01,
            pictures: 3,
            grains: 2,
            radius_m: 0.003,
            length_m: 0.1,
            shown_m: 0.1,
            bottom_m: 0.0,
            top_m: 0.2,
            places: base64([255; 24]),
        };
        let html = motion_html(&motion);
        assert!(html.contains("from 2.000 s to 2.020 s of the flow in 3 pictures"), "{html}");
        assert!(
            html.contains("data-colours=\"#443a78 ") && html.contains(&format!("data-places=\"{}\"", motion.places))
        );
    }
}
