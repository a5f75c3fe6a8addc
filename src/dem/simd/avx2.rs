//! Four contacts at a time: AVX2.
#![allow(unsafe_code, reason = "vector instructions; indices are checked once per tile, not once per contact")]

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Load, Pair, Quad, Row, Simd, Window};

/// Evidence that the machine has AVX2: nothing else makes one, and without it there is no [`Four`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof(());

impl Proof {
    /// Asks the machine.
    #[must_use]
    pub fn new() -> Option<Self> {
        std::arch::is_x86_feature_detected!("avx2").then_some(Self(()))
    }

    pub(super) fn of_wider() -> Self {
        Self(())
    }
}

/// Four numbers.
#[derive(Clone, Copy, Debug)]
pub struct Four(__m256d);

macro_rules! operator {
    ($trait:ident, $name:ident, $instruction:ident) => {
        impl $trait for Four {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: a `Four` exists only where AVX2 does.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}
operator!(Add, add, _mm256_add_pd);
operator!(Sub, sub, _mm256_sub_pd);
operator!(Mul, mul, _mm256_mul_pd);
operator!(Div, div, _mm256_div_pd);

impl Neg for Four {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

/// For each mask the pairs of 32-bit words that it keeps, packed.
static KEPT: [[u32; 8]; 16] = {
    let mut table = [[0; 8]; 16];
    let mut mask = 0;
    while mask < 16 {
        let (mut lane, mut to) = (0, 0);
        while lane < 4 {
            if mask >> lane & 1 == 1 {
                table[mask][2 * to] = 2 * lane as u32;
                table[mask][2 * to + 1] = 2 * lane as u32 + 1;
                to += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// Four rows as four columns, and back.
#[inline(always)]
fn transpose([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    // SAFETY: called only with values that a `Proof` allowed.
    unsafe {
        let (ab0, ab1) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd0, cd1) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab0, cd0),
            _mm256_permute2f128_pd::<0x20>(ab1, cd1),
            _mm256_permute2f128_pd::<0x31>(ab0, cd0),
            _mm256_permute2f128_pd::<0x31>(ab1, cd1),
        ]
    }
}

#[inline(always)]
unsafe fn row(rows: &[Row], at: usize) -> __m256d {
    // SAFETY: the caller stays inside the rows, which are aligned to 32 bytes.
    unsafe { _mm256_load_pd(rows.as_ptr().add(at).cast()) }
}

#[inline(always)]
unsafe fn packed(value: __m256i, mask: __m256d) -> __m256i {
    // SAFETY: the table has an entry for each mask; AVX2 as the caller has it.
    unsafe {
        let kept = KEPT.as_ptr().add(_mm256_movemask_pd(mask) as usize);
        _mm256_permutevar8x32_epi32(value, _mm256_loadu_si256(kept.cast()))
    }
}

impl Simd for Four {
    const WIDTH: usize = 4;
    type Proof = Proof;
    type Mask = __m256d;

    #[inline(always)]
    fn splat(_: Proof, x: f64) -> Self {
        // SAFETY: the proof.
        Self(unsafe { _mm256_set1_pd(x) })
    }
    #[inline(always)]
    fn load(_: Proof, from: &[f64]) -> Self {
        let from = &from[..4];
        // SAFETY: the proof, and four numbers.
        Self(unsafe { _mm256_loadu_pd(from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        let to = &mut to[..4];
        // SAFETY: the numbers exist only where the instructions do, and there is room for them.
        unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: a `Four` exists only where AVX2 does.
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn above(self, other: Self) -> __m256d {
        // SAFETY: as above.
        unsafe { _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn select(mask: __m256d, yes: Self, no: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_blendv_pd(no.0, yes.0, mask) })
    }
    #[inline(always)]
    fn bits(mask: __m256d) -> u32 {
        // SAFETY: as above.
        unsafe { _mm256_movemask_pd(mask) as u32 }
    }
    #[inline(always)]
    fn largest(self) -> f64 {
        let mut numbers = [0.0; 4];
        // SAFETY: as above, with room for four numbers.
        unsafe { _mm256_storeu_pd(numbers.as_mut_ptr(), self.0) };
        numbers.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }
    #[inline(always)]
    unsafe fn pack(self, mask: __m256d, to: *mut f64) {
        // SAFETY: the caller has room for four numbers.
        unsafe { _mm256_storeu_si256(to.cast(), packed(_mm256_castpd_si256(self.0), mask)) }
    }
    #[inline(always)]
    unsafe fn pack_words(_: Proof, mask: __m256d, from: *const u64, to: *mut u64) {
        // SAFETY: the caller has four words at either end.
        unsafe { _mm256_storeu_si256(to.cast(), packed(_mm256_loadu_si256(from.cast()), mask)) }
    }
    #[inline(always)]
    unsafe fn apart(_: Proof, rows: &[Row], pairs: *const Pair) -> [Self; 4] {
        // SAFETY: the caller has four pairs inside the rows.
        unsafe {
            let flip = _mm256_set_pd(-0.0, 0.0, 0.0, 0.0);
            let one = |l: usize| {
                let Pair { i, j } = *pairs.add(l);
                _mm256_sub_pd(row(rows, j as usize), _mm256_xor_pd(row(rows, i as usize), flip))
            };
            transpose([one(0), one(1), one(2), one(3)]).map(Self)
        }
    }
    #[inline(always)]
    unsafe fn together(_: Proof, rows: &[Row], pairs: *const Pair) -> [Self; 4] {
        // SAFETY: as above.
        unsafe {
            let one = |l: usize| {
                let Pair { i, j } = *pairs.add(l);
                _mm256_add_pd(row(rows, j as usize), row(rows, i as usize))
            };
            transpose([one(0), one(1), one(2), one(3)]).map(Self)
        }
    }
    #[inline(always)]
    unsafe fn columns(_: Proof, rows: &[Row], at: *const u64) -> [Self; 4] {
        // SAFETY: the caller has four indices inside the rows.
        unsafe {
            let one = |l: usize| row(rows, *at.add(l) as usize);
            transpose([one(0), one(1), one(2), one(3)]).map(Self)
        }
    }
    #[inline(always)]
    unsafe fn put(columns: [Self; 3], rows: &mut [Row], at: *const u64, count: usize) {
        // SAFETY: the caller has four indices inside the rows, which are aligned.
        unsafe {
            let turned = transpose([columns[0].0, columns[1].0, columns[2].0, _mm256_setzero_pd()]);
            for (l, value) in turned.into_iter().enumerate().take(count) {
                _mm256_store_pd(rows.as_mut_ptr().add(*at.add(l) as usize).cast(), value);
            }
        }
    }
    #[inline(always)]
    unsafe fn act(force: [Self; 3], spin: [Self; 3], loads: &mut [Load], of: Window, pairs: *const Pair, count: usize) {
        // SAFETY: the caller has four pairs whose places are inside the loads, which are aligned.
        unsafe {
            let flip = _mm256_set1_pd(-0.0);
            let zero = _mm256_setzero_pd();
            let low = transpose([force[0].0, force[1].0, force[2].0, zero]);
            let high = transpose([spin[0].0, spin[1].0, spin[2].0, zero]);
            for l in 0..count {
                let Pair { i, j } = *pairs.add(l);
                let to: *mut f64 = loads.as_mut_ptr().add(of.place(i)).cast();
                _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), _mm256_xor_pd(low[l], flip)));
                _mm256_store_pd(to.add(4), _mm256_add_pd(_mm256_load_pd(to.add(4)), high[l]));
                let to: *mut f64 = loads.as_mut_ptr().add(of.place(j)).cast();
                _mm256_store_pd(to, _mm256_add_pd(_mm256_load_pd(to), low[l]));
                _mm256_store_pd(to.add(4), _mm256_add_pd(_mm256_load_pd(to.add(4)), high[l]));
            }
        }
    }
}

impl Quad for Four {
    type Proof = Proof;

    #[inline(always)]
    fn of(_: Proof, row: &Row) -> Self {
        // SAFETY: the proof; a row is aligned.
        Self(unsafe { _mm256_load_pd(row.0.as_ptr()) })
    }
    #[inline(always)]
    fn row(self) -> Row {
        let mut row = Row::default();
        // SAFETY: a `Four` exists only where AVX2 does; a row is aligned.
        unsafe { _mm256_store_pd(row.0.as_mut_ptr(), self.0) };
        row
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }
    #[inline(always)]
    fn by(self, other: Self) -> Self {
        self * other
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        // SAFETY: as above.
        self * Self(unsafe { _mm256_set1_pd(factor) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn with_last(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_blend_pd::<0b1000>(self.0, other.0) })
    }
}
