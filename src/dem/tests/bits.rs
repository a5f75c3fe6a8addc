use super::{Domain, G, R, RHO, gas, go, hash, law};
use crate::closures::contact::Tension;
use crate::dem::checkpoint::{Reader, Writer};
use crate::dem::law::Lammps;
use crate::dem::simd::Backend;
use crate::dem::{Engine, Grain, LinearSpring, Settings, Wall};
use crate::result::CheckpointError;

/// Grains of several sizes that fall on fixed ones, between walls.
fn scene(threads: usize, law: LinearSpring) -> Engine<LinearSpring> {
    let mut grains = gas(1500, 0.09, 0.2);
    for n in 0..13 * 13 {
        let at = [(f64::from(n % 13) + 0.5) * 0.09 / 13.0, (f64::from(n / 13) + 0.5) * 0.09 / 13.0, -R];
        grains.push(Grain { fixed: true, ..Grain::at_rest(at, R, RHO) });
    }
    let walls = vec![Wall::through([0.0; 3], [0.0, 1.0, 0.0]), Wall::through([0.0, 0.09, 0.0], [0.0, -1.0, 0.0])];
    let domain = Domain { periods: [Some(0.09), None], walls };
    Engine::new(&grains, domain, law, Settings::new(3e-5, [2.0, 0.0, -G], 2.0 * R), threads).unwrap()
}

#[test]
fn every_backend_and_number_of_threads_gives_the_same_bits() {
    let lammps = Lammps { inverse_mass: 2.0 / Grain::at_rest([0.0; 3], R, RHO).mass() };
    let kept = LinearSpring { lammps: Some(lammps), ..law(0.5, Tension::Kept) };
    for law in [law(0.5, Tension::Cut), law(0.3, Tension::Kept), kept] {
        let mut hashes = Vec::new();
        for backend in Backend::available() {
            for threads in [1, 2, 3] {
                let mut engine = scene(threads, law).with_backend(backend);
                go(&mut engine, 500);
                let found = engine.found();
                assert!(found.contacts > 100 && found.wall_contacts > 3 && engine.rebuilds() > 2, "{found:?}");
                hashes.push((hash(&engine), backend.name(), threads));
            }
        }
        assert!(hashes.iter().all(|(hash, ..)| *hash == hashes[0].0), "{hashes:?}");
    }
}

#[test]
fn a_restart_from_any_step_makes_the_same_bits_and_taking_a_checkpoint_changes_none() {
    let case = [7; 32];
    let mut straight = scene(1, law(0.5, Tension::Cut));
    go(&mut straight, 700);
    for stop in [0, 1, 333, 500] {
        let mut engine = scene(2, law(0.5, Tension::Cut));
        go(&mut engine, stop);
        let mut to = Writer::default();
        engine.save(&mut to);
        let bytes = to.seal(&case);
        let mut from = Reader::open(&bytes, &case).unwrap();
        let mut again = Engine::restore(&mut from, engine.domain().clone(), law(0.5, Tension::Cut), 1).unwrap();
        from.close().unwrap();
        go(&mut engine, 700 - stop);
        go(&mut again, 700 - stop);
        assert_eq!(hash(&engine), hash(&straight), "the run that was saved at {stop}");
        assert_eq!(hash(&again), hash(&straight), "the run that goes on from {stop}");
        assert_eq!((again.steps(), again.ledger()), (straight.steps(), straight.ledger()));
    }
}

#[test]
fn a_damaged_checkpoint_is_refused_whatever_the_damage() {
    let case = [7; 32];
    let mut engine = scene(1, law(0.5, Tension::Cut));
    go(&mut engine, 300);
    let mut to = Writer::default();
    engine.save(&mut to);
    let bytes = to.seal(&case);
    assert_eq!(Reader::open(&bytes, &[8; 32]).unwrap_err(), CheckpointError::OtherCase);
    for length in [0, 5, 11, 30, 60, bytes.len() / 2, bytes.len() - 1] {
        assert!(Reader::open(&bytes[..length], &case).is_err(), "{length}");
    }
    for place in (0..bytes.len()).step_by(bytes.len() / 40) {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0x10;
        assert!(Reader::open(&damaged, &case).is_err(), "{place}");
    }
    let mut longer = bytes.clone();
    longer.push(0);
    assert!(Reader::open(&longer, &case).is_err());
    // A body that is sealed and still says what cannot be.
    let mut wrong = Writer::default();
    (0..40).for_each(|n| wrong.whole(n * 1000));
    let sealed = wrong.seal(&case);
    let mut from = Reader::open(&sealed, &case).unwrap();
    assert!(Engine::restore(&mut from, engine.domain().clone(), law(0.5, Tension::Cut), 1).is_err());
}

