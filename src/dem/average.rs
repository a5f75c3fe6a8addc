//! Profiles of a bed: slices of spheres exactly, stresses of contacts and fluctuations, block averages.
//!
//! Means of a slice are weighted with the volume that each sphere has in it (Maurin et al. 2015, eq. A1). The stress is
//! σ = -ρ_p φ <v'v'> - (1/V) Σ f b (Chassagne et al. 2023, eq. 2.27), b the branch of a contact, spread over the slices that it crosses.
//! The flux of fluctuation energy is q = (1/2) ρ_p φ <w' v'^2> - (1/V) Σ f·v' b_z with the mean velocity of both grains (2.28);
//! what a contact takes, -(1/2) f·(v_p - v_q) of each grain (2.29), and the work of the drag f_D·v' (2.30) are spread over the grains.

use std::f64::consts::PI;

use super::certainty::{MIN_SAMPLES, of_blocks};
use super::checkpoint::Saved;
use super::engine::Engine;
use super::grains::Point;
use super::law::ContactLaw;
use crate::result::{Estimate, Unknown};

/// Volume of the part of a sphere of radius `r` around 0 that lies between `low` and `high` \[m3].
#[must_use]
pub fn slice_volume(r: f64, low: f64, high: f64) -> f64 {
    let (a, b) = (low.clamp(-r, r), high.clamp(-r, r));
    // The difference of two cubes, without their cancellation.
    PI * (b - a) * (r * r - (b * b + a * b + a * a) / 3.0)
}

/// Sums over the samples of one block, one entry per slice.
#[derive(Clone, Debug, Default, PartialEq)]
struct Block {
    samples: f64,
    volume: Vec<f64>,
    momentum: Vec<[f64; 3]>,
    /// u², v², w², u w, v w, w |v|²
    squares: Vec<[f64; 6]>,
    /// force of contacts along x (against the flow), z and y, and its power
    contact: Vec<[f64; 4]>,
    /// drag, its power, and the power that contacts take
    taken: Vec<[f64; 5]>,
}

impl Block {
    /// Mean velocity in a slice [m/s].
    fn velocity(&self, s: usize) -> Point {
        self.momentum[s].map(|m| m / self.volume[s])
    }

    /// Flux of fluctuation energy upward times the volume of the samples.
    fn flux(&self, s: usize, density: f64) -> f64 {
        let ([u, v, w], [uu, vv, ww, uw, vw, third]) = (self.velocity(s), self.squares[s].map(|x| x / self.volume[s]));
        let speed = u * u + v * v + w * w;
        let fluctuating = third - 2.0 * (u * uw + v * vw + w * ww) - w * (uu + vv + ww) + 2.0 * w * speed;
        let [x, z, y, power] = self.contact[s];
        0.5 * density * self.volume[s] * fluctuating + power + u * x - v * y - w * z
    }

    /// What the drag takes from the fluctuations times the volume of the samples.
    fn drag_loss(&self, s: usize) -> f64 {
        let ([u, v, w], [x, y, z, power, _]) = (self.velocity(s), self.taken[s]);
        u * x + v * y + w * z - power
    }
}

/// Profiles over time, in blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Averages {
    bottom: f64,
    thickness: f64,
    slice_volume: f64,
    density: f64,
    blocks: Vec<Block>,
}

/// The averaged profile, one entry per slice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Averaged {
    /// elevation of the middle \[m]
    pub z: Vec<f64>,
    /// solid fraction
    pub phi: Vec<Option<Estimate>>,
    /// velocity along the flow [m/s]
    pub velocity: Vec<Option<Estimate>>,
    /// granular temperature [m2/s2]
    pub temperature: Vec<Option<Estimate>>,
    /// shear stress, positive where the upper layer drags the lower one \[Pa]
    pub shear: Vec<Option<Estimate>>,
    /// normal stress \[Pa]
    pub pressure: Vec<Option<Estimate>>,
    /// flux of fluctuation energy upward [W/m2]
    pub flux: Vec<Option<Estimate>>,
    /// what the drag takes from the fluctuations [W/m3]
    pub drag_loss: Vec<Option<Estimate>>,
    /// what contacts take from the motion of the centres [W/m3]
    pub contact_loss: Vec<Option<Estimate>>,
}

impl Averaged {
    /// The same without standard errors, for the reason `why`.
    #[must_use]
    pub fn without_errors(mut self, why: Unknown) -> Self {
        let Self { z: _, phi, velocity, temperature, shear, pressure, flux, drag_loss, contact_loss } = &mut self;
        for means in [phi, velocity, temperature, shear, pressure, flux, drag_loss, contact_loss] {
            means.iter_mut().flatten().for_each(|estimate| estimate.stderr = Err(why));
        }
        self
    }
}

