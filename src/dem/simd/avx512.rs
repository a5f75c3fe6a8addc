//! Eight contacts at a time: AVX-512.
#![allow(unsafe_code, reason = "vector instructions; indices are checked once per tile, not once per contact")]

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Load, Pair, Row, Simd, Window};

/// Evidence that the machine has AVX-512 F, DQ and VL: nothing else makes one, and without it there is no [`Eight`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof(());

impl Proof {
    /// It asks for AVX2, too.
    #[must_use]
    pub fn narrower(self) -> super::avx2::Proof {
        super::avx2::Proof::of_wider()
    }

    /// Asks the machine.
    #[must_use]
    pub fn new() -> Option<Self> {
        let has = std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512dq")
            && std::arch::is_x86_feature_detected!("avx512vl")
            && std::arch::is_x86_feature_detected!("avx2");
        has.then_some(Self(()))
    }
}

/// Eight numbers.
#[derive(Clone, Copy, Debug)]
pub struct Eight(__m512d);

macro_rules! operator {
    ($trait:ident, $name:ident, $instruction:ident) => {
        impl $trait for Eight {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: an `Eight` exists only where AVX-512 does.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
    };
}
operator!(Add, add, _mm512_add_pd);
operator!(Sub, sub, _mm512_sub_pd);
operator!(Mul, mul, _mm512_mul_pd);
operator!(Div, div, _mm512_div_pd);

impl Neg for Eight {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_xor_pd(self.0, _mm512_set1_pd(-0.0)) })
    }
}

/// Rows l and l + 4 side by side, for l = 0 to 3.
type Sides = [__m512d; 4];

/// Four columns of eight from rows side by side.
#[inline(always)]
fn transpose([a, b, c, d]: Sides) -> [__m512d; 4] {
    // SAFETY: called only with values that a `Proof` allowed.
    unsafe {
        let (ab0, ab1) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        let (cd0, cd1) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
        // Quarters of ab0: column 0 of rows 0 1, column 2 of 0 1, column 0 of 4 5, column 2 of 4 5.
        let low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
        let high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
        [
            _mm512_permutex2var_pd(ab0, low, cd0),
            _mm512_permutex2var_pd(ab1, low, cd1),
            _mm512_permutex2var_pd(ab0, high, cd0),
            _mm512_permutex2var_pd(ab1, high, cd1),
        ]
    }
}

/// Rows side by side from four columns: the way back.
#[inline(always)]
fn sides([a, b, c, d]: [__m512d; 4]) -> Sides {
    // SAFETY: as above.
    unsafe {
        let (ab0, ab1) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        let (cd0, cd1) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
        // Quarters of ab0: rows 0, 2, 4, 6 of columns 0 1.
        let low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
        let high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
        [
            _mm512_permutex2var_pd(ab0, low, cd0),
            _mm512_permutex2var_pd(ab1, low, cd1),
            _mm512_permutex2var_pd(ab0, high, cd0),
            _mm512_permutex2var_pd(ab1, high, cd1),
        ]
    }
}

#[inline(always)]
unsafe fn both(rows: &[Row], low: usize, high: usize) -> __m512d {
    // SAFETY: the caller stays inside the rows, which are aligned to 32 bytes.
    unsafe {
        let low = _mm256_load_pd(rows.as_ptr().add(low).cast());
        let high = _mm256_load_pd(rows.as_ptr().add(high).cast());
        _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low), high)
    }
}

impl Simd for Eight {
    const WIDTH: usize = 8;
    type Proof = Proof;
    type Mask = __mmask8;

