//! Keyed streams: draws of neighbouring keys are uniform, and know nothing of each other. Per kind of neighbour a
//! chi-square test of the first draws, one of the pairs they make with the neighbour's, and four correlations. The same
//! tests refuse keys that are used raw, as a generator's state and stream.

use crate::support::cells::Grid;
use crate::support::verdict::Family;
use chainlight::sampling::{Purpose, StreamKey};
use chainlight::stats::z_test::Estimate;
use rand_core::Rng;
use rand_pcg::Pcg32;

const PAIRS: u64 = 1 << 20;
/// Kinds of neighbours, six tests each.
const FAMILY: Family = Family { tests: 6 * 9 };

/// The first two draws under a key.
type Draws = [f64; 2];

fn keyed(seed: u64, chain: u64, step: u64, purpose: Purpose, depth: u64) -> Draws {
    let mut stream = StreamKey::new(seed, chain as u32, step).stream(purpose, depth as u32);
    stream.next_pair().map(f64::from)
}

/// What a test of one kind of neighbour looks at.
struct Neighbours {
    name: &'static str,
    pairs: Vec<(Draws, Draws)>,
}

/// Pairs of neighbours, none of which shares a key with another pair: `draws` of a number and the neighbour's of it.
fn neighbours(name: &'static str, draws: impl Fn(u64, u64) -> Draws) -> Neighbours {
    Neighbours {
        name,
        pairs: (0..PAIRS).map(|i| (draws(i, 0), draws(i, 1))).collect(),
    }
}

/// Chains and steps of a render: 4096 chains side by side.
const fn place(i: u64) -> (u64, u64) {
    (i % 4096, i / 4096)
}

fn every_kind() -> Vec<Neighbours> {
    let across = |name, near: Purpose, far: Purpose| {
        neighbours(name, move |i, j| {
            let (chain, step) = place(i);
            keyed(1, chain, step, if j == 0 { near } else { far }, 3)
        })
    };
    vec![
        neighbours("chains", |i, j| {
            let (chain, step) = place(i);
            keyed(1, 2 * chain + j, step, Purpose::FILM, 0)
        }),
        neighbours("steps", |i, j| {
            let (chain, step) = place(i);
            keyed(1, chain, 2 * step + j, Purpose::FILM, 0)
        }),
        neighbours("depths", |i, j| {
            keyed(1, i % 4096, i / 65_536, Purpose::SCATTER, 2 * (i / 4096 % 16) + j)
        }),
        neighbours("seeds", |i, j| keyed(2 * (i / 4096) + j, i % 4096, 0, Purpose::FILM, 0)),
        across("purposes film and light", Purpose::FILM, Purpose::LIGHT),
        across("purposes light and scatter", Purpose::LIGHT, Purpose::SCATTER),
        across("purposes scatter and roulette", Purpose::SCATTER, Purpose::ROULETTE),
        // The same numbers in another part of the key.
        neighbours("chain for step", |i, j| {
            let (chain, step) = (i % 1024, 1024 + i / 1024);
            let (chain, step) = if j == 0 { (chain, step) } else { (step, chain) };
            keyed(1, chain, step, Purpose::FILM, 0)
        }),
        neighbours("first and later chains", |i, j| {
            keyed(1, i + j * (1 << 31), 0, Purpose::FILM, 0)
        }),
    ]
}

/// Counts of the first draws, and of the pairs of first draws.
fn counts(of: &Neighbours) -> [(Vec<u64>, Vec<f64>); 2] {
    let line = Grid {
        x: [0.0, 1.0],
        y: [0.0, 1.0],
        columns: 256,
        rows: 1,
    };
    let square = Grid {
        columns: 16,
        rows: 16,
        ..line
    };
    let even = vec![1.0 / 256.0; 256];
    let first = of.pairs.iter().map(|(a, _)| [a[0], 0.5]);
    let both = of.pairs.iter().map(|(a, b)| [a[0], b[0]]);
    [(line.count(first), even.clone()), (square.count(both), even)]
}

/// Covariances of each draw with each of the neighbour's.
fn covariances(of: &Neighbours) -> Vec<Estimate> {
    let covariance = |m: usize, n: usize| {
        let products: Vec<f64> = of.pairs.iter().map(|(a, b)| (a[m] - 0.5) * (b[n] - 0.5)).collect();
        Estimate::of(&products)
    };
    vec![covariance(0, 0), covariance(0, 1), covariance(1, 0), covariance(1, 1)]
}

#[test]
fn draws_of_neighbouring_keys_are_uniform_and_independent() {
    let kinds = every_kind();
    assert_eq!(6 * kinds.len(), FAMILY.tests);
    for kind in &kinds {
        for (what, (counts, even)) in ["first draws", "pairs of first draws"].into_iter().zip(counts(kind)) {
            FAMILY.follows(&format!("{}, {what}", kind.name), &counts, &even, 0.012);
        }
        for covariance in covariances(kind) {
            FAMILY.is_uncorrelated(kind.name, covariance);
        }
    }
}

#[test]
fn raw_keys_are_refused() {
    let raw = |chain: u64, step: u64| {
        let mut generator = Pcg32::new(step, chain);
        [0, 1].map(|_| f64::from(generator.next_u32()) / 4_294_967_296.0)
    };
    let kinds = [
        neighbours("raw chains", |i, j| {
            let (chain, step) = place(i);
            raw(2 * chain + j, step)
        }),
        neighbours("raw steps", |i, j| {
            let (chain, step) = place(i);
            raw(chain, 2 * step + j)
        }),
    ];
    for kind in &kinds {
        let [_, (pairs, even)] = counts(kind);
        FAMILY.refuses(kind.name, &pairs, &even);
        let refused = covariances(kind)
            .into_iter()
            .filter(|c| !c.against(0.0).passes(0.01, FAMILY.tests));
        assert!(refused.count() > 0, "{} look independent", kind.name);
    }
}
