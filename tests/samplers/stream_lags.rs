//! Keyed streams over many lags: the first draws under keys in a row (chains, steps, depths, purposes, chains with steps, and
//! what chains draw for choices, decisions, perturbations and bootstraps) are correlated with those 1 to 64 keys on and, for chains and steps, 2⁷ to 2³⁰ keys on; at lags that are powers
//! of two, where generators with related states are most alike, their pairs are tested too. All tests together raise a
//! false alarm once in a hundred; each sees a correlation of 0.006, or cells of pairs that are off by 1.3 % in the root
//! mean square. The same tests refuse streams whose keys are not hashed.

use crate::support::cells::Grid;
use crate::support::verdict::{ALPHA, Family, POWER, say};
use chainlight::sampling::{Purpose, StreamKey};
use chainlight::stats::chi_square::chi_square;
use chainlight::stats::z_test::Estimate;
use chainlight::systems::chains::bootstrap_step;
use rand_core::Rng;
use rand_pcg::Pcg32;

const PAIRS: usize = 1 << 20;
const NEAR: usize = 64;
/// Exponents of two of the far lags.
const FAR: std::ops::RangeInclusive<u32> = 7..=30;
/// Rows of keys.
const ROWS: usize = 9;
/// Near lags, far ones of two rows, and the pairs of those that are powers of two.
const FAMILY: Family = Family {
    tests: ROWS * (NEAR + 7) + 2 * 2 * 24,
};
const PURPOSES: [Purpose; 10] = [
    Purpose::FILM,
    Purpose::LIGHT,
    Purpose::SCATTER,
    Purpose::ROULETTE,
    Purpose::MUTATION,
    Purpose::ACCEPT,
    Purpose::PERTURB,
    Purpose::RESAMPLE,
    Purpose::named("one of another crate"),
    Purpose::named("two of another crate"),
];

/// What a stream is keyed by, within one render.
struct Key {
    chain: u32,
    step: u64,
    /// Its number among the purposes.
    purpose: u64,
    depth: u32,
}

impl Key {
    /// The key of which a row changes one part or two.
    const FIRST: Self = Self {
        chain: 7,
        step: 7,
        purpose: 2,
        depth: 2,
    };
}

/// Keys in a row.
struct Row {
    name: &'static str,
    key: fn(u64) -> Key,
    /// Whether the row goes on to far lags.
    long: bool,
}

const EVERY_ROW: [Row; ROWS] = [
    Row {
        name: "chains",
        key: |i| Key {
            chain: i as u32,
            ..Key::FIRST
        },
        long: true,
    },
    Row {
        name: "steps",
        key: |i| Key { step: i, ..Key::FIRST },
        long: true,
    },
    Row {
        name: "chains with steps",
        key: |i| Key {
            chain: i as u32,
            step: i,
            ..Key::FIRST
        },
        long: false,
    },
    Row {
        name: "chains against steps",
        key: |i| Key {
            chain: i as u32,
            step: (1 << 21) - i,
            ..Key::FIRST
        },
        long: false,
    },
    Row {
        name: "depths",
        key: |i| Key {
            chain: (i / 256) as u32,
            depth: (i % 256) as u32,
            ..Key::FIRST
        },
        long: false,
    },
    Row {
        name: "purposes",
        key: |i| Key {
            chain: (i / 10) as u32,
            purpose: i % 10,
            ..Key::FIRST
        },
        long: false,
    },
    // A chain's choice of a mutation, then its decision, step by step.
    Row {
        name: "choices and decisions",
        key: |i| Key {
            step: i / 2,
            purpose: 4 + i % 2,
            ..Key::FIRST
        },
        long: false,
    },
    // How far a chain moves its coordinates on the film and at its first seven vertices, step by step.
    Row {
        name: "perturbations",
        key: |i| Key {
            step: i / 8,
            purpose: 6,
            depth: (i % 8) as u32,
            ..Key::FIRST
        },
        long: false,
    },
    // Steps of a chain, and rounds of the bootstrap in which it drew samples.
    Row {
        name: "steps and rounds",
        key: |i| Key {
            step: if i % 2 == 0 { i / 2 } else { bootstrap_step(i / 2) },
            ..Key::FIRST
        },
        long: false,
    },
];

/// The first draw under a key, as renders draw it.
fn hashed(key: &Key) -> f64 {
    let mut stream = StreamKey::new(1, key.chain, key.step).stream(PURPOSES[key.purpose as usize], key.depth);
    f64::from(stream.next_f32())
}