impl Averages {
    /// Nothing yet: slices of `thickness` \[m] from `bottom` to `top` \[m] over `area` \[m2], in `blocks` blocks.
    #[must_use]
    pub fn new(bottom: f64, top: f64, thickness: f64, area: f64, density: f64, blocks: usize) -> Self {
        let slices = (((top - bottom) / thickness).ceil().max(1.0) as usize).min(1_000_000);
        Self::empty(slices, blocks, [bottom, thickness, area * thickness, density])
    }

    /// Number of slices and of blocks.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        [self.blocks.first().map_or(0, |b| b.volume.len()), self.blocks.len()]
    }

    /// Nothing yet, of a given shape.
    #[must_use]
    pub fn empty(slices: usize, blocks: usize, [bottom, thickness, slice_volume, density]: [f64; 4]) -> Self {
        let block = Block {
            samples: 0.0,
            volume: vec![0.0; slices],
            momentum: vec![[0.0; 3]; slices],
            squares: vec![[0.0; 6]; slices],
            contact: vec![[0.0; 4]; slices],
            taken: vec![[0.0; 5]; slices],
        };
        let blocks = vec![block; blocks.max(1)];
        Self { bottom, thickness, slice_volume, density, blocks }
    }

    /// The same without the blocks before `first`.
    #[must_use]
    pub fn after(&self, first: usize) -> Self {
        Self { blocks: self.blocks.iter().skip(first).cloned().collect(), ..self.clone() }
    }

    /// Whether there are samples enough for standard errors.
    fn are_enough(&self) -> bool {
        self.blocks.iter().map(|block| block.samples).sum::<f64>() >= MIN_SAMPLES as f64
    }

    /// Each block that has samples as a profile of its own.
    #[must_use]
    pub fn each(&self) -> Vec<Averaged> {
        let used = self.blocks.iter().filter(|b| b.samples > 0.0);
        used.map(|block| Self { blocks: vec![block.clone()], ..*self }.profile()).collect()
    }

    /// Adds the present state to block `block`; `drag` is the force of the fluid on a grain by its place \[N].
    pub fn sample<C: ContactLaw>(&mut self, engine: &Engine<C>, block: usize, drag: impl Fn(usize) -> Point) {
        let (bottom, thickness) = (self.bottom, self.thickness);
        let last = self.blocks.len() - 1;
        let Block { samples, volume, momentum, squares, contact: branches, taken } = &mut self.blocks[block.min(last)];
        *samples += 1.0;
        let slices = volume.len();
        let index = |z: f64| ((z - bottom) / thickness).clamp(0.0, slices as f64) as usize;
        let grains = engine.grains();
        let dot = |a: Point, b: Point| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let mut lost = vec![0.0; grains.len()];
        for contact in engine.contacts() {
            let (first, second) =
                (grains.velocity(contact.first), contact.second.map_or([0.0; 3], |j| grains.velocity(j)));
            let half = 0.5 * (dot(contact.force, first) - dot(contact.force, second));
            lost[contact.first] += half;
            if let Some(j) = contact.second {
                lost[j] += half;
            }
            let z = grains.position(contact.first)[2];
            let rise = contact.normal[2] * contact.distance;
            let (low, high) = if rise > 0.0 { (z, z + rise) } else { (z + rise, z) };
            // A level branch carries no stress across levels.
            if high <= low {
                continue;
            }
            let sign = if rise > 0.0 { 1.0 } else { -1.0 };
            let power = 0.5 * (dot(contact.force, first) + dot(contact.force, second));
            let carried = [-contact.force[0], contact.force[2], contact.force[1], power];
            let crossed = index(low)..(index(high) + 1).min(slices);
            for (s, sums) in branches[crossed.clone()].iter_mut().enumerate().map(|(n, sums)| (n + crossed.start, sums))
            {
                let from = bottom + s as f64 * thickness;
                let length = (high.min(from + thickness) - low.max(from)).max(0.0);
                for (sum, x) in sums.iter_mut().zip(carried) {
                    *sum += sign * x * length;
                }
            }
        }
        for (i, &lost) in lost.iter().enumerate() {
            let (r, [_, _, z]) = (grains.radius(i), grains.position(i));
            let velocity = grains.velocity(i);
            let [u, v, w] = velocity;
            let push = if grains.is_fixed(i) { [0.0; 3] } else { drag(i) };
            let per_volume = 3.0 / (4.0 * PI * r * r * r);
            let takes = [push[0], push[1], push[2], dot(push, velocity), lost].map(|x| per_volume * x);
            for s in index(z - r)..(index(z + r) + 1).min(slices) {
                let low = bottom + s as f64 * thickness - z;
                let part = slice_volume(r, low, low + thickness);
                volume[s] += part;
                for (sum, x) in momentum[s].iter_mut().zip([u, v, w]) {
                    *sum += part * x;
                }
                for (sum, x) in
                    squares[s].iter_mut().zip([u * u, v * v, w * w, u * w, v * w, w * dot(velocity, velocity)])
                {
                    *sum += part * x;
                }
                for (sum, x) in taken[s].iter_mut().zip(takes) {
                    *sum += part * x;
                }
            }
        }
    }

    /// The profile with its standard errors, where there are samples enough; empty slices have no velocity.
    #[must_use]
    pub fn profile(&self) -> Averaged {
        let profile = self.means();
        if self.are_enough() { profile } else { profile.without_errors(Unknown::TooFew) }
    }

    fn means(&self) -> Averaged {
        let used: Vec<&Block> = self.blocks.iter().filter(|b| b.samples > 0.0).collect();
        let mut profile = Averaged::default();
        if used.is_empty() {
            return profile;
        }
        for s in 0..used[0].volume.len() {
            profile.z.push(self.bottom + (s as f64 + 0.5) * self.thickness);
            let mean = |value: &dyn Fn(&Block) -> Option<f64>| mean(used.iter().filter_map(|b| value(b)));
            let per = |b: &Block| b.samples * self.slice_volume;
            // What is thinner than a thousandth of a per cent is a grain that flew by.
            let filled = |b: &&Block| b.volume[s] > 1e-5 * per(b);
            let fluctuation = |b: &Block, a: usize, c: usize, square: usize| {
                let m = b.momentum[s].map(|m| m / b.volume[s]);
                b.squares[s][square] / b.volume[s] - m[a] * m[c]
            };
            let kinetic = |b: &Block, a: usize, c: usize, square: usize| {
                if filled(&b) { self.density * b.volume[s] / per(b) * fluctuation(b, a, c, square) } else { 0.0 }
            };
            profile.phi.push(mean(&|b| Some(b.volume[s] / per(b))));
            profile.velocity.push(mean(&|b| filled(&b).then(|| b.momentum[s][0] / b.volume[s])));
            let temperature = |b: &Block| (0..3).map(|k| fluctuation(b, k, k, k)).sum::<f64>().max(0.0) / 3.0;
            profile.temperature.push(mean(&|b| filled(&b).then(|| temperature(b))));
            profile.shear.push(mean(&|b| Some(b.contact[s][0] / per(b) - kinetic(b, 0, 2, 3))));
            profile.pressure.push(mean(&|b| Some(b.contact[s][1] / per(b) + kinetic(b, 2, 2, 2))));
            // Of the mean velocity only what the slice has: it moves with its grains.
            profile.flux.push(mean(&|b| filled(&b).then(|| b.flux(s, self.density) / per(b))));
            profile.drag_loss.push(mean(&|b| filled(&b).then(|| b.drag_loss(s) / per(b))));
            profile.contact_loss.push(mean(&|b| Some(b.taken[s][4] / per(b))));
        }
        profile
    }
}