#[test]
fn every_near_pair_is_listed_once_however_periods_and_tiles_lie() {
    let grains = gas(5000, 0.12, 0.2);
    // One axis stretched: layers lie across it, and around its period the last meets the first.
    let shapes = [[4.0, 0.6, 0.6], [0.6, 4.0, 0.6], [0.6, 0.6, 4.0], [1.0, 1.0, 1.0], [16.0, 0.2, 0.4]];
    for stretch in shapes {
        for periodic in [[true, true], [true, false], [false, false]] {
            let scaled: Vec<Grain> = grains
                .iter()
                .map(|g| Grain { position: std::array::from_fn(|k| g.position[k] * stretch[k]), ..*g })
                .collect();
            let period = |k: usize| periodic[k].then_some(0.12 * stretch[k]);
            let domain = Domain { periods: [period(0), period(1)], walls: Vec::new() };
            let settings = Settings { largest_overlap: 2.0, ..Settings::new(1e-5, [0.0; 3], 2.0 * R) };
            let mut engine = Engine::new(&scaled, domain.clone(), law(0.5, Tension::Cut), settings, 2).unwrap();
            engine.forces(0.0);
            let all = engine.grains();
            let mut found: Vec<[usize; 2]> =
                engine.contacts().map(|c| [c.first.min(c.second.unwrap()), c.first.max(c.second.unwrap())]).collect();
            found.sort_unstable();
            let mut expected = Vec::new();
            for i in 0..all.len() {
                for j in i + 1..all.len() {
                    let apart = domain.apart(all.position(i), all.position(j));
                    let reach = all.radius(i) + all.radius(j);
                    if apart.iter().map(|x| x * x).sum::<f64>() < reach * reach {
                        expected.push([i, j]);
                    }
                }
            }
            assert!(expected.len() > 300, "{}", expected.len());
            assert_eq!(found, expected, "{stretch:?} {periodic:?}");
            assert_eq!(engine.found().contacts, expected.len());
            assert!(engine.tiles.len() == 4, "{}", engine.tiles.len());
        }
    }
}

#[test]
fn a_long_channel_of_many_tiles_gives_the_same_bits_and_keeps_its_momentum() {
    // Along x the last tile acts on the first one.
    let grains: Vec<Grain> = gas(5000, 0.14, 0.1)
        .into_iter()
        .map(|g| Grain { position: [4.0 * g.position[0], 0.5 * g.position[1], 0.5 * g.position[2]], ..g })
        .collect();
    let domain = Domain { periods: [Some(0.56), Some(0.07)], walls: Vec::new() };
    let run = |threads, backend| {
        let settings = Settings { largest_overlap: 2.0, ..Settings::new(1e-5, [0.0; 3], 2.0 * R) };
        let engine = Engine::new(&grains, domain.clone(), law(0.5, Tension::Cut), settings, threads).unwrap();
        let mut engine = engine.with_backend(backend);
        let before = engine.grains().momentum();
        go(&mut engine, 300);
        assert!(engine.rebuilds() > 2 && engine.found().contacts > 300);
        let scale: f64 = (0..grains.len()).map(|i| engine.grains().mass(i)).sum();
        for (now, before) in engine.grains().momentum().into_iter().zip(before) {
            assert!((now - before).abs() < 1e-13 * scale, "{:e}", now - before);
        }
        hash(&engine)
    };
    let first = run(1, Backend::Scalar);
    for backend in Backend::available() {
        for threads in [1, 2, 3, 4] {
            assert_eq!(run(threads, backend), first, "{} {threads}", backend.name());
        }
    }
}
