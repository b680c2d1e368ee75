"""Checks the scene files and the reference pictures in ways that do not rest on each other.

    python3 tests/oracle/check_references.py

1. colours: the scene files hold what cornell_spectra.py computes.
2. depth: Mitsuba with max_depth 1 shows the light and nothing else, and of the film as much of it as
   its projected area says.
3. quadrature: direct light (max_depth 2) on unshadowed walls and floor, Mitsuba against the closed
   form for a polygonal light, integrated over each pixel's footprint. It pins down camera, colours,
   emission and the depth convention.
4. light tracing: what Mitsuba's particle tracer, which builds its paths from the light, finds on the
   surfaces that the camera sees directly, caustics included, against the reference.
5. the block of index 1.00001 in cornell-near-index-one, which Mitsuba refracts at, against the one of index 1 in
   cornell-index-one, which it leaves out.
6. brute force: the whole picture against brute_force.py, which shares no code with Mitsuba.

Every comparison prints its z-scores and the smallest relative difference that it would have noticed
(4 standard errors). Exit status 1 if one fails.
"""

import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

import brute_force
import cornell_spectra
import ron

ROOT = Path(__file__).resolve().parents[2]
FAILURES = []

# The scenes' camera and light, from the published data and not from the scene files.
CAMERA = np.array([278.0, 273.0, -800.0])
HALF_WIDTH = 0.0125 / 0.035
LIGHT = np.array([[x, 548.8, z] for x, z in ((213, 227), (343, 227), (343, 332), (213, 332))])


def verdict(name, passed, text):
    print(f"{'ok  ' if passed else 'FAIL'} {name}: {text}", flush=True)
    if not passed:
        FAILURES.append(name)


def scene_path(name):
    return ROOT / "scenes" / f"{name}.ron"


def reference(name):
    """Mean and variance of the mean, [row, column, channel] each."""
    bitmap = mi.Bitmap(str(ROOT / "tests" / "references" / f"{name}.exr"))
    names = [field.name for field in bitmap.struct_()]
    values = np.array(bitmap, dtype=np.float64)
    order = [names.index(c) for c in ("R", "G", "B", "variance.R", "variance.G", "variance.B")]
    return values[..., order[:3]], values[..., order[3:]]


def compare(name, mean, runs, expected, expected_variance):
    """z-tests of independent `runs` [run, ...] against `expected`; `mean` names what a value is."""
    n = len(runs)
    error = np.sqrt(runs.var(0, ddof=1) / n + expected_variance)
    z = (runs.mean(0) - expected) / error
    chi2 = float((z**2).mean())
    noticed = 4 * np.median(error / expected)
    # Student's t with n - 1 degrees of freedom has variance (n - 1) / (n - 3). The mean of z^2 says
    # something only of many values: the channels of one value move together.
    scale = (n - 1) / (n - 3)
    passed = abs(z).max() < 4.5 * np.sqrt(scale) and (z.size < 30 or chi2 < 1.6 * scale)
    verdict(
        name,
        passed,
        f"{z.size} {mean}, largest |z| {abs(z).max():.2f}, mean z^2 {chi2:.2f}, "
        f"a difference of {100 * noticed:.2f} % would show",
    )


def check_colours():
    values = cornell_spectra.scene_values()
    cornell = ("box", "glass", "index-one", "near-index-one", "glossy")
    for name in (f"cornell-{kind}" for kind in cornell):
        scene = ron.load(scene_path(name))
        materials = {key: m.fields for key, m in scene["materials"].items()}
        lights = [entry["emission"] for entry in scene["shapes"] if "emission" in entry]
        held = {
            "white": materials["white"]["reflectance"],
            "green": materials["green"]["reflectance"],
            "red": materials["red"]["reflectance"],
            "light reflectance": materials["light"]["reflectance"],
            "light emission": lights[0],
        }
        if "silver" in materials:
            held["silver eta"], held["silver k"] = materials["silver"]["eta"], materials["silver"]["k"]
        wrong = [key for key, rgb in held.items() if rgb != values[key]]
        verdict(f"{name} colours", not wrong, f"{len(held)} values, wrong: {wrong or 'none'}")


def mitsuba_runs(name, size, integrator, spp, runs, sampler="independent"):
    import mitsuba_scene

    scene = mitsuba_scene.scene(scene_path(name), size, size, sampler)
    return np.array(
        [mitsuba_scene.render(scene, integrator, spp, seed) for seed in range(runs)], np.float64
    )


def check_depth():
    import mitsuba_scene

    light = np.array(cornell_spectra.scene_values()["light emission"])
    corners = LIGHT - CAMERA
    # The light on the film, in units of half its width; the light nowhere leaves the film.
    x, y = corners[:, 0] / corners[:, 2] / HALF_WIDTH, corners[:, 1] / corners[:, 2] / HALF_WIDTH
    share = abs(x @ np.roll(y, 1) - y @ np.roll(x, 1)) / 2 / 4
    runs = mitsuba_runs("cornell-box", 24, mitsuba_scene.path_tracer(1), 1024, 32, "multijitter")
    compare("depth 1", "channel", runs[..., 1].mean((1, 2))[:, None], light[1:2] * share, 0.0)
    dark = (runs.mean(0)[5:] == 0).all()
    verdict("depth 1, elsewhere", dark, "nothing but the light is seen")


def polygon_irradiance(point, normal, corners):
    """Irradiance at `point` from a polygon of unit radiance wholly above it (Lambert's formula)."""
    d = corners - point[..., None, :]
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    total = 0.0
    for i in range(4):
        a, b = d[..., i, :], d[..., (i + 1) % 4, :]
        axis = np.cross(a, b)
        sine = np.linalg.norm(axis, axis=-1)
        angle = np.arctan2(sine, (a * b).sum(-1))
        total = total + angle * (axis @ normal) / sine
    return np.abs(total) / 2


