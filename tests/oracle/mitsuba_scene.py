"""Builds a Mitsuba 3 scene from one of our scene files.

What has no counterpart here is refused, never guessed. How the two sides are matched:

* Both cameras look from `origin` to `target` with +y up and no mirroring; Mitsuba's +x points left
  in its camera's frame, and its picture is flipped accordingly, so nothing has to be done.
* `max_depth` counts edges in both: 1 sees emitters only, 2 adds direct light.
* A quad becomes a `rectangle`, whose [-1, 1] square is mapped so that its normal is edge_u x edge_v.
* A mesh gets `face_normals`: without them Mitsuba smooths the normals of a file that has none.
* Diffuse surfaces are wrapped in `twosided`; emission is one-sided in both.
* The reconstruction filter is a box one pixel wide, whatever the scene says, so that pixels are
  independent and a pixel is the mean of the radiance over its square.

`mitsuba.set_variant` must have been called with an rgb variant.
"""

import hashlib
from pathlib import Path

import mitsuba as mi
import numpy as np

import ron

# Russian roulette starts this deep: never.
NO_ROULETTE = 1_000_000


class Unsupported(ValueError):
    """The scene uses something that this builder does not know."""


def take(fields, required, optional=()):
    """The fields, checked to hold every required name and no unknown one."""
    missing = set(required) - set(fields)
    unknown = set(fields) - set(required) - set(optional)
    if missing or unknown:
        raise Unsupported(f"missing {sorted(missing)}, unknown {sorted(unknown)}")
    return fields


def rgb(values):
    return {"type": "rgb", "value": [float(v) for v in values]}


def bsdf(material):
    f = material.fields
    if material.name == "Diffuse":
        take(f, ["reflectance"], ["two_sided"])
        diffuse = {"type": "diffuse", "reflectance": rgb(f["reflectance"])}
        return {"type": "twosided", "bsdf": diffuse} if f.get("two_sided", True) else diffuse
    if material.name == "Conductor":
        take(f, ["eta", "k"])
        conductor = {"type": "conductor", "eta": rgb(f["eta"]), "k": rgb(f["k"])}
        return {"type": "twosided", "bsdf": conductor}
    if material.name == "Dielectric":
        take(f, ["interior_ior", "exterior_ior"])
        interior, exterior = float(f["interior_ior"]), float(f["exterior_ior"])
        return {"type": "dielectric", "int_ior": interior, "ext_ior": exterior}
    raise Unsupported(f"material {material.name}")


def quad(f):
    take(f, ["corner", "edge_u", "edge_v"])
    corner, u, v = (np.array(f[name], float) for name in ("corner", "edge_u", "edge_v"))
    normal = np.cross(u, v)
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1] = u / 2, v / 2
    matrix[:3, 2] = normal / np.linalg.norm(normal)
    matrix[:3, 3] = corner + u / 2 + v / 2
    return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix)}


def shape(description, directory):
    f = description.fields
    if description.name == "Quad":
        return quad(f)
    if description.name == "Sphere":
        take(f, ["center", "radius"])
        return {"type": "sphere", "center": [float(x) for x in f["center"]], "radius": float(f["radius"])}
    if description.name == "Obj":
        take(f, ["file"])
        return {"type": "obj", "filename": str(directory / f["file"]), "face_normals": True}
    raise Unsupported(f"shape {description.name}")


def camera(description, width, height, sampler):
    f = description.fields
    if description.name != "Perspective":
        raise Unsupported(f"camera {description.name}")
    take(f, ["origin", "target", "up", "fov", "fov_axis"])
    axes = {"Horizontal": "x", "Vertical": "y"}
    if f["fov_axis"].name not in axes:
        raise Unsupported(f"fov_axis {f['fov_axis'].name}")
    origin, target, up = ([float(x) for x in f[name]] for name in ("origin", "target", "up"))
    return {
        "type": "perspective",
        "to_world": mi.ScalarTransform4f().look_at(origin=origin, target=target, up=up),
        "fov": float(f["fov"]),
        "fov_axis": axes[f["fov_axis"].name],
        "film": {
            "type": "hdrfilm",
            "width": width,
            "height": height,
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
            "component_format": "float32",
        },
        "sampler": {"type": sampler},
    }


def max_depth(path):
    """The longest path, in edges, that the scene at `path` asks for."""
    return ron.load(path)["settings"]["max_depth"]


def scene(path, width, height, sampler="independent"):
    """The Mitsuba scene of the file at `path`, with a film of `width` x `height` pixels."""
    path = Path(path)
    description = ron.load(path)
    take(description, ["version", "settings", "camera", "film", "materials", "shapes"])
    take(description["settings"], ["max_depth"])
    if description["version"] != 1:
        raise Unsupported(f"version {description['version']}")
    parts = {"type": "scene", "sensor": camera(description["camera"], width, height, sampler)}
    for index, entry in enumerate(description["shapes"]):
        take(entry, ["shape", "material"], ["name", "emission"])
        part = shape(entry["shape"], path.parent)
        part["bsdf"] = bsdf(description["materials"][entry["material"]])
        if "emission" in entry:
            part["emitter"] = {"type": "area", "radiance": rgb(entry["emission"])}
        parts[f"shape{index}"] = part
    return mi.load_dict(parts)


def path_tracer(depth, rr_depth=NO_ROULETTE):
    """Mitsuba's path tracer: next event estimation and multiple importance sampling."""
    settings = {"type": "path", "max_depth": depth, "rr_depth": rr_depth, "hide_emitters": False}
    return mi.load_dict(settings)


def render(loaded, integrator, spp, seed):
    """The picture as an array [row, column, channel], row 0 at the top."""
    return np.array(mi.render(loaded, integrator=integrator, spp=spp, seed=seed), dtype=np.float32)


def scene_hash(path):
    """SHA-256 over the scene file and the meshes it names, in order."""
    path = Path(path)
    digest = hashlib.sha256(path.read_bytes())
    for entry in ron.load(path)["shapes"]:
        if entry["shape"].name == "Obj":
            digest.update((path.parent / entry["shape"].fields["file"]).read_bytes())
    return digest.hexdigest()
