//! A text of a figure: its place, the room that it takes, and its lines.

use super::PlotError;
use super::canvas::{Align, width};
use super::theme::Role;

/// Line spacing of titles.
pub(super) const LEADING: f64 = 15.5;

/// Left, top, right, bottom.
pub(super) type Rectangle = (f64, f64, f64, f64);

/// A line of text and the place of its base line.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub text: String,
    pub at: (f64, f64),
    pub size: f64,
    pub align: Align,
    pub role: Role,
}

/// Heights of letters above and below the base line, over the size of the text.
const ABOVE: f64 = 0.74;
const UNDER: f64 = 0.22;

impl Text {
    /// The room that it takes.
    pub fn room(&self) -> Result<Rectangle, PlotError> {
        let (x, y) = self.at;
        let (wide, up, down) = (width(&self.text, self.size)?, ABOVE * self.size, UNDER * self.size);
        Ok(match self.align {
            Align::Left => (x, y - up, x + wide, y + down),
            Align::Centre => (x - wide / 2.0, y - up, x + wide / 2.0, y + down),
            Align::Right => (x - wide, y - up, x, y + down),
            Align::Upward => (x - up, y - wide / 2.0, x + down, y + wide / 2.0),
        })
    }
}

/// Whether two rooms have a place in common.
pub(super) fn overlap(a: Rectangle, b: Rectangle) -> bool {
    a.0 < b.2 && b.0 < a.2 && a.1 < b.3 && b.1 < a.3
}

/// A text in lines that are no wider than `room`, where its words allow it. A unit in brackets stays whole.
pub(super) fn wrapped(text: &str, room: f64, size: f64) -> Result<Vec<String>, PlotError> {
    let mut lines: Vec<String> = Vec::new();
    let (mut word, mut depth) = (String::new(), 0_i32);
    let mut words = Vec::new();
    for letter in text.chars() {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        if letter == ' ' && depth == 0 {
            words.push(std::mem::take(&mut word));
        } else {
            word.push(letter);
        }
    }
    words.push(word);
    for word in words {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size)? <= room => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::super::theme::LABEL;
    use super::*;

    #[test]
    fn a_title_breaks_between_words_and_keeps_its_unit_whole() {
        let lines = |room| wrapped("mass rate per width (kg/(m s))", room, LABEL).unwrap();
        assert_eq!(lines(1e3), ["mass rate per width (kg/(m s))"]);
        assert_eq!(lines(140.0), ["mass rate per width", "(kg/(m s))"]);
        assert_eq!(lines(70.0), ["mass rate", "per width", "(kg/(m s))"]);
        assert!(wrapped("", 10.0, LABEL).unwrap().concat().is_empty());
    }

    #[test]
    fn a_text_takes_the_room_in_which_it_stands() {
        let text = |align| Text { text: "level".into(), at: (50.0, 20.0), size: 10.0, align, role: Role::Ink };
        let [left, right, up] = [Align::Left, Align::Right, Align::Upward].map(|align| text(align).room().unwrap());
        assert!(left.0 == 50.0 && right.2 == 50.0 && (left.2 - left.0 - (up.3 - up.1)).abs() < 1e-9);
        assert!(!overlap(left, right) && overlap(left, up));
    }
}
