//! Grains and fluid against each other: terminal velocity, momentum, steady states, restarts.

use super::exchange::Exchange;
use super::fluid_at_grains::FluidAtGrains;
use super::record::{Record, Sample};
use super::run;
use super::run::Run;
use super::start::{gravity, level, relief};
use crate::closures::contact::{LinearSpring, Tension};
use crate::closures::drag::DallavalleGrain;
use crate::closures::fluctuation::{Fluctuation, RandomWalk};
use crate::closures::mixing_length::{BelowPacked, LiSawamoto, MixingLength};
use crate::closures::mixture_viscosity::MixtureViscosity;
use crate::closures::side_wall::SideWall;
use crate::dem::Bottom;
use crate::dem::GrainBed;
use crate::dem::deposit::{Deposit, deposit};
use crate::dem::domain::Domain;
use crate::dem::drive::{self, HalfWay, accepts};
use crate::dem::engine::{Engine, Settings};
use crate::dem::grains::Grain;
use crate::dem::keep::law;
use crate::models::coupled::{Coupled, Relief, Surface};
use crate::result::{Checkpoints, Context, Quiet, Status, quantity as q};
use approx::assert_relative_eq;
use std::ops::ControlFlow;

const D: f64 = 6e-3;

pub(super) fn flow() -> Coupled {
    let discrete = crate::models::coupled::case::CoupledDiscrete {
        duration: 0.4,
        known_to: None,
        coupling_period: 1e-2,
        fluid_steps: 1,
        fluid_scheme: crate::models::coupled::FluidScheme::Implicit,
        sample_period: 2e-2,
        settle: 1.0,
        time_step: None,
        force_time_step: false,
        freeze_below: None,
        freeze_period: 0.2,
        freeze_after: 0.0,
        safety: 0.7,
        skin: 0.3,
        slice: 1.0 / 30.0,
        seed: 1,
        frames: 0,
    };
    Coupled {
        bed: GrainBed {
            d: D,
            rho_p: 2500.0,
            mobile: 108,
            bottom: Bottom::Steps,
            size: [6.0 * D, 6.0 * D],
            side_walls: false,
            smooth_walls: false,
            beta: 0.1_f64.atan(),
            g: 9.81,
            contact: LinearSpring { k_n: 5e3, k_s: 2.5e3, mu: 0.4, e_n: 0.5, tension: Tension::Cut },
            discrete: discrete.grains(),
        },
        relief: Relief { largest: 2.75e-3, step: 0.5e-3 },
        rho_f: 1000.0,
        eta: 1e-3,
        surface: Surface::Height(6.0 * D),
        drag: DallavalleGrain { constant: 0.4, exponent: 3.1 },
        mixing_length: MixingLength::LiSawamoto(LiSawamoto {
            kappa: 0.41,
            phi_max: 0.61,
            below_packed: BelowPacked::Published,
        }),
        viscosity: MixtureViscosity::Clear,
        side_wall: SideWall::None,
        fluctuation: Fluctuation::RandomWalk(RandomWalk { spanwise: false, per_porosity: true }),
        coupling_period: 1e-2,
        fluid_steps: 1,
        freeze: None,
        fluid_scheme: crate::models::coupled::FluidScheme::Implicit,
        sample_period: 2e-2,
        known_to: None,
    }
}

/// Grains far from each other on a lattice of two diameters, without gravity.
fn sparse(density: f64, dt: f64, layers: usize) -> Engine<crate::dem::LinearSpring> {
    let mut grains = Vec::new();
    for n in 0..9 * layers {
        let (i, j, k) = (n % 3, n / 3 % 3, n / 9);
        let at = [(2 * i) as f64 * D, (2 * j) as f64 * D, (0.6 + 1.3 * k as f64) * D];
        grains.push(Grain::at_rest(at, 0.5 * D, density));
    }
    let domain = Domain { periods: [Some(6.0 * D), Some(6.0 * D)], walls: Vec::new() };
    Engine::new(&grains, domain, law(&flow().bed.contact).unwrap(), Settings::new(dt, [0.0; 3], D), 1).unwrap()
}

