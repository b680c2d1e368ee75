"""A mesh under construction, and how it is written as a Wavefront OBJ file.

Vertices are welded by what is written: two corners with the same digits are one vertex, so that closed
surfaces are closed in the file as well. Faces are triangles or quadrilaterals, counter-clockwise seen from
outside.
"""

import math
from pathlib import Path

MESHES = Path(__file__).resolve().parents[1] / "meshes"


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scale(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return scale(a, 1 / length)


class Mesh:
    """Faces whose corners are (position, normal or None, texture coordinates or None)."""

    def __init__(self, digits=4):
        self.digits = digits
        self.lines = {"v": {}, "vn": {}, "vt": {}}
        self.faces = []

    def number(self, kind, values, digits):
        """The number of a vertex, normal or coordinate pair in the file; equal digits are one."""
        # Adding zero turns a negative zero into a plain one.
        words = []
        for value in values:
            word = f"{round(value, digits) + 0.0:.{digits}f}"
            word = word.rstrip("0").rstrip(".")
            words.append(word)
        return self.lines[kind].setdefault(" ".join(words), len(self.lines[kind]) + 1)

    def face(self, corners):
        """Adds a face; corners that are one point in the file are one corner, and fewer than three are none."""
        numbers = []
        for position, normal, uv in corners:
            v = self.number("v", position, self.digits)
            vt = "" if uv is None else self.number("vt", uv, 4)
            vn = "" if normal is None else self.number("vn", normal, 4)
            if not any(v == other[0] for other in numbers):
                numbers.append((v, vt, vn))
        if len(numbers) >= 3:
            self.faces.append(numbers)

    def flat(self, points, uvs=None):
        """A flat face: its normal is that of its plane."""
        if uvs is None:
            uvs = [None] * len(points)
        normal = unit(cross(sub(points[1], points[0]), sub(points[2], points[0])))
        self.face([(p, normal, uv) for p, uv in zip(points, uvs)])

    def grid(self, rows):
        """Faces between neighbouring corners of a grid [row][column] of corners."""
        for low, high in zip(rows, rows[1:]):
            for j in range(len(low) - 1):
                self.face([low[j], low[j + 1], high[j + 1], high[j]])

    def open_edges(self):
        """How many edges do not have exactly one neighbour in the other direction: 0 for a closed surface."""
        count = {}
        for face in self.faces:
            for (a, _, _), (b, _, _) in zip(face, face[1:] + face[:1]):
                count[a, b] = count.get((a, b), 0) + 1
        return sum(1 for (a, b), n in count.items() if n != 1 or count.get((b, a), 0) != 1)

    def write(self, name, about, closed=False):
        """Writes scenes/meshes/NAME.obj. With `closed` it must be a closed surface."""
        if closed and self.open_edges():
            raise ValueError(f"{name}: {self.open_edges()} edges are open")
        out = [f"# {line}" for line in about.strip().splitlines()]
        out.append("# Made by a script in scenes/generate: change that, not this.")
        for kind in ("v", "vt", "vn"):
            out += [f"{kind} {words}" for words in self.lines[kind]]
        for face in self.faces:
            out.append("f " + " ".join(corner(*numbers) for numbers in face))
        path = MESHES / f"{name}.obj"
        path.write_text("\n".join(out) + "\n", encoding="utf-8")
        print(f"{path.name}: {len(self.faces)} faces, {path.stat().st_size / 1024:.0f} KiB")


def corner(v, vt, vn):
    if vn == "":
        return f"{v}" if vt == "" else f"{v}/{vt}"
    return f"{v}/{vt}/{vn}"
