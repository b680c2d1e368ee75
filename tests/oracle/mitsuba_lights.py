"""Mitsuba's counterparts of the lights that are no shapes."""

import mitsuba as mi
import numpy as np

from mitsuba_common import Unsupported, frame, rgb, rotation, take, to_world, unit, vector


def spot(f):
    take(f, ["position", "target", "intensity"], ["cutoff", "beam"])
    origin, target = vector(f["position"]), vector(f["target"])
    along = unit(target - origin)
    up = [1.0, 0.0, 0.0] if abs(along[0]) < 0.9 else [0.0, 1.0, 0.0]
    look = mi.ScalarTransform4f().look_at(origin=origin.tolist(), target=target.tolist(), up=up)
    cutoff, beam = float(f.get("cutoff", 20)), float(f.get("beam", 15))
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
    raise Unsupported(f"light {name}")


def sun_and_sky(descriptions):
    """Mitsuba's `sunsky` for our `Sun` and `Sky`, of which there may be one each under the same sky."""
    parts = {"type": "sunsky", "sun_scale": 0.0, "sky_scale": 0.0}
    skies = set()
    for entry in descriptions:
        f = entry.fields
        if entry.name == "Sun":
            take(f, ["direction"], ["turbidity", "scale"])
            towards, parts["sun_scale"] = f["direction"], float(f.get("scale", 1))
            # Our sun's angular diameter.
            parts["sun_aperture"] = 2 * 0.2665
        else:
            take(f, ["sun_direction"], ["turbidity", "albedo", "scale"])
            towards, parts["sky_scale"] = f["sun_direction"], float(f.get("scale", 1))
            parts["albedo"] = rgb(f.get("albedo", [0.3] * 3))
        skies.add((tuple(towards), float(f.get("turbidity", 3))))
    if len(skies) != 1 or len(descriptions) > 2:
        raise Unsupported("suns and skies that differ in direction or turbidity")
    [(towards, turbidity)] = skies
    # Mitsuba's sky has its zenith along z in a frame of its own, and takes the sun in the world's.
    x, y, z = unit(towards)
    zenith = rotation([1, 0, 0], -90)
    return parts | {"sun_direction": [x, y, z], "turbidity": turbidity, "to_world": to_world(zenith)}


def lights(descriptions, directory):
    """All of them, as the parts of a scene; Mitsuba knows one environment alone."""
    skies = [entry for entry in descriptions if entry.name in ("Sun", "Sky")]
    others = [entry for entry in descriptions if entry.name not in ("Sun", "Sky")]
    parts = {f"light{index}": light(entry, directory) for index, entry in enumerate(others)}
    return parts | ({"sky": sun_and_sky(skies)} if skies else {})
