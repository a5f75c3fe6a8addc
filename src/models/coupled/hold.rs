//! Rest for the deep bed: layers that hardly creep are held, and woken when the layer above them moves.
//!
//! Every `hold_period` the mean way of the grains is taken in layers of one diameter. From the bottom up, layers whose grains went less than
//! `hold_creep` d on average are at rest. All of them but the uppermost are held: their grains are fixed, pairs of them are not looked at. The
//! uppermost stays free: it is the watch. If it comes to move, the two layers under it are woken. Held grains carry stress to the
//! ground that is not averaged; what they would have crept is lost.

use crate::dem::checkpoint::{Reader, Writer};
use crate::dem::engine::Engine;
use crate::dem::grains::Point;
use crate::dem::law::ContactLaw;
use crate::models::coupled::Coupled;
use crate::result::CheckpointError;

/// Layers that are woken at once.
const WOKEN: f64 = 2.0;
/// Fewer grains than this are no layer.
const FEW: usize = 4;

/// What is held, and what it is judged by.
#[derive(Debug)]
pub struct Hold {
    /// mean way of a layer at rest \[m]
    creep: f64,
    /// coupling periods between two looks, and before the first
    every: u64,
    after: u64,
    d: f64,
    periods: [f64; 2],
    /// grains of the bottom, which come first and are fixed for good
    fixed: usize,
    /// grains below are held \[m]
    level: f64,
    /// the highest of these levels so far \[m]
    highest: f64,
    /// centres of all grains at the last look, by name \[m]
    then: Vec<Point>,
}

impl Hold {
    /// Nothing is held yet; `None` if nothing is to be.
    pub fn new<C: ContactLaw>(flow: &Coupled, engine: &Engine<C>) -> Option<Self> {
        let [creep, period, after] = flow.hold?;
        let d = flow.bed.d;
        let mut hold = Self {
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
        let named = |i: usize| engine.grains().ids[i] as usize >= hold.fixed || engine.grains().is_fixed(i);
        debug_assert!((0..engine.grains().len()).all(named), "the grains of the bottom come first");
        hold.remember(engine);
        Some(hold)
    }

    /// Elevation below which grains are held \[m].
    pub fn level(&self) -> f64 {
        self.level
    }

    /// Elevation below which contacts were not looked at, at some time \[m]; `None` if all were.
    pub fn blind(&self) -> Option<f64> {
        (self.highest > 0.0).then_some(self.highest + 0.5 * self.d)
    }

    fn remember<C: ContactLaw>(&mut self, engine: &Engine<C>) {
        let grains = engine.grains();
        self.then = grains.places().into_iter().map(|i| grains.position(i)).collect();
    }

    /// Looks at the layers after period `made`, if it is time to; whether grains were held or let go.
    pub fn look<C: ContactLaw>(&mut self, made: u64, engine: &mut Engine<C>) -> bool {
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
        let still = |layer: &(f64, usize)| layer.1 >= FEW && layer.0 < self.creep * layer.1 as f64;
        let resting = layers.iter().take_while(|layer| still(layer)).count() as f64 * self.d;
        self.level = if resting > self.level { resting - self.d } else { (self.level - WOKEN * self.d).max(0.0) };
        self.highest = self.highest.max(self.level);
        let changed = engine.hold_below(self.level, self.fixed);
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
        let Some(mut hold) = Self::new(flow, engine) else { return Ok(None) };
        hold.level = from.number()?;
        hold.highest = from.number()?;
        for x in hold.then.iter_mut().flatten() {
            *x = from.number()?;
        }
        Ok(Some(hold))
    }
}
