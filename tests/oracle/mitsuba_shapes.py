"""Mitsuba's counterparts of our shapes.

* A quad becomes a `rectangle`, whose [-1, 1] square is mapped so that its normal is edge_u x edge_v and its
  texture coordinates run from the corner.
* Spheres, disks and cylinders are analytic in both; what a transform would turn into an ellipsoid is refused.
* A mesh gets `face_normals` where our side shades it flat: Mitsuba would smooth the normals of a file that
  has none.
"""

import mitsuba as mi
import numpy as np

from mitsuba_common import Unsupported, frame, perpendicular, take, to_world, unit, vector
from mitsuba_tessellation import height_field, torus


# Mitsuba's longitude starts at its x axis and turns towards y, ours starts at -z and turns towards -x, with the pole at
# y. Mitsuba's v grows from the pole down, ours up.
SPHERE_AXES = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
UPSIDE_DOWN = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


def similarity(matrix):
    """The scale of a map that keeps angles. Refuses any other."""
    linear = matrix[:3, :3]
    scale = np.cbrt(abs(np.linalg.det(linear)))
    if not np.allclose(linear.T @ linear, scale**2 * np.eye(3), rtol=0, atol=1e-5 * scale**2):
        raise Unsupported("a round shape under a map that does not keep angles")
    return scale


def point(matrix, p):
    return matrix[:3, :3] @ vector(p) + matrix[:3, 3]


def quad(f, matrix):
    take(f, ["corner", "edge_u", "edge_v"])
    corner = point(matrix, f["corner"])
    u, v = (matrix[:3, :3] @ vector(f[name]) for name in ("edge_u", "edge_v"))
    return {"type": "rectangle", "to_world": to_world(frame(u / 2, v / 2, unit(np.cross(u, v)), corner + u / 2 + v / 2))}


def cuboid(f, matrix):
    take(f, ["min", "max"])
    low, high = vector(f["min"]), vector(f["max"])
    placed = frame(*np.diag((high - low) / 2), (low + high) / 2)
    return {"type": "cube", "to_world": to_world(matrix @ placed)}


def sphere(f, matrix):
    take(f, ["radius"], ["center"])
    similarity(matrix)
    radius = float(f["radius"])
    placed = frame(*(radius * SPHERE_AXES), vector(f.get("center", [0, 0, 0])))
    return {"type": "sphere", "to_world": to_world(matrix @ placed)}


def disk(f, matrix):
    take(f, ["normal", "radius"], ["center"])
    similarity(matrix)
    normal, radius = unit(f["normal"]), float(f["radius"])
    x, y = perpendicular(normal)
    return {"type": "disk", "to_world": to_world(matrix @ frame(radius * x, radius * y, normal, vector(f.get("center", [0, 0, 0]))))}


def cylinder(f, matrix):
    take(f, ["from", "to", "radius"])
    scale = similarity(matrix)
    ends = {"p0": point(matrix, f["from"]).tolist(), "p1": point(matrix, f["to"]).tolist()}
    return {"type": "cylinder", "radius": float(f["radius"]) * scale} | ends


def has_normals(path):
    with open(path, encoding="utf-8") as lines:
        return any(line.startswith("vn ") for line in lines)


def mesh(f, matrix, directory):
    take(f, ["file"], ["smooth"])
    path = directory / f["file"]
    smooth = f.get("smooth", True) and has_normals(path)
    return {
        "type": "obj",
        "filename": str(path),
        "face_normals": not smooth,
        "flip_tex_coords": False,
        "to_world": to_world(matrix),
    }


SIMPLE = {
    "Quad": quad,
    "Box": cuboid,
    "Sphere": sphere,
    "Disk": disk,
    "Cylinder": cylinder,
    "Torus": torus,
}


FROM_FILES = {"Obj": mesh, "HeightField": height_field}


def shape(description, matrix, directory):
    """The shape, placed by `matrix` (4 x 4). Files are relative to `directory`."""
    name, f = description.name, description.fields
    if name in SIMPLE:
        return SIMPLE[name](f, matrix)
    if name in FROM_FILES:
        return FROM_FILES[name](f, matrix, directory)
    raise Unsupported(f"shape {name}")


def texture_map(description):
    """From Mitsuba's texture coordinates of a shape to ours, a matrix; `None` where they are not alike."""
    if description.name == "Sphere":
        return UPSIDE_DOWN
    return np.eye(4) if description.name in ("Quad", "Obj", "Torus", "HeightField") else None
