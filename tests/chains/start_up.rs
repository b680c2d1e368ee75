//! Chains right after their start: ten mutations per pixel, over 200 runs with sixteen chains per group, and 100 with others.
//!
//! Seeds are resampled from a bootstrap in proportion to f, and groups count by the b of those same samples, so the picture is unbiased (but for the bias of a ratio
//! over all groups, one over the number of their samples)
//! after any number of steps, from the first on: no burn-in is thrown away. Held here: block means are unbiased with one
//! chain per group, with 16 and with 64; b is; and the bounds that are stated with a picture (of b, of the picture's error,
//! of single block means) cover the truth about as often as they say.
//!
//! The truth is the committed reference of the Cornell box, reduced to 12 x 12 pixels: its mean is known to 5e-5, its blocks
//! to less than 1e-3, where one run is off by ten per cent or more. Family-wise significance is 1 %. A share of 200 runs near
//! 0.95 has a standard error of 0.015, so 0.90 and 0.99 are 3.2 and 2.6 of them off.

use crate::support::chains::Chains;
use crate::support::reference::{SIZE, reference_picture};
use crate::support::scenes::box_filtered;
use crate::support::verdict::{Family, POWER, say};
use chainlight::chain::Target;
use chainlight::film::BlockGrid;
use chainlight::path::ChainTable;
use chainlight::render::ChainRender;
use chainlight::scene::Scene;
use chainlight::stats::error::PictureError;
use chainlight::stats::group_means::GroupMeans;
use chainlight::stats::student::t_interval;
use chainlight::stats::z_test::Estimate;
use std::sync::{Arc, LazyLock};

const MUTATIONS_PER_PIXEL: f64 = 10.0;
const GROUPS: u32 = 16;
/// Samples of a group's bootstrap; a lone chain draws fewer, since its rounds are of one sample each.
const BOOTSTRAP: [u32; 2] = [1024, 64];
/// Pixels along each side of the film, and blocks.
const SIDE: u32 = 12;
const BLOCKS_PER_SIDE: u32 = 3;
/// Block means in three channels.
const STATISTICS: usize = 3 * (BLOCKS_PER_SIDE * BLOCKS_PER_SIDE) as usize;
const NAME: &str = "cornell-box.ron";

fn grid() -> BlockGrid {
    BlockGrid::new(SIDE, SIDE, BLOCKS_PER_SIDE)
}

/// Block means of the reference, as [`block_means`] orders them.
static TRUTH: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let pixels = reference_picture(NAME);
    // Blocks of the reference's film are the same rectangles, of four times as many pixels.
    let grid = BlockGrid::new(SIZE as u32, SIZE as u32, BLOCKS_PER_SIDE);
    let mean = |block, channel: usize| {
        let sum: f64 = grid.pixels_in(block).map(|pixel| pixels[pixel as usize][channel]).sum();
        sum / f64::from(grid.pixel_count(block))
    };
    (0..grid.blocks())
        .flat_map(|block| [0, 1, 2].map(|channel| mean(block, channel)))
        .collect()
});

/// b of the reference: the mean over pixels of the sum of its channels.
fn true_b() -> f64 {
    TRUTH.iter().sum::<f64>() / (STATISTICS / 3) as f64
}

/// What one run says.
struct Run {
    /// Block means, group by group.
    means: GroupMeans,
    /// b and its standard error, over the groups.
    b: Estimate,
}

/// One run of ten mutations per pixel. `spoil` may spoil the chains before their first step.
fn run(scene: &Arc<Scene>, chains: u32, seed: u64, spoil: fn(&ChainRender)) -> Run {
    let bootstrap = BOOTSTRAP[usize::from(chains == 1)];
    let mut render = Chains::new(GROUPS, chains, bootstrap).seeded(seed).start(scene);
    spoil(&render);
    render.run.burst(render.steps_for(MUTATIONS_PER_PIXEL), &|_| {});
    Run {
        means: render.group_block_means(&grid()).expect("finite means"),
        b: Estimate::of(&render.run.normalizations()),
    }
}

fn runs(count: u64, chains: u32, first_seed: u64, spoil: fn(&ChainRender)) -> Vec<Run> {
    let scene = box_filtered(NAME, SIDE, 1.0);
    (0..count)
        .map(|number| run(&scene, chains, first_seed + number, spoil))
        .collect()
}