#[test]
fn the_slope_of_the_drag_is_its_derivative() {
    let law = DallavalleGrain { constant: 0.4, exponent: 3.1 };
    let at = |u: f64| {
        let mut at_grains = FluidAtGrains::new(law, law.viscous(1e-6, D), 4, D, 1);
        at_grains.velocity.fill(u);
        at_grains.size.fill(law.size(0.3, 1000.0, D));
        at_grains.set_fluctuation(0, [0.02, 0.0, -0.01]);
        at_grains.drag(0, 0.5 * D, [0.3, 0.05, 0.02])
    };
    for u in [0.1, 0.28, 0.5, 1.0] {
        let numerical = (at(u + 1e-6).force[0] - at(u - 1e-6).force[0]) / 2e-6;
        assert_relative_eq!(at(u).slope, numerical, max_relative = 1e-7);
    }
    assert!(at(0.28).force[0].abs() < 1e-15);
}

#[test]
fn the_whole_weight_pulls_along_the_flow_and_the_submerged_one_normal_to_it() {
    let [x, y, z] = gravity(&flow());
    let cosine = 1.0 / 1.01_f64.sqrt();
    assert_relative_eq!(x, 9.81 * 0.1 * cosine, max_relative = 1e-14);
    assert_relative_eq!(z, -9.81 * 0.6 * cosine, max_relative = 1e-14);
    assert_eq!(y, 0.0);
}

#[test]
fn there_is_no_drag_above_the_surface() {
    let law = DallavalleGrain { constant: 0.4, exponent: 3.1 };
    let mut at_grains = FluidAtGrains::new(law, law.viscous(1e-6, D), 4, D, 1);
    at_grains.velocity[..4].fill(1.0);
    at_grains.size[..4].fill(law.size(0.0, 1000.0, D));
    let at = |z: f64| at_grains.drag(0, z, [0.0; 3]).force[0];
    assert!(at(3.99 * D) > 0.0 && at(-0.2 * D) > 0.0);
    assert_eq!((at(4.01 * D), at(1e3 * D)), (0.0, 0.0));
}

#[test]
fn what_the_grains_are_averaged_to_is_exact() {
    let case = flow();
    let moving = |n: usize| {
        let at = [2.0 * (n % 3) as f64 * D, 2.0 * (n / 3) as f64 * D, 0.77 * D];
        Grain { velocity: [0.1 * n as f64, 0.0, 0.0], ..Grain::at_rest(at, 0.5 * D, 2500.0) }
    };
    let grains: Vec<Grain> = (0..9).map(moving).collect();
    let domain = Domain { periods: [Some(6.0 * D), Some(6.0 * D)], walls: Vec::new() };
    let engine =
        Engine::new(&grains, domain, law(&case.bed.contact).unwrap(), Settings::new(1e-4, [0.0; 3], D), 1).unwrap();
    let mut exchange = Exchange::new(&case, 4.0 * D, 9).unwrap();
    exchange.average(&engine, 0.0);
    let (h, area, pi) = (exchange.cell_height(), 36.0 * D * D, std::f64::consts::PI);
    let (phi, volume) = (exchange.phi(), pi / 6.0 * D.powi(3));
    assert_relative_eq!(phi.iter().sum::<f64>() * h * area, 9.0 * volume, max_relative = 1e-12);
    assert_relative_eq!(exchange.rate(), volume * 3.6 / area, max_relative = 1e-12);
    let mut shallow = Exchange::new(&case, D, 9).unwrap();
    shallow.average(&engine, 0.0);
    assert!(shallow.phi().iter().sum::<f64>() * shallow.cell_height() * area < 8.9 * volume);
    assert_eq!(shallow.rate(), exchange.rate(), "a grain counts as a whole, whatever of it is under water");
    // Within a cell the section is a parabola: Simpson's rule is exact.
    let section = |z: f64| 9.0 * pi * (0.25 * D * D - (z - 0.77 * D).powi(2));
    for i in (0..phi.len()).filter(|&i| i as f64 * h > 0.27 * D && (i + 1) as f64 * h < 1.27 * D) {
        let [low, middle, high] = [0.0, 0.5, 1.0].map(|x| section((i as f64 + x) * h));
        assert_relative_eq!(phi[i], (low + 4.0 * middle + high) / 6.0 / area, max_relative = 1e-10);
    }
}

