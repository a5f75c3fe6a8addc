//! The whole state as bytes, and back: a run that goes on from it makes the same bits as one that was never stopped.
//!
//! Layout, little-endian: magic, version, name of the case (32 bytes), length of the body, body, SHA-256 of all before.

use sha2::{Digest, Sha256};

use super::domain::Domain;
use super::engine::{Engine, Settings};
use super::grains::Grains;
use super::law::ContactLaw;
use super::simd::{Pair, Row};
use super::tile::{GROUP, Tile, WallList, cut};
use crate::numerics::sum::Sum;
use crate::result::CheckpointError;

const MAGIC: &[u8; 8] = b"bedload\x01";
/// Version of the layout.
pub const VERSION: u32 = 4;
const HEAD: usize = 8 + 4 + 32 + 8;
const DIGEST: usize = 32;

/// Writes numbers one after the other.
#[derive(Debug, Default)]
pub struct Writer(Vec<u8>);

impl Writer {
    /// A whole number.
    pub fn whole(&mut self, x: u64) {
        self.0.extend_from_slice(&x.to_le_bytes());
    }
    /// A number, bit by bit.
    pub fn number(&mut self, x: f64) {
        self.whole(x.to_bits());
    }
    fn rows(&mut self, rows: &[Row]) {
        self.whole(rows.len() as u64);
        rows.iter().flat_map(|row| row.0).for_each(|x| self.number(x));
    }
    fn words(&mut self, words: impl ExactSizeIterator<Item = u64>) {
        self.whole(words.len() as u64);
        words.for_each(|word| self.whole(word));
    }
    /// Words of 4 bytes.
    pub(super) fn half_words(&mut self, words: &[u32]) {
        self.whole(words.len() as u64);
        words.iter().for_each(|word| self.0.extend_from_slice(&word.to_le_bytes()));
    }
    /// The checkpoint of the case with the name `case`.
    #[must_use]
    pub fn seal(self, case: &[u8; 32]) -> Vec<u8> {
        let mut all = Vec::with_capacity(HEAD + self.0.len() + DIGEST);
        all.extend_from_slice(MAGIC);
        all.extend_from_slice(&VERSION.to_le_bytes());
        all.extend_from_slice(case);
        all.extend_from_slice(&(self.0.len() as u64).to_le_bytes());
        all.extend_from_slice(&self.0);
        let digest = Sha256::digest(&all);
        all.extend_from_slice(&digest);
        all
    }
}

/// Reads what [`Writer`] wrote.
#[derive(Debug)]
pub struct Reader<'a>(&'a [u8]);

type Read<T> = Result<T, CheckpointError>;

const SHORT: CheckpointError = CheckpointError::Corrupt { what: "the body ends too soon" };

impl<'a> Reader<'a> {
    /// Opens a checkpoint of the case with the name `case`.
    ///
    /// # Errors
    /// [`CheckpointError`] if it is none, another's, truncated or corrupt.
    pub fn open(bytes: &'a [u8], case: &[u8; 32]) -> Read<Self> {
        let field = |from: usize, to: usize| bytes.get(from..to);
        if field(0, 8) != Some(MAGIC) {
            return Err(CheckpointError::Foreign);
        }
        let truncated = |expected| CheckpointError::Truncated { found: bytes.len(), expected };
        let version = field(8, 12).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
        let version = version.ok_or_else(|| truncated(HEAD + DIGEST))?;
        if version != VERSION {
            return Err(CheckpointError::Version { found: version, reads: VERSION });
        }
        let length = field(44, 52).and_then(|b| b.try_into().ok()).map(u64::from_le_bytes);
        let length = length.ok_or_else(|| truncated(HEAD + DIGEST))?;
        let expected = usize::try_from(length).ok().and_then(|l| l.checked_add(HEAD + DIGEST));
        let expected = expected.ok_or(CheckpointError::Corrupt { what: "its length" })?;
        if bytes.len() < expected {
            return Err(truncated(expected));
        }
        if bytes.len() > expected {
            return Err(CheckpointError::Corrupt { what: "bytes follow its end" });
        }
        let (content, digest) = bytes.split_at(expected - DIGEST);
        if Sha256::digest(content).as_slice() != digest {
            return Err(CheckpointError::Corrupt { what: "its checksum" });
        }
        if field(12, 44) != Some(case) {
            return Err(CheckpointError::OtherCase);
        }
        Ok(Self(&content[HEAD..]))
    }

