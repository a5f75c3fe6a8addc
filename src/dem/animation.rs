//! Frames of the grains as they flow, kept in memory: the last clip of an animation for the report. It only looks.

use super::checkpoint::{Reader, Writer};
use super::grains::Grains;
use crate::dem::GrainBed;
use crate::result::CheckpointError;
use crate::result::{Animation, base64};

/// Time between two frames over the time in which a grain falls its diameter: what moves does not jump.
const INTERVAL: f64 = 0.25;
/// Most frames of a clip.
const MAX_FRAMES: usize = 120;
/// Most places of grains in a clip, 4 bytes each; a large bed has fewer frames.
const MAX_PLACES: usize = 480_000;
/// Most grains; the nearest to the viewer stay.
const MAX_GRAINS: usize = 10_000;

/// Clips of an animation: when one is full the next one begins, and the last full one is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorder {
    /// steps between two frames
    every: u64,
    /// time between two frames \[s]
    interval: f64,
    radius: f64,
    length: f64,
    shown: f64,
    /// elevations that can be shown \[m]
    heights: [f64; 2],
    now: Clip,
    full: Clip,
}

/// Some grains in a few frames.
#[derive(Clone, Debug, Default, PartialEq)]
struct Clip {
    /// time of the first frame \[s]
    begin: f64,
    /// names of the grains, the farthest first
    ids: Vec<u32>,
    /// x and z in 65536ths
    places: Vec<u32>,
}

impl Recorder {
    /// An animation of `bed`, recorded at most every `step` \[s].
    #[must_use]
    pub fn new(bed: &GrainBed, grains: &Grains, step: f64) -> Self {
        let ends = (0..grains.len()).map(|i| grains.position(i)[2]);
        let (low, high) = ends.fold((0.0_f64, 0.0_f64), |(low, high), z| (low.min(z), high.max(z)));
        let heights = [low - bed.d, high + 2.0 * (high - low) + 20.0 * bed.d];
        let (radius, length) = (0.5 * bed.d, bed.size[0]);
        let shown = length.min(Animation::LONGEST * (high - low + bed.d));
        let every = (INTERVAL * (bed.d / bed.g).sqrt() / step).round().max(1.0) as u64;
        let (now, full) = (Clip::default(), Clip::default());
        Self { every, interval: every as f64 * step, radius, length, shown, heights, now, full }
    }

    /// Whether there is to be a frame after so many steps.
    #[must_use]
    pub fn is_due(&self, steps: u64) -> bool {
        steps.is_multiple_of(self.every)
    }

    /// Records a frame at the time `time` \[s].
    pub fn record(&mut self, grains: &Grains, time: f64) {
        if self.now.ids.is_empty() {
            self.now = Clip { begin: time, ids: self.nearest(grains), places: Vec::new() };
        }
        let places = grains.places();
        let [low, high] = self.heights;
        for &id in &self.now.ids {
            let [x, _, z] = grains.position(places[id as usize]);
            let along = ((x / self.length).rem_euclid(1.0) * 65536.0) as u32 & 0xffff;
            let up = (((z - low) / (high - low)).clamp(0.0, 1.0) * 65535.0) as u32;
            self.now.places.push(up << 16 | along);
        }
        let wanted = (MAX_PLACES / self.now.ids.len().max(1)).min(MAX_FRAMES);
        if self.now.frames() >= wanted {
            self.full = std::mem::take(&mut self.now);
        }
    }

    /// Grains of one slice along the flow, two diameters deep across it, the farthest first: those in the part that is
    /// shown, and those beside it that may get there.
    fn nearest(&self, grains: &Grains) -> Vec<u32> {
        let front = (0..grains.len()).map(|i| grains.position(i)[1]).fold(f64::INFINITY, f64::min);
        let depth = front + 4.0 * grains.largest_radius();
        let is_visible = |&i: &usize| {
            let [x, y, _] = grains.position(i);
            let x = x.rem_euclid(self.length);
            y <= depth && (x < 2.0 * self.shown || x > self.length - self.shown)
        };
        let mut visible: Vec<usize> = grains.places().into_iter().filter(is_visible).collect();
        visible.sort_by(|&a, &b| grains.position(b)[1].total_cmp(&grains.position(a)[1]));
        visible.drain(..visible.len().saturating_sub(MAX_GRAINS));
        visible.into_iter().map(|i| grains.ids[i]).collect()
    }