/// The first draw if the key were used as it is: the step, with purpose and depth above it, as state, the chain as stream.
fn raw(key: &Key) -> f64 {
    let named = key.purpose << 56 | u64::from(key.depth) << 40;
    f64::from(Pcg32::new(key.step | named, u64::from(key.chain)).next_u32()) / 4_294_967_296.0
}

/// What the tests of one row found.
struct Findings {
    /// The largest |z| of a correlation, and its lag.
    worst: (f64, u64),
    /// The smallest p of the pairs, and its lag.
    rarest: (f64, u64),
    tests: usize,
    refused: usize,
}

impl Findings {
    fn correlation(&mut self, lag: u64, near: &[f64], far: &[f64]) {
        let sum: f64 = near.iter().zip(far).map(|(a, b)| (a - 0.5) * (b - 0.5)).sum();
        let z = covariance(sum).against(0.0);
        if z.z.abs() > self.worst.0 {
            self.worst = (z.z.abs(), lag);
        }
        self.count(z.passes(ALPHA, FAMILY.tests));
    }

    fn pairs(&mut self, lag: u64, near: &[f64], far: &[f64]) {
        let square = Grid {
            columns: 16,
            rows: 16,
            ..Grid::unit_square()
        };
        let counts = square.count(near.iter().zip(far).map(|(&a, &b)| [a, b]));
        let p = chi_square(&counts, &vec![1.0 / square.len() as f64; square.len()]).p;
        if p < self.rarest.0 {
            self.rarest = (p, lag);
        }
        self.count(p > FAMILY.significance());
    }

    const fn count(&mut self, passes: bool) {
        self.tests += 1;
        self.refused += !passes as usize;
    }
}

/// The mean product of `PAIRS` centred pairs. Products of independent uniform draws have mean 0 and variance 1/144, and
/// those that share a draw are uncorrelated.
fn covariance(sum: f64) -> Estimate {
    Estimate {
        mean: sum / PAIRS as f64,
        error: 1.0 / (12.0 * (PAIRS as f64).sqrt()),
    }
}

fn findings(row: &Row, draw: fn(&Key) -> f64) -> Findings {
    let from = |first: u64, many: usize| -> Vec<f64> { (first..).take(many).map(|i| draw(&(row.key)(i))).collect() };
    let draws = from(0, PAIRS + NEAR);
    let near = &draws[..PAIRS];
    let mut found = Findings {
        worst: (0.0, 0),
        rarest: (1.0, 0),
        tests: 0,
        refused: 0,
    };
    for lag in 1..=NEAR {
        let far = &draws[lag..lag + PAIRS];
        found.correlation(lag as u64, near, far);
        if lag.is_power_of_two() {
            found.pairs(lag as u64, near, far);
        }
    }
    for lag in FAR.filter(|_| row.long).map(|exponent| 1 << exponent) {
        let far = from(lag, PAIRS);
        found.correlation(lag, near, &far);
        found.pairs(lag, near, &far);
    }
    found
}

#[test]
fn draws_under_hashed_keys_are_independent_at_every_lag() {
    let correlation = covariance(0.0).against(0.0);
    let correlation = 12.0 * correlation.smallest_visible_bias(ALPHA, FAMILY.tests, POWER);
    let even = chi_square(&[PAIRS as u64 / 256; 256], &[1.0 / 256.0; 256]);
    let pairs = even.smallest_visible_deviation(FAMILY.significance(), POWER);
    say(&format!(
        "sees a correlation of {correlation:.4}, and pairs off by {pairs:.4} in the root mean square"
    ));
    assert!(correlation < 0.006 && pairs < 0.013);
    let mut tests = 0;
    for row in &EVERY_ROW {
        let found = findings(row, hashed);
        let Findings { worst, rarest, .. } = found;
        let summary = format!(
            "{}: |z| {:.2} at lag {}, p {:.5} at lag {}",
            row.name, worst.0, worst.1, rarest.0, rarest.1
        );
        say(&summary);
        assert_eq!(found.refused, 0, "{summary}");
        tests += found.tests;
    }
    assert_eq!(tests, FAMILY.tests);
}

#[test]
fn draws_under_raw_keys_are_refused_in_every_row() {
    for row in &EVERY_ROW {
        let found = findings(row, raw);
        say(&format!(
            "raw {}: |z| {:.0} at lag {}, {} of {} tests refuse",
            row.name, found.worst.0, found.worst.1, found.refused, found.tests
        ));
        assert!(found.refused > 0, "raw {} look independent", row.name);
    }
}
