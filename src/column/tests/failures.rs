//! What cannot be solved is said, and leaves the velocity as it was.

use super::*;
use crate::closures::mixing_length::{MixingLength, Prandtl};
use crate::closures::mixture_viscosity::{Boyer, MixtureViscosity};
use crate::closures::side_wall::SideWall;

const FILM: Forcing = Forcing { drive: 1.0, bottom: Bottom::NoSlip, top: Top::FreeSurface };
const LAMINAR: fn() -> Setup = || Setup::laminar(1000.0, 1e-3);

fn column(setup: Setup) -> FluidColumn {
    FluidColumn::new(uniform(1.0, 4), setup).unwrap()
}

#[test]
fn numbers_that_cannot_be() {
    let new = |setup| FluidColumn::new(uniform(1.0, 4), setup).unwrap_err();
    assert!(matches!(new(Setup { rho: 0.0, ..LAMINAR() }), ColumnError::Value { what: "density [kg/m3]", .. }));
    assert!(matches!(new(Setup { eta: f64::NAN, ..LAMINAR() }), ColumnError::Value { .. }));
    // A side wall needs a width.
    assert!(matches!(
        new(Setup { side_wall: SideWall::Blasius, ..LAMINAR() }),
        ColumnError::Value { what: "width [m]", .. }
    ));
    let mut column = column(LAMINAR());
    let clear = Medium::clear(4);
    for dt in [0.0, -1.0, f64::NAN] {
        assert!(matches!(column.step(&clear, &FILM, dt), Err(ColumnError::Value { what: "time step [s]", .. })));
    }
    for forcing in [
        Forcing { drive: f64::NAN, ..FILM },
        Forcing { bottom: Bottom::Flow { velocity: f64::INFINITY, mixing_length: 0.0 }, ..FILM },
        Forcing { bottom: Bottom::Flow { velocity: 1.0, mixing_length: -1.0 }, ..FILM },
        Forcing { bottom: Bottom::Stress(f64::NAN), ..FILM },
        Forcing { bottom: Bottom::Rough { z_0: 0.0, kappa: 0.41 }, ..FILM },
        Forcing { top: Top::Lid(f64::NAN), ..FILM },
        Forcing { top: Top::Stress(f64::NAN), ..FILM },
    ] {
        assert!(matches!(column.step(&clear, &forcing, 1.0), Err(ColumnError::Value { .. })), "{forcing:?}");
    }
    let rough = Forcing { bottom: Bottom::Rough { z_0: 0.125, kappa: 0.41 }, ..FILM };
    let above = ColumnError::RoughnessAboveCell { z_0: 0.125, distance: 0.125 };
    assert_eq!(column.step(&clear, &rough, 1.0), Err(above));
    assert!(matches!(column.step(&Medium::clear(3), &FILM, 1.0), Err(ColumnError::Length { found: 3, .. })));
    assert!(column.set_velocity(&[1.0]).is_err());
    assert!(column.force_on_grains(&clear, &mut [0.0]).is_err());
}

#[test]
fn a_jammed_viscosity_is_named() {
    // Boyer's viscosity diverges at phi_max and is negative beyond.
    let mut column = column(Setup { viscosity: MixtureViscosity::Boyer(Boyer { phi_max: 0.6 }), ..LAMINAR() });
    for phi in [0.6, 0.61] {
        let medium = Medium { phi: vec![0.5, phi, 0.0, 0.0], ..Medium::clear(4) };
        assert!(matches!(column.step(&medium, &FILM, 1.0), Err(ColumnError::Cell { z: 0.375, .. })));
    }
}

#[test]
fn a_flow_that_nothing_holds() {
    let adrift = Forcing { bottom: Bottom::Stress(0.0), ..FILM };
    let mut column = column(LAMINAR());
    assert_eq!(column.step(&Medium::clear(4), &adrift, STEADY), Err(ColumnError::Adrift));
    // Inertia holds it for a while, drag for ever.
    column.step(&Medium::clear(4), &adrift, 1.0).unwrap();
    let grains = Medium { beta: vec![1.0, 0.0, 0.0, 0.0], ..Medium::clear(4) };
    column.step(&grains, &adrift, STEADY).unwrap();
    assert_eq!(column.step(&Medium::clear(4), &Forcing { drive: 0.0, ..FILM }, STEADY).unwrap().residual, 0.0);
}

#[test]
fn a_failed_step_changes_nothing() {
    let newton = Newton { iterations: 3, ..Newton::default() };
    let mixing_length = MixingLength::Prandtl(Prandtl { kappa: 0.41 });
    let mut column = column(Setup { newton, mixing_length, ..LAMINAR() });
    let start = [0.1, 0.2, 0.3, 0.4];
    column.set_velocity(&start).unwrap();
    let failed = column.step(&Medium::clear(4), &FILM, STEADY);
    assert!(
        matches!(failed, Err(ColumnError::NotConverged { iterations: 3, residual, .. }) if residual > 1e-3),
        "{failed:?}"
    );
    assert_eq!(column.velocity(), start);
    let huge = Medium { force: vec![f64::MAX; 4], ..Medium::clear(4) };
    assert!(matches!(column.step(&huge, &FILM, STEADY), Err(ColumnError::NotFinite { .. })));
    assert_eq!(column.velocity(), start);
}
