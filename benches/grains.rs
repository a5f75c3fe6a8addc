//! Speed of the grain engine, and trajectories to hold against other codes.
//!
//! `grains <work> [key=value ...]`: `speed`, `scaling`, `callgrind`, `trajectory`. See docs/grains.md and compare_dem.py.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeMap;
use std::fs;
use std::process::Command;
use std::time::Instant;

use bedload::closures::contact::Tension;
use bedload::dem::body::{Body, GrainState, Pushed};
use bedload::dem::law::{Discrete, Lammps};
use bedload::dem::{Domain, Engine, Grain, LinearSpring, Point, Settings};

const D: f64 = 6e-3;
const DENSITY: f64 = 2500.0;
const GAMMA: f64 = 2562.0;
const LENGTH: [f64; 2] = [0.18, 0.132];

/// CPU seconds of the process so far.
fn cpu_seconds() -> f64 {
    let text = fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let own: f64 = text.split(' ').next().and_then(|t| t.parse().ok()).unwrap_or(f64::NAN);
    own * 1e-9
}

/// The bed that is committed: compressed, and read by the tool that everybody has.
const BED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/reference/dem_bed/bed_10046_spheres.csv.gz");

/// The text of a file, unpacked where its name says that it is packed.
fn text_of(file: &str) -> String {
    if !file.ends_with(".gz") {
        return fs::read_to_string(file).unwrap_or_else(|e| panic!("{file}: {e}"));
    }
    let unpacked = Command::new("gzip").args(["-dc", file]).output().unwrap_or_else(|e| panic!("gzip: {e}"));
    assert!(unpacked.status.success(), "{file}: {}", String::from_utf8_lossy(&unpacked.stderr));
    String::from_utf8(unpacked.stdout).unwrap()
}

/// The steady bed of `reference/dem_bed`, repeated `copies` times along x, fixed grains first.
fn bed(file: &str, copies: usize) -> Vec<Grain> {
    let text = text_of(file);
    let rows = text.lines().filter(|l| !l.starts_with('#') && !l.starts_with("id"));
    let mut grains = Vec::new();
    for row in rows {
        let x: Vec<f64> = row.split(',').map(|f| f.trim().parse().unwrap()).collect();
        for copy in 0..copies {
            grains.push(Grain {
                position: [x[1] + copy as f64 * LENGTH[0], x[2], x[3]],
                velocity: [x[4], x[5], x[6]],
                spin: [x[7], x[8], x[9]],
                radius: 0.5 * D,
                density: DENSITY,
                fixed: x[0] <= 660.0,
            });
        }
    }
    grains
}

fn engine(grains: &[Grain], copies: usize, threads: usize, own: bool) -> Engine<LinearSpring> {
    let mass = grains[0].mass();
    // LAMMPS damps with gamma_n times the reduced mass: zeta = gamma sqrt(m/(2 k_n))/2 for the pair.
    let zeta = 0.5 * GAMMA * (0.5 * mass / 5e3).sqrt();
    let lammps = (!own).then(|| Lammps { inverse_mass: 2.0 / mass });
    let law = LinearSpring {
        k_n: 5e3,
        k_s: 2.5e3,
        mu: 0.4,
        zeta,
        tension: Tension::Kept,
        lammps,
        discrete: Discrete::default(),
    };
    let domain = Domain { periods: [Some(copies as f64 * LENGTH[0]), Some(LENGTH[1])], walls: Vec::new() };
    let settings = Settings::new(1.8e-5, [0.0, 0.0, -9.81], D);
    Engine::new(grains, domain, law, settings, threads).unwrap()
}

const PUSHED: Pushed = Pushed { force: 3.05e-3, above: 0.06363283, drag: 2.774e-3 };

fn hash(engine: &Engine<LinearSpring>) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let grains = engine.grains();
    for place in grains.places() {
        for rows in [&grains.positions, &grains.velocities, &grains.spins] {
            for x in rows[place].0 {
                hash = (hash ^ x.to_bits()).wrapping_mul(0x100_0000_01b3);
            }
        }
    }
    hash
}

struct Options(BTreeMap<String, String>);

impl Options {
    fn number(&self, key: &str, default: usize) -> usize {
        self.0.get(key).map_or(default, |v| v.parse().unwrap_or_else(|_| panic!("{key}={v}")))
    }
    fn text(&self, key: &str, default: &str) -> String {
        self.0.get(key).cloned().unwrap_or_else(|| default.into())
    }
}

fn steps<B: Body>(engine: &mut Engine<LinearSpring>, body: &B, count: usize) {
    for _ in 0..count {
        engine.step(body).unwrap_or_else(|e| panic!("{e}"));
    }
}

