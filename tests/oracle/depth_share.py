"""Measures how much of a scene's light is carried by paths longer than its `max_depth`.

    python3 tests/oracle/depth_share.py scenes/cornell-box.ron ... [--size 24] [--spp 256] [--deep 96]

Renders with both depths and the same random numbers, so that what differs is the longer paths and nothing else.
"""

import argparse
from pathlib import Path

import mitsuba as mi


def main():
    parser = argparse.ArgumentParser(description="Measure the share of light beyond a scene's max_depth.")
    parser.add_argument("scene", type=Path, nargs="+")
    parser.add_argument("--size", type=int, default=24, help="width and height (default 24)")
    parser.add_argument("--spp", type=int, default=256, help="samples per pixel (default 256)")
    parser.add_argument("--deep", type=int, default=96, help="edges of the deeper render (default 96)")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba variant (default llvm_ad_rgb)")
    options = parser.parse_args()
    mi.set_variant(options.variant)
    import mitsuba_scene

    for path in options.scene:
        scene = mitsuba_scene.scene(path, options.size, options.size)
        depth = mitsuba_scene.max_depth(path)
        means = []
        for edges in (depth, options.deep):
            tracer = mitsuba_scene.path_tracer(edges)
            means.append(mitsuba_scene.render(scene, tracer, options.spp, 1).astype(float).mean())
        print(f"{path.stem}: {100 * (means[1] - means[0]) / means[1]:.5f} % of the light beyond {depth} edges", flush=True)


if __name__ == "__main__":
    main()
