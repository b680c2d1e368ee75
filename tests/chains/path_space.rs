//! A few mutations of whole paths are already an unbiased picture, and its bounds hold as often as they say.
//!
//! As of chains in primary sample space ([`super::start_up`]): 200 runs of ten mutations per pixel, direct light rendered apart,
//! against the reference of another renderer. The family of the block means has a significance of 1 %.

use crate::support::chains::Chains;
use crate::support::reference::{SIZE, reference_picture};
use crate::support::scenes::box_filtered;
use crate::support::verdict::{Family, POWER, say};
use chainlight::chain::Target;
use chainlight::film::{BlockGrid, block_means_of};
use chainlight::path::ChainTable;
use chainlight::plan::{Plan, Technique};
use chainlight::render::{ChainRender, Render, Rendering};
use chainlight::scene::Scene;
use chainlight::stats::error::{IndependentBlocks, PictureError};
use chainlight::stats::group_means::GroupMeans;
use chainlight::stats::student::t_interval;
use chainlight::stats::z_test::Estimate;
use std::sync::{Arc, LazyLock};

const MUTATIONS_PER_PIXEL: f64 = 10.0;
const RUNS: u64 = 200;
const GROUPS: u32 = 16;
/// Pixels along each side of the film, and blocks.
const SIDE: u32 = 12;
const BLOCKS_PER_SIDE: u32 = 3;
/// Block means in three channels.
const STATISTICS: usize = 3 * (BLOCKS_PER_SIDE * BLOCKS_PER_SIDE) as usize;
const NAME: &str = "cornell-box.ron";

fn grid() -> BlockGrid {
    BlockGrid::new(SIDE, SIDE, BLOCKS_PER_SIDE)
}

static SCENE: LazyLock<Arc<Scene>> = LazyLock::new(|| box_filtered(NAME, SIDE, 1.0));

/// Block means of the reference.
static TRUTH: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let pixels = reference_picture(NAME);
    let grid = BlockGrid::new(SIZE as u32, SIZE as u32, BLOCKS_PER_SIDE);
    let mean = |block, channel: usize| {
        let sum: f64 = grid.pixels_in(block).map(|pixel| pixels[pixel as usize][channel]).sum();
        sum / f64::from(grid.pixel_count(block))
    };
    (0..grid.blocks())
        .flat_map(|block| [0, 1, 2].map(|channel| mean(block, channel)))
        .collect()
});

/// What of them is not direct light, by path tracing: as in both its pictures samples draw the same numbers, what is noise of direct
/// light in one is so in the other.
static INDIRECT: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let [all, direct] = [u32::MAX, 2].map(|longest| {
        let mut plan = Plan::new(&SCENE, Technique::Pt, None);
        plan.tile.longest = longest;
        let mut render = Render::new(Arc::clone(&SCENE), plan, 1 << 40, 1).expect("a small film");
        render.burst(50_000, &|_| {});
        block_means_of(render.picture().view(), &grid()).expect("the same size")
    });
    all.iter().zip(&direct).map(|(all, direct)| all - direct).collect()
});

/// The b of chains that leave direct light out: the mean over pixels of the sum of the channels of all other.
fn true_b() -> f64 {
    INDIRECT.iter().sum::<f64>() / (STATISTICS / 3) as f64
}

fn chains(seed: u64) -> Chains {
    Chains {
        technique: Technique::Mlt,
        ..Chains::new(GROUPS, 16, 1024).seeded(seed)
    }
}

/// What one run says.
struct Run {
    /// Block means of light that is not direct, group by group.
    means: GroupMeans,
    /// Block means of direct light, and their variances.
    direct: (Vec<f64>, IndependentBlocks),
    /// b and its standard error, over the groups.
    b: Estimate,
}

impl Run {
    /// Of every block mean of the picture, its value and its standard error.
    fn estimates(&self) -> Vec<Estimate> {
        let (means, blocks) = &self.direct;
        let direct = means.iter().zip(&blocks.variances);
        let both = self.means.estimates().into_iter().zip(direct);
        both.map(|(chains, (mean, variance))| Estimate {
            mean: chains.mean + mean,
            error: (chains.error * chains.error + variance).sqrt(),
        })
        .collect()
    }

    fn stated(&self) -> PictureError {
        PictureError::of_parts(&self.means, &self.direct.1).expect("groups")
    }
}

fn run(seed: u64, spoil: fn(&ChainRender)) -> Run {
    let mut render = chains(seed).start(&SCENE);
    spoil(&render);
    render.burst(render.steps_for(MUTATIONS_PER_PIXEL), &|_| {});
    let direct = render.direct().expect("rendered apart");
    Run {
        means: render.group_block_means(&grid()).expect("finite means"),
        direct: direct.block_means(&grid()).expect("many samples"),
        b: Estimate::of(&render.run.normalizations()),
    }
}

