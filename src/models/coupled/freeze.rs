//! Freezing of the deep bed: layers that hardly creep are frozen, and released when the layer above them moves.
//!
//! Every `freeze_period` the mean displacement of the grains is taken in layers of one diameter. From the bottom up, layers whose grains
//! moved less than `freeze_below` d on average are at rest. All of them but the uppermost are frozen: their grains are fixed, pairs of
//! them are not computed. The uppermost stays free, as a sensor: if it comes to move, the two layers under it are released. Frozen
//! grains carry stress to the ground that is not averaged; their creep is neglected.

use crate::dem::checkpoint::{Reader, Writer};
use crate::dem::engine::Engine;
use crate::dem::grains::Point;
use crate::dem::law::ContactLaw;
use crate::models::coupled::{Coupled, Freeze};
use crate::result::CheckpointError;

/// Layers that are released at once.
const RELEASED: f64 = 2.0;
/// Fewest grains of a layer.
const MIN_GRAINS: usize = 4;

/// The frozen part of the bed, and the criterion by which layers are frozen.
#[derive(Debug)]
pub struct FrozenBed {
    /// mean displacement of a layer at rest \[m]
    creep: f64,
    /// coupling periods between two checks, and before the first
    every: u64,
    after: u64,
    d: f64,
    periods: [f64; 2],
    /// grains of the bottom, which come first and are fixed for good
    fixed: usize,
    /// grains below are frozen \[m]
    level: f64,
    /// the highest of these levels so far \[m]
    highest: f64,
    /// centres of all grains at the last check, by name \[m]
    then: Vec<Point>,
}

impl FrozenBed {
    /// Nothing is frozen yet; `None` if nothing is to be.
    pub fn new<C: ContactLaw>(flow: &Coupled, engine: &Engine<C>) -> Option<Self> {
        let Freeze { creep, period, after } = flow.freeze?;
        let d = flow.bed.d;
        let mut frozen = Self {
            creep: creep * d,
            every: (period / flow.coupling_period).round().max(1.0) as u64,
            after: (after / flow.coupling_period).round() as u64,
            d,
            periods: flow.bed.size,
            fixed: engine.grains().len() - flow.bed.mobile,
            level: 0.0,
            highest: 0.0,
            then: Vec::new(),
        };
        let named = |i: usize| engine.grains().ids[i] as usize >= frozen.fixed || engine.grains().is_fixed(i);
        debug_assert!((0..engine.grains().len()).all(named), "the grains of the bottom come first");
        frozen.remember(engine);
        Some(frozen)
    }

    /// Elevation below which grains are frozen \[m].
    pub fn level(&self) -> f64 {
        self.level
    }

    /// Elevation below which contacts were not computed, at some time \[m]; `None` if all were.
    pub fn blind_below(&self) -> Option<f64> {
        (self.highest > 0.0).then_some(self.highest + 0.5 * self.d)
    }

    fn remember<C: ContactLaw>(&mut self, engine: &Engine<C>) {
        let grains = engine.grains();
        self.then = grains.places().into_iter().map(|i| grains.position(i)).collect();
    }

    /// Checks the layers after period `made`, if it is time to; whether grains were frozen or released.
    pub fn check<C: ContactLaw>(&mut self, made: u64, engine: &mut Engine<C>) -> bool {
        if !made.is_multiple_of(self.every) {
            return false;
        }
        if made <= self.after {
            self.remember(engine);
            return false;
        }
        let grains = engine.grains();
        let mut layers: Vec<(f64, usize)> = Vec::new();
        for i in (0..grains.len()).filter(|&i| grains.ids[i] as usize >= self.fixed) {
            let (now, then) = (grains.position(i), self.then[grains.ids[i] as usize]);
            let way = |k: usize| {
                let straight = now[k] - then[k];
                self.periods.get(k).map_or(straight, |length| straight - (straight / length).round() * length)
            };
            let k = (now[2] / self.d).max(0.0) as usize;
            if layers.len() <= k {
                layers.resize(k + 1, (0.0, 0));
            }
            layers[k].0 += (0..3).map(|k| way(k) * way(k)).sum::<f64>().sqrt();
            layers[k].1 += 1;
        }
        let still = |layer: &(f64, usize)| layer.1 >= MIN_GRAINS && layer.0 < self.creep * layer.1 as f64;
        let resting = layers.iter().take_while(|layer| still(layer)).count() as f64 * self.d;
        self.level = if resting > self.level { resting - self.d } else { (self.level - RELEASED * self.d).max(0.0) };
        self.highest = self.highest.max(self.level);
        let changed = engine.freeze_below(self.level, self.fixed);
        self.remember(engine);
        changed
    }

    pub fn save(&self, to: &mut Writer) {
        to.number(self.level);
        to.number(self.highest);
        for x in self.then.iter().flatten() {
            to.number(*x);
        }
    }

    /// As it was saved.
    pub fn restore<C: ContactLaw>(
        flow: &Coupled,
        engine: &Engine<C>,
        from: &mut Reader<'_>,
    ) -> Result<Option<Self>, CheckpointError> {
        let Some(mut frozen) = Self::new(flow, engine) else { return Ok(None) };
        frozen.level = from.number()?;
        frozen.highest = from.number()?;
        for x in frozen.then.iter_mut().flatten() {
            *x = from.number()?;
        }
        Ok(Some(frozen))
    }
}
