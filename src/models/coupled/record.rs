//! What is remembered of a run: samples, blocks of the fluid, and where the transient ends.

use super::exchange::Exchange;
use crate::dem::certainty::{MIN_BLOCKS, of_blocks, of_series, resolved};
use crate::dem::checkpoint::{Reader, Saved, Writer};
use crate::result::{CheckpointError, Estimate, Unknown};

/// Blocks of the whole duration.
pub const BLOCKS: usize = 40;
/// Numbers of blocks of which the largest standard error is taken.
const COUNTS: &[usize] = &[8, 12, 20];
/// Columns of the fluid that are averaged.
pub const FLUID: usize = 5;

/// One sample of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// time \[s]
    pub time: f64,
    /// block of the duration
    pub block: usize,
    /// kinetic energy of the grains \[J]
    pub kinetic_energy: f64,
    /// transport rate [m2/s]
    pub transport_rate: f64,
    /// largest Reynolds stress \[Pa]
    pub reynolds: f64,
    /// bed level \[m]
    pub level: f64,
    /// mean velocity of the water [m/s]
    pub velocity: f64,
}

impl Sample {
    fn numbers(&self) -> [f64; 7] {
        let Self { time, block, kinetic_energy, transport_rate, reynolds, level, velocity } = *self;
        [time, block as f64, kinetic_energy, transport_rate, reynolds, level, velocity]
    }

    fn of([time, block, kinetic_energy, transport_rate, reynolds, level, velocity]: [f64; 7]) -> Self {
        Self { time, block: block as usize, kinetic_energy, transport_rate, reynolds, level, velocity }
    }
}

/// Sums of the fluid over the samples of one block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// number of samples
    pub samples: f64,
    /// per cell: velocity, Reynolds stress, viscous stress, mixing length, eddy viscosity
    pub sums: Vec<[f64; FLUID]>,
}

/// All samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// in order
    pub samples: Vec<Sample>,
    /// blocks of the fluid
    pub blocks: Vec<Block>,
}

impl Record {
    /// Nothing yet, for `cells` cells.
    #[must_use]
    pub fn new(cells: usize) -> Self {
        Self { samples: Vec::new(), blocks: vec![Block { samples: 0.0, sums: vec![[0.0; FLUID]; cells] }; BLOCKS] }
    }

    /// Adds a sample, and the fluid to its block.
    pub fn add(&mut self, sample: Sample, exchange: &Exchange) {
        let block = &mut self.blocks[sample.block.min(BLOCKS - 1)];
        block.samples += 1.0;
        for (sums, values) in block.sums.iter_mut().zip(fluid(exchange)) {
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += value;
            }
        }
        self.samples.push(sample);
    }

    /// First block after the transient: the cut of the transport rates, not beyond their half, that leaves the smallest
    /// squared standard error of their mean (the marginal standard error rule, White 1997, doi:10.1177/003754979706900601),
    /// rounded up to a block. And whether it lies inside, not at the half: else the transient may not be over.
    #[must_use]
    pub fn transient(&self) -> (usize, bool) {
        let values: Vec<f64> = self.samples.iter().map(|sample| sample.transport_rate).collect();
        let cut = marginal(&values);
        let block = self.samples.get(cut).map_or(0, |sample| if cut == 0 { 0 } else { sample.block + 1 });
        let last = self.samples.last().map_or(0, |sample| sample.block);
        (block.min(last), cut < values.len() / 2 || values.len() < 2)
    }

    /// Mean of `value` from block `first` on, and its standard error by blocks of time.
    #[must_use]
    pub fn mean(&self, value: impl Fn(&Sample) -> f64, first: usize) -> Option<Estimate> {
        of_series(&self.values(value, first), COUNTS)
    }

    /// What `value` gains from the first half of the samples from block `first` on to the second. Where a half is too short for an error,
    /// it is that of the whole: a half has the root of two of it, their difference twice.
    #[must_use]
    pub fn drift(&self, value: impl Fn(&Sample) -> f64, first: usize) -> Option<Estimate> {
        let values = self.values(value, first);
        let (before, after) = values.split_at(values.len() / 2);
        let drift = of_series(after, COUNTS)?.plus(of_series(before, COUNTS)?.times(-1.0));
        let whole = of_series(&values, COUNTS)?.stderr.map(|error| 2.0 * error);
        Some(Estimate { stderr: drift.stderr.or(whole), ..drift })
    }

    /// Whether the samples of the transport rate from block `first` on are enough for standard errors.
    ///
    /// # Errors
    /// Why they are not.
    pub fn resolved(&self, first: usize) -> Result<(), Unknown> {
        resolved(&self.values(|sample| sample.transport_rate, first))
    }

    fn values(&self, value: impl Fn(&Sample) -> f64, first: usize) -> Vec<f64> {
        self.samples.iter().filter(|sample| sample.block >= first).map(value).collect()
    }

    /// Standard error of the transport rate over it, where it has one and there are samples enough to rely on it.
    #[must_use]
    pub fn precision(&self) -> Option<f64> {
        let (first, over) = self.transient();
        let blocks = self.samples.last()?.block + 1;
        let enough = over && blocks >= first + MIN_BLOCKS && self.samples.len() >= 80;
        let rate = self.mean(|sample| sample.transport_rate, first).filter(|_| enough)?;
        rate.stderr.ok().filter(|_| rate.mean > 0.0).map(|error| error / rate.mean)
    }

    /// Fluid per cell from block `first` on: means, and standard errors of them.
    #[must_use]
    pub fn fluid(&self, first: usize) -> Vec<[Estimate; FLUID]> {
        let blocks: Vec<&Block> = self.blocks[first..].iter().filter(|block| block.samples > 0.0).collect();
        let cells = self.blocks[0].sums.len();
        let enough = self.resolved(first);
        let one = |cell: usize, k: usize| {
            let values: Vec<f64> = blocks.iter().map(|block| block.sums[cell][k] / block.samples).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            Estimate { mean, stderr: enough.and_then(|()| of_blocks(&values, mean)) }
        };
        if blocks.is_empty() {
            return Vec::new();
        }
        (0..cells).map(|cell| std::array::from_fn(|k| one(cell, k))).collect()
    }

    /// Writes all samples.
    pub fn write(&self, to: &mut Writer) {
        to.whole(self.samples.len() as u64);
        self.samples.iter().flat_map(Sample::numbers).for_each(|x| to.number(x));
        self.save(to);
    }

    /// Reads what [`Self::write`] wrote, for `cells` cells.
    ///
    /// # Errors
    /// [`CheckpointError`] if it cannot be.
    pub fn read(from: &mut Reader<'_>, cells: usize) -> Result<Self, CheckpointError> {
        let mut record = Self::new(cells);
        for _ in 0..from.whole()? {
            let mut numbers = [0.0; 7];
            for x in &mut numbers {
                *x = from.number()?;
            }
            record.samples.push(Sample::of(numbers));
        }
        record.fill(from)?;
        Ok(record)
    }
}

