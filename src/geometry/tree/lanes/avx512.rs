//! Lanes in registers as wide as those of AVX2, twice as many of them, and with the masks of AVX-512.

use super::{Entry, Lanes, Reference, Task};
use pulp::x86::V4;
use pulp::{NullaryFnOnce, cast};
use std::arch::x86_64::{__m128, __m256, __m256d, __m256i, __m512i, _CMP_LE_OQ, _CMP_LT_OQ, _CMP_NEQ_UQ};

/// The proof that the machine has them.
#[derive(Clone, Copy, Debug)]
pub struct Avx512(pub(super) V4);

impl Avx512 {
    /// The proof, if the machine has them.
    #[must_use]
    pub fn detect() -> Option<Self> {
        V4::try_new().map(Self)
    }
}

/// A task, and the instructions that it is done with.
struct Call<T>(Avx512, T);

impl<T: Task> NullaryFnOnce for Call<T> {
    type Output = T::Output;

    #[inline(always)]
    fn call(self) -> T::Output {
        self.1.run(self.0)
    }
}

impl Lanes for Avx512 {
    type Single = __m256;
    type Double = __m256d;

    #[inline(always)]
    fn run<T: Task>(self, task: T) -> T::Output {
        self.0.vectorize(Call(self, task))
    }

    #[inline(always)]
    fn single(self, numbers: &[f32; 8]) -> __m256 {
        cast(*numbers)
    }

    #[inline(always)]
    fn single_splat(self, number: f32) -> __m256 {
        self.0.avx._mm256_set1_ps(number)
    }

    #[inline(always)]
    fn single_sub(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_sub_ps(a, b)
    }

    #[inline(always)]
    fn single_mul(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_mul_ps(a, b)
    }

    #[inline(always)]
    fn single_max(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_max_ps(a, b)
    }

    #[inline(always)]
    fn single_min(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_min_ps(a, b)
    }

    #[inline(always)]
    fn single_le(self, a: __m256, b: __m256) -> u32 {
        u32::from(self.0.avx512f._mm256_cmp_ps_mask::<_CMP_LE_OQ>(a, b))
    }

    #[inline(always)]
    fn leave(self, mask: u32, distances: __m256, children: &[Reference; 8], room: &mut [Entry; 8]) -> usize {
        let f = self.0.avx512f;
        let mask = mask as u8;
        let distances = f._mm512_cvtepu32_epi64(cast::<__m256, __m256i>(distances));
        let children = f._mm512_cvtepu32_epi64(cast::<[Reference; 8], __m256i>(*children));
        let entries = f._mm512_or_si512(f._mm512_slli_epi64::<32>(distances), children);
        // The least of all lanes, in all lanes: distances first, and no two children are the same.
        let least = f._mm512_mask_mov_epi64(f._mm512_set1_epi64(-1), mask, entries);
        let least = f._mm512_min_epu64(least, f._mm512_shuffle_i64x2::<0b01_00_11_10>(least, least));
        let least = f._mm512_min_epu64(least, f._mm512_permutex_epi64::<0b01_00_11_10>(least));
        let least = f._mm512_min_epu64(least, f._mm512_permutex_epi64::<0b10_11_00_01>(least));
        let others = mask & !f._mm512_cmpeq_epu64_mask(entries, least);
        *room = cast::<__m512i, [Entry; 8]>(f._mm512_maskz_compress_epi64(others, entries));
        let count = mask.count_ones() as usize;
        room[count.wrapping_sub(1) & 7] = Entry(cast::<__m512i, [u64; 8]>(least)[0]);
        count
    }

    #[inline(always)]
    fn double(self, numbers: &[f32; 4]) -> __m256d {
        self.0.avx._mm256_cvtps_pd(cast::<[f32; 4], __m128>(*numbers))
    }

    #[inline(always)]
    fn double_load(self, numbers: &[f64; 4]) -> __m256d {
        cast(*numbers)
    }

    #[inline(always)]
    fn double_splat(self, number: f64) -> __m256d {
        self.0.avx._mm256_set1_pd(number)
    }

    #[inline(always)]
    fn double_array(self, a: __m256d) -> [f64; 4] {
        cast(a)
    }

    #[inline(always)]
    fn double_add(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_add_pd(a, b)
    }

    #[inline(always)]
    fn double_sub(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_sub_pd(a, b)
    }

    #[inline(always)]
    fn double_mul(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_mul_pd(a, b)
    }

    #[inline(always)]
    fn double_div(self, a: __m256d, b: __m256d) -> __m256d {
        self.0.avx._mm256_div_pd(a, b)
    }

    #[inline(always)]
    fn double_le(self, a: __m256d, b: __m256d) -> u32 {
        u32::from(self.0.avx512f._mm256_cmp_pd_mask::<_CMP_LE_OQ>(a, b))
    }

    #[inline(always)]
    fn double_lt(self, a: __m256d, b: __m256d) -> u32 {
        u32::from(self.0.avx512f._mm256_cmp_pd_mask::<_CMP_LT_OQ>(a, b))
    }

    #[inline(always)]
    fn double_ne(self, a: __m256d, b: __m256d) -> u32 {
        u32::from(self.0.avx512f._mm256_cmp_pd_mask::<_CMP_NEQ_UQ>(a, b))
    }
}
