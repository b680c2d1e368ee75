"""Renders the reference pictures that chainlight's tests compare against, with Mitsuba 3.

    python3 tests/oracle/make_references.py [--scene NAME ...] [--runs N] [--spp N]

writes tests/references/NAME.exr (channels R, G, B: the mean; variance.R, variance.G, variance.B: the
variance OF THAT MEAN, all f32) and tests/references/NAME.json (how it was made and how good it is).

The picture is the mean of many runs with seeds of their own, and its variance is estimated from the
spread of the runs alone, so nothing is assumed about the samples inside a run: they are stratified
(correlated multi-jittered), which makes the picture's mean twice as sure. Roulette is off.
"""

import argparse
import json
import math
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
# The scenes, how many runs each gets unless told otherwise, and samples per pixel of a run. What is not here is beyond a
# path tracer: see README.md.
SCENES = {
    "cornell-box": (192, 1024),
    "cornell-glass": (384, 1024),
    "cornell-index-one": (128, 256),
    "cornell-near-index-one": (192, 256),
    "cornell-glossy": (96, 256),
    "cornell-window": (128, 256),
    "veach-plates": (256, 256),
    "depth-of-field": (192, 256),
    "island": (128, 256),
}
SAMPLER = "multijitter"
CHANNELS = ["R", "G", "B", "variance.R", "variance.G", "variance.B"]


def percentiles(values):
    """Median, 90th and 99th percentile and maximum, as a dict."""
    at = {"median": 50, "p90": 90, "p99": 99, "max": 100}
    return {name: float(np.percentile(values, p)) for name, p in at.items()}


def quality(pictures):
    """How good the mean of `pictures` [run, row, column, channel] is, and whether to believe it.

    * `pixel_relative_error`: standard error of a pixel's channel over its value. Here and below,
      values under 1 % of the picture's mean are left out: they are reflections of the dark outside.
    * `mean_relative_error`: the same for the mean of the whole picture, per channel.
    * `halves_chi2`: mean of the squared difference between the two halves of the runs, over the
      variance that their own spread predicts. Right variances make it 1; missed fireflies, more.
    * `run_excess_kurtosis`: of the runs of one pixel, averaged over pixels; 0 if normal.
    * `largest_share`: the largest share that one run has in the sum of a pixel; 1 / runs if even.
    """
    runs = len(pictures)
    mean, spread = pictures.mean(0), pictures.var(0, ddof=1)
    # Where all runs agree to the last digit a lamp fills the pixel.
    lit = (mean > 0.01 * mean.mean((0, 1))) & (spread > 1e-12 * mean**2)
    halves = pictures[0::2], pictures[1::2]
    expected = sum(half.var(0, ddof=1) / len(half) for half in halves)
    chi2 = (halves[0].mean(0) - halves[1].mean(0))[lit] ** 2 / expected[lit]
    fourth = ((pictures - mean) ** 4).mean(0)[lit] / pictures.var(0)[lit] ** 2
    totals = pictures.mean((1, 2))
    return {
        "pixel_relative_error": percentiles(np.sqrt(spread[lit] / runs) / mean[lit]),
        "mean": totals.mean(0).tolist(),
        "mean_relative_error": (totals.std(0, ddof=1) / np.sqrt(runs) / totals.mean(0)).tolist(),
        "halves_chi2": float(chi2.mean()),
        "run_excess_kurtosis": float(fourth.mean() - 3.0),
        "largest_share": float((pictures.max(0)[lit] / pictures.sum(0)[lit]).max()),
    }


def make(name, options):
    # Imported here: the variant must be set first.
    import mitsuba_scene

    path = ROOT / "scenes" / f"{name}.ron"
    runs, spp = options.runs or SCENES[name][0], options.spp or SCENES[name][1]
    scene = mitsuba_scene.scene(path, options.size, options.size, SAMPLER)
    depth = mitsuba_scene.max_depth(path)
    integrator = mitsuba_scene.path_tracer(depth)
    pictures = []
    for seed in range(runs):
        pictures.append(mitsuba_scene.render(scene, integrator, spp, seed))
        if sys.stderr.isatty():
            print(f"\r{name}: run {seed + 1} of {runs}", end="", file=sys.stderr)
    pictures = np.array(pictures, dtype=np.float64)
    if not np.isfinite(pictures).all():
        raise SystemExit(f"{name}: a run holds values that are not finite")

    variance = pictures.var(0, ddof=1) / runs
    channels = np.concatenate([pictures.mean(0), variance], axis=2).astype(np.float32)
    options.out.mkdir(parents=True, exist_ok=True)
    bitmap = mi.Bitmap(channels, mi.Bitmap.PixelFormat.MultiChannel, CHANNELS)
    bitmap.write(str(options.out / f"{name}.exr"))

    about = {
        "scene": f"scenes/{name}.ron",
        "scene_sha256": mitsuba_scene.scene_hash(path),
        "renderer": f"Mitsuba {mi.__version__} {mi.variant()}",
        "integrator": "path (next event estimation, multiple importance sampling), no roulette",
        "max_depth": depth,
        "filter": "box, radius 0.5",
        "width": options.size,
        "height": options.size,
        "sampler": SAMPLER,
        "runs": runs,
        "seeds": f"0 to {runs - 1}",
        "spp_per_run": spp,
        "spp": runs * spp,
        "quality": quality(pictures),
    }
    text = json.dumps(about, indent=2) + "\n"
    (options.out / f"{name}.json").write_text(text, encoding="utf-8")
    print(text, end="")


def main():
    parser = argparse.ArgumentParser(description="Render the reference pictures with Mitsuba 3.")
    parser.add_argument("--scene", action="append", choices=list(SCENES), help="only this one")
    parser.add_argument("--runs", type=int, help="independent runs (default: by scene)")
    parser.add_argument("--spp", type=int, help="samples per pixel and run (default: by scene)")
    parser.add_argument("--size", type=int, default=24, help="width and height in pixels (default 24)")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba variant (default llvm_ad_rgb)")
    parser.add_argument("--out", type=Path, default=ROOT / "tests" / "references")
    options = parser.parse_args()
    if options.spp is not None and math.isqrt(options.spp) ** 2 != options.spp:
        parser.error("--spp: a square, or the sampler takes another number")
    if options.runs is not None and options.runs < 64:
        parser.error("--runs: at least 64, or the variance of the mean is not worth writing down")
    mi.set_variant(options.variant)
    for name in options.scene or SCENES:
        make(name, options)


if __name__ == "__main__":
    main()