impl Saved for Record {
    fn numbers(&mut self) -> Vec<&mut f64> {
        let mut all = Vec::new();
        for block in &mut self.blocks {
            all.push(&mut block.samples);
            all.extend(block.sums.iter_mut().flatten());
        }
        all
    }
}

/// Velocity, Reynolds stress, viscous stress, mixing length and eddy viscosity at the centres of the cells.
fn fluid(exchange: &Exchange) -> impl Iterator<Item = [f64; FLUID]> + '_ {
    let column = &exchange.column;
    let middle = |faces: &[f64], i: usize| 0.5 * (faces[i] + faces[i + 1]);
    let (faces, u) = (column.grid().faces(), column.velocity());
    (0..u.len()).map(move |i| {
        let reynolds = middle(column.tau_reynolds(), i);
        // R = rho nu_t du/dz over the cell, from its two faces.
        let (below, above) = (i.saturating_sub(1), (i + 1).min(u.len() - 1));
        let z = |i: usize| 0.5 * (faces[i] + faces[i + 1]);
        let slope = (u[above] - u[below]) / (z(above) - z(below));
        let eddy = if slope.abs() > 0.0 { reynolds / (column.setup().rho * slope) } else { 0.0 };
        [u[i], reynolds, middle(column.tau_viscous(), i), middle(column.mixing_length(), i), eddy]
    })
}

/// Index that the marginal standard error rule cuts at.
fn marginal(values: &[f64]) -> usize {
    let n = values.len();
    let (mut sum, mut square, mut best) = (0.0, 0.0, (f64::INFINITY, 0));
    for (i, x) in values.iter().enumerate().rev() {
        sum += x;
        square += x * x;
        let count = (n - i) as f64;
        let spread = (square - sum * sum / count).max(0.0) / (count * count);
        if 2 * i <= n && spread <= best.0 {
            best = (spread, i);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runtime::rng::Stream;

    /// An autoregressive series of correlation time `t` samples around 1.
    fn noise(n: u64, t: f64, seed: u64) -> Vec<f64> {
        let a = (-1.0 / t).exp();
        let mut x = 0.0;
        (0..n)
            .map(|i| {
                x = a * x + (1.0 - a * a).sqrt() * Stream::new([seed, 0, i]).normal_pair()[0];
                1.0 + 0.2 * x
            })
            .collect()
    }

    #[test]
    fn the_transient_is_cut_where_it_ends() {
        let values: Vec<f64> =
            noise(1000, 3.0, 1).into_iter().enumerate().map(|(i, x)| x + 4.0 * (-(i as f64) / 40.0).exp()).collect();
        let cut = marginal(&values);
        assert!((80..220).contains(&cut), "{cut}");
        assert!(marginal(&noise(1000, 3.0, 2)) < 300);
    }
}
