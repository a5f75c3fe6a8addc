//! An animation of grains seen from the side: a few frames, small enough to stand in a page.

use serde::{Deserialize, Serialize};

/// Where some grains were at evenly spaced moments. As a file it is JSON.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Animation {
    /// version of the layout: [`Animation::FORMAT`]
    pub format: u32,
    /// time of the flow at the first frame \[s]
    pub begin_s: f64,
    /// time between two frames \[s]
    pub interval_s: f64,
    /// number of frames
    #[serde(rename = "pictures")]
    pub frames: usize,
    /// number of grains in each frame
    pub grains: usize,
    /// radius of the grains \[m]
    pub radius_m: f64,
    /// period along the flow \[m]
    pub length_m: f64,
    /// the part of it that is shown, from x = 0 \[m]; what starts further from it than it is long is left out
    pub shown_m: f64,
    /// elevation of the smallest z that can be written \[m]
    pub bottom_m: f64,
    /// elevation of the largest \[m]
    pub top_m: f64,
    /// base64 of 16-bit numbers, the low byte first: x/`length_m` in 65536ths and z in 65535ths of the way from
    /// `bottom_m` to `top_m`, of one grain after the other, the farthest from the viewer first, frame after frame
    pub places: String,
}

impl Animation {
    /// Version of the layout.
    pub const FORMAT: u32 = 1;
    /// A bed longer than so many of its heights is shown from its beginning to there \[1].
    pub const LONGEST: f64 = 12.0;

    /// Whether it is of this format, its numbers make sense, and there is a place for each grain in each frame.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let positive = [self.interval_s, self.radius_m, self.length_m, self.shown_m, self.top_m - self.bottom_m];
        let bytes = self.frames.checked_mul(self.grains).and_then(|places| places.checked_mul(4));
        let characters = bytes.and_then(|bytes| bytes.div_ceil(3).checked_mul(4));
        self.format == Self::FORMAT
            && self.begin_s.is_finite()
            && positive.iter().all(|x| x.is_finite() && *x > 0.0)
            && self.frames > 1
            && self.grains > 0
            && characters == Some(self.places.len())
            && self.places.bytes().all(|b| LETTERS.contains(&b) || b == b'=')
    }
}

const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Bytes as text of the standard alphabet of 64 letters, padded (RFC 4648).
#[must_use]
pub fn base64(bytes: impl IntoIterator<Item = u8>) -> String {
    let (mut text, mut bits, mut count) = (String::new(), 0_u32, 0);
    let letter = |six: u32| char::from(LETTERS[(six & 63) as usize]);
    for byte in bytes {
        bits = bits << 8 | u32::from(byte);
        count += 8;
        while count >= 6 {
            count -= 6;
            text.push(letter(bits >> count));
        }
    }
    if count > 0 {
        text.push(letter(bits << (6 - count)));
    }
    while !text.len().is_multiple_of(4) {
        text.push('=');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        let pairs =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("fooba", "Zm9vYmE=")];
        for (plain, text) in pairs {
            assert_eq!(base64(plain.bytes()), text);
        }
        assert_eq!(base64([0xfb, 0xff]), "+/8=");
    }

    #[test]
    fn what_does_not_fit_together_is_unsound() {
        let sound = Animation {
            format: Animation::FORMAT,
            begin_s: 0.0,
            interval_s: 0.01,
            frames: 2,
            grains: 3,
            radius_m: 0.003,
            length_m: 0.1,
            shown_m: 0.1,
            bottom_m: -0.01,
            top_m: 0.2,
            places: base64([7; 24]),
        };
        assert!(sound.is_sound());
        let text = serde_json::to_string(&sound).unwrap();
        assert_eq!(serde_json::from_str::<Animation>(&text).unwrap(), sound);
        let hostile = "<script>".repeat(4);
        for spoilt in [
            Animation { places: hostile, ..sound.clone() },
            Animation { grains: 4, ..sound.clone() },
            Animation { grains: usize::MAX, ..sound.clone() },
            Animation { frames: 1, grains: 6, ..sound.clone() },
            Animation { top_m: -0.01, ..sound.clone() },
            Animation { interval_s: f64::NAN, ..sound.clone() },
            Animation { format: 2, ..sound.clone() },
        ] {
            assert!(!spoilt.is_sound(), "{spoilt:?}");
        }
    }
}