def direct_radiance(size, row, column, plane, normal, reflectance, emission):
    """Mean radiance of one pixel that sees only the plane axis = value, lit by all of the light."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    s, w = (nodes + 1) / 2, np.outer(weights, weights) / 4
    x, y = np.meshgrid((column + s) / size, (row + s) / size)
    # Seen along +z with +y up, the picture's right is -x.
    d = np.stack([(1 - 2 * x) * HALF_WIDTH, (1 - 2 * y) * HALF_WIDTH, np.ones_like(x)], -1)
    axis, value = plane
    point = CAMERA + d * ((value - CAMERA[axis]) / d[..., axis])[..., None]
    irradiance = (w * polygon_irradiance(point, np.array(normal, float), LIGHT)).sum()
    return irradiance / np.pi * np.array(reflectance) * np.array(emission)


def check_quadrature():
    import mitsuba_scene

    size = 24
    values = cornell_spectra.scene_values()
    back, green, floor = ((2, 559.2), [0, 0, -1]), ((0, 0.0), [1, 0, 0]), ((1, 0.0), [0, 1, 0])
    # Above the blocks, or on the floor before the tall one: nothing stands in the light's way.
    pixels = [(r, c, *back, "white") for r in (7, 8) for c in (6, 9, 12, 15, 17)]
    pixels += [(r, c, *green, "green") for r in (4, 6, 8) for c in (20, 21)]
    pixels += [(22, c, *floor, "white") for c in (2, 3, 4)]
    expected = np.array(
        [
            direct_radiance(size, r, c, plane, normal, values[colour], values["light emission"])
            for r, c, plane, normal, colour in pixels
        ]
    )
    runs = mitsuba_runs("cornell-box", size, mitsuba_scene.path_tracer(2), 1024, 32, "multijitter")
    rows, columns = [p[0] for p in pixels], [p[1] for p in pixels]
    # One channel: the others are multiples of it.
    compare("quadrature", "pixels", runs[:, rows, columns, 1], expected[:, 1], 0.0)
    ratios = runs.mean(0)[rows, columns] / expected
    spread = np.ptp(ratios, axis=1).max()
    verdict("quadrature colours", spread < 1e-4, f"channels agree to {spread:.1e}")


def blocks(picture, width):
    """Means over blocks of `width` x `width` pixels of [..., row, column, channel]."""
    *lead, rows, columns, channels = picture.shape
    shape = (*lead, rows // width, width, columns // width, width, channels)
    return picture.reshape(shape).mean((-4, -2))


def check_light_tracing(name, pixels, runs=24, spp=1024):
    """`pixels`: slices of rows and columns whose camera rays meet a diffuse surface."""
    integrator = mi.load_dict({
        "type": "ptracer",
        "max_depth": ron.load(scene_path(name))["settings"]["max_depth"],
        "rr_depth": 1_000_000,
    })
    mean, variance = reference(name)
    found = mitsuba_runs(name, mean.shape[0], integrator, spp, runs)
    for label, at in pixels.items():
        part = (slice(None), *at)
        totals = found[part].mean((1, 2))
        count = mean[at][..., 0].size
        compare(
            f"{name} light tracing, {label}",
            "channels",
            totals,
            mean[at].mean((0, 1)),
            variance[at].sum((0, 1)) / count**2,
        )


def check_same_picture(name, other):
    """Two references must show the same light, up to their noise."""
    (mean, variance), (expected, expected_variance) = reference(name), reference(other)
    z = (blocks(mean, 4) - blocks(expected, 4)) / np.sqrt(blocks(variance + expected_variance, 4) / 16)
    verdict(f"{name} as {other}", abs(z).max() < 4.5, f"{z.size} block channels, largest |z| {abs(z).max():.2f}")


def check_brute_force(name, runs=30, spp=448, width=4):
    scene = brute_force.Scene(scene_path(name))
    mean, variance = reference(name)
    found = np.array([brute_force.render(scene, mean.shape[0], spp, seed) for seed in range(runs)])
    whole = variance.sum((0, 1)) / variance[..., 0].size ** 2
    compare(f"{name} brute force, picture", "channels", found.mean((1, 2)), mean.mean((0, 1)), whole)
    compare(
        f"{name} brute force, blocks",
        "block channels",
        blocks(found, width),
        blocks(mean, width),
        blocks(variance, width) / width**2,
    )


def main():
    mi.set_variant("llvm_ad_rgb")
    check_colours()
    check_depth()
    check_quadrature()
    box = {
        "floor": (slice(20, 22), slice(2, 22)),
        "ceiling": (slice(0, 3), slice(2, 22)),
        "walls": (slice(6, 18), slice(1, 23)),
    }
    glass = {
        "floor below the glass": (slice(20, 23), slice(13, 22)),
        "ceiling": (slice(0, 3), slice(2, 22)),
        "back wall": (slice(6, 12), slice(6, 18)),
    }
    check_light_tracing("cornell-box", box)
    check_light_tracing("cornell-glass", glass)
    glossy = {"ceiling": (slice(0, 3), slice(2, 22)), "back wall": (slice(6, 9), slice(6, 18))}
    check_light_tracing("cornell-glossy", glossy)
    # Mitsuba refracts at the one block, and leaves the other out.
    check_same_picture("cornell-index-one", "cornell-near-index-one")
    for name in ("cornell-box", "cornell-glass"):
        check_brute_force(name)
    sys.exit(1 if FAILURES else 0)


if __name__ == "__main__":
    main()
