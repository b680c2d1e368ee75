"""Mitsuba's counterparts of the lights that are no shapes."""

import math
from pathlib import Path

import mitsuba as mi
import numpy as np

from mitsuba_common import Unsupported, frame, perpendicular, rgb, rotation, take, to_world, unit, vector

# Cubics of the sun's radiance: turbidity, segment of its elevation, channel, power.
SUN = Path(__file__).resolve().parents[2] / "src" / "light" / "hosek_wilkie" / "sun.f32"
SUN_RADIUS = 0.2665
# How far away the sun's disk stands, in scene units.
FAR = 1e7


def spot(f):
    take(f, ["position", "target", "intensity"], ["cutoff", "beam"])
    origin, target = vector(f["position"]), vector(f["target"])
    along = unit(target - origin)
    up = [1.0, 0.0, 0.0] if abs(along[0]) < 0.9 else [0.0, 1.0, 0.0]
    look = mi.ScalarTransform4f().look_at(origin=origin.tolist(), target=target.tolist(), up=up)
    cutoff = float(f.get("cutoff", 20))
    beam = float(f.get("beam", 0.75 * cutoff))
    if beam < cutoff:
        raise Unsupported("a spot with a soft edge: Mitsuba's falls off otherwise")
    return {"type": "spot", "to_world": look, "intensity": rgb(f["intensity"]), "cutoff_angle": cutoff, "beam_width": beam}


def environment(f, directory):
    if "radiance" in f:
        take(f, ["radiance"])
        return {"type": "constant", "radiance": rgb(f["radiance"])}
    take(f, ["file"], ["scale", "up", "rotate"])
    up = unit(f.get("up", [0, 1, 0]))
    turn = rotation(up, float(f.get("rotate", 0)))
    if abs(up[1] - 1) > 1e-6:
        raise Unsupported("an environment whose up is not +y")
    return {
        "type": "envmap",
        "filename": str(directory / f["file"]),
        "scale": float(f.get("scale", 1)),
        "to_world": to_world(turn),
    }


def light(description, directory):
    name, f = description.name, description.fields
    if name == "Point":
        take(f, ["position", "intensity"])
        return {"type": "point", "position": [float(x) for x in f["position"]], "intensity": rgb(f["intensity"])}
    if name == "Spot":
        return spot(f)
    if name == "Directional":
        take(f, ["direction", "irradiance"])
        return {"type": "directional", "direction": unit(f["direction"]).tolist(), "irradiance": rgb(f["irradiance"])}
    if name == "Environment":
        return environment(f, directory)
    if name in ("Sun", "Sky"):
        return {"Sun": sun, "Sky": sky}[name](f)
    raise Unsupported(f"light {name}")


def sun(f):
    """A far disk of the sun's angular radius, as bright as ours: Mitsuba's own sun differs by some per cent.

    It is so far away that its parallax over a scene is nothing. Its radiance rests on our table and is not checked.
    """
    take(f, ["direction"], ["turbidity", "scale"])
    towards = unit(f["direction"])
    elevation = math.asin(towards[1]) / (math.pi / 2)
    turbidity = float(f.get("turbidity", 3))
    segment = min(int(elevation ** (1 / 3) * 45), 44)
    powers = ((elevation - (segment / 45) ** 3) * math.pi / 2) ** np.arange(4)
    table = np.fromfile(SUN, "<f4").reshape(10, 45, 3, 4)[:, segment].astype(float) @ powers
    low = min(int(turbidity), 9)
    radiance = table[low - 1] + (turbidity - low) * (table[low] - table[low - 1])
    radius = FAR * math.tan(math.radians(SUN_RADIUS))
    x, y = perpendicular(-towards)
    return {
        "type": "disk",
        "to_world": to_world(frame(radius * x, radius * y, -towards, FAR * towards)),
        "bsdf": {"type": "diffuse", "reflectance": rgb([0, 0, 0])},
        "emitter": {"type": "area", "radiance": rgb(np.maximum(radiance, 0) * float(f.get("scale", 1)))},
    }


def sky(f):
    """Mitsuba's `sunsky` without the sun: the same tables, some thousandths apart."""
    take(f, ["sun_direction"], ["turbidity", "albedo", "scale"])
    return {
        "type": "sunsky",
        "sun_scale": 0.0,
        "sky_scale": float(f.get("scale", 1)),
        "turbidity": float(f.get("turbidity", 3)),
        "albedo": rgb(f.get("albedo", [0.3] * 3)),
        "sun_direction": unit(f["sun_direction"]).tolist(),
        # Its zenith is along z in a frame of its own; the sun's direction is the world's.
        "to_world": to_world(rotation([1, 0, 0], -90)),
    }


def lights(descriptions, directory):
    """All of them, as the parts of a scene; Mitsuba knows one environment alone."""
    return {f"light{index}": light(entry, directory) for index, entry in enumerate(descriptions)}
