"""Builds a Mitsuba 3 scene from one of our scene files.

What has no counterpart here is refused, never guessed. How the two sides are matched is said where each
block is built: mitsuba_camera.py, mitsuba_materials.py, mitsuba_shapes.py, mitsuba_lights.py. Besides:

* `max_depth` counts edges in both: 1 sees emitters only, 2 adds direct light.
* Emission is one-sided in both, on the side of the geometric normal.
* A clear interface between media of one and the same index is left out: it is nothing. So what is behind it
  is not noise here, and paths through it have fewer edges than ours.

`mitsuba.set_variant` must have been called with an rgb variant.
"""

import hashlib
from pathlib import Path

import mitsuba as mi
import numpy as np

import mitsuba_lights
import mitsuba_tessellation
import ron
from mitsuba_camera import camera
from mitsuba_common import Unsupported, rgb, take, transform
from mitsuba_materials import Materials
from mitsuba_shapes import shape, texture_map

# Russian roulette starts this deep: never.
NO_ROULETTE = 1_000_000


def max_depth(path):
    """The longest path, in edges, that the scene at `path` asks for."""
    return ron.load(path).get("settings", {}).get("max_depth", 16)


def is_nothing(material):
    """Whether a material is an interface that changes no path."""
    f = material.fields
    indices = (f.get("interior_ior"), f.get("exterior_ior", 1))
    return material.name == "Dielectric" and indices[0] == indices[1] and set(f) <= {"interior_ior", "exterior_ior"}


def scene(path, width, height, sampler="independent"):
    """The Mitsuba scene of the file at `path`, with a film of `width` x `height` pixels."""
    path = Path(path)
    description = ron.load(path)
    take(description, ["version", "camera", "film", "shapes"], ["settings", "textures", "materials", "lights"])
    take(description.get("settings", {}), [], ["max_depth", "technique"])
    if description["version"] != 1:
        raise Unsupported(f"version {description['version']}")
    directory = path.parent
    parts = {"type": "scene", "sensor": camera(description["camera"], width, height, sampler)}
    parts |= mitsuba_lights.lights(description.get("lights", []), directory)
    for index, entry in enumerate(description["shapes"]):
        take(entry, ["shape", "material"], ["name", "emission", "transform"])
        if is_nothing(description["materials"][entry["material"]]) and "emission" not in entry:
            continue
        part = shape(entry["shape"], transform(entry.get("transform", [])), directory)
        part["bsdf"] = Materials(description, directory, texture_map(entry["shape"])).named(entry["material"])
        if "emission" in entry:
            part["emitter"] = {"type": "area", "radiance": rgb(entry["emission"])}
        parts[f"shape{index}"] = part
    loaded = mi.load_dict(parts)
    mitsuba_tessellation.forget()
    return loaded


def path_tracer(depth, rr_depth=NO_ROULETTE):
    """Mitsuba's path tracer: next event estimation and multiple importance sampling."""
    settings = {"type": "path", "max_depth": depth, "rr_depth": rr_depth, "hide_emitters": False}
    return mi.load_dict(settings)


def render(loaded, integrator, spp, seed):
    """The picture as an array [row, column, channel], row 0 at the top."""
    return np.array(mi.render(loaded, integrator=integrator, spp=spp, seed=seed), dtype=np.float32)


def particle_tracer(depth):
    """Mitsuba's particle tracer: paths from the lights, joined with the camera."""
    return mi.load_dict({"type": "ptracer", "max_depth": depth, "rr_depth": NO_ROULETTE})


def files(description):
    """The files that a scene names: those of textures by name, of lights, of shapes in order."""
    named = [texture for _, texture in sorted(description.get("textures", {}).items())]
    named += description.get("lights", [])
    named += [entry["shape"] for entry in description["shapes"]]
    return [part.fields["file"] for part in named if "file" in part.fields]


def scene_hash(path):
    """SHA-256 over the scene file and the files that it names, in order."""
    path = Path(path)
    digest = hashlib.sha256(path.read_bytes())
    for file in files(ron.load(path)):
        digest.update((path.parent / file).read_bytes())
    return digest.hexdigest()
