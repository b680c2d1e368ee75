"""Meshes of the shapes that both sides tessellate, by the formulae of src/scene/shapes."""

import math
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

from mitsuba_common import Unsupported, perpendicular, take, unit, vector


def grid_mesh(points, normals, uvs, matrix):
    """A mesh over a grid [rows + 1, columns + 1] of points, its vertices doubled where it closes."""
    rows, columns = points.shape[0] - 1, points.shape[1] - 1
    points = points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]
    normals = normals.reshape(-1, 3) @ np.linalg.inv(matrix[:3, :3])
    lines = ["v {:.9g} {:.9g} {:.9g}".format(*p) for p in points]
    lines += ["vn {:.9g} {:.9g} {:.9g}".format(*n) for n in normals]
    lines += ["vt {:.9g} {:.9g}".format(*t) for t in uvs.reshape(-1, 2)]
    for i in range(rows):
        for j in range(columns):
            a = 1 + i * (columns + 1) + j
            b, c, d = a + columns + 1, a + columns + 2, a + 1
            for triangle in ((a, b, c), (a, c, d)):
                lines.append("f " + " ".join(f"{k}/{k}/{k}" for k in triangle))
    with tempfile.NamedTemporaryFile("w", suffix=".obj", delete=False) as file:
        file.write("\n".join(lines) + "\n")
    loaded = {"type": "obj", "filename": file.name, "face_normals": False, "flip_tex_coords": False}
    TEMPORARY.append(Path(file.name))
    return loaded


# Files to delete once Mitsuba has read them.
TEMPORARY = []


def forget():
    while TEMPORARY:
        TEMPORARY.pop().unlink()


def torus(f, matrix):
    take(f, ["center", "axis", "major_radius", "minor_radius"], ["segments"])
    around, across = f.get("segments", [64, 32])
    axis = unit(f["axis"])
    x, y = perpendicular(axis)
    major, minor = float(f["major_radius"]), float(f["minor_radius"])
    i, j = np.meshgrid(np.arange(around + 1), np.arange(across + 1), indexing="ij")
    phi, theta = 2 * math.pi * i / around, 2 * math.pi * j / across
    outward = np.cos(phi)[..., None] * x + np.sin(phi)[..., None] * y
    normals = np.cos(theta)[..., None] * outward + np.sin(theta)[..., None] * axis
    points = vector(f["center"]) + major * outward + minor * normals
    uvs = np.stack([i / around, j / across], -1)
    return grid_mesh(points, normals, uvs, matrix)


def height_field(f, matrix, directory):
    raise Unsupported("height field")
