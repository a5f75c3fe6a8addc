//! The step loop: forces, kick and drift, a new list when grains have come far enough.
#![allow(unsafe_code, reason = "tiles and their grains go to threads, each to one")]

use super::body::Body;
use super::cells::Cells;
use super::domain::Domain;
use super::error::GrainError;
use super::forces::{self, ContactStep, Part, Touching};
use super::grains::{Grain, Grains, Point};
use super::integrate::{self, Lengths, Mover, Rows};
use super::law::ContactLaw;
use super::ledger::Ledger;
use super::neighbours::{self, Before, Surroundings};
use super::simd::{Backend, Load, Row};
use super::tile::{Moved, Tile, cut};
use crate::runtime::pool::{Parts, Pool};

/// How the grains are moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// time step \[s]
    pub dt: f64,
    /// gravity [m/s2]
    pub gravity: Point,
    /// listed pairs are nearer than the sum of their radii and this \[m]
    pub skin: f64,
    /// largest accepted overlap over the sum of the radii
    pub largest_overlap: f64,
    /// elevation below which a grain is lost \[m]
    pub lowest: f64,
}

impl Settings {
    /// Defaults for grains of diameter `d` \[m]: skin 0.15 d, overlaps to 0.2, nothing below.
    #[must_use]
    pub fn new(dt: f64, gravity: Point, d: f64) -> Self {
        Self { dt, gravity, skin: 0.15 * d, largest_overlap: 0.2, lowest: f64::NEG_INFINITY }
    }
}

/// Grains, their contacts, and the means to move them. One thread or many: the same bits.
#[derive(Debug)]
pub struct Engine<C> {
    pub(super) law: C,
    pub(super) domain: Domain,
    pub(super) settings: Settings,
    pub(super) grains: Grains,
    pub(super) tiles: Vec<Tile>,
    /// what acts on the grains, the rows of one tile after those of the other; zero between two steps
    pub(super) loads: Vec<Load>,
    /// positions when the list was made
    pub(super) reference: Vec<Row>,
    /// bound of the way of any grain since the list was made \[m]
    pub(super) way: f64,
    pub(super) step: u64,
    pub(super) ledger: Ledger,
    backend: Backend,
    pool: Pool,
    /// first tile of each thread, and the end
    bounds: Vec<usize>,
    moved: Vec<Moved>,
    pub(super) former: Vec<Tile>,
    cells: Cells,
    order: Vec<u32>,
    rebuilds: u64,
    scratch: Vec<Touching>,
}

/// Most grains: indices are 32-bit words.
const MAX_GRAINS: usize = 1 << 30;

impl<C: ContactLaw> Engine<C> {
    /// Grains at the beginning, with no contact made yet.
    ///
    /// # Errors
    /// [`GrainError`] if the domain cannot hold them.
    pub fn new(
        grains: &[Grain],
        domain: Domain,
        law: C,
        settings: Settings,
        threads: usize,
    ) -> Result<Self, GrainError> {
        if grains.is_empty() || grains.len() > MAX_GRAINS {
            return Err(GrainError::Count { count: grains.len(), limit: MAX_GRAINS });
        }
        let mut engine = Self::bare(Grains::new(grains), domain, law, settings, threads);
        let least = 2.0 * (2.0 * engine.grains.largest_radius() + settings.skin);
        for (axis, period) in ['x', 'y'].into_iter().zip(engine.domain.periods) {
            if let Some(length) = period.filter(|&l| l.is_nan() || l <= least) {
                return Err(GrainError::PeriodTooShort { axis, length, least });
            }
        }
        engine.look_for_madness(true)?;
        engine.rebuild();
        engine.begin_ledger();
        Ok(engine)
    }

    /// Grains without a list.
    pub(super) fn bare(grains: Grains, domain: Domain, law: C, settings: Settings, threads: usize) -> Self {
        let law = law.for_step(settings.dt, grains.inverse_masses());
        let pool = Pool::new(threads);
        let scratch = vec![Touching::default(); pool.threads()];
        Self {
            law,
            domain,
            settings,
            grains,
            tiles: Vec::new(),
            loads: Vec::new(),
            reference: Vec::new(),
            way: 0.0,
            step: 0,
            ledger: Ledger::default(),
            backend: Backend::choose(),
            bounds: vec![0; pool.threads() + 1],
            pool,
            moved: Vec::new(),
            former: Vec::new(),
            cells: Cells::default(),
            order: Vec::new(),
            rebuilds: 0,
            scratch,
        }
    }

    /// The same with the instructions of `backend`.
    #[must_use]
    pub fn with_backend(mut self, backend: Backend) -> Self {
        self.backend = backend;
        self
    }

