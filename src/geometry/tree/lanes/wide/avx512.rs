//! Sixteen numbers in a register of AVX-512.

use super::{BUNDLE, Wide};
use crate::geometry::tree::lanes::Avx512;
use pulp::cast;
use std::arch::x86_64::{__m256, __m512, __m512d, _CMP_LT_OQ, _CMP_NLT_UQ};

impl Wide for Avx512 {
    const WIDTH: usize = BUNDLE;
    type Numbers = __m512;
    type Doubles = [__m512d; 2];
    type Flags = u16;

    #[inline(always)]
    fn wide(self, numbers: &[f32; BUNDLE], _: usize) -> __m512 {
        cast(*numbers)
    }
    #[inline(always)]
    fn wide_put(self, numbers: &mut [f32; BUNDLE], _: usize, values: __m512) {
        *numbers = cast(values);
    }
    #[inline(always)]
    fn wide_splat(self, number: f32) -> __m512 {
        self.0.avx512f._mm512_set1_ps(number)
    }
    #[inline(always)]
    fn wide_add(self, a: __m512, b: __m512) -> __m512 {
        self.0.avx512f._mm512_add_ps(a, b)
    }
    #[inline(always)]
    fn wide_sub(self, a: __m512, b: __m512) -> __m512 {
        self.0.avx512f._mm512_sub_ps(a, b)
    }
    #[inline(always)]
    fn wide_mul(self, a: __m512, b: __m512) -> __m512 {
        self.0.avx512f._mm512_mul_ps(a, b)
    }
    #[inline(always)]
    fn wide_mul_add(self, a: __m512, b: __m512, c: __m512) -> __m512 {
        self.0.avx512f._mm512_fmadd_ps(a, b, c)
    }
    #[inline(always)]
    fn wide_max(self, a: __m512, b: __m512) -> __m512 {
        self.0.avx512f._mm512_max_ps(a, b)
    }
    #[inline(always)]
    fn wide_min(self, a: __m512, b: __m512) -> __m512 {
        self.0.avx512f._mm512_min_ps(a, b)
    }
    #[inline(always)]
    fn wide_abs(self, a: __m512) -> __m512 {
        self.0.avx512f._mm512_abs_ps(a)
    }
    #[inline(always)]
    fn wide_turned(self, a: __m512, b: __m512) -> __m512 {
        let sign = self.0.avx512dq._mm512_and_ps(self.wide_splat(-0.0), b);
        self.0.avx512dq._mm512_xor_ps(a, sign)
    }
    #[inline(always)]
    fn doubles(self, numbers: &[f64; BUNDLE], _: usize) -> [__m512d; 2] {
        cast(*numbers)
    }
    #[inline(always)]
    fn minus_dot(self, c: f64, a: &[f64; 3], b: [[__m512d; 2]; 3]) -> __m512 {
        let f = self.0.avx512f;
        let mut halves = [f._mm512_set1_pd(c); 2];
        for axis in 0..3 {
            let a = f._mm512_set1_pd(a[axis]);
            halves[0] = f._mm512_fnmadd_pd(a, b[axis][0], halves[0]);
            halves[1] = f._mm512_fnmadd_pd(a, b[axis][1], halves[1]);
        }
        cast::<[__m256; 2], __m512>([f._mm512_cvtpd_ps(halves[0]), f._mm512_cvtpd_ps(halves[1])])
    }
    #[inline(always)]
    fn wide_lt(self, a: __m512, b: __m512) -> u16 {
        self.0.avx512f._mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b)
    }
    #[inline(always)]
    fn wide_not_lt(self, a: __m512, b: __m512) -> u16 {
        self.0.avx512f._mm512_cmp_ps_mask::<_CMP_NLT_UQ>(a, b)
    }
    #[inline(always)]
    fn both(self, a: u16, b: u16) -> u16 {
        a & b
    }
    #[inline(always)]
    fn either(self, a: u16, b: u16) -> u16 {
        a | b
    }
    #[inline(always)]
    fn wide_select(self, flags: u16, a: __m512, b: __m512) -> __m512 {
        self.0.avx512f._mm512_mask_blend_ps(flags, b, a)
    }
    #[inline(always)]
    fn bits(self, flags: u16) -> u32 {
        u32::from(flags)
    }
}
