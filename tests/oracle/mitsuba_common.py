"""What the builders of Mitsuba's counterparts share: checked fields, colours, vectors and transforms."""

import math

import mitsuba as mi
import numpy as np


class Unsupported(ValueError):
    """The scene uses something that has no counterpart here."""


def take(fields, required, optional=()):
    """The fields, checked to hold every required name and no unknown one."""
    missing = set(required) - set(fields)
    unknown = set(fields) - set(required) - set(optional)
    if missing or unknown:
        raise Unsupported(f"missing {sorted(missing)}, unknown {sorted(unknown)}")
    return fields


def rgb(values):
    return {"type": "rgb", "value": [float(v) for v in values]}


def vector(values):
    return np.array(values, float)


def unit(values):
    return vector(values) / np.linalg.norm(vector(values))


def perpendicular(axis):
    """Two unit vectors that make a right-handed frame with the unit vector `axis` as the third."""
    helper = [1.0, 0.0, 0.0] if abs(axis[0]) < 0.9 else [0.0, 1.0, 0.0]
    first = unit(np.cross(helper, axis))
    return first, np.cross(axis, first)


def frame(x, y, z, origin):
    """The map that takes the axes to x, y, z and zero to `origin`, as a 4 x 4 array."""
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = x, y, z, origin
    return matrix


def rotation(axis, degrees):
    """The turn about `axis` by `degrees`, counter-clockwise seen from the axis' tip (Rodrigues' formula)."""
    x, y, z = unit(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = math.radians(degrees)
    matrix = np.eye(4)
    matrix[:3, :3] += math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return matrix


def step(description):
    """One step of a `transform` list, as a 4 x 4 array."""
    name, f = description.name, description.fields
    matrix = np.eye(4)
    if name == "Translate":
        # A newtype variant that holds a tuple: one value, a list of three.
        matrix[:3, 3] = vector(f[0])
    elif name == "Scale":
        matrix[:3, :3] = np.diag(vector(f[0]))
    elif name == "Rotate":
        take(f, ["axis", "degrees"])
        matrix = rotation(f["axis"], f["degrees"])
    elif name == "Matrix":
        matrix = np.array(f[0], float)
    else:
        raise Unsupported(f"transform {name}")
    return matrix


def transform(steps):
    """The map of a whole `transform` list: its steps in the order listed."""
    matrix = np.eye(4)
    for description in steps:
        matrix = step(description) @ matrix
    return matrix


def to_world(matrix):
    return mi.ScalarTransform4f(matrix)
