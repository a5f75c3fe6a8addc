//! The animation of the grains: a canvas that the script of the page plays.

use crate::result::Animation;
use crate::units::significant;

use super::grains::colours;
use super::svg::escape;

/// The animation as a figure that stays hidden where no script plays it.
#[must_use]
pub(super) fn animation_html(animation: &Animation) -> String {
    let Animation { begin_s, interval_s, frames, grains, .. } = animation;
    let end = begin_s + interval_s * frames.saturating_sub(1) as f64;
    let caption = format!(
        "The {grains} grains that were nearest to the viewer when the animation began, from {} s to {} s of the flow in {frames} frames, \
         coloured by their velocity along the flow; between frames they move straight on.",
        significant(*begin_s, 4),
        significant(end, 4)
    );
    format!(
        "<figure id=\"animation\" hidden><canvas role=\"img\" aria-label=\"{caption}\" data-begin=\"{begin_s}\" data-interval=\"{interval_s}\" \
         data-frames=\"{frames}\" data-grains=\"{grains}\" data-radius=\"{}\" data-length=\"{}\" data-shown=\"{}\" data-bottom=\"{}\" data-top=\"{}\" \
         data-colours=\"{}\" data-places=\"{}\"></canvas>\
         <div class=\"player\"><button type=\"button\">Pause</button>\
         <input type=\"range\" min=\"0\" max=\"{}\" step=\"any\" value=\"0\" aria-label=\"time\"><output></output></div>\
         <figcaption>{caption}</figcaption></figure>\n",
        animation.radius_m,
        animation.length_m,
        animation.shown_m,
        animation.bottom_m,
        animation.top_m,
        colours(),
        escape(&animation.places),
        frames.saturating_sub(1)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::result::base64;

    #[test]
    fn the_caption_states_what_the_animation_shows() {
        let animation = Animation {
            format: Animation::FORMAT,
            begin_s: 2.0,
            interval_s: 0.01,
            frames: 3,
            grains: 2,
            radius_m: 0.003,
            length_m: 0.1,
            shown_m: 0.1,
            bottom_m: 0.0,
            top_m: 0.2,
            places: base64([255; 24]),
        };
        let html = animation_html(&animation);
        assert!(html.contains("from 2.000 s to 2.020 s of the flow in 3 frames"), "{html}");
        assert!(
            html.contains("data-colours=\"#443a78 ") && html.contains(&format!("data-places=\"{}\"", animation.places))
        );
    }
}
