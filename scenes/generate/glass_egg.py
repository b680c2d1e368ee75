"""The meshes of glass-egg.ron, in centimetres: egg, table, standing lamp, spot lamp."""

import math

from curve import arc, line, rounded, spline
from mesh import Mesh
from solids import revolve, sweep


def egg():
    """A solid of revolution: half axis 12 along y, and an ellipse's width that grows towards the blunt end.

    r(t) = 8.4 sin t (1 + 0.17 cos t), y(t) = -12 cos t; the tangent is its derivative.
    """
    mesh = Mesh()
    run = []
    steps = 48
    for i in range(steps + 1):
        t = math.pi * i / steps
        s, c = math.sin(t), math.cos(t)
        slope = (8.4 * (c + 0.17 * (c * c - s * s)), 12 * s)
        length = math.hypot(*slope)
        ends = i in (0, steps)
        point = (0.0 if ends else 8.4 * s * (1 + 0.17 * c), -12 * c)
        run.append((point, (slope[0] / length, slope[1] / length)))
    revolve(mesh, [run], 64)
    mesh.write("egg", "An egg of glass: closed, smooth; the tip points along +y. Centimetres.", closed=True)


def table():
    mesh = Mesh()
    wood = dict(texture=lambda p: (p[0] / 60, p[2] / 60))
    top = rounded([(6, 71.0), (56, 71.0), (60, 72.2), (60, 75.0), (0, 75.0)], [1.5, 0.8, 1.0])
    revolve(mesh, [top], 72, **wood)
    leg = spline([(5.0, 6.0), (4.0, 14.0), (7.5, 26.0), (4.2, 40.0), (3.8, 54.0), (8.0, 66.0), (9.0, 71.3)], 4)
    revolve(mesh, [leg], 32, **wood)
    foot = rounded([(0, 0.05), (26, 0.05), (26, 2.2), (8, 5.5), (5.0, 6.0)], [0.6, 0.9, 2.0])
    revolve(mesh, [foot], 48, **wood)
    mesh.write("egg-table", "A round table on one turned leg, its top at y = 75. Centimetres.")


def lamp():
    stand = Mesh()
    foot = rounded([(0, 0.05), (16, 0.05), (16, 1.4), (3, 3.4), (1.3, 6.0)], [0.5, 0.5, 1.5])
    revolve(stand, [foot], 48)
    # Up to the bulb's socket, with a ring on the way.
    pole = [line((1.3, 6), (1.3, 88)), arc((1.3, 89.2), 1.2, -90, 90, 8), line((1.3, 90.4), (1.3, 138))]
    socket = rounded([(1.3, 138), (2.4, 139), (2.4, 143.5), (0, 143.5)], [0.6, 0.5])
    revolve(stand, [*pole, socket], 32)
    # Three spokes carry the shade.
    for k in range(3):
        angle = 2 * math.pi * k / 3
        along = (math.cos(angle), 0.0, math.sin(angle))
        ends = [(along[0] * r, 140.0, along[2] * r) for r in (1.5, 10.0, 18.9)]
        sweep(stand, spline(ends, 1), lambda t: (0.22, 0.22), 6)
    stand.write("lamp-stand", "The foot, pole and socket of a standing lamp. Centimetres.")
    shade = Mesh()
    outside = [line((21.0, 132.0), (13.5, 166.0)), line((13.5, 166.0), (13.2, 166.0))]
    inside = [line((13.2, 166.0), (20.7, 132.0)), line((20.7, 132.0), (21.0, 132.0))]
    revolve(shade, [*outside, *inside], 80)
    shade.write("lamp-shade", "A conical shade with a thickness of 3 mm, open at both ends. Centimetres.", closed=True)


def spot():
    """Its mouth is at y = 0 and it shines along -y."""
    mesh = Mesh()
    outside = rounded([(5.5, 0.0), (5.5, 26.0), (4.0, 30.0), (0, 31.0)], [2.0, 1.2])
    inside = [line((0, 27.0), (5.1, 27.0)), line((5.1, 27.0), (5.1, 0.0)), line((5.1, 0.0), (5.5, 0.0))]
    revolve(mesh, [outside, *inside], 64)
    mesh.write("spot-tube", "The tube of a spot lamp, its mouth at y = 0, shining along -y. Centimetres.", closed=True)


if __name__ == "__main__":
    egg()
    table()
    lamp()
    spot()
