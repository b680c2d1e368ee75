"""Renders a scene of ours with Mitsuba 3 to a PNG, to see what another renderer makes of it.

    python3 tests/oracle/preview.py scenes/cornell-box.ron -o box.png [--width 320] [--spp 64]

The picture is scaled by 2^exposure, clipped and encoded as sRGB, as our own PNG files are.
"""

import argparse
from pathlib import Path

import mitsuba as mi
import numpy as np

import ron


def main():
    parser = argparse.ArgumentParser(description="Render a scene file with Mitsuba 3 to a PNG.")
    parser.add_argument("scene", type=Path)
    parser.add_argument("-o", "--out", type=Path, help="default: the scene's name in the current folder")
    parser.add_argument("--width", type=int, help="pixels (default: the scene's); the height follows")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (default 64)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--exposure", type=float, default=0.0, help="stops (default 0)")
    parser.add_argument("--max-depth", type=int, help="edges (default: the scene's)")
    parser.add_argument("--light-tracing", action="store_true", help="use the particle tracer")
    parser.add_argument("--variant", default="llvm_ad_rgb", help="Mitsuba variant (default llvm_ad_rgb)")
    options = parser.parse_args()
    mi.set_variant(options.variant)
    import mitsuba_scene

    film = ron.load(options.scene)["film"]
    width = options.width or film["width"]
    height = round(width * film["height"] / film["width"])
    loaded = mitsuba_scene.scene(options.scene, width, height)
    depth = options.max_depth or mitsuba_scene.max_depth(options.scene)
    tracer = mitsuba_scene.particle_tracer if options.light_tracing else mitsuba_scene.path_tracer
    picture = mitsuba_scene.render(loaded, tracer(depth), options.spp, options.seed)
    print("mean", picture.mean((0, 1)), "finite", np.isfinite(picture).all())
    linear = np.clip(picture * 2.0**options.exposure, 0, 1)
    encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    out = options.out or Path(options.scene.stem + ".png")
    mi.Bitmap(np.round(255 * encoded).astype(np.uint8)).write(str(out))


if __name__ == "__main__":
    main()
