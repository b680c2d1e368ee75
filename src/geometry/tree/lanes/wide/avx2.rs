//! Eight numbers in a register of AVX2.

use super::{BUNDLE, Wide};
use crate::geometry::tree::lanes::Avx2;
use pulp::cast;
use std::arch::x86_64::{__m128, __m256, __m256d, _CMP_LT_OQ, _CMP_NLT_UQ};

impl Wide for Avx2 {
    const WIDTH: usize = 8;
    type Numbers = __m256;
    type Doubles = [__m256d; 2];
    type Flags = __m256;

    #[inline(always)]
    fn wide(self, numbers: &[f32; BUNDLE], part: usize) -> __m256 {
        cast::<[f32; 8], __m256>(numbers.as_chunks().0[part])
    }
    #[inline(always)]
    fn wide_put(self, numbers: &mut [f32; BUNDLE], part: usize, values: __m256) {
        numbers.as_chunks_mut().0[part] = cast::<__m256, [f32; 8]>(values);
    }
    #[inline(always)]
    fn wide_splat(self, number: f32) -> __m256 {
        self.0.avx._mm256_set1_ps(number)
    }
    #[inline(always)]
    fn wide_add(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_add_ps(a, b)
    }
    #[inline(always)]
    fn wide_sub(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_sub_ps(a, b)
    }
    #[inline(always)]
    fn wide_mul(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_mul_ps(a, b)
    }
    #[inline(always)]
    fn wide_mul_add(self, a: __m256, b: __m256, c: __m256) -> __m256 {
        self.0.fma._mm256_fmadd_ps(a, b, c)
    }
    #[inline(always)]
    fn wide_max(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_max_ps(a, b)
    }
    #[inline(always)]
    fn wide_min(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_min_ps(a, b)
    }
    #[inline(always)]
    fn wide_abs(self, a: __m256) -> __m256 {
        self.0.avx._mm256_andnot_ps(self.wide_splat(-0.0), a)
    }
    #[inline(always)]
    fn wide_turned(self, a: __m256, b: __m256) -> __m256 {
        let sign = self.0.avx._mm256_and_ps(self.wide_splat(-0.0), b);
        self.0.avx._mm256_xor_ps(a, sign)
    }
    #[inline(always)]
    fn doubles(self, numbers: &[f64; BUNDLE], part: usize) -> [__m256d; 2] {
        cast::<[f64; 8], [__m256d; 2]>(numbers.as_chunks().0[part])
    }
    #[inline(always)]
    fn minus_dot(self, c: f64, a: &[f64; 3], b: [[__m256d; 2]; 3]) -> __m256 {
        let (avx, fma) = (self.0.avx, self.0.fma);
        let mut halves = [avx._mm256_set1_pd(c); 2];
        for axis in 0..3 {
            let a = avx._mm256_set1_pd(a[axis]);
            halves[0] = fma._mm256_fnmadd_pd(a, b[axis][0], halves[0]);
            halves[1] = fma._mm256_fnmadd_pd(a, b[axis][1], halves[1]);
        }
        cast::<[__m128; 2], __m256>([avx._mm256_cvtpd_ps(halves[0]), avx._mm256_cvtpd_ps(halves[1])])
    }
    #[inline(always)]
    fn wide_lt(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_cmp_ps::<_CMP_LT_OQ>(a, b)
    }
    #[inline(always)]
    fn wide_not_lt(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_cmp_ps::<_CMP_NLT_UQ>(a, b)
    }
    #[inline(always)]
    fn both(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_and_ps(a, b)
    }
    #[inline(always)]
    fn either(self, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_or_ps(a, b)
    }
    #[inline(always)]
    fn wide_select(self, flags: __m256, a: __m256, b: __m256) -> __m256 {
        self.0.avx._mm256_blendv_ps(b, a, flags)
    }
    #[inline(always)]
    fn bits(self, flags: __m256) -> u32 {
        self.0.avx._mm256_movemask_ps(flags) as u32
    }
}
