//! A bed let fall onto its bottom and brought to rest.

use std::ops::ControlFlow;
use std::time::Instant;

use super::body::Pushed;
use super::checkpoint::{Reader, Writer};
use super::domain::Domain;
use super::engine::{Engine, Settings};
use super::error::RunError;
use super::grains::Grain;
use super::keep::law;
use super::law::LinearSpring;
use super::{pack, stability};
use crate::dem::Bottom;
use crate::dem::GrainBed;
use crate::result::CheckpointError;
use crate::result::{Context, Snapshot, SolveError};

/// Steps between two looks at the clock, the checkpoint and the wish to stop.
pub const BETWEEN: u64 = 64;
/// Kinetic energy per grain over m g d below which a bed has come to rest.
const AT_REST: f64 = 1e-6;
/// Step of the fall over the limit of one contact: more contacts come.
const FALLING: f64 = 0.35;
/// Step of the fall over the limit of strong damping in a packing.
const DAMPED: f64 = 0.7;

/// What a run is at: a checkpoint may be taken in each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// the bed falls of which a slice becomes the bottom
    Below,
    /// the bed falls
    Falling,
    /// it is tilted and followed
    Flowing,
}

impl Stage {
    const ALL: [Self; 3] = [Self::Below, Self::Falling, Self::Flowing];

    /// Its number in a checkpoint.
    #[must_use]
    pub fn number(self) -> u64 {
        self as u64
    }

    /// Reads it from a checkpoint.
    ///
    /// # Errors
    /// [`CheckpointError`] if it is none.
    pub fn read(from: &mut Reader<'_>) -> Result<Self, CheckpointError> {
        let number = from.whole()?;
        let stage = Self::ALL.into_iter().find(|stage| stage.number() == number);
        stage.ok_or(CheckpointError::Corrupt { what: "what the run was at" })
    }

    /// Periods and walls: a slice lies on the plane on which it was deposited, what falls onto it has no plane.
    #[must_use]
    pub fn domain(self, bed: &GrainBed) -> Domain {
        let bottom = match (self, bed.bottom) {
            (Self::Falling | Self::Flowing, Bottom::Slice) => Bottom::Steps,
            (_, bottom) => bottom,
        };
        pack::domain(&GrainBed { bottom, ..*bed })
    }
}

/// What is deposited.
#[derive(Clone, Copy, Debug)]
pub struct Deposit<'a> {
    /// the bed
    pub bed: &'a GrainBed,
    /// fixed grains of a rough bottom, in place of those that the bed itself would have
    pub fixed: Option<&'a [Grain]>,
    /// name of the case for its checkpoints
    pub name: &'a [u8; 32],
}

/// Deposits the bed, from the beginning or from where it was; stops where the watch wants it.
///
/// # Errors
/// The grain that cannot go on, or a checkpoint that cannot be written.
pub fn deposit(
    what: Deposit<'_>,
    mut half_way: Option<(Stage, Engine<LinearSpring>)>,
    context: &mut Context<'_>,
) -> Result<ControlFlow<(), Engine<LinearSpring>>, SolveError> {
    let Deposit { bed, fixed, .. } = what;
    let mut taken = |wanted: Stage| half_way.take_if(|(stage, _)| *stage == wanted).map(|(_, engine)| engine);
    let above = taken(Stage::Falling);
    let engine = match above {
        Some(engine) => engine,
        None => {
            let mut grains = fixed.map_or_else(|| pack::bottom(bed), <[Grain]>::to_vec);
            if bed.bottom == Bottom::Slice {
                // Six layers deposited on a plane; the slice is taken in their middle.
                let mobile = (6.0 * bed.size[0] * bed.size[1] / (bed.d * bed.d)).round() as usize;
                let few = GrainBed { mobile, ..*bed };
                let engine = match taken(Stage::Below) {
                    Some(engine) => engine,
                    None => begin(bed, Stage::Below, &pack::cloud(&few, 0.0), context.threads)?,
                };
                let ControlFlow::Continue(below) = settle(what, Stage::Below, engine, context)? else {
                    return Ok(ControlFlow::Break(()));
                };
                grains = pack::slice(&below.grains().listed(), 2.5 * bed.d, bed.d);
            }
            // Above the highest of the fixed grains.
            let floor = match bed.bottom {
                Bottom::Plane => 0.0,
                Bottom::Steps => 0.5 * bed.d,
                Bottom::Slice => bed.d,
            };
            grains.extend(pack::cloud(bed, floor));
            begin(bed, Stage::Falling, &grains, context.threads)?
        }
    };
    settle(what, Stage::Falling, engine, context)
}