#[test]
fn eddies_turn_over_with_the_water_and_differ_from_grain_to_grain() {
    let case = flow();
    let fixed = relief(&case);
    let what = Deposit { bed: &case.bed, fixed: Some(&fixed), name: &[0; 32] };
    let Ok(ControlFlow::Continue(engine)) = deposit(what, None, &mut Context::new(&mut Quiet)) else {
        panic!("the bed does not rest");
    };
    let mut run = <Run<'_> as drive::Flow<'_>>::begin(&case, engine).unwrap();
    let [_, depth, speed] = run.water();
    assert!(depth > 0.5 * D && depth < 6.0 * D && speed > 0.05, "{depth} {speed}");
    let mut eddies = || {
        run.resample_fluctuations();
        assert_eq!(run.until_draw, (depth / speed / run.engine.settings().dt).round() as u64);
        let carried: Vec<f64> = run.exchange.at_grains.carried().collect();
        carried.chunks(4).map(|c| [c[0], c[1], c[2]]).collect::<Vec<_>>()
    };
    let (first, second) = (eddies(), eddies());
    let moved = |e: &[f64; 3]| e[0] != 0.0;
    assert!(first.iter().filter(|e| moved(e)).count() > 30);
    for (i, (a, b)) in first.iter().zip(&second).enumerate().filter(|(_, (a, b))| moved(a) && moved(b)) {
        assert!(a != b && first[..i].iter().all(|c| c != a), "grain {i} has the eddy of another, or the former one");
        assert_eq!((a[1], b[1]), (0.0, 0.0));
    }
}

#[test]
fn a_grain_settles_at_the_terminal_velocity() {
    // w_s where the drag is the submerged weight, in a fluid at rest; the first-order start has died out.
    let case = Coupled { bed: GrainBed { beta: 0.0, ..flow().bed }, surface: Surface::Height(90.0 * D), ..flow() };
    let dt = 1e-4;
    let g = 9.81 * (1.0 - 1000.0 / 2500.0);
    let domain = Domain { periods: [Some(6.0 * D), Some(6.0 * D)], walls: Vec::new() };
    let grain = Grain::at_rest([0.0, 0.0, 85.0 * D], 0.5 * D, 2500.0);
    let settings = Settings::new(dt, [0.0, 0.0, -g], D);
    let mut engine = Engine::new(&[grain], domain, law(&case.bed.contact).unwrap(), settings, 1).unwrap();
    let mut exchange = Exchange::new(&case, 90.0 * D, 1).unwrap();
    exchange.average(&engine, 0.0);
    // A single grain in so small a box is not dilute: the hindrance of clear water.
    exchange.at_grains.size[..].fill(case.drag.size(0.0, 1000.0, D));
    for _ in 0..7000 {
        engine.step(&exchange.at_grains).unwrap();
    }
    let weight = std::f64::consts::PI / 6.0 * D.powi(3) * 1500.0 * 9.81;
    let (mut low, mut high) = (0.0, 2.0);
    for _ in 0..60 {
        let w = 0.5 * (low + high);
        let drag = case.drag.size(0.0, 1000.0, D) * case.drag.rate(w, case.drag.viscous(1e-6, D)) * w;
        if drag < weight { low = w } else { high = w }
    }
    assert_relative_eq!(-engine.grains().velocity(0)[2], low, max_relative = 1e-6);
}

#[test]
fn any_coupling_period_leads_to_the_same_flow_through_grains_that_cannot_move() {
    // So heavy that nothing moves them: what the fluid loses they get, all of it through the residual impulse.
    let case = flow();
    let top = 8.0 * D;
    let dt = 1e-3;
    let engine = sparse(1e12, dt, 4);
    let mut steady = Exchange::new(&case, top, engine.grains().len()).unwrap();
    steady.begin(&engine).unwrap();
    let fastest = steady.column.velocity().iter().copied().fold(0.0, f64::max);
    assert!(fastest > 0.1, "{fastest}");
    for (period, time) in [(1e-2, 60.0), (1e-1, 60.0), (1.0, 200.0)] {
        let mut engine = sparse(1e12, dt, 4);
        let mut exchange = Exchange::new(&case, top, engine.grains().len()).unwrap();
        for _ in 0..(time / period) as usize {
            exchange.average(&engine, dt);
            // The drag does not change while the grains rest: one step of the whole period.
            engine.step(&exchange.at_grains).unwrap();
            exchange.at_grains.repeat(period / dt);
            exchange.advance(period, 1).unwrap();
        }
        exchange.average(&engine, dt);
        assert!(exchange.defect().abs() < 1e-12, "{period}: {}", exchange.defect());
        for (u, v) in exchange.column.velocity().iter().zip(steady.column.velocity()) {
            assert!((u - v).abs() < 1e-4 * fastest, "{period}: {u} for {v}");
        }
    }
}

