"""Mitsuba's counterparts of our cameras.

Both look from `origin` to `target` with +y up and no mirroring; Mitsuba's +x points left in its camera's
frame, and its picture is flipped accordingly, so nothing has to be done.

The reconstruction filter is a box one pixel wide, whatever the scene says, so that pixels are independent
and a pixel is the mean of the radiance over its square.
"""

import numpy as np

from mitsuba_common import Unsupported, take, to_world, vector

AXES = {"Horizontal": "x", "Vertical": "y", "Smaller": "smaller", "Larger": "larger"}


def film(width, height):
    return {
        "type": "hdrfilm",
        "width": width,
        "height": height,
        "rfilter": {"type": "box"},
        "pixel_format": "rgb",
        "component_format": "float32",
    }


def looking(f):
    import mitsuba as mi

    origin, target, up = ([float(x) for x in f[name]] for name in ("origin", "target", "up"))
    return mi.ScalarTransform4f().look_at(origin=origin, target=target, up=up)


def camera(description, width, height, sampler):
    name, f = description.name, {"up": [0, 1, 0]} | description.fields
    parts = {"film": film(width, height), "sampler": {"type": sampler}}
    if name == "Orthographic":
        take(f, ["origin", "target", "up", "height"])
        # Mitsuba's film is two wide before the transform.
        half = float(f["height"]) * width / height / 2
        scaled = to_world(np.diag([half, half, 1.0, 1.0]))
        return parts | {"type": "orthographic", "near_clip": 1e-4, "to_world": looking(f) @ scaled}
    if name not in ("Perspective", "ThinLens"):
        raise Unsupported(f"camera {name}")
    lens = ["aperture_radius"] if name == "ThinLens" else []
    take(f, ["origin", "target", "up", "fov", *lens], ["fov_axis", *(["focus_distance"] if lens else [])])
    axis = f["fov_axis"].name if "fov_axis" in f else "Vertical"
    parts |= {"to_world": looking(f), "fov": float(f["fov"]), "fov_axis": AXES[axis], "near_clip": 1e-4}
    if not lens:
        return parts | {"type": "perspective"}
    distance = np.linalg.norm(vector(f["target"]) - vector(f["origin"]))
    return parts | {
        "type": "thinlens",
        "aperture_radius": float(f["aperture_radius"]),
        "focus_distance": float(f.get("focus_distance", distance)),
    }
