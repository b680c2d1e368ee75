"""Meshes of the shapes that both sides tessellate, by the formulae of src/scene/shapes."""

import math
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

from mitsuba_common import take, unit, vector


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
            b, c, d = a + 1, a + columns + 2, a + columns + 1
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


def axes_about(axis):
    """The columns x, y, z of the frame of a shape that is round about y = `axis`."""
    y = unit(axis)
    x = unit(np.cross(y, [0.0, 0.0, 1.0] if abs(y[2]) < 0.999 else [1.0, 0.0, 0.0]))
    return np.stack([x, y, np.cross(x, y)], 1)


def torus(f, matrix):
    take(f, ["major_radius", "minor_radius"], ["center", "axis", "segments"])
    around, along = f.get("segments", [64, 32])
    axes = axes_about(f.get("axis", [0, 1, 0]))
    j, i = np.meshgrid(np.arange(along + 1), np.arange(around + 1), indexing="ij")
    tube, turn = (2 * math.pi * (k % n / n - 0.5) for k, n in ((j, along), (i, around)))
    outward = np.stack([np.sin(turn), 0 * turn, np.cos(turn)], -1)
    normals = np.cos(tube)[..., None] * outward + np.sin(tube)[..., None] * [0.0, 1.0, 0.0]
    points = float(f["major_radius"]) * outward + float(f["minor_radius"]) * normals
    points = vector(f.get("center", [0, 0, 0])) + points @ axes.T
    return grid_mesh(points, normals @ axes.T, np.stack([i / around, j / along], -1), matrix)


def heights(f, directory):
    """Rows along u, the one at v = 0 first."""
    if "heights" in f:
        return np.array(f["heights"], float)
    values = np.array(mi.Bitmap(str(directory / f["file"])))
    values = values / np.iinfo(values.dtype).max if values.dtype.kind == "u" else values.astype(float)
    return (values if values.ndim == 2 else values.mean(2))[::-1]


def height_field(f, matrix, directory):
    take(f, ["edge_u", "edge_v"], ["heights", "file", "corner", "height"])
    field = heights(f, directory)
    rows, columns = field.shape
    u, v = vector(f["edge_u"]), vector(f["edge_v"])
    up = unit(np.cross(u, v)) * float(f.get("height", 1))
    # Over both neighbours, over one at an edge.
    slope_v, slope_u = np.gradient(field, 1 / (rows - 1), 1 / (columns - 1))
    j, i = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    points = vector(f.get("corner", [0, 0, 0])) + i[..., None] * u + j[..., None] * v + field[..., None] * up
    normals = np.cross(u + slope_u[..., None] * up, v + slope_v[..., None] * up)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    return grid_mesh(points, normals, np.stack([i, j], -1), matrix)