/// The mean over runs of every statistic, as a fraction of the block's true brightness, once what is known of b is taken
/// out: a run whose b is too large by some factor is too bright by that factor, whatever its chains do. b has tests of its own.
fn shares(runs: &[Run]) -> Vec<Estimate> {
    let of = |statistic: usize| {
        let values: Vec<f64> = runs
            .iter()
            .map(|run| {
                let mean = run.means.column(statistic).sum::<f64>() / f64::from(GROUPS);
                // Unbiased where both means are: a control variate with a fixed factor.
                mean - TRUTH[statistic] * (run.b.mean / true_b() - 1.0)
            })
            .collect();
        Estimate::of(&values)
    };
    (0..STATISTICS).map(of).collect()
}

/// The number of block means that differ significantly from the truth, and the smallest visible bias of each, as a fraction.
fn biased(runs: &[Run], family: Family) -> (usize, Vec<f64>) {
    let tests: Vec<_> = shares(runs)
        .iter()
        .zip(&*TRUTH)
        .map(|(e, &truth)| e.against(truth))
        .collect();
    let failed = tests.iter().filter(|test| !test.passes(0.01, family.tests)).count();
    let visible = tests.iter().zip(&*TRUTH);
    let visible = visible.map(|(test, truth)| test.smallest_visible_bias(0.01, family.tests, POWER) / truth);
    let mut visible: Vec<f64> = visible.collect();
    visible.sort_by(f64::total_cmp);
    (failed, visible)
}

/// Leaves chains as they are.
fn as_they_start(_: &ChainRender) {}

/// The planted mistake of forced acceptance: every chain forgets how bright its seed is, and leaves it for the first light
/// that it finds.
fn forced_from_their_seeds(render: &ChainRender) {
    render.run.for_each_tile(&mut |chains, tile| {
        tile.write::<Target, ChainTable>(&vec![f32::MIN_POSITIVE; chains.len()]);
    });
}

/// The three numbers of chains per group that are looked at.
const CHAINS: [u32; 3] = [1, 16, 64];
/// Runs with each.
const RUNS: [u64; 3] = [100, 200, 100];
/// The bias of the median block mean that must be seen with each: a lone chain's ninety steps stay near its seed.
const SEES: [f64; 3] = [0.4, 0.15, 0.12];

#[test]
fn pictures_are_unbiased_from_the_first_steps_on() {
    let family = Family {
        tests: CHAINS.len() * STATISTICS,
    };
    let mut all_b = Vec::new();
    for (number, chains) in CHAINS.into_iter().enumerate() {
        let runs = runs(RUNS[number], chains, 10_000 * (number as u64 + 1), as_they_start);
        let (failed, visible) = biased(&runs, family);
        say(&format!(
            "{chains} chains per group: smallest visible bias of a block mean {:.2} to {:.2} %, median {:.2} %",
            100.0 * visible[0],
            100.0 * visible[STATISTICS - 1],
            100.0 * visible[STATISTICS / 2]
        ));
        assert_eq!(failed, 0, "{chains} chains per group");
        assert!(visible[STATISTICS / 2] < SEES[number]);
        if chains > 1 {
            all_b.extend(runs.iter().map(|run| run.b.mean));
        }
        if chains == 16 {
            covers_as_stated(&runs);
        }
    }
    let b = Estimate::of(&all_b);
    let one = Family { tests: 1 };
    one.is("b", b, true_b(), 1e-4 * true_b(), 0.02);
    one.is_not("b, 2 % too large", b, true_b() / 1.02, 1e-4 * true_b());
}

#[test]
fn chains_that_are_forced_from_their_seeds_are_noticed() {
    let family = Family {
        tests: CHAINS.len() * STATISTICS,
    };
    let runs = runs(50, 16, 50_000, forced_from_their_seeds);
    let failed = biased(&runs, family).0;
    say(&format!(
        "forced from their seeds: {failed} of {STATISTICS} block means are biased"
    ));
    assert!(failed > 0);
}

/// The share of runs for which something holds.
fn share(runs: &[Run], holds: impl Fn(&Run) -> f64) -> f64 {
    runs.iter().map(holds).sum::<f64>() / runs.len() as f64
}

/// The error that a run's picture has.
fn realised(run: &Run) -> f64 {
    let errors = run.means.estimates();
    let squares = errors
        .iter()
        .zip(&*TRUTH)
        .map(|(e, truth)| (e.mean - truth) * (e.mean - truth));
    (squares.sum::<f64>() / STATISTICS as f64).sqrt()
}

