//! The small step of primary sample space against its density: for every kernel and both widths of a coordinate a
//! chi-square test of a million steps, one of a million points of the support, and the mean of 1/density, which is the
//! support's length. The starts are everywhere, the ends of the interval included.

use crate::support::cells::Grid;
use crate::support::verdict::Family;
use chainlight::chain::{Kernel, KernelError};
use chainlight::stats::z_test::Estimate;
use rand_core::Rng;
use rand_pcg::Pcg32;

const SAMPLES: usize = 1_000_000;
/// Smallest and largest steps.
const SIZES: [[f32; 2]; 3] = [[1.0 / 1_048_576.0, 0.5], [1.0 / 1024.0, 1.0 / 64.0], [0.001, 0.3]];
/// Kernels, widths, and three tests each.
const FAMILY: Family = Family { tests: 3 * 2 * 3 };
/// Cells off by this much, in the root mean square, are seen.
const SEES: f64 = 0.012;

/// A width of coordinates, as functions of wide ones.
struct Width {
    name: &'static str,
    perturb: fn(&Kernel, u64, u32) -> u64,
    uniform: fn(&Kernel, u64, u32) -> u64,
    log_density: fn(&Kernel, u64, u64) -> f64,
}

const WIDTHS: [Width; 2] = [
    Width {
        name: "narrow",
        perturb: |kernel, c, random| widened(kernel.perturb(narrowed(c), random)),
        uniform: |kernel, c, random| widened(kernel.uniform_in_support(narrowed(c), random)),
        log_density: |kernel, from, to| kernel.log_density(narrowed(from), narrowed(to)),
    },
    Width {
        name: "wide",
        perturb: Kernel::perturb_wide,
        uniform: Kernel::uniform_in_support_wide,
        log_density: Kernel::log_density_wide,
    },
];

const fn narrowed(c: u64) -> u32 {
    (c >> 32) as u32
}

const fn widened(c: u32) -> u64 {
    (c as u64) << 32
}

/// From where to where: a million steps, of which every fourth starts at an end of the interval.
fn steps(case: usize, kernel: &Kernel, step: fn(&Kernel, u64, u32) -> u64) -> Vec<[u64; 2]> {
    let mut generator = Pcg32::new(case as u64, 0x5EED);
    let mut one = |i: usize| {
        let anywhere = widened(generator.next_u32()) | u64::from(generator.next_u32());
        let from = [anywhere, anywhere, anywhere, if i % 8 == 3 { 0 } else { u64::MAX }][i % 4];
        // What is narrowed has no low half.
        let to = step(kernel, from, generator.next_u32());
        [from, to]
    };
    (0..SAMPLES).map(&mut one).collect()
}

/// The signed length of a step, the short way around.
fn length([from, to]: [u64; 2], narrow: bool) -> f64 {
    let from = if narrow { widened(narrowed(from)) } else { from };
    to.wrapping_sub(from) as i64 as f64 / 18_446_744_073_709_551_616.0
}

/// Cells of the size's logarithm, which is uniform, or of the size itself; below zero and above.
fn grid([least, most]: [f64; 2]) -> Grid {
    Grid {
        x: [least, most],
        y: [-1.0, 1.0],
        columns: 64,
        rows: 2,
    }
}

/// Sizes as the coordinates' units round them.
fn rounded(sizes: [f32; 2]) -> [f64; 2] {
    sizes.map(|s| (f64::from(s) * 4_294_967_296.0).round() / 4_294_967_296.0)
}

