//! What holds of every step, number by number; `tests/samplers/primary.rs` holds steps against their density.

use super::*;
use proptest::prelude::*;

const STARTS: [u32; 4] = [0, 1, 1 << 31, u32::MAX];
const WIDE_STARTS: [u64; 4] = [0, 1, 1 << 63, u64::MAX];

#[test]
fn sizes_that_make_no_kernel_are_refused() {
    let nan = f32::NAN;
    for (smallest, largest) in [
        (0.0, 0.1),
        (-0.1, 0.1),
        (0.1, 0.1),
        (0.2, 0.1),
        (0.1, 0.500_001),
        (LEAST_STEP / 2.0, 0.1),
        (nan, 0.1),
        (0.1, nan),
        (0.1, f32::INFINITY),
    ] {
        assert!(Kernel::new(smallest, largest).is_err(), "{smallest} {largest}");
    }
    let said = Kernel::new(0.2, 0.1).expect_err("the wrong way round").to_string();
    assert_eq!(said, "perturbations from 0.2 to 0.1 of a random number's range");
}

#[test]
fn coordinates_stay_below_one() {
    assert_eq!((to_f32(0), to_f64(0)), (0.0, 0.0));
    assert_eq!((to_f32(1 << 31), to_f64(1 << 63)), (0.5, 0.5));
    assert_eq!(to_f32(u32::MAX), 1.0 - f32::EPSILON / 2.0);
    assert_eq!(to_f64(u64::MAX), 1.0 - f64::EPSILON / 2.0);
}

#[test]
fn no_random_number_leads_past_the_ends() -> Result<(), KernelError> {
    for (smallest, largest) in [
        (LEAST_STEP, 0.5),
        (1.0 / 1024.0, 1.0 / 64.0),
        (0.001, 0.3),
        (0.499, 0.5),
    ] {
        let kernel = Kernel::new(smallest, largest)?;
        let units = |s: f32| (f64::from(s) * UNITS_NARROW).round() as u32;
        assert_eq!(kernel.perturb(0, 0), units(largest));
        let least = kernel.perturb(0, u32::MAX).wrapping_neg();
        assert!(f64::from(least - units(smallest)) <= 2e-6 * f64::from(least), "{least}");
        assert_eq!(
            kernel.perturb_wide(0, 0),
            u64::from(largest.to_bits() & 0x7f_ffff | 0x80_0000) << shift(largest)
        );
        for random in [0, 1, 2, 3, u32::MAX, u32::MAX - 1, 1 << 31] {
            assert!(kernel.log_density(0, kernel.perturb(0, random)).is_finite());
            assert!(kernel.log_density(0, kernel.uniform_in_support(0, random)).is_finite());
            assert!(kernel.log_density_wide(0, kernel.perturb_wide(0, random)).is_finite());
            assert!(
                kernel
                    .log_density_wide(0, kernel.uniform_in_support_wide(0, random))
                    .is_finite()
            );
        }
    }
    Ok(())
}

/// How far a mantissa of 24 bits is shifted to make units of 2⁻⁶⁴.
fn shift(x: f32) -> u32 {
    (x.to_bits() >> 23) + 64 - 127 - 23
}

#[test]
fn where_no_step_leads_the_density_is_zero() -> Result<(), KernelError> {
    let kernel = Kernel::new(1.0 / 1024.0, 1.0 / 64.0)?;
    let (least, most) = (1 << 22, 1 << 26);
    for c in STARTS {
        for (distance, possible) in [
            (0, false),
            (least - 1, false),
            (least, true),
            (most, true),
            (most + 1, false),
            (1 << 31, false),
        ] {
            for to in [c.wrapping_add(distance), c.wrapping_sub(distance)] {
                assert_eq!(kernel.log_density(c, to).is_finite(), possible, "{c} {distance}");
            }
        }
    }
    let at_most = libm::exp(kernel.log_density(0, most));
    assert!((at_most - 64.0 / (2.0 * 4.0 * LN_2)).abs() < 1e-12, "{at_most}");
    Ok(())
}