#[test]
fn what_the_fluid_loses_the_grains_get() {
    let case = flow();
    let dt = 1e-4;
    let mut engine = sparse(2500.0, dt, 4);
    let mut exchange = Exchange::new(&case, 8.0 * D, engine.grains().len()).unwrap();
    exchange.begin(&engine).unwrap();
    let before = engine.grains().momentum()[0];
    for _ in 0..50 {
        exchange.average(&engine, dt);
        for _ in 0..100 {
            engine.step(&exchange.at_grains).unwrap();
        }
        let inertia = |e: &Exchange| {
            let cells = e.phi().iter().zip(e.column.velocity());
            cells.map(|(phi, u)| 1000.0 * (1.0 - phi) * e.cell_height() * u).sum::<f64>()
        };
        let (before, net) = (inertia(&exchange), exchange.totals[0].total());
        exchange.advance(1e-2, 1).unwrap();
        // What drives the fluid, less what the bottom holds back and what it lost to the grains.
        let slope = 0.1 / 1.01_f64.sqrt();
        let water: f64 = exchange.phi().iter().map(|phi| (1.0 - phi) * exchange.cell_height()).sum();
        let bottom = exchange.column.tau_viscous()[0] + exchange.column.tau_reynolds()[0];
        let impulse = 1e-2 * (1000.0 * 9.81 * slope * water - bottom) - (exchange.totals[0].total() - net);
        assert!((inertia(&exchange) - before - impulse).abs() < 1e-9 * before, "{impulse}");
    }
    exchange.average(&engine, dt);
    assert!(exchange.defect().abs() < 1e-12, "{}", exchange.defect());
    // Nothing else acts along x: what was given is the momentum of the grains.
    let area = 36.0 * D * D;
    let gained = engine.grains().momentum()[0] - before;
    assert!(gained > 1e-4);
    assert_relative_eq!(exchange.totals[1].total() * area, gained, max_relative = 1e-10);
}

/// Keeps the checkpoint of one moment, and goes on.
struct At {
    calls: usize,
    wanted: usize,
    bytes: Vec<u8>,
}

impl Checkpoints for At {
    fn keep(&mut self, _: bool, content: &mut dyn FnMut() -> Vec<u8>) -> std::io::Result<()> {
        self.calls += 1;
        if self.calls == self.wanted {
            self.bytes = content();
        }
        Ok(())
    }

    fn resumed(&mut self) -> Option<Vec<u8>> {
        None
    }
}

#[test]
fn a_run_that_goes_on_makes_the_same_bits() {
    let case = flow();
    let fixed = relief(&case);
    let what = Deposit { bed: &case.bed, fixed: Some(&fixed), name: &[0; 32] };
    let Ok(ControlFlow::Continue(engine)) = deposit(what, None, &mut Context::new(&mut Quiet)) else {
        panic!("the bed does not rest");
    };
    let mut whole = drive::Run::<Run<'_>>::begin(&case, engine).unwrap();
    let mut at = At { calls: 0, wanted: 17, bytes: Vec::new() };
    whole.follow(&mut Context::new(&mut Quiet).checkpoints(&mut at)).unwrap();
    assert_eq!(at.calls, 40);
    let middle = at.bytes;
    for threads in [1, 2] {
        let half_way = drive::resume::<Run<'_>>(&case, &middle, threads);
        let Ok(HalfWay::Flowing(mut resumed)) = half_way else { panic!("not resumed") };
        resumed.follow(&mut Context::new(&mut Quiet)).unwrap();
        assert!(resumed.checkpoint() == whole.checkpoint(), "{threads} threads");
    }
    let mut damaged = middle.clone();
    damaged[1000] ^= 1;
    assert!(accepts(&case, &middle).is_ok() && accepts(&case, &damaged).is_err());
    assert!(accepts(&Coupled { eta: 2e-3, ..case }, &middle).is_err());
    assert!(accepts(&case, &middle[..middle.len() - 9]).is_err());
}