    /// A whole number.
    ///
    /// # Errors
    /// The body ends.
    pub fn whole(&mut self) -> Read<u64> {
        let (first, rest) = self.0.split_at_checked(8).ok_or(SHORT)?;
        self.0 = rest;
        first.try_into().map(u64::from_le_bytes).map_err(|_| SHORT)
    }
    /// A number.
    ///
    /// # Errors
    /// The body ends.
    pub fn number(&mut self) -> Read<f64> {
        self.whole().map(f64::from_bits)
    }
    /// A count of things that each take at least a word.
    fn count(&mut self) -> Read<usize> {
        let count = usize::try_from(self.whole()?).map_err(|_| SHORT)?;
        if count > self.0.len() / 8 { Err(SHORT) } else { Ok(count) }
    }
    fn rows(&mut self) -> Read<Vec<Row>> {
        let count = self.count()?;
        (0..count).map(|_| Ok(Row([self.number()?, self.number()?, self.number()?, self.number()?]))).collect()
    }
    fn words(&mut self) -> Read<Vec<u64>> {
        let count = self.count()?;
        (0..count).map(|_| self.whole()).collect()
    }
    /// Words of 4 bytes.
    pub(super) fn half_words(&mut self) -> Read<Vec<u32>> {
        let count = usize::try_from(self.whole()?).ok().and_then(|count| count.checked_mul(4)).ok_or(SHORT)?;
        let (words, rest) = self.0.split_at_checked(count).ok_or(SHORT)?;
        self.0 = rest;
        Ok(words.chunks_exact(4).map(|b| b.iter().rev().fold(0, |word, &b| word << 8 | u32::from(b))).collect())
    }
    /// Nothing may be left.
    ///
    /// # Errors
    /// [`CheckpointError::Corrupt`] if something is.
    pub fn close(self) -> Read<()> {
        if self.0.is_empty() { Ok(()) } else { Err(CheckpointError::Corrupt { what: "more than the state" }) }
    }
}

fn whole32(words: Vec<u64>) -> Read<Vec<u32>> {
    let narrow = |word| u32::try_from(word).map_err(|_| CheckpointError::Corrupt { what: "an index" });
    words.into_iter().map(narrow).collect()
}

/// Numbers of a kind that is saved one after the other.
pub trait Saved {
    /// Every number, in a fixed order.
    fn numbers(&mut self) -> Vec<&mut f64>;

    /// Writes them.
    fn save(&self, to: &mut Writer)
    where
        Self: Clone,
    {
        let mut copy = self.clone();
        let numbers = copy.numbers();
        to.whole(numbers.len() as u64);
        numbers.into_iter().for_each(|x| to.number(*x));
    }

    /// Reads them into what has as many.
    ///
    /// # Errors
    /// [`CheckpointError::Corrupt`] if their number differs.
    fn fill(&mut self, from: &mut Reader<'_>) -> Read<()> {
        let numbers = self.numbers();
        if from.count()? != numbers.len() {
            return Err(CheckpointError::Corrupt { what: "the averages" });
        }
        for x in numbers {
            *x = from.number()?;
        }
        Ok(())
    }
}