    /// Makes one step: velocities go from t - dt/2 to t + dt/2, positions from t to t + dt.
    ///
    /// # Errors
    /// [`GrainError`] with the grain that cannot go on; the step is made, and the state is not to be used.
    pub fn step<B: Body>(&mut self, body: &B) -> Result<(), GrainError> {
        let dt = self.settings.dt;
        self.advance(body, dt, Lengths { kick: dt, drift: dt })
    }

    /// The first step from velocities at t = 0 instead of -dt/2: half a kick by forces whose springs do not follow.
    ///
    /// # Errors
    /// As [`Engine::step`].
    pub fn half_step<B: Body>(&mut self, body: &B) -> Result<(), GrainError> {
        let dt = self.settings.dt;
        self.advance(body, 0.0, Lengths { kick: 0.5 * dt, drift: dt })
    }

    fn advance<B: Body>(&mut self, body: &B, spring_dt: f64, lengths: Lengths) -> Result<(), GrainError> {
        self.forces(spring_dt);
        let deepest = self.tiles.iter().fold(0.0, |deepest: f64, tile| tile.found.overlap.max(deepest));
        // Also true for NaN.
        let shallow = deepest <= self.settings.largest_overlap;
        if !shallow {
            return Err(self.overlap_error());
        }
        self.kick_and_drift(body, lengths);
        self.step += 1;
        let (mut fastest, mut sane) = (0.0, 0.0);
        for moved in &self.moved {
            if moved.fastest > fastest {
                fastest = moved.fastest;
            }
            sane += moved.sane;
            self.ledger.add(moved);
        }
        for tile in &self.tiles {
            self.ledger.add_walls(tile.found.walls, lengths.kick);
        }
        if sane != 0.0 {
            return self.look_for_madness(false);
        }
        self.way += fastest.sqrt() * lengths.drift;
        if 2.0 * self.way > self.settings.skin {
            self.way = self.farthest();
            // Fixed grains may move, too, with a given velocity; their way is in `farthest` but not in `fastest`.
            if 2.0 * self.way > 0.9 * self.settings.skin {
                self.look_for_madness(true)?;
                self.rebuild();
            }
        }
        Ok(())
    }

    /// Computes what acts on every grain.
    pub(super) fn forces(&mut self, dt: f64) {
        let Self { law, domain, grains, tiles, loads, backend, pool, bounds, scratch, .. } = self;
        let step = ContactStep { law, domain, grains, dt };
        let (tiles, loads, scratch) = (Parts::new(tiles), Parts::new(loads), Parts::new(scratch));
        pool.each(bounds, |thread, t| {
            // SAFETY: each tile with its rows, and each thread, is a part of its own.
            let (tile, scratch) = unsafe { (tiles.part(t..t + 1), scratch.part(thread..thread + 1)) };
            let tile = &mut tile[0];
            // SAFETY: as above.
            let loads = unsafe { loads.part(tile.loads.clone()) };
            forces::compute(*backend, step, Part { tile, loads }, &mut scratch[0]);
        });
    }

    fn kick_and_drift<B: Body>(&mut self, body: &B, lengths: Lengths) {
        let Self { grains, tiles, loads, moved, backend, pool, bounds, settings, .. } = self;
        let mover = Mover { gravity: settings.gravity, body, step: lengths };
        let (count, tiles, loads) = (grains.len(), tiles.as_slice(), Parts::new(loads));
        let results = Parts::new(moved);
        let positions = Parts::new(&mut grains.positions);
        let velocities = Parts::new(&mut grains.velocities);
        let spins = Parts::new(&mut grains.spins);
        let ids = &grains.ids;
        pool.each(bounds, |_, t| {
            let range = tiles[t].grains.clone();
            let own = tiles[t].loads.start..tiles[t].loads.start + range.len();
            // SAFETY: tiles are disjoint, and each is a part of its own; so are the rows of loads of its grains in all tiles.
            let (rows, result) = unsafe {
                let own = loads.part(own);
                for other in tiles {
                    for (rows, grains) in other.rows_of(&range, count) {
                        let (from, to) = (grains.start - range.start, grains.end - range.start);
                        integrate::gather(*backend, &mut own[from..to], loads.part(rows));
                    }
                }
                let rows = Rows {
                    loads: own,
                    positions: positions.part(range.clone()),
                    velocities: velocities.part(range.clone()),
                    spins: spins.part(range.clone()),
                    ids: &ids[range],
                };
                (rows, results.part(t..t + 1))
            };
            result[0] = integrate::advance(*backend, mover, rows);
        });
    }

    /// Longest way of a grain since the list was made \[m].
    fn farthest(&self) -> f64 {
        let squared =
            |(now, then): (&Row, &Row)| (0..3).map(|k| (now.0[k] - then.0[k]) * (now.0[k] - then.0[k])).sum::<f64>();
        let rows = self.grains.positions[..self.grains.len()].iter().zip(&self.reference);
        rows.map(squared).fold(0.0, f64::max).sqrt()
    }

