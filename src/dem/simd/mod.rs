//! Several contacts at once: what the pair loop needs of a vector of `f64`, on three kinds of machine.
//!
//! Every operation is one of IEEE 754 (+ - × / √ and comparison), none is fused, and loads are added to grains in the
//! order of the list: the width changes no bit of a result.
#![allow(unsafe_code, reason = "indices are checked once per tile, not once per contact")]

#[cfg(target_arch = "x86_64")]
pub mod avx2;
#[cfg(target_arch = "x86_64")]
pub mod avx512;
pub mod scalar;

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Four numbers of one grain: position and radius, velocity, or R ω and inverse mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(32))]
pub struct Row(pub [f64; 4]);

/// One row in a register.
pub trait Quad: Copy {
    /// Evidence that the machine has the instructions.
    type Proof: Copy;

    /// From memory.
    fn of(proof: Self::Proof, row: &Row) -> Self;
    /// To memory.
    fn row(self) -> Row;
    /// The sum, number by number.
    fn plus(self, other: Self) -> Self;
    /// The difference, number by number.
    fn minus(self, other: Self) -> Self;
    /// The product, number by number.
    fn by(self, other: Self) -> Self;
    /// The row times a number.
    fn times(self, factor: f64) -> Self;
    /// The larger, number by number, of numbers that are none NaN.
    fn max(self, other: Self) -> Self;
    /// The first three numbers and the last of `other`.
    fn with_last(self, other: Self) -> Self;
}

/// What acts on one grain: force \[N], and torque over radius \[N]; the last numbers are 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Load(pub [Row; 2]);

/// One number of each of [`Simd::WIDTH`] contacts.
pub trait Simd:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// contacts at once; divides 8
    const WIDTH: usize;
    /// Evidence that the machine has the instructions.
    type Proof: Copy;
    /// One truth value per contact.
    type Mask: Copy;

    /// The same number everywhere.
    fn splat(proof: Self::Proof, x: f64) -> Self;
    /// The first numbers of a slice.
    fn load(proof: Self::Proof, from: &[f64]) -> Self;
    /// Writes the numbers at the beginning of a slice.
    fn store(self, to: &mut [f64]);
    /// Square root.
    fn sqrt(self) -> Self;
    /// self > other
    fn above(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Bit l is the mask of contact l.
    fn bits(mask: Self::Mask) -> u32;
    /// Largest of the numbers, none of which is NaN.
    fn largest(self) -> f64;

    /// Writes the numbers where the mask holds, packed; what stands behind them, up to `WIDTH`, is overwritten.
    ///
    /// # Safety
    /// `to` takes `WIDTH` numbers.
    unsafe fn pack(self, mask: Self::Mask, to: *mut f64);
    /// As [`Simd::pack`], for `WIDTH` words read at `from`.
    ///
    /// # Safety
    /// `from` holds and `to` takes `WIDTH` words.
    unsafe fn pack_words(proof: Self::Proof, mask: Self::Mask, from: *const u64, to: *mut u64);

    /// Rows of the pairs, j minus i in the first three columns, j plus i in the last.
    ///
    /// # Safety
    /// `pairs` holds `WIDTH` pairs, whose indices are below the length of `rows`.
    unsafe fn apart(proof: Self::Proof, rows: &[Row], pairs: *const Pair) -> [Self; 4];
    /// Rows of the pairs, j plus i.
    ///
    /// # Safety
    /// As [`Simd::apart`].
    unsafe fn together(proof: Self::Proof, rows: &[Row], pairs: *const Pair) -> [Self; 4];
    /// The rows `at`, columns apart.
    ///
    /// # Safety
    /// `at` holds `WIDTH` indices below the length of `rows`.
    unsafe fn columns(proof: Self::Proof, rows: &[Row], at: *const u64) -> [Self; 4];
    /// Writes three columns into the first `count` of the rows `at`; the last column becomes 0.
    ///
    /// # Safety
    /// As [`Simd::columns`], and `count` is at most `WIDTH`.
    unsafe fn put(columns: [Self; 3], rows: &mut [Row], at: *const u64, count: usize);
    /// Adds (-force, spin) to i and (force, spin) to j, for the first `count` of the pairs in their order.
    ///
    /// # Safety
    /// `pairs` holds `WIDTH` pairs; the places of their grains are below the length of `loads`; `count` is at most `WIDTH`.
    unsafe fn act(force: [Self; 3], spin: [Self; 3], loads: &mut [Load], of: Window, pairs: *const Pair, count: usize);
}

/// To which grains rows of loads belong: to those from `first` on, and after the last of all to the first again.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// grain of the first row
    pub first: u32,
    /// number of all grains
    pub grains: u32,
}

impl Window {
    /// The row of grain `i`.
    #[inline(always)]
    #[must_use]
    pub fn place(self, i: u32) -> usize {
        let ahead = i.wrapping_sub(self.first);
        // Before the first one: a difference that wrapped around is larger than any number of grains.
        ahead.min(ahead.wrapping_add(self.grains)) as usize
    }
}

/// Two grains of the list, i before j. One 64-bit word, so that it can be packed as one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(C, align(8))]
pub struct Pair {
    /// the grain that comes first
    pub i: u32,
    /// the other one
    pub j: u32,
}

/// Which instructions the pair loop uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// one contact at a time, on any machine
    Scalar,
    /// four at a time
    #[cfg(target_arch = "x86_64")]
    Avx2(avx2::Proof),
    /// eight at a time
    #[cfg(target_arch = "x86_64")]
    Avx512(avx512::Proof),
}

impl Backend {
    /// The variable of the environment that forces a backend: `scalar`, `avx2` or `avx512`.
    pub const VARIABLE: &'static str = "BEDLOAD_BACKEND";

    /// All that this machine has, the widest first.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let mut found = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            found.extend(avx512::Proof::new().map(Self::Avx512));
            found.extend(avx2::Proof::new().map(Self::Avx2));
        }
        found.push(Self::Scalar);
        found
    }

    /// The one that the environment asks for, else the widest. A name that this machine does not have is ignored: the
    /// result is the same.
    #[must_use]
    pub fn choose() -> Self {
        let wanted = std::env::var(Self::VARIABLE).unwrap_or_default();
        let found = Self::available();
        found.iter().copied().find(|b| b.name() == wanted).or(found.first().copied()).unwrap_or(Self::Scalar)
    }

    /// `scalar`, `avx2` or `avx512`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => "avx512",
        }
    }
}

/// Vectors in space.
pub type Vector<L> = [L; 3];

/// a · b
#[inline(always)]
pub fn dot<L: Simd>(a: Vector<L>, b: Vector<L>) -> L {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b
#[inline(always)]
pub fn cross<L: Simd>(a: Vector<L>, b: Vector<L>) -> Vector<L> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// k a
#[inline(always)]
pub fn scale<L: Simd>(k: L, a: Vector<L>) -> Vector<L> {
    [k * a[0], k * a[1], k * a[2]]
}

/// a + b
#[inline(always)]
pub fn plus<L: Simd>(a: Vector<L>, b: Vector<L>) -> Vector<L> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a - b
#[inline(always)]
pub fn minus<L: Simd>(a: Vector<L>, b: Vector<L>) -> Vector<L> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