/// Moments of 1/(V k) over small steps: in closed form as by the rule of midpoints.
#[test]
fn weights_of_uniform_coordinates_have_the_moments_that_are_said() -> Result<(), KernelError> {
    for (smallest, largest) in [(LEAST_STEP, LONGEST_STEP), (1.0 / 1024.0, 1.0 / 16.0), (0.25, 0.251)] {
        let kernel = Kernel::new(smallest, largest)?;
        let steps = 1 << 16;
        let mut moments = [0.0; 3];
        for step in 0..steps {
            let to = kernel.perturb_wide(0, (2 * step + 1) << 15);
            let weight = libm::exp(-kernel.log_density_wide(0, to)) / kernel.support_length();
            for (moment, power) in moments.iter_mut().zip([1.0, 2.0, 4.0]) {
                *moment += libm::pow(weight, power) / f64::from(steps);
            }
        }
        let expected = [1.0, kernel.weights_of_uniform()[1], kernel.fourth_moment_of_uniform()];
        for (moment, expected) in moments.into_iter().zip(expected) {
            assert!((moment / expected - 1.0).abs() < 1e-4, "{moments:?}, {kernel:?}");
        }
        let at_largest = libm::exp(-kernel.log_density_wide(0, kernel.wide[1])) / kernel.support_length();
        assert!((at_largest / kernel.weights_of_uniform()[0] - 1.0).abs() < 1e-9);
    }
    Ok(())
}

/// Kernels of all sizes.
fn kernel() -> impl Strategy<Value = Kernel> {
    let sizes = (LEAST_STEP.to_bits()..LONGEST_STEP.to_bits()).prop_map(f32::from_bits);
    (sizes.clone(), sizes).prop_filter_map("sizes differ", |(a, b)| Kernel::new(a.min(b), a.max(b)).ok())
}

proptest! {
    #[test]
    fn a_step_wraps_around_and_can_be_taken_back(
        kernel in kernel(),
        c in prop_oneof![prop::sample::select(&STARTS[..]), any::<u32>()],
        random in any::<u32>(),
    ) {
        for y in [kernel.perturb(c, random), kernel.uniform_in_support(c, random)] {
            prop_assert!((0.0..1.0).contains(&to_f32(y)));
            let density = kernel.log_density(c, y);
            prop_assert!(density.is_finite());
            prop_assert_eq!(density.to_bits(), kernel.log_density(y, c).to_bits());
        }
        // The other sign leads back, and what is added is the same wherever the chain stands.
        let step = kernel.perturb(0, random);
        prop_assert_eq!(kernel.perturb(c, random), c.wrapping_add(step));
        prop_assert_eq!(kernel.perturb(kernel.perturb(c, random), random ^ 1), c);
    }

    #[test]
    fn a_wide_step_wraps_around_and_can_be_taken_back(
        kernel in kernel(),
        c in prop_oneof![prop::sample::select(&WIDE_STARTS[..]), any::<u64>()],
        random in any::<u32>(),
    ) {
        for y in [kernel.perturb_wide(c, random), kernel.uniform_in_support_wide(c, random)] {
            prop_assert!((0.0..1.0).contains(&to_f64(y)));
            let density = kernel.log_density_wide(c, y);
            prop_assert!(density.is_finite());
            prop_assert_eq!(density.to_bits(), kernel.log_density_wide(y, c).to_bits());
        }
        let step = kernel.perturb_wide(0, random);
        prop_assert_eq!(kernel.perturb_wide(c, random), c.wrapping_add(step));
        prop_assert_eq!(kernel.perturb_wide(kernel.perturb_wide(c, random), random ^ 1), c);
    }

    /// Both kinds take the same step, to the rounding of the narrow one.
    #[test]
    fn wide_and_narrow_steps_agree(kernel in kernel(), random in any::<u32>()) {
        let (narrow, wide) = (kernel.perturb(0, random), kernel.perturb_wide(0, random));
        let gap = (u64::from(narrow) << 32).wrapping_sub(wide) as i64;
        prop_assert!(gap.unsigned_abs() <= 1 << 32, "{narrow} {wide}");
    }
}