    /// Sorts the grains and lists their neighbours anew; springs stay with their contacts.
    fn rebuild(&mut self) {
        let reach = 2.0 * self.grains.largest_radius() + self.settings.skin;
        self.cells.sort(&mut self.grains, &self.domain, reach, &mut self.order);
        self.reference.clear();
        self.reference.extend_from_slice(&self.grains.positions[..self.grains.len()]);
        self.way = 0.0;
        self.rebuilds += 1;
        let ranges = cut(self.grains.len());
        std::mem::swap(&mut self.tiles, &mut self.former);
        self.tiles.resize_with(ranges.len(), Tile::default);
        self.moved.resize(ranges.len(), Moved::default());
        for (tile, range) in self.tiles.iter_mut().zip(ranges) {
            tile.grains = range;
        }
        let Self { grains, cells, domain, former, order, settings, tiles, pool, backend, .. } = self;
        let before = Before { tiles: former, order };
        let count = tiles.len();
        let even: Vec<usize> = (0..=pool.threads()).map(|k| k * count / pool.threads()).collect();
        let parts = Parts::new(tiles);
        pool.each(&even, |_, t| {
            // SAFETY: each tile is a part of its own.
            let tile = &mut unsafe { parts.part(t..t + 1) }[0];
            let around = Surroundings { grains, cells, domain, skin: settings.skin, before };
            neighbours::list(*backend, tile, around);
            let sound = tile.is_sound(grains.len());
            debug_assert!(sound, "a list that was just made is sound");
        });
        self.lay_out();
    }

    /// Gives each tile its rows of loads, and each thread tiles.
    pub(super) fn lay_out(&mut self) {
        let mut end = 0;
        for tile in &mut self.tiles {
            tile.loads = end..end + tile.reach;
            end += tile.reach;
        }
        self.loads.clear();
        self.loads.resize(end, Load::default());
        self.share();
    }

    /// Gives each thread tiles with about as much work.
    fn share(&mut self) {
        let work: Vec<usize> = self
            .tiles
            .iter()
            .map(|tile| 2 * tile.pairs.len() + 6 * tile.grains.len() + tile.walls.grains.len())
            .collect();
        let total: usize = work.iter().sum();
        let threads = self.pool.threads();
        self.moved.resize(self.tiles.len(), Moved::default());
        self.bounds.clear();
        self.bounds.push(0);
        let (mut tile, mut done) = (0, 0);
        for k in 1..threads {
            while tile < work.len() && (2 * done + work[tile]) * threads <= 2 * k * total {
                done += work[tile];
                tile += 1;
            }
            self.bounds.push(tile);
        }
        self.bounds.push(work.len());
    }

    /// Goes on with another step or gravity; the skin stays.
    pub fn change(&mut self, dt: f64, gravity: Point) {
        self.settings.dt = dt;
        self.law = self.law.for_step(dt, self.grains.inverse_masses());
        self.settings.gravity = gravity;
    }

    /// Freezes the grains whose centres are below `level` \[m] and releases the others, but for the first `fixed` of the scene. The
    /// kinetic energy and momentum of grains that freeze go to the ground; springs between two of them are dropped.
    /// Whether any was frozen or released.
    pub fn freeze_below(&mut self, level: f64, fixed: usize) -> bool {
        let mut changed = false;
        for i in (0..self.grains.len()).filter(|&i| self.grains.ids[i] as usize >= fixed) {
            let (below, frozen) = (self.grains.position(i)[2] < level, self.grains.is_fixed(i));
            if below == frozen {
                continue;
            }
            changed = true;
            let mass = self.grains.mass(i);
            if below {
                self.ledger.contacts.add(-self.grains.kinetic_energy_of(i));
                for (sum, v) in self.ledger.bounds.iter_mut().zip(self.grains.velocity(i)) {
                    sum.add(-mass * v);
                }
                self.grains.velocities[i] = Row([0.0, 0.0, 0.0, mass]);
                self.grains.spins[i] = Row::default();
            } else {
                self.grains.spins[i].0[3] = 1.0 / mass;
            }
        }
        if changed {
            self.rebuild();
        }
        changed
    }

    /// Restarts the balances of energy and momentum.
    pub fn begin_ledger(&mut self) {
        self.ledger.begin(self.grains.kinetic_energy(), self.grains.momentum());
    }

    /// The grains, in the order of the list.
    #[must_use]
    pub fn grains(&self) -> &Grains {
        &self.grains
    }

    /// Steps made.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Lists made.
    #[must_use]
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }

    /// How the grains are moved.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Periods and walls.
    #[must_use]
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// Energies and impulses so far.
    #[must_use]
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }
}