impl Saved for Averages {
    fn numbers(&mut self) -> Vec<&mut f64> {
        let mut all = vec![&mut self.bottom, &mut self.thickness, &mut self.slice_volume, &mut self.density];
        for block in &mut self.blocks {
            all.push(&mut block.samples);
            all.extend(block.volume.iter_mut());
            all.extend(block.momentum.iter_mut().flatten());
            all.extend(block.squares.iter_mut().flatten());
            all.extend(block.contact.iter_mut().flatten());
            all.extend(block.taken.iter_mut().flatten());
        }
        all
    }
}

/// Mean of blocks and its standard error.
pub(super) fn mean(values: impl Iterator<Item = f64>) -> Option<Estimate> {
    let values: Vec<f64> = values.collect();
    if values.is_empty() {
        return None;
    }
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    Some(Estimate { mean, stderr: of_blocks(&values, mean) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_of_a_sphere_add_up_to_it_however_thin() {
        let r = 3e-3;
        let whole = 4.0 / 3.0 * PI * r * r * r;
        for n in [1, 2, 7, 60, 1000] {
            let thickness = 2.2 * r / f64::from(n);
            let sum: f64 = (0..n)
                .map(|s| -1.1 * r + f64::from(s) * thickness)
                .map(|low| slice_volume(r, low, low + thickness))
                .sum();
            approx::assert_relative_eq!(sum, whole, max_relative = 1e-13);
        }
        // A slice as thin as a thousandth of the diameter through the middle is a disc.
        let thin = 2e-3 * r;
        let disc = PI * r * r * thin;
        approx::assert_relative_eq!(slice_volume(r, -0.5 * thin, 0.5 * thin), disc, max_relative = 1e-6);
        assert_eq!(slice_volume(r, 1.5 * r, 2.0 * r), 0.0);
    }

    #[test]
    fn the_standard_error_is_that_of_independent_blocks() {
        let Estimate { mean: m, stderr } = mean((1..=8).map(f64::from)).unwrap();
        approx::assert_relative_eq!(m, 4.5);
        approx::assert_relative_eq!(stderr.unwrap(), (42.0_f64 / 56.0).sqrt());
        assert_eq!(mean((1..=7).map(f64::from)), Some(Estimate { mean: 4.0, stderr: Err(Unknown::TooFew) }));
        assert_eq!(mean([].into_iter()), None);
    }
}