/// Counts by the logarithm of the size, and the probabilities that the density gives these cells.
fn logarithmic(sizes: [f32; 2], width: &Width, steps: &[[u64; 2]], density_of: &Kernel) -> (Vec<u64>, Vec<f64>) {
    let narrow = width.name == "narrow";
    let ends = if narrow { rounded(sizes) } else { sizes.map(f64::from) };
    let grid = grid(ends.map(libm::log));
    let place = |&step: &[u64; 2]| {
        let d = length(step, narrow);
        [libm::log(d.abs()), 0.5 * d.signum()]
    };
    let density = |log_size: f64, sign: f64| {
        let size = libm::exp(log_size);
        let to = (size * 18_446_744_073_709_551_616.0) as u64;
        let to = if sign < 0.0 { to.wrapping_neg() } else { to };
        size * libm::exp((width.log_density)(density_of, 0, to))
    };
    (grid.count(steps.iter().map(place)), grid.midpoint(4, density))
}

#[test]
fn steps_follow_their_density() -> Result<(), KernelError> {
    for (k, sizes) in SIZES.into_iter().enumerate() {
        let kernel = Kernel::new(sizes[0], sizes[1])?;
        for (w, width) in WIDTHS.iter().enumerate() {
            let name = format!("{} steps of {sizes:?}", width.name);
            let steps = steps(10 * k + w, &kernel, width.perturb);
            let (counts, probabilities) = logarithmic(sizes, width, &steps, &kernel);
            FAMILY.follows(&name, &counts, &probabilities, SEES);
            let inverse = |&[from, to]: &[u64; 2]| libm::exp(-(width.log_density)(&kernel, from, to));
            let lengths: Vec<f64> = steps.iter().map(inverse).collect();
            let mean = Estimate::of(&lengths);
            // Sizes carry a rounding of some 10⁻⁶ of themselves.
            let slack = 2e-6 * kernel.support_length();
            FAMILY.is(
                &format!("{name}, 1/density"),
                mean,
                kernel.support_length(),
                slack,
                0.015,
            );
        }
    }
    Ok(())
}

#[test]
fn points_of_the_support_are_uniform() -> Result<(), KernelError> {
    for (k, sizes) in SIZES.into_iter().enumerate() {
        let kernel = Kernel::new(sizes[0], sizes[1])?;
        for (w, width) in WIDTHS.iter().enumerate() {
            let narrow = width.name == "narrow";
            let grid = grid(if narrow { rounded(sizes) } else { sizes.map(f64::from) });
            let steps = steps(100 + 10 * k + w, &kernel, width.uniform);
            let place = |&step: &[u64; 2]| {
                let d = length(step, narrow);
                [d.abs(), 0.5 * d.signum()]
            };
            let counts = grid.count(steps.iter().map(place));
            let even = vec![1.0 / grid.len() as f64; grid.len()];
            FAMILY.follows(&format!("{} support of {sizes:?}", width.name), &counts, &even, SEES);
        }
    }
    Ok(())
}

#[test]
fn wrong_steps_are_refused() -> Result<(), KernelError> {
    let sizes = SIZES[1];
    let [smallest, largest] = sizes;
    let right = Kernel::new(smallest, largest)?;
    for (w, width) in WIDTHS.iter().enumerate() {
        let refuses = |name: &str, steps: &[[u64; 2]]| {
            let (counts, probabilities) = logarithmic(sizes, width, steps, &right);
            FAMILY.refuses(&format!("{} {name}", width.name), &counts, &probabilities);
        };
        refuses("uniform sizes", &steps(200 + w, &right, width.uniform));
        for (name, off) in [("largest 5 % less", 1.0 / 1.05), ("largest 5 % more", 1.05)] {
            let wrong = Kernel::new(smallest, largest * off)?;
            let steps = steps(210 + w, &wrong, width.perturb);
            refuses(name, &steps);
            // Its own densities see steps of a length that is not theirs.
            let inverse = |&[from, to]: &[u64; 2]| libm::exp(-(width.log_density)(&wrong, from, to));
            let lengths: Vec<f64> = steps.iter().map(inverse).collect();
            FAMILY.is_not(name, Estimate::of(&lengths), right.support_length(), 0.0);
        }
        // The sign forgotten.
        refuses(
            "one direction",
            &steps(220 + w, &right, |k, c, r| k.perturb_wide(c, r & !1)),
        );
    }
    Ok(())
}
