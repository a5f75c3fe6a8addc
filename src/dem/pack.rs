//! Beds to start from: fixed bottoms, and clouds that fall onto them.

use super::domain::{Domain, Wall};
use super::grains::Grain;
use crate::dem::Bottom;
use crate::dem::GrainBed;
use crate::runtime::rng::Stream;

/// Streams of random numbers that a scene uses.
const BOTTOM: u64 = 1;
const CLOUD: u64 = 2;

/// Periods and walls of a bed; the plane bottom is at z = 0.
#[must_use]
pub fn domain(bed: &GrainBed) -> Domain {
    let [length, width] = bed.size;
    let mut domain = Domain { periods: [Some(length), (!bed.side_walls).then_some(width)], walls: Vec::new() };
    if bed.bottom != Bottom::Steps {
        domain.walls.push(Wall::through([0.0; 3], [0.0, 0.0, 1.0]));
    }
    if bed.side_walls {
        for (y, inward) in [(0.0, 1.0), (width, -1.0)] {
            let wall = Wall::through([0.0, y, 0.0], [0.0, inward, 0.0]);
            domain.walls.push(Wall { rough: !bed.smooth_walls, ..wall });
        }
    }
    domain
}

/// Fixed grains side by side, elevations at random among -d/3, 0 and d/3; none on a plane.
#[must_use]
pub fn bottom(bed: &GrainBed) -> Vec<Grain> {
    let d = bed.d;
    if bed.bottom != Bottom::Steps {
        return Vec::new();
    }
    let along = (bed.size[0] / d).floor().max(1.0) as usize;
    let across = (bed.size[1] / d).floor().max(1.0) as usize;
    let spacing = [bed.size[0] / along as f64, bed.size[1] / across as f64];
    let mut grains = Vec::with_capacity(along * across);
    for n in 0..along * across {
        let mut stream = Stream::new([u64::from(bed.discrete.seed), BOTTOM, n as u64]);
        let step = (3.0 * stream.uniform()).floor() - 1.0;
        let (i, j) = (n % along, n / along);
        let at = [(i as f64 + 0.5) * spacing[0], (j as f64 + 0.5) * spacing[1], step * d / 3.0];
        grains.push(Grain { fixed: true, ..Grain::at_rest(at, 0.5 * d, bed.rho_p) });
    }
    grains
}

/// `bed.mobile` grains in loose layers above `floor` \[m], each a little off its place.
#[must_use]
pub fn cloud(bed: &GrainBed, floor: f64) -> Vec<Grain> {
    let d = bed.d;
    let span = if bed.side_walls { bed.size[1] - d } else { bed.size[1] };
    let along = (bed.size[0] / (1.12 * d)).floor().max(1.0) as usize;
    let across = if bed.side_walls {
        (span / (1.12 * d)).floor() as usize + 1
    } else {
        (span / (1.12 * d)).floor().max(1.0) as usize
    };
    let gaps = if bed.side_walls { (across - 1).max(1) } else { across };
    let spacing = [bed.size[0] / along as f64, span / gaps as f64];
    let mut grains = Vec::with_capacity(bed.mobile);
    for n in 0..bed.mobile {
        let mut stream = Stream::new([u64::from(bed.discrete.seed), CLOUD, n as u64]);
        let mut jitter = || 0.1 * (stream.uniform() - 0.5) * d;
        let layer = n / (along * across);
        let (i, j) = (n % along, n / along % across);
        let x = (i as f64 + 0.5) * spacing[0] + jitter();
        let y = if bed.side_walls {
            let centre = if across == 1 { 0.5 * span } else { j as f64 * spacing[1] };
            0.5 * d + (centre + jitter()).clamp(0.0, span.max(0.0))
        } else {
            (j as f64 + 0.5) * spacing[1] + jitter()
        };
        let z = floor + (layer as f64 + 1.0) * 1.12 * d + jitter();
        grains.push(Grain::at_rest([x, y, z], 0.5 * d, bed.rho_p));
    }
    grains
}

/// The grains of a resting bed whose centres are within three quarters of a diameter of `level` \[m], fixed, and moved so
/// that their mean is at 0. A slice of one diameter, as in the paper, has holes through which a grain can fall.
#[must_use]
pub fn slice(resting: &[Grain], level: f64, d: f64) -> Vec<Grain> {
    let inside = |g: &&Grain| (g.position[2] - level).abs() <= 0.75 * d;
    let mut fixed: Vec<Grain> = resting.iter().filter(inside).copied().collect();
    let mean = fixed.iter().map(|g| g.position[2]).sum::<f64>() / fixed.len().max(1) as f64;
    for grain in &mut fixed {
        let [x, y, z] = grain.position;
        *grain = Grain { fixed: true, ..Grain::at_rest([x, y, z - mean], grain.radius, grain.density) };
    }
    fixed
}
