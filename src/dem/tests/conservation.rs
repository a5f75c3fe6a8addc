use super::{Domain, G, R, Which, engine, gas, go, law, verification};
use crate::closures::contact::Tension;
use crate::dem::{Grain, Wall};
use crate::models::grains::Verification;
use crate::models::grains::verification::{clouds, found};
use crate::result::quantity as q;

#[test]
fn momentum_and_angular_momentum_are_kept_to_round_off() {
    let all = clouds::cluster(&Verification { velocity: 1.0, ..verification(Which::Cluster, 0.5, 30.0) }).unwrap();
    println!("{:?}", all.iter().map(|(q, x)| (q.name, *x)).collect::<Vec<_>>());
    assert!(found(Ok(all.clone()), &q::MOMENTUM_ERROR) < 1e-13);
    assert!(found(Ok(all), &q::ANGULAR_MOMENTUM_ERROR) < 1e-13);
}

#[test]
fn the_balances_of_energy_and_momentum_close_to_round_off() {
    let all =
        clouds::ledger(&Verification { velocity: 1.0, ..verification(Which::Ledger, 0.9, 30.0) }, 100_000).unwrap();
    println!("{:?}", all.iter().map(|(q, x)| (q.name, *x)).collect::<Vec<_>>());
    assert!(found(Ok(all.clone()), &q::LEDGER_ERROR) < 1e-12);
    assert!(found(Ok(all), &q::MOMENTUM_ERROR) < 1e-12);
}

#[test]
fn what_fixed_grains_and_walls_take_is_in_the_balance_of_momentum() {
    let mut grains = gas(60, 0.03, 0.2);
    for n in 0..25 {
        let at = [(f64::from(n % 5) + 0.5) * 6e-3, (f64::from(n / 5) + 0.5) * 6e-3, -R];
        grains.push(Grain { fixed: true, ..Grain::at_rest(at, R, 2500.0) });
    }
    let walls = vec![Wall::through([0.0; 3], [0.0, 1.0, 0.0]), Wall::through([0.0, 0.03, 0.0], [0.0, -1.0, 0.0])];
    let domain = Domain { periods: [Some(0.03), None], walls };
    let mut engine = engine(&grains, domain, law(0.5, Tension::Cut), 2e-5, [1.0, 0.0, -G]);
    go(&mut engine, 20_000);
    let ledger = engine.ledger();
    let defect = ledger.momentum_defect(engine.grains().momentum());
    assert!(defect < 1e-12, "{defect:e}");
    // The bottom carries the weight, the walls have pushed to both sides.
    let [_, across, up] = ledger.bounds.map(|sum| sum.total());
    assert!(up > 0.5 * -ledger.given()[2] && across != 0.0, "{up} {across}");
}