    /// The last full clip, or the first one as far as it is; none of fewer than two frames.
    #[must_use]
    pub fn animation(&self) -> Option<Animation> {
        let clip = if self.full.frames() > 0 { &self.full } else { &self.now };
        let animation = Animation {
            format: Animation::FORMAT,
            begin_s: clip.begin,
            interval_s: self.interval,
            frames: clip.frames(),
            grains: clip.ids.len(),
            radius_m: self.radius,
            length_m: self.length,
            shown_m: self.shown,
            bottom_m: self.heights[0],
            top_m: self.heights[1],
            places: base64(clip.places.iter().flat_map(|place| place.to_le_bytes())),
        };
        animation.is_sound().then_some(animation)
    }

    /// Writes it into a checkpoint.
    pub fn save(&self, to: &mut Writer) {
        to.whole(self.every);
        for x in [self.interval, self.radius, self.length, self.shown, self.heights[0], self.heights[1]] {
            to.number(x);
        }
        for clip in [&self.now, &self.full] {
            to.number(clip.begin);
            to.half_words(&clip.ids);
            to.half_words(&clip.places);
        }
    }

    /// Reads what [`Recorder::save`] wrote of so many grains.
    ///
    /// # Errors
    /// [`CheckpointError`] if what it says cannot be.
    pub fn restore(from: &mut Reader<'_>, grains: usize) -> Result<Self, CheckpointError> {
        let every = from.whole()?;
        if every == 0 {
            return Err(CheckpointError::Corrupt { what: "the animation" });
        }
        let mut number = || from.number();
        let (interval, radius, length, shown) = (number()?, number()?, number()?, number()?);
        let heights = [number()?, number()?];
        let mut clip = || -> Result<Clip, CheckpointError> {
            let (begin, ids, places) = (from.number()?, from.half_words()?, from.half_words()?);
            let whole =
                ids.is_empty() == places.is_empty() && (ids.is_empty() || places.len().is_multiple_of(ids.len()));
            if !whole || ids.iter().any(|&id| id as usize >= grains) {
                return Err(CheckpointError::Corrupt { what: "the animation" });
            }
            Ok(Clip { begin, ids, places })
        };
        Ok(Self { every, interval, radius, length, shown, heights, now: clip()?, full: clip()? })
    }
}

impl Clip {
    fn frames(&self) -> usize {
        self.places.len().checked_div(self.ids.len()).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::grains::Grain;

    fn recorder() -> Recorder {
        let (now, full) = (Clip::default(), Clip::default());
        Recorder { every: 1, interval: 0.01, radius: 0.1, length: 2.0, shown: 2.0, heights: [0.0, 10.0], now, full }
    }

    /// Three grains, the last behind the others, moved by `x` along the flow.
    fn grains(x: f64) -> Grains {
        let at = |place| Grain::at_rest(place, 0.1, 1.0);
        Grains::new(&[at([x, 0.0, 5.0]), at([1.0, 0.2, 20.0]), at([x, 3.0, 5.0])])
    }

    #[test]
    fn the_last_full_clip_is_shown_and_a_checkpoint_changes_nothing() {
        let mut recorder = recorder();
        recorder.record(&grains(0.5), 0.0);
        assert_eq!(recorder.animation(), None, "one frame is no animation");
        for k in 1..250 {
            recorder.record(&grains(0.5), f64::from(k));
            let mut to = Writer::default();
            recorder.save(&mut to);
            let bytes = to.seal(&[1; 32]);
            let mut from = Reader::open(&bytes, &[1; 32]).unwrap();
            assert_eq!(Recorder::restore(&mut from, 3).unwrap(), recorder);
            from.close().unwrap();
            assert!(Recorder::restore(&mut Reader::open(&bytes, &[1; 32]).unwrap(), 1).is_err());
        }
        let animation: Animation = recorder.animation().unwrap();
        assert_eq!((animation.frames, animation.grains, animation.begin_s), (MAX_FRAMES, 2, 120.0));
    }

    #[test]
    fn of_a_long_bed_the_part_that_is_shown_and_what_may_get_there() {
        let at = |x| Grain::at_rest([x, 0.0, 5.0], 0.1, 1.0);
        let grains = Grains::new(&[0.5, 1.5, 2.5, 8.5, 9.5, -0.5].map(at));
        let mut recorder = Recorder { length: 10.0, shown: 1.0, ..recorder() };
        recorder.record(&grains, 0.0);
        assert_eq!(recorder.now.ids, [0, 1, 4, 5]);
    }

    #[test]
    fn places_are_shares_of_the_period_and_of_the_height() {
        let mut recorder = recorder();
        recorder.record(&grains(0.5), 0.0);
        recorder.record(&grains(2.0), 1.0);
        // The farther of the two in front first, higher than can be shown; the period ends where it begins.
        assert_eq!(recorder.now.ids, [1, 0]);
        assert_eq!(recorder.now.places, [0xffff_8000, 0x7fff_4000, 0xffff_8000, 0x7fff_0000]);
    }
}