/// Grains that are about to fall.
fn begin(bed: &GrainBed, stage: Stage, grains: &[Grain], threads: usize) -> Result<Engine<LinearSpring>, SolveError> {
    let law = law(&bed.contact)?;
    let mass = 0.5 * bed.mass();
    let derived = (FALLING * stability::of_pair(&law, mass)).min(DAMPED * stability::of_packing(&law, mass));
    let dt = bed.discrete.time_step.unwrap_or(f64::INFINITY).min(derived);
    let lowest = grains.iter().map(|g| g.position[2]).fold(0.0, f64::min) - 2.0 * bed.d;
    let settings = Settings { skin: bed.discrete.skin * bed.d, lowest, ..Settings::new(dt, [0.0, 0.0, -bed.g], bed.d) };
    Ok(Engine::new(grains, stage.domain(bed), law, settings, threads)?)
}

/// Lets grains fall until they rest.
fn settle(
    Deposit { bed, name, .. }: Deposit<'_>,
    stage: Stage,
    mut engine: Engine<LinearSpring>,
    context: &mut Context<'_>,
) -> Result<ControlFlow<(), Engine<LinearSpring>>, SolveError> {
    let mobile = (0..engine.grains().len()).filter(|&i| !engine.grains().is_fixed(i)).count();
    let mass = bed.mass();
    // A drag that lets grains fall at sqrt(g d): they land softly.
    let slow = Pushed { force: 0.0, above: f64::INFINITY, drag: mass * (bed.g / bed.d).sqrt() };
    let most = (bed.discrete.settle / engine.settings().dt).ceil() as u64;
    let rest = AT_REST * mass * bed.g * bed.d * mobile as f64;
    let (clock, begun) = (Instant::now(), engine.steps());
    while engine.steps() < most {
        for _ in 0..BETWEEN {
            engine.step(&slow)?;
        }
        // At the beginning the grains are at rest, too: then none touches.
        let found = engine.found();
        let supported = 2 * (found.contacts + found.wall_contacts) > mobile;
        if supported && engine.grains().kinetic_energy() < rest {
            break;
        }
        let fraction = engine.steps() as f64 / most as f64;
        let text = progress_text("falling", engine.steps() - begun, clock, most.saturating_sub(engine.steps()));
        let stop = context.watch.see(&Snapshot { stage: &text, fraction, quantity: None }).is_break();
        let mut content = || {
            let mut to = Writer::default();
            to.whole(stage.number());
            engine.save(&mut to);
            to.seal(name)
        };
        context.keep(stop, &mut content).map_err(RunError::File)?;
        if stop {
            return Ok(ControlFlow::Break(()));
        }
    }
    Ok(ControlFlow::Continue(engine))
}

/// What a run does, how fast, and how long it will take at most.
#[must_use]
pub fn progress_text(what: &str, made: u64, since: Instant, left: u64) -> String {
    let rate = made as f64 / since.elapsed().as_secs_f64().max(1e-9);
    let left = match left as f64 / rate.max(1e-9) {
        seconds if seconds < 120.0 => format!("{seconds:.0} s"),
        seconds if seconds < 7200.0 => format!("{:.0} min", seconds / 60.0),
        seconds => format!("{:.1} h", seconds / 3600.0),
    };
    format!("{what}, {rate:.0} steps/s, {left} left,")
}
