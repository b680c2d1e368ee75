//! Lanes in the registers of AVX2.

use super::{Entry, Lanes, Reference, Task};
use pulp::x86::V3;
use pulp::{NullaryFnOnce, cast};
use std::arch::x86_64::{__m128, __m128i, __m256, __m256d, __m256i, _CMP_LE_OQ, _CMP_LT_OQ, _CMP_NEQ_UQ};

/// Of every mask the numbers of its bits, a byte each, the least first.
static ORDER: [u64; 256] = {
    let mut order = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut place) = (0, 0);
        while lane < 8 {
            if (mask >> lane) & 1 != 0 {
                order[mask] |= (lane as u64) << (8 * place);
                place += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    order
};

/// Of every mask a number for each of its bits that is all ones where the bit is set.
static BITS: [[u32; 8]; 256] = {
    let mut bits = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let mut lane = 0;
        while lane < 8 {
            if (mask >> lane) & 1 != 0 {
                bits[mask][lane] = u32::MAX;
            }
            lane += 1;
        }
        mask += 1;
    }
    bits
};

/// The proof that the machine has them.
#[derive(Clone, Copy, Debug)]
pub struct Avx2(pub(super) V3);

impl Avx2 {
    /// The proof, if the machine has them.
    #[must_use]
    pub fn detect() -> Option<Self> {
        V3::try_new().map(Self)
    }
}

/// A task, and the instructions that it is done with.
struct Call<T>(Avx2, T);

impl<T: Task> NullaryFnOnce for Call<T> {
    type Output = T::Output;

    #[inline(always)]
    fn call(self) -> T::Output {
        self.1.run(self.0)
    }
}

impl Lanes for Avx2 {
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
        self.0
            .avx
            ._mm256_movemask_ps(self.0.avx._mm256_cmp_ps::<_CMP_LE_OQ>(a, b)) as u32
    }

    #[inline(always)]
    fn leave(self, mask: u32, distances: __m256, children: &[Reference; 8], room: &mut [Entry; 8]) -> usize {
        let (avx, avx2) = (self.0.avx, self.0.avx2);
        // The least of the lanes that count, in all lanes.
        let counts = cast::<[u32; 8], __m256>(BITS[(mask & 255) as usize]);
        let least = avx._mm256_blendv_ps(avx._mm256_set1_ps(f32::INFINITY), distances, counts);
        let least = avx._mm256_min_ps(least, avx._mm256_permute2f128_ps::<1>(least, least));
        let least = avx._mm256_min_ps(least, avx._mm256_permute_ps::<0b01_00_11_10>(least));
        let least = avx._mm256_min_ps(least, avx._mm256_permute_ps::<0b10_11_00_01>(least));
        let nearest = mask & self.single_le(distances, least);
        let nearest = nearest & nearest.wrapping_neg();
        // The others come first, one behind the other.
        let order = avx2._mm256_cvtepu8_epi32(cast::<[u64; 2], __m128i>([ORDER[((mask ^ nearest) & 255) as usize], 0]));
        let packed = avx2._mm256_permutevar8x32_epi32(cast(distances), order);
        let children_packed = avx2._mm256_permutevar8x32_epi32(cast::<[Reference; 8], __m256i>(*children), order);
        let even = avx2._mm256_unpacklo_epi32(children_packed, packed);
        let odd = avx2._mm256_unpackhi_epi32(children_packed, packed);
        let [low, high] = [
            avx2._mm256_permute2x128_si256::<0x20>(even, odd),
            avx2._mm256_permute2x128_si256::<0x31>(even, odd),
        ];
        *room = cast::<[__m256i; 2], [Entry; 8]>([low, high]);
        let count = mask.count_ones() as usize;
        let lane = (nearest.trailing_zeros() & 7) as usize;
        let distance = cast::<__m256, [f32; 8]>(least)[0];
        room[count.wrapping_sub(1) & 7] = Entry::new(distance, children[lane]);
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
        self.0
            .avx
            ._mm256_movemask_pd(self.0.avx._mm256_cmp_pd::<_CMP_LE_OQ>(a, b)) as u32
    }

    #[inline(always)]
    fn double_lt(self, a: __m256d, b: __m256d) -> u32 {
        self.0
            .avx
            ._mm256_movemask_pd(self.0.avx._mm256_cmp_pd::<_CMP_LT_OQ>(a, b)) as u32
    }

    #[inline(always)]
    fn double_ne(self, a: __m256d, b: __m256d) -> u32 {
        self.0
            .avx
            ._mm256_movemask_pd(self.0.avx._mm256_cmp_pd::<_CMP_NEQ_UQ>(a, b)) as u32
    }
}
