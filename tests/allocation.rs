//! A step of the fluid column allocates nothing: counted by the allocator itself, in a binary of its own.

#![allow(unsafe_code, reason = "an allocator cannot be written without")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use bedload::closures::mixing_length::{BelowPacked, LiSawamoto, MixingLength, Prandtl};
use bedload::closures::mixture_viscosity::{Boyer, MixtureViscosity};
use bedload::closures::side_wall::SideWall;
use bedload::column::{Bottom, FluidColumn, Forcing, Grid, Medium, Setup, Top, ViscousForm};

/// The system's allocator, which counts.
struct Counting;

thread_local! {
    /// Per thread: the harness allocates beside the test when it feels like it.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn count() {
    ALLOCATIONS.with(|n| n.set(n.get() + 1));
}

// SAFETY: everything is handed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller's promise.
        unsafe { System.realloc(pointer, layout, size) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    work();
    ALLOCATIONS.get() - before
}

#[test]
fn a_step_allocates_nothing() {
    assert_eq!(allocations(|| drop(std::hint::black_box(vec![1.0; 10]))), 1, "the count must be able to fail");

    let cells = 100;
    let grid = Grid::uniform(0.0, 0.1, cells).unwrap();
    let mut medium = Medium::clear(cells);
    for i in 0..cells / 2 {
        (medium.phi[i], medium.beta[i], medium.velocity[i]) = (0.5, 1e5, 1e-3 * i as f64);
    }
    let li_sawamoto = LiSawamoto { kappa: 0.41, phi_max: 0.51, below_packed: BelowPacked::Zero };
    for form in [ViscousForm::Mixture, ViscousForm::Fluid, ViscousForm::Effective] {
        for mixing_length in
            [MixingLength::None, MixingLength::Prandtl(Prandtl { kappa: 0.41 }), MixingLength::LiSawamoto(li_sawamoto)]
        {
            let setup = Setup {
                viscosity: MixtureViscosity::Boyer(Boyer { phi_max: 0.6 }),
                form,
                mixing_length,
                side_wall: SideWall::GrafAltinakar,
                width: 6.5e-3,
                ..Setup::laminar(1000.0, 1e-3)
            };
            let mut column = FluidColumn::new(grid.clone(), setup).unwrap();
            let forcing = Forcing { drive: 981.0, bottom: Bottom::NoSlip, top: Top::FreeSurface };
            let rough = Forcing { bottom: Bottom::Rough { z_0: 1e-5, kappa: 0.41 }, top: Top::Lid(0.1), ..forcing };
            let mut force = vec![0.0; cells];
            let counted = allocations(|| {
                for dt in [1e-2, 1.0, f64::INFINITY] {
                    column.step(&medium, &forcing, dt).unwrap();
                    column.step(&medium, &rough, dt).unwrap();
                }
                column.force_on_grains(&medium, &mut force).unwrap();
                // An error is no reason to allocate either.
                column.step(&medium, &forcing, -1.0).unwrap_err();
            });
            assert_eq!(counted, 0, "{form:?}, {mixing_length:?}");
        }
    }
}