    #[inline(always)]
    fn splat(_: Proof, x: f64) -> Self {
        // SAFETY: the proof.
        Self(unsafe { _mm512_set1_pd(x) })
    }
    #[inline(always)]
    fn load(_: Proof, from: &[f64]) -> Self {
        let from = &from[..8];
        // SAFETY: the proof, and eight numbers.
        Self(unsafe { _mm512_loadu_pd(from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        let to = &mut to[..8];
        // SAFETY: the numbers exist only where the instructions do, and there is room for them.
        unsafe { _mm512_storeu_pd(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: an `Eight` exists only where AVX-512 does.
        Self(unsafe { _mm512_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn above(self, other: Self) -> __mmask8 {
        // SAFETY: as above.
        unsafe { _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn select(mask: __mmask8, yes: Self, no: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm512_mask_blend_pd(mask, no.0, yes.0) })
    }
    #[inline(always)]
    fn bits(mask: __mmask8) -> u32 {
        u32::from(mask)
    }
    #[inline(always)]
    fn largest(self) -> f64 {
        // SAFETY: as above.
        unsafe { _mm512_reduce_max_pd(self.0) }
    }
    #[inline(always)]
    unsafe fn pack(self, mask: __mmask8, to: *mut f64) {
        // SAFETY: the caller has room for eight numbers. A whole store is faster than a compressing one.
        unsafe { _mm512_storeu_pd(to, _mm512_maskz_compress_pd(mask, self.0)) }
    }
    #[inline(always)]
    unsafe fn pack_words(_: Proof, mask: __mmask8, from: *const u64, to: *mut u64) {
        // SAFETY: the caller has eight words at either end.
        unsafe { _mm512_storeu_epi64(to.cast(), _mm512_maskz_compress_epi64(mask, _mm512_loadu_epi64(from.cast()))) }
    }
    #[inline(always)]
    unsafe fn apart(_: Proof, rows: &[Row], pairs: *const Pair) -> [Self; 4] {
        // SAFETY: the caller has eight pairs inside the rows.
        unsafe {
            let flip = _mm512_setr_pd(0.0, 0.0, 0.0, -0.0, 0.0, 0.0, 0.0, -0.0);
            let one = |l: usize| {
                let (a, b) = (*pairs.add(l), *pairs.add(l + 4));
                let i = both(rows, a.i as usize, b.i as usize);
                _mm512_sub_pd(both(rows, a.j as usize, b.j as usize), _mm512_xor_pd(i, flip))
            };
            transpose([one(0), one(1), one(2), one(3)]).map(Self)
        }
    }
    #[inline(always)]
    unsafe fn together(_: Proof, rows: &[Row], pairs: *const Pair) -> [Self; 4] {
        // SAFETY: as above.
        unsafe {
            let one = |l: usize| {
                let (a, b) = (*pairs.add(l), *pairs.add(l + 4));
                _mm512_add_pd(both(rows, a.j as usize, b.j as usize), both(rows, a.i as usize, b.i as usize))
            };
            transpose([one(0), one(1), one(2), one(3)]).map(Self)
        }
    }
    #[inline(always)]
    unsafe fn columns(_: Proof, rows: &[Row], at: *const u64) -> [Self; 4] {
        // SAFETY: the caller has eight indices inside the rows.
        unsafe {
            let one = |l: usize| both(rows, *at.add(l) as usize, *at.add(l + 4) as usize);
            transpose([one(0), one(1), one(2), one(3)]).map(Self)
        }
    }
    #[inline(always)]
    unsafe fn put(columns: [Self; 3], rows: &mut [Row], at: *const u64, count: usize) {
        // SAFETY: the caller has eight indices inside the rows, which are aligned.
        unsafe {
            let turned = sides([columns[0].0, columns[1].0, columns[2].0, _mm512_setzero_pd()]);
            for l in 0..count {
                let value = turned[l & 3];
                let half = if l < 4 { _mm512_castpd512_pd256(value) } else { _mm512_extractf64x4_pd::<1>(value) };
                _mm256_store_pd(rows.as_mut_ptr().add(*at.add(l) as usize).cast(), half);
            }
        }
    }
    #[inline(always)]
    unsafe fn act(force: [Self; 3], spin: [Self; 3], loads: &mut [Load], of: Window, pairs: *const Pair, count: usize) {
        // SAFETY: the caller has eight pairs whose places are inside the loads, which are aligned.
        unsafe {
            let flip = _mm512_setr_pd(-0.0, -0.0, -0.0, -0.0, 0.0, 0.0, 0.0, 0.0);
            let zero = _mm512_setzero_pd();
            let low = sides([force[0].0, force[1].0, force[2].0, zero]);
            let high = sides([spin[0].0, spin[1].0, spin[2].0, zero]);
            let whole: [__m512d; 8] = std::array::from_fn(|l| {
                if l < 4 {
                    _mm512_shuffle_f64x2::<0x44>(low[l], high[l])
                } else {
                    _mm512_shuffle_f64x2::<0xEE>(low[l - 4], high[l - 4])
                }
            });
            for (l, value) in whole.into_iter().enumerate().take(count) {
                let Pair { i, j } = *pairs.add(l);
                let to: *mut f64 = loads.as_mut_ptr().add(of.place(i)).cast();
                _mm512_store_pd(to, _mm512_add_pd(_mm512_load_pd(to), _mm512_xor_pd(value, flip)));
                let to: *mut f64 = loads.as_mut_ptr().add(of.place(j)).cast();
                _mm512_store_pd(to, _mm512_add_pd(_mm512_load_pd(to), value));
            }
        }
    }
}
