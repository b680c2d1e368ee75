"""The object that shows materials: a thick hollow ball with a wedge cut out of it, and the ring that carries it."""

import math

from curve import arc, rounded
from mesh import Mesh, dot
from solids import revolve

# How far the ball is turned, and where that begins: the wedge is missing around +x.
DEGREES, START = 264.0, 48.0
OUTER, INNER = 1.0, 0.66


def around(point):
    """Longitude and latitude as texture coordinates, without a seam where the ball is."""
    turn = math.degrees(math.atan2(-point[2], point[0])) % 360.0
    return (turn / 360.0, math.asin(max(-1.0, min(1.0, point[1] / math.dist(point, (0, 0, 0))))) / math.pi + 0.5)


def ball():
    mesh = Mesh()
    steps, segments = 32, 40
    outside = arc((0, 0), OUTER, -90, 90, steps)
    inside = arc((0, 0), INNER, 90, -90, steps)
    for run in (outside, inside):
        for end in (0, -1):
            (_, y), tangent = run[end]
            run[end] = ((0.0, y), tangent)
    revolve(mesh, [outside], segments, DEGREES, START, around)
    revolve(mesh, [inside], segments, DEGREES, START, around)
    # The two cut faces, each a half ring in a plane through the axis.
    for turn, sign in ((math.radians(START), -1), (math.radians(START + DEGREES), 1)):
        c, s = math.cos(turn), math.sin(turn)
        normal = (-sign * s, 0.0, -sign * c)
        out = [(r * c, y, -r * s) for (r, y), _ in outside]
        within = [(r * c, y, -r * s) for (r, y), _ in reversed(inside)]
        for a, b, d, e in zip(out, out[1:], within, within[1:]):
            points = [a, b, e, d]
            uvs = [(0.5 + 0.5 * math.hypot(p[0], p[2]), 0.5 + 0.5 * p[1]) for p in points]
            first, second = (tuple(q - p for p, q in zip(points[0], points[k])) for k in (1, 2))
            facing = dot((first[1] * second[2] - first[2] * second[1], 0.0, first[0] * second[1] - first[1] * second[0]), normal)
            corners = [(p, normal, uv) for p, uv in zip(points, uvs)]
            mesh.face(corners if facing > 0 else corners[::-1])
    mesh.write("material-ball", "A thick hollow ball of radius 1 with a wedge cut out around +x: closed.", closed=True)


def ring():
    mesh = Mesh()
    section = rounded(
        [(0.50, -0.96), (0.50, -1.06), (0.72, -1.06), (0.66, -0.875), (0.50, -0.875), (0.50, -0.96)],
        [0.015, 0.03, 0.03, 0.012],
        3,
    )
    revolve(mesh, [section], 40)
    mesh.write("material-ring", "A ring that carries a ball of radius 1 around the origin, down to y = -1.06.", closed=True)


if __name__ == "__main__":
    ball()
    ring()
