"""Mitsuba's counterparts of our materials and textures.

* Opaque materials are wrapped in `twosided` unless they say `two_sided: false`.
* Rough models: `distribution`, `alpha` or `alpha_u` and `alpha_v` mean the same in both, and both sample the
  visible normals. Mitsuba turns its shading frame along dp/du, as ours does.
* `Plastic` is Mitsuba's `plastic`: a smooth clear coat over a diffuse base, `nonlinear` included. Mitsuba's
  internal diffuse Fresnel reflectance is a fitted polynomial, good to some tenths of a per cent.
* A metal by name gets the RGB numbers of src/material/metals.rs, so that both sides calculate with the same.
* Our v grows from the bottom row of a picture; Mitsuba's from the top one. Rows are turned here, and meshes
  are loaded without Mitsuba's own turn. Texels are linearized here, and Mitsuba takes them as they are.
"""

import re
from pathlib import Path

import mitsuba as mi
import numpy as np

from mitsuba_common import Unsupported, rgb, take, to_world

METALS = Path(__file__).resolve().parents[2] / "src" / "material" / "metals.rs"


def metal(name):
    """eta and k of a metal by its symbol, as this program has them."""
    triple = r"\[([-0-9._eE]+), ([-0-9._eE]+), ([-0-9._eE]+)\]"
    row = re.search(rf'metal\("{re.escape(name)}", "[^"]*", {triple}, {triple}\)', METALS.read_text(encoding="utf-8"))
    if row is None:
        raise Unsupported(f"metal {name}")
    values = [float(v.replace("_", "")) for v in row.groups()]
    return {"eta": rgb(values[:3]), "k": rgb(values[3:])}


def linear_texels(path, encoding):
    """The texels of a picture file, linear, row 0 at the top, three channels."""
    bitmap = mi.Bitmap(str(path))
    eight_bit = bitmap.component_format() == mi.Struct.Type.UInt8
    values = np.array(bitmap)
    if values.ndim == 2:
        values = values[..., None]
    values = np.repeat(values, 3, 2) if values.shape[2] < 3 else values[..., :3]
    if values.dtype.kind == "u":
        values = values / np.iinfo(values.dtype).max
    values = values.astype(np.float64)
    if encoding == "Srgb" or (encoding == "Auto" and eight_bit):
        values = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    return values.astype(np.float32)


def scaled(scale, uv):
    return to_world(np.diag([float(scale[0]), float(scale[1]), 1.0, 1.0]) @ uv)


def texture(description, directory, uv):
    """`uv`: from Mitsuba's texture coordinates of the shape to ours, or `None` where no linear map is."""
    if uv is None:
        raise Unsupported(f"texture {description.name} on a shape whose texture coordinates differ")
    f = description.fields
    if description.name == "Checkerboard":
        take(f, [], ["even", "odd", "scale"])
        scale = f.get("scale", [1, 1])
        return {
            "type": "checkerboard",
            "color0": rgb(f.get("even", [0.4] * 3)),
            "color1": rgb(f.get("odd", [0.2] * 3)),
            # Mitsuba's unit square holds two by two cells.
            "to_uv": scaled([scale[0] / 2, scale[1] / 2], uv),
        }
    if description.name == "Bitmap":
        take(f, ["file"], ["encoding", "filter", "wrap", "scale"])
        named = {name: f[name].name for name in ("encoding", "filter", "wrap") if name in f}
        texels = linear_texels(directory / f["file"], named.get("encoding", "Auto"))
        return {
            "type": "bitmap",
            "bitmap": mi.Bitmap(np.ascontiguousarray(texels[::-1])),
            "raw": True,
            "filter_type": named.get("filter", "Bilinear").lower(),
            "wrap_mode": named.get("wrap", "Repeat").lower(),
            "to_uv": scaled(f.get("scale", [1, 1]), uv),
        }
    raise Unsupported(f"texture {description.name}")


class Materials:
    """Builds materials by name from the `materials` and `textures` blocks of a scene.

    `uv` is the map from Mitsuba's texture coordinates of the shape that wears them to ours.
    """

    def __init__(self, description, directory, uv):
        self.uv = uv
        self.materials = description.get("materials", {})
        self.textures = description.get("textures", {})
        self.directory = directory

    def color(self, value):
        if isinstance(value, str):
            return texture(self.textures[value], self.directory, self.uv)
        return rgb(value)

    def index(self, f):
        """A metal's complex index of refraction."""
        if "metal" in f:
            return metal(f["metal"])
        return {"eta": rgb(f["eta"]), "k": rgb(f["k"])}

    def roughness(self, f):
        distribution = f["distribution"].name.lower() if "distribution" in f else "ggx"
        if "alpha" in f:
            return {"distribution": distribution, "alpha": float(f["alpha"])}
        u, v = float(f["alpha_u"]), float(f["alpha_v"])
        return {"distribution": distribution, "alpha_u": u, "alpha_v": v}

    def interface(self, f):
        return {"int_ior": float(f["interior_ior"]), "ext_ior": float(f.get("exterior_ior", 1.0))}

    def clear(self, f):
        interface = self.interface(f)
        for ours, theirs in (("reflectance", "specular_reflectance"), ("transmittance", "specular_transmittance")):
            if ours in f:
                interface[theirs] = self.color(f[ours])
        return interface

    def named(self, name):
        return self.model(self.materials[name])

    def model(self, material):
        f = material.fields
        if material.name in ("Dielectric", "RoughDielectric"):
            rough = ["distribution", "alpha", "alpha_u", "alpha_v"] if material.name == "RoughDielectric" else []
            take(f, ["interior_ior"], ["exterior_ior", "reflectance", "transmittance", *rough])
            parts = self.clear(f) | (self.roughness(f) if rough else {})
            return {"type": material.name.lower()} | parts
        if material.name == "TwoSided":
            take(f, ["front", "back"])
            sides = [self.one_sided(self.materials[f[side]]) for side in ("front", "back")]
            return {"type": "twosided", "front": sides[0], "back": sides[1]}
        one_sided = self.one_sided(material)
        return {"type": "twosided", "bsdf": one_sided} if f.get("two_sided", True) else one_sided

    def one_sided(self, material):
        """An opaque model, as its front sees it."""
        f = material.fields
        if material.name == "Diffuse":
            take(f, ["reflectance"], ["two_sided"])
            return {"type": "diffuse", "reflectance": self.color(f["reflectance"])}
        if material.name in ("Conductor", "RoughConductor"):
            rough = ["distribution", "alpha", "alpha_u", "alpha_v"] if material.name == "RoughConductor" else []
            take(f, [], ["metal", "eta", "k", "reflectance", "two_sided", *rough])
            parts = self.index(f) | (self.roughness(f) if rough else {})
            if "reflectance" in f:
                parts["specular_reflectance"] = self.color(f["reflectance"])
            return {"type": material.name.lower()} | parts
        if material.name == "Plastic":
            optional = ["interior_ior", "exterior_ior", "diffuse_reflectance", "specular_reflectance", "nonlinear"]
            take(f, [], [*optional, "two_sided"])
            parts = self.interface({"interior_ior": 1.49} | f)
            parts["diffuse_reflectance"] = self.color(f.get("diffuse_reflectance", [0.5] * 3))
            parts["specular_reflectance"] = self.color(f.get("specular_reflectance", [1.0] * 3))
            return {"type": "plastic", "nonlinear": f.get("nonlinear", False)} | parts
        raise Unsupported(f"material {material.name}")