#[test]
fn a_flow_over_a_small_bed_carries_grains_and_closes_its_balances() {
    let outcome = run(&flow(), &mut Context::new(&mut Quiet)).unwrap();
    assert_eq!(outcome.status, Status::Done);
    let result = |quantity: &crate::result::Quantity| outcome.results.get(quantity.name).unwrap();
    assert!(result(&q::TRANSPORT_RATE) > 0.0);
    assert_relative_eq!(
        result(&q::TRANSPORT_RATE_BEADS),
        result(&q::TRANSPORT_RATE) * 6.0 * D / (std::f64::consts::PI / 6.0 * D.powi(3)),
        max_relative = 1e-12
    );
    for balance in &outcome.balances {
        assert!(balance.relative.abs() < 1e-12, "{} {}", balance.name, balance.relative);
    }
    let profile = outcome.profile.unwrap();
    // Most of the grains lie below the surface: their volume over the area.
    let z = profile.axis();
    let phi: f64 = profile.get(&q::PHI).unwrap().iter().flatten().sum::<f64>() * (z[1] - z[0]);
    let whole = 108.0 * std::f64::consts::PI / 6.0 * D / 36.0;
    assert!(phi > 0.98 * whole && phi < 1.2 * whole, "{phi} {whole}");
    // The flux in the moments of the samples, the rate in all periods.
    let flux: f64 = profile.get(&q::FLUX).unwrap().iter().flatten().sum::<f64>() * (z[1] - z[0]);
    let ratio = result(&q::TRANSPORT_RATE) / flux;
    assert!((0.75..1.33).contains(&ratio), "{ratio}");
}

#[test]
fn the_bottom_has_the_elevations_of_the_flume() {
    let case = Coupled { bed: GrainBed { size: [600.0 * D, 6.5e-3], side_walls: true, ..flow().bed }, ..flow() };
    let fixed = relief(&case);
    assert_eq!(fixed.len(), 600);
    let mut seen = std::collections::BTreeSet::new();
    for grain in &fixed {
        let steps = (grain.position[2] + 2.75e-3) / 0.5e-3;
        assert!((steps - steps.round()).abs() < 1e-9 && (-0.1..11.1).contains(&steps), "{steps}");
        seen.insert(steps.round() as i32);
    }
    assert_eq!(seen.len(), 12);
}

#[test]
fn the_level_of_a_bed_is_where_half_of_it_is_left() {
    let phi: Vec<f64> = (0..300).map(|i| 0.6 / (1.0 + (0.1 * (f64::from(i) - 150.0)).exp())).collect();
    assert!((level(&phi, 1.0, 30.0) - 150.0).abs() <= 1.0);
    assert_eq!(level(&[0.0; 9], 1.0, 3.0), 0.0);
    // A bed of one and a half diameters, and two cells of a grain that flies over it.
    let thin = |i: usize| if i < 15 || (40..42).contains(&i) { 0.6 } else { 0.0 };
    let phi: Vec<f64> = (0..100).map(thin).collect();
    assert!((level(&phi, 1.0, 10.0) - 15.0).abs() <= 1.0);
}

#[test]
fn samples_are_read_as_they_were_written() {
    use crate::dem::checkpoint::{Reader, Writer};
    let mut record = Record::new(3);
    record.samples.push(Sample {
        time: 1.0,
        block: 0,
        kinetic_energy: 3.0,
        transport_rate: 4.0,
        reynolds: 5.0,
        level: 6.0,
        velocity: 7.0,
    });
    record.blocks[0].samples = 2.0;
    record.blocks[7].sums[2][4] = 9.0;
    let mut to = Writer::default();
    record.write(&mut to);
    let bytes = to.seal(&[0; 32]);
    let read = Record::read(&mut Reader::open(&bytes, &[0; 32]).unwrap(), 3).unwrap();
    assert_eq!(read, record);
}