fn runs(count: u64, first_seed: u64, spoil: fn(&ChainRender)) -> Vec<Run> {
    (0..count).map(|number| run(first_seed + number, spoil)).collect()
}

/// The number of block means that differ significantly from the truth, and the smallest visible bias of each, as a fraction, in
/// order. What is known of b is taken out, as of other chains.
fn biased(runs: &[Run]) -> (usize, Vec<f64>) {
    let tests: Vec<_> = (0..STATISTICS)
        .map(|statistic| {
            let values: Vec<f64> = runs
                .iter()
                .map(|run| run.estimates()[statistic].mean - INDIRECT[statistic] * (run.b.mean / true_b() - 1.0))
                .collect();
            Estimate::of(&values).against(TRUTH[statistic])
        })
        .collect();
    let failed = tests.iter().filter(|test| !test.passes(0.01, STATISTICS)).count();
    let visible = tests.iter().zip(&*TRUTH);
    let mut visible: Vec<f64> = visible
        .map(|(test, truth)| test.smallest_visible_bias(0.01, STATISTICS, POWER) / truth)
        .collect();
    visible.sort_by(f64::total_cmp);
    (failed, visible)
}

#[test]
fn pictures_are_unbiased_from_the_first_steps_on() {
    let runs = runs(RUNS, 1, |_| {});
    let (failed, visible) = biased(&runs);
    say(&format!(
        "mlt: smallest visible bias of a block mean {:.2} to {:.2} %, median {:.2} %",
        100.0 * visible[0],
        100.0 * visible[STATISTICS - 1],
        100.0 * visible[STATISTICS / 2]
    ));
    assert_eq!(failed, 0);
    assert!(visible[STATISTICS / 2] < 0.12);
    let b = Estimate::of(&runs.iter().map(|run| run.b.mean).collect::<Vec<_>>());
    let one = Family { tests: 1 };
    one.is("b", b, true_b(), 2e-3 * true_b(), 0.03);
    one.is_not("b, 4 % too large", b, true_b() / 1.04, 2e-3 * true_b());
    covers_as_stated(&runs);
}

/// The planted mistake of forced acceptance: every chain forgets how bright its seed is, and leaves it for the first light that it
/// finds.
fn forced_from_their_seeds(render: &ChainRender) {
    render.run.for_each_tile(&mut |chains, tile| {
        tile.write::<Target, ChainTable>(&vec![f32::MIN_POSITIVE; chains.len()]);
    });
}

#[test]
fn chains_that_are_forced_from_their_seeds_are_noticed() {
    let failed = biased(&runs(100, 50_000, forced_from_their_seeds)).0;
    say(&format!(
        "forced from their seeds: {failed} of {STATISTICS} block means are biased"
    ));
    assert!(failed > 0);
}

/// Holds that bounds cover the truth as often as they say, and that bounds of half the width would be found out.
fn covers_as_stated(runs: &[Run]) {
    let share = |holds: &dyn Fn(&Run) -> f64| runs.iter().map(holds).sum::<f64>() / runs.len() as f64;
    let inside = |low: f64, value: f64, high: f64| f64::from(u8::from((low..=high).contains(&value)));
    let realised = |run: &Run| {
        let errors = run.estimates().into_iter().zip(&*TRUTH);
        let squares: f64 = errors.map(|(e, truth)| (e.mean - truth) * (e.mean - truth)).sum();
        (squares / STATISTICS as f64).sqrt()
    };
    let b = |width: f64| {
        share(&|run| {
            let [low, high] = t_interval(run.b.mean, width * run.b.error, f64::from(GROUPS - 1), 0.95);
            inside(low, true_b(), high)
        })
    };
    let error = |width: f64| {
        share(&|run| {
            let [low, high] = run.stated().interval;
            inside(low * width, realised(run), high * width)
        })
    };
    let upper = share(&|run| inside(0.0, realised(run), run.stated().upper));
    let blocks = |width: f64| {
        share(&|run| {
            let covered = run.estimates().into_iter().zip(&*TRUTH).map(|(e, &truth)| {
                let [low, high] = t_interval(e.mean, width * e.error, f64::from(GROUPS - 1), 0.95);
                inside(low, truth, high)
            });
            covered.sum::<f64>() / STATISTICS as f64
        })
    };
    say(&format!(
        "mlt, coverage of 95 %: b {:.3}, the picture's error {:.3} (upper bound {upper:.3}), block means {:.3}",
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