impl<C: ContactLaw> Engine<C> {
    /// Writes the whole state.
    pub fn save(&self, to: &mut Writer) {
        to.whole(self.step);
        to.number(self.way);
        let Settings { dt, gravity, skin, largest_overlap, lowest } = self.settings;
        for x in [dt, gravity[0], gravity[1], gravity[2], skin, largest_overlap, lowest] {
            to.number(x);
        }
        let count = self.grains.len();
        to.words(self.grains.ids.iter().map(|&id| u64::from(id)));
        for rows in [&self.grains.positions, &self.grains.velocities, &self.grains.spins] {
            to.rows(&rows[..count]);
        }
        to.rows(&self.reference);
        let l = &self.ledger;
        to.number(l.initial_kinetic);
        l.initial_momentum.into_iter().for_each(|x| to.number(x));
        for sum in [l.contacts, l.gravity, l.body].into_iter().chain(l.impulse).chain(l.bounds) {
            to.number(sum.value);
            to.number(sum.rest);
        }
        for tile in &self.tiles {
            to.words(tile.starts.iter().map(|&s| u64::from(s)));
            to.words(tile.pairs.iter().map(|p| u64::from(p.i) | u64::from(p.j) << 32));
            to.rows(&tile.springs);
            to.words(tile.touching.iter().map(|&b| u64::from(b)));
            to.whole(tile.reach as u64);
            to.words(tile.walls.grains.iter().copied());
            to.rows(&tile.walls.springs);
            to.words(tile.walls.ranges.iter().map(|r| r.start as u64));
            to.words(tile.walls.ranges.iter().map(|r| r.end as u64));
        }
    }

    /// Reads what [`Engine::save`] wrote; law and domain are those of the case.
    ///
    /// # Errors
    /// [`CheckpointError`] if what it says cannot be.
    pub fn restore(from: &mut Reader<'_>, domain: Domain, law: C, threads: usize) -> Read<Self> {
        let (step, way) = (from.whole()?, from.number()?);
        let dt = from.number()?;
        let gravity = [from.number()?, from.number()?, from.number()?];
        let settings =
            Settings { dt, gravity, skin: from.number()?, largest_overlap: from.number()?, lowest: from.number()? };
        let mut grains = Grains { ids: whole32(from.words()?)?, ..Grains::default() };
        (grains.positions, grains.velocities, grains.spins) = (from.rows()?, from.rows()?, from.rows()?);
        let reference = from.rows()?;
        let count = grains.len();
        let mut named = vec![false; count];
        let known =
            grains.ids.iter().all(|&id| named.get_mut(id as usize).is_some_and(|seen| !std::mem::replace(seen, true)));
        let lengths = [&grains.positions, &grains.velocities, &grains.spins, &reference].map(|rows| rows.len());
        if !known || lengths != [count; 4] || count == 0 {
            return Err(CheckpointError::Corrupt { what: "the grains" });
        }
        grains.pad();
        let mut engine = Self::bare(grains, domain, law, settings, threads);
        (engine.step, engine.way, engine.reference) = (step, way, reference);
        engine.ledger.initial_kinetic = from.number()?;
        engine.ledger.initial_momentum = [from.number()?, from.number()?, from.number()?];
        let mut sum = || -> Read<Sum> { Ok(Sum { value: from.number()?, rest: from.number()? }) };
        engine.ledger.contacts = sum()?;
        engine.ledger.gravity = sum()?;
        engine.ledger.body = sum()?;
        engine.ledger.impulse = [sum()?, sum()?, sum()?];
        engine.ledger.bounds = [sum()?, sum()?, sum()?];
        for range in cut(count) {
            let starts = whole32(from.words()?)?;
            let pairs = from.words()?.into_iter().map(|w| Pair { i: w as u32, j: (w >> 32) as u32 }).collect();
            let springs = from.rows()?;
            let touching = from.words()?.into_iter().map(|b| b as u8).collect();
            let reach = usize::try_from(from.whole()?).map_err(|_| SHORT)?;
            let (walls, wall_springs) = (from.words()?, from.rows()?);
            let (begins, ends) = (from.words()?, from.words()?);
            let ranges = begins.into_iter().zip(ends).map(|(a, b)| a as usize..b as usize).collect();
            let mut tile = Tile {
                grains: range,
                starts,
                pairs,
                springs,
                touching,
                walls: WallList {
                    touching: vec![u8::MAX; walls.len().div_ceil(GROUP)],
                    grains: walls,
                    springs: wall_springs,
                    ranges,
                },
                reach,
                ..Tile::default()
            };
            if !tile.is_sound(count) {
                return Err(CheckpointError::Corrupt { what: "the list of neighbours" });
            }
            engine.tiles.push(tile);
        }
        engine.lay_out();
        Ok(engine)
    }
}