/// Holds that bounds cover the truth as often as they say, and that bounds of half the width would be found out.
fn covers_as_stated(runs: &[Run]) {
    let inside = |low: f64, value: f64, high: f64| f64::from(u8::from((low..=high).contains(&value)));
    let b = |width: f64| {
        share(runs, |run| {
            let [low, high] = t_interval(run.b.mean, width * run.b.error, f64::from(GROUPS - 1), 0.95);
            inside(low, true_b(), high)
        })
    };
    let error = |width: f64| {
        share(runs, |run| {
            let stated = PictureError::of(&run.means).expect("groups");
            inside(stated.interval[0] * width, realised(run), stated.interval[1] * width)
        })
    };
    let upper = share(runs, |run| {
        let stated = PictureError::of(&run.means).expect("groups");
        inside(0.0, realised(run), stated.upper)
    });
    let blocks = |width: f64| {
        share(runs, |run| {
            let covered = run.means.estimates().into_iter().zip(&*TRUTH).map(|(e, &truth)| {
                let [low, high] = t_interval(e.mean, width * e.error, f64::from(GROUPS - 1), 0.95);
                inside(low, truth, high)
            });
            covered.sum::<f64>() / STATISTICS as f64
        })
    };
    say(&format!(
        "coverage of 95 %: b {:.3}, the picture's error {:.3} (upper bound {upper:.3}), block means {:.3}",
        b(1.0),
        error(1.0),
        blocks(1.0)
    ));
    for (name, share) in [
        ("b", b(1.0)),
        ("error", error(1.0)),
        ("upper", upper),
        ("blocks", blocks(1.0)),
    ] {
        assert!((0.90..=0.99).contains(&share), "{name}: {share}");
    }
    for (name, share) in [("b", b(0.5)), ("error", error(0.5)), ("blocks", blocks(0.5))] {
        assert!(share < 0.85, "{name}: halved bounds still cover {share}");
    }
}

/// A dim half of the film, and a light as bright in all that fills a thousandth of it: most groups' bootstraps see only the
/// dim half, and some the light.
const RARE: &str = r#"(version: 1, settings: (max_depth: 1),
    camera: Perspective(origin: (0, 0, 2), target: (0, 0, 0), fov: 53.13010235), film: (width: 16, height: 16),
    materials: {"m": Diffuse(reflectance: (0, 0, 0))},
    shapes: [
        (shape: Quad(corner: (-1, -1, 0), edge_u: (1, 0, 0), edge_v: (0, 2, 0)), material: "m", emission: (2, 2, 2)),
        (shape: Quad(corner: (0.5, 0.5, 0), edge_u: (0.0632, 0, 0), edge_v: (0, 0.0632, 0)), material: "m",
            emission: (1000, 1000, 1000)),
    ])"#;

/// What the film's left half is, and what its mean is, exactly.
const RARE_TRUTH: [f64; 2] = [2.0, 1.0 + 1000.0 * 0.0632 * 0.0632 / 4.0];

#[test]
fn groups_count_by_what_their_bootstraps_found() {
    let scene = crate::support::scenes::inline(RARE, 16);
    let (mut dim, mut mean) = (Vec::new(), Vec::new());
    for seed in 0..40 {
        let mut render = Chains::new(128, 16, 128).seeded(90_000 + seed).start(&scene);
        render.run.burst(40, &|_| {});
        let picture = chainlight::render::Rendering::picture(&render);
        let value = |pixel: usize| f64::from(picture.rgb[pixel].g);
        let left = (0..256).filter(|pixel| pixel % 16 < 8).map(value).sum::<f64>() / 128.0;
        dim.push(left);
        mean.push((0..256).map(value).sum::<f64>() / 256.0);
    }
    let family = Family { tests: 2 };
    family.is("the dim half", Estimate::of(&dim), RARE_TRUTH[0], 2e-3, 0.15);
    family.is("the whole film", Estimate::of(&mean), RARE_TRUTH[1], 2e-3, 0.2);
    // With a b of its own for every group, the dim half came out three quarters too bright.
    family.is_not(
        "the dim half, too bright",
        Estimate::of(&dim),
        RARE_TRUTH[0] / 1.25,
        2e-3,
    );
}
