//! One contact at a time: the reference for the others, without `std::arch`.
#![allow(unsafe_code, reason = "indices are checked once per tile, not once per contact")]

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Load, Pair, Quad, Row, Simd, Window};

/// One number.
#[derive(Clone, Copy, Debug)]
pub struct One(pub f64);

impl Add for One {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}
impl Sub for One {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}
impl Mul for One {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}
impl Div for One {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}
impl Neg for One {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Simd for One {
    const WIDTH: usize = 1;
    type Proof = ();
    type Mask = bool;

    #[inline(always)]
    fn splat((): (), x: f64) -> Self {
        Self(x)
    }
    #[inline(always)]
    fn load((): (), from: &[f64]) -> Self {
        Self(from[0])
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self.0;
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn above(self, other: Self) -> bool {
        self.0 > other.0
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn largest(self) -> f64 {
        self.0
    }
    #[inline(always)]
    unsafe fn pack(self, _: bool, to: *mut f64) {
        // SAFETY: the caller has room for one number.
        unsafe { to.write(self.0) }
    }
    #[inline(always)]
    unsafe fn pack_words((): (), _: bool, from: *const u64, to: *mut u64) {
        // SAFETY: the caller has one word at either end.
        unsafe { to.write(from.read()) }
    }
    #[inline(always)]
    unsafe fn apart((): (), rows: &[Row], pairs: *const Pair) -> [Self; 4] {
        // SAFETY: the caller has one pair, inside the rows.
        let (a, b) = unsafe {
            let Pair { i, j } = pairs.read();
            (rows.get_unchecked(i as usize).0, rows.get_unchecked(j as usize).0)
        };
        [Self(b[0] - a[0]), Self(b[1] - a[1]), Self(b[2] - a[2]), Self(b[3] + a[3])]
    }
    #[inline(always)]
    unsafe fn together((): (), rows: &[Row], pairs: *const Pair) -> [Self; 4] {
        // SAFETY: as above.
        let (a, b) = unsafe {
            let Pair { i, j } = pairs.read();
            (rows.get_unchecked(i as usize).0, rows.get_unchecked(j as usize).0)
        };
        [Self(b[0] + a[0]), Self(b[1] + a[1]), Self(b[2] + a[2]), Self(b[3] + a[3])]
    }
    #[inline(always)]
    unsafe fn columns((): (), rows: &[Row], at: *const u64) -> [Self; 4] {
        // SAFETY: the caller has one index, inside the rows.
        unsafe { rows.get_unchecked(at.read() as usize).0.map(Self) }
    }
    #[inline(always)]
    unsafe fn put(columns: [Self; 3], rows: &mut [Row], at: *const u64, count: usize) {
        if count > 0 {
            // SAFETY: the caller has one index, inside the rows.
            unsafe {
                *rows.get_unchecked_mut(at.read() as usize) = Row([columns[0].0, columns[1].0, columns[2].0, 0.0])
            }
        }
    }
    #[inline(always)]
    unsafe fn act(force: [Self; 3], spin: [Self; 3], loads: &mut [Load], of: Window, pairs: *const Pair, count: usize) {
        if count == 0 {
            return;
        }
        // SAFETY: the caller has one pair, whose places are inside the loads.
        unsafe {
            let Pair { i, j } = pairs.read();
            let to = &mut loads.get_unchecked_mut(of.place(i)).0;
            for k in 0..3 {
                to[0].0[k] -= force[k].0;
                to[1].0[k] += spin[k].0;
            }
            let to = &mut loads.get_unchecked_mut(of.place(j)).0;
            for k in 0..3 {
                to[0].0[k] += force[k].0;
                to[1].0[k] += spin[k].0;
            }
        }
    }
}

impl Quad for Row {
    type Proof = ();

    #[inline(always)]
    fn of((): (), row: &Row) -> Self {
        *row
    }
    #[inline(always)]
    fn row(self) -> Row {
        self
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }
    #[inline(always)]
    fn by(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] * other.0[k]))
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        Self(std::array::from_fn(|k| self.0[k] * factor))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] }))
    }
    #[inline(always)]
    fn with_last(self, other: Self) -> Self {
        Self([self.0[0], self.0[1], self.0[2], other.0[3]])
    }
}