/// Million particle-steps per CPU second and per second of wall time.
fn speed(options: &Options) {
    let (copies, threads) = (options.number("copies", 1), options.number("threads", 1));
    let count = options.number("steps", 3000);
    let grains = bed(&options.text("bed", BED), copies);
    let mobile = grains.iter().filter(|g| !g.fixed).count();
    let mut engine = engine(&grains, copies, threads, options.text("law", "lammps") == "own");
    engine.half_step(&PUSHED).unwrap();
    steps(&mut engine, &PUSHED, options.number("warm", 300));
    let (wall, cpu, lists) = (Instant::now(), cpu_seconds(), engine.rebuilds());
    steps(&mut engine, &PUSHED, count);
    let (wall, cpu) = (wall.elapsed().as_secs_f64(), cpu_seconds() - cpu);
    let work = (mobile * count) as f64 * 1e-6;
    println!(
        "grains {} mobile {mobile} threads {threads} steps {count} contacts {:.3} lists {} million_per_cpu_s {:.3} \
         million_per_s {:.3} bytes_per_grain {:.0} hash {:016x}",
        grains.len(),
        engine.found().contacts as f64 / mobile as f64,
        engine.rebuilds() - lists,
        work / cpu,
        work / wall,
        engine.memory() as f64 / grains.len() as f64,
        hash(&engine)
    );
}

/// The same from one thousand to one million grains.
fn scaling(options: &Options) {
    let file = options.text("bed", BED);
    for (copies, part, count) in [(1, 0.1, 10000), (1, 1.0, 3000), (10, 1.0, 300), (100, 1.0, 30)] {
        for threads in [1, 2] {
            let mut grains = bed(&file, copies);
            if part < 1.0 {
                // A tenth of the period: cut where the image begins, spaced so that the cut ends do not overlap much.
                grains.retain(|g| g.position[0] < part * LENGTH[0] - 0.5 * D);
            }
            let length = part * copies as f64;
            let mass = grains[0].mass();
            let zeta = 0.5 * GAMMA * (0.5 * mass / 5e3).sqrt();
            let law = LinearSpring {
                k_n: 5e3,
                k_s: 2.5e3,
                mu: 0.4,
                zeta,
                tension: Tension::Kept,
                lammps: None,
                discrete: Discrete::default(),
            };
            let domain = Domain { periods: [Some(length * LENGTH[0]), Some(LENGTH[1])], walls: Vec::new() };
            let settings = Settings { largest_overlap: 0.5, ..Settings::new(1.8e-5, [0.0, 0.0, -9.81], D) };
            let mut engine = Engine::new(&grains, domain, law, settings, threads).unwrap();
            steps(&mut engine, &PUSHED, count / 10);
            let wall = Instant::now();
            steps(&mut engine, &PUSHED, count);
            let work = (grains.len() * count) as f64 * 1e-6;
            println!(
                "grains {} threads {threads} million_per_s {:.3} bytes_per_grain {:.0}",
                grains.len(),
                work / wall.elapsed().as_secs_f64(),
                engine.memory() as f64 / grains.len() as f64
            );
        }
    }
}

/// Writes positions of all grains after `steps` steps, in the order of the bed.
fn trajectory(options: &Options) {
    let copies = options.number("copies", 1);
    let grains = bed(&options.text("bed", BED), copies);
    let mut engine = engine(&grains, copies, options.number("threads", 1), false);
    engine.half_step(&Region).unwrap();
    steps(&mut engine, &Region, options.number("steps", 300) - 1);
    let listed = engine.grains().listed();
    let mut text = String::new();
    for Grain { position: [x, y, z], .. } in listed {
        text += &format!("{x:.17e} {y:.17e} {z:.17e}\n");
    }
    fs::write(options.text("out", "bedload.txt"), text).unwrap();
    println!("hash {:016x}", hash(&engine));
}

/// The push as a region of LAMMPS: the level belongs to it.
struct Region;

impl Body for Region {
    fn force(&self, grain: &GrainState) -> Point {
        let push = if grain.position[2] >= PUSHED.above { PUSHED.force } else { 0.0 };
        let [u, v, w] = grain.velocity;
        [push - PUSHED.drag * u, -PUSHED.drag * v, -PUSHED.drag * w]
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let pairs = arguments.iter().filter_map(|a| a.split_once('='));
    let options = Options(pairs.map(|(k, v)| (k.to_owned(), v.to_owned())).collect());
    match arguments.first().map_or("speed", String::as_str) {
        "scaling" => scaling(&options),
        "trajectory" => trajectory(&options),
        _ => speed(&options),
    }
}
