//! The one place where a sum of squares and a square of a sum meet: exactly, in integers, so that their difference keeps
//! every digit however close they are.

use super::fixed::{SQUARE_FRACTION_BITS, VALUE_FRACTION_BITS};

/// 320 bits, least significant limb first: room for n·S₂ (64 + 192 bits) lifted by 24, and for S² (256 bits).
type Limbs = [u64; 5];

/// `n` S₂ − S², in multiples of 2⁻¹²⁸ units², where S is a sum in multiples of 2⁻⁶⁴ units and S₂ a sum of squares in
/// multiples of 2⁻¹⁰⁴ units². The difference is exact; only the conversion to `f64` rounds (relative error below 2⁻⁵²).
/// Mathematically it cannot be negative; where the rounding of tiny values to fixed point makes it so, it is zero.
pub fn scatter(n: u64, square_sum: [u64; 3], sum: i128) -> f64 {
    const LIFT: u32 = (2 * VALUE_FRACTION_BITS - SQUARE_FRACTION_BITS) as u32;
    let left = shift_left(multiply(square_sum, n), LIFT);
    subtract(left, square(sum.unsigned_abs())).map_or(0.0, to_f64)
}

fn multiply(a: [u64; 3], n: u64) -> Limbs {
    let mut out = [0; 5];
    let mut carry = 0_u128;
    for (limb, &x) in out.iter_mut().zip(&a) {
        carry += u128::from(x) * u128::from(n);
        *limb = carry as u64;
        carry >>= 64;
    }
    out[3] = carry as u64;
    out
}

fn square(a: u128) -> Limbs {
    let (low, high) = (u128::from(a as u64), a >> 64);
    let (low2, cross, high2) = (low * low, low * high, high * high);
    // a² = high2·2¹²⁸ + cross·2⁶⁵ + low2; the carries are added limb by limb.
    let parts = [
        [low2 as u64, (low2 >> 64) as u64, 0, 0],
        [0, (cross << 1) as u64, (cross >> 63) as u64, (cross >> 127) as u64],
        [0, 0, high2 as u64, (high2 >> 64) as u64],
    ];
    let mut out = [0; 5];
    let mut carry = 0_u128;
    for (i, limb) in out.iter_mut().take(4).enumerate() {
        carry += parts.iter().map(|p| u128::from(p[i])).sum::<u128>();
        *limb = carry as u64;
        carry >>= 64;
    }
    out
}

/// Shifts by fewer than 64 bits; the bits that leave the top limb are zero by the sizes above.
fn shift_left(a: Limbs, bits: u32) -> Limbs {
    let mut out = [0; 5];
    let mut carry = 0_u128;
    for (limb, &x) in out.iter_mut().zip(&a) {
        carry |= u128::from(x) << bits;
        *limb = carry as u64;
        carry >>= 64;
    }
    out
}

/// a − b, or nothing where that is negative.
fn subtract(a: Limbs, b: Limbs) -> Option<Limbs> {
    let mut out = [0; 5];
    let mut borrow = false;
    for ((limb, &x), &y) in out.iter_mut().zip(&a).zip(&b) {
        let (d, under) = x.overflowing_sub(y);
        let (d, under_borrow) = d.overflowing_sub(u64::from(borrow));
        *limb = d;
        borrow = under | under_borrow;
    }
    (!borrow).then_some(out)
}

/// The leading 128 bits or more, rounded; what is below them is under 2⁻⁶⁴ of the value.
fn to_f64(a: Limbs) -> f64 {
    let top = a.iter().rposition(|&x| x != 0).unwrap_or(0);
    let below = if top == 0 { 0 } else { a[top - 1] };
    let lead = (u128::from(a[top]) << 64) | u128::from(below);
    // `lead` counts multiples of 2^(64 (top − 1)).
    lead as f64 * super::fixed::power_of_two(64 * (top as i32 - 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::fixed::power_of_two;

    #[test]
    fn difference_of_close_giants_keeps_its_last_bit() {
        // S = 2^100 + 1, so S² = 2^200 + 2^101 + 1; S₂ lifted by 24 is 2^200 + 2^101 + 2^24.
        let squares = [1, 1 << (77 - 64), 1 << (176 - 128)];
        for sum in [(1_i128 << 100) + 1, -(1_i128 << 100) - 1] {
            assert_eq!(scatter(1, squares, sum), power_of_two(24) - 1.0);
        }
    }

    #[test]
    fn small_numbers_agree_with_plain_integers() {
        for n in [1_u64, 2, 1000, 1 << 30] {
            for squares in [0_u64, 1, 12345, 1 << 40] {
                for sum in [0_i128, 1, -77, 1 << 40] {
                    let exact = ((i128::from(n) * i128::from(squares)) << 24) - sum * sum;
                    assert_eq!(scatter(n, [squares, 0, 0], sum), exact.max(0) as f64);
                }
            }
        }
    }

    #[test]
    fn largest_operands_fit() {
        let largest = scatter(u64::MAX, [u64::MAX; 3], 0);
        assert_eq!(largest, power_of_two(64 + 192 + 24), "rounded to 53 bits");
        assert_eq!(scatter(1, [0; 3], i128::MIN), 0.0, "a negative difference is zero");
        let m = power_of_two(254);
        assert_eq!(
            scatter(1, [0, 0, 1 << 63], 0) - scatter(1, [0, 0, 1 << 63], 1 << 63),
            0.0,
            "below 53 bits of 2^215"
        );
        assert_eq!(to_f64(square(u128::MAX >> 1)), m);
        assert_eq!(square(u128::MAX), [1, 0, u64::MAX - 1, u64::MAX, 0]);
    }
}
