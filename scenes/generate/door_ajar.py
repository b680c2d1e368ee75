"""The meshes of door-ajar.ron, in metres: two rooms, a door with its frame, and a table laid with things."""

import math

from curve import rounded, spline
from mesh import Mesh
from solids import chamfered_box, panel, revolve, sweep

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
# Our room is 0..WIDTH x 0..HEIGHT x 0..DEPTH; the wall at z = 0 is WALL thick and has the doorway.
WIDTH, HEIGHT, DEPTH, WALL = 4.2, 2.6, 3.8, 0.12
DOOR_LEFT, DOOR_RIGHT, DOOR_TOP = 0.5, 1.4, 2.05
# The next room: -1.6..3.6 in x, and this far back.
NEXT_LEFT, NEXT_RIGHT, NEXT_BACK = -1.6, 3.6, -3.4
# Half the table's top, and where its legs stand.
TABLE_X, TABLE_Z, LEG_X, LEG_Z = 0.65, 0.40, 0.565, 0.315


def rooms():
    walls, floor, ceiling = Mesh(), Mesh(), Mesh()
    ours = [0, DOOR_LEFT, DOOR_RIGHT, WIDTH]
    up = [0, DOOR_TOP, HEIGHT]
    panel(walls, (0, 0, 0), X, Y, ours, up, holes=[(1, 0)])
    panel(walls, (0, 0, 0), Y, Z, [0, HEIGHT], [0, DEPTH])
    panel(walls, (WIDTH, 0, 0), Z, Y, [0, DEPTH], [0, HEIGHT])
    panel(walls, (0, 0, DEPTH), Y, X, [0, HEIGHT], [0, WIDTH])
    back = NEXT_BACK
    theirs = [0, DOOR_LEFT - NEXT_LEFT, DOOR_RIGHT - NEXT_LEFT, NEXT_RIGHT - NEXT_LEFT]
    panel(walls, (NEXT_LEFT, 0, -WALL), Y, X, up, theirs, holes=[(0, 1)])
    panel(walls, (NEXT_LEFT, 0, back), X, Y, [0, theirs[-1]], [0, HEIGHT])
    panel(walls, (NEXT_LEFT, 0, back), Y, Z, [0, HEIGHT], [0, -WALL - back])
    panel(walls, (NEXT_RIGHT, 0, back), Z, Y, [0, -WALL - back], [0, HEIGHT])
    # The sides and the head of the doorway.
    wide = DOOR_RIGHT - DOOR_LEFT
    panel(walls, (DOOR_LEFT, 0, -WALL), Y, Z, [0, DOOR_TOP], [0, WALL])
    panel(walls, (DOOR_RIGHT, 0, -WALL), Z, Y, [0, WALL], [0, DOOR_TOP])
    panel(walls, (DOOR_LEFT, DOOR_TOP, -WALL), X, Z, [0, wide], [0, WALL])
    walls.write("ajar-walls", "The walls of both rooms, with the doorway. Metres.")

    # A tile of the boards' picture is 1.2 m; the boards run along z.
    def boards(corner):
        return dict(texture=lambda a, b: ((corner[0] + b) / 1.2, (corner[2] + a) / 1.2))

    for corner, length, across in (
        ((0, 0, 0), DEPTH, ours),
        ((DOOR_LEFT, 0, -WALL), WALL, [0, wide]),
        ((NEXT_LEFT, 0, back), -WALL - back, theirs),
    ):
        panel(floor, corner, Z, X, [0, length], across, **boards(corner))
    floor.write("ajar-floor", "The floor of both rooms, with texture coordinates for boards. Metres.")
    panel(ceiling, (0, HEIGHT, 0), X, Z, [0, WIDTH], [0, DEPTH])
    panel(ceiling, (NEXT_LEFT, HEIGHT, back), X, Z, [0, theirs[-1]], [0, -WALL - back])
    ceiling.write("ajar-ceiling", "The ceilings of both rooms. Metres.")


def trim():
    """Door casing and skirting, let a centimetre into the walls."""
    mesh = Mesh()
    out, wide, bevel = 0.022, 0.085, 0.006
    chamfered_box(mesh, (DOOR_LEFT - wide, -0.01, -0.01), (DOOR_LEFT - 0.004, DOOR_TOP + 0.01, out), bevel)
    chamfered_box(mesh, (DOOR_RIGHT + 0.004, -0.01, -0.01), (DOOR_RIGHT + wide, DOOR_TOP + 0.01, out), bevel)
    low, high = DOOR_TOP + 0.004, DOOR_TOP + wide + 0.02
    chamfered_box(mesh, (DOOR_LEFT - wide - 0.015, low, -0.012), (DOOR_RIGHT + wide + 0.015, high, out + 0.006), bevel)
    thick, tall, bevel = 0.014, 0.11, 0.004
    chamfered_box(mesh, (-0.02, -0.01, -0.011), (DOOR_LEFT - wide - 0.0005, tall, thick), bevel)
    chamfered_box(mesh, (DOOR_RIGHT + wide + 0.0005, -0.01, -0.011), (WIDTH + 0.02, tall, thick), bevel)
    chamfered_box(mesh, (-0.013, -0.012, thick + 0.0005), (thick, tall + 0.0007, DEPTH + 0.02), bevel)
    chamfered_box(mesh, (WIDTH - thick, -0.012, thick + 0.0005), (WIDTH + 0.013, tall + 0.0007, DEPTH + 0.02), bevel)
    mesh.write("ajar-trim", "Door casing and skirting boards. Metres.")


def leaf_side(mesh, wide, tall, depth, sign):
    """One face of the door leaf: stiles and rails around panels that lie deeper, with a raised field each.

    The face is at z = sign * depth; `sign` says which way it looks.
    """
    xs = [0, 0.11, wide / 2 - 0.05, wide / 2 + 0.05, wide - 0.11, wide]
    ys = [0, 0.22, 0.84, 0.97, 1.56, 1.66, tall - 0.12, tall]

    def quad(points):
        mesh.flat(points if sign > 0 else points[::-1])

    def ring(outer, inner, z_outer, z_inner):
        (a, b, c, d), (e, f, g, h) = outer, inner
        a, c, e, g = (a, b), (c, d), (e, f), (g, h)
        corners = [(p[0], q[1]) for p, q in ((a, a), (c, a), (c, c), (a, c))]
        within = [(p[0], q[1]) for p, q in ((e, e), (g, e), (g, g), (e, g))]
        for k in range(4):
            n = (k + 1) % 4
            quad([
                (*corners[k], sign * z_outer),
                (*corners[n], sign * z_outer),
                (*within[n], sign * z_inner),
                (*within[k], sign * z_inner),
            ])

    def shrunk(rect, by):
        return (rect[0] + by, rect[1] + by, rect[2] - by, rect[3] - by)

    for i in range(5):
        for j in range(7):
            rect = (xs[i], ys[j], xs[i + 1], ys[j + 1])
            if i % 2 == 0 or j % 2 == 0:
                x0, y0, x1, y1 = rect
                z = sign * depth
                quad([(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)])
                continue
            ring(rect, shrunk(rect, 0.012), depth, depth - 0.011)
            ring(shrunk(rect, 0.012), shrunk(rect, 0.03), depth - 0.011, depth - 0.011)
            ring(shrunk(rect, 0.03), shrunk(rect, 0.058), depth - 0.011, depth - 0.004)
            x0, y0, x1, y1 = shrunk(rect, 0.058)
            z = sign * (depth - 0.004)
            quad([(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)])
    return xs, ys


def door():
    """The leaf in its own frame: hinges along x = 0, z = 0 is its middle plane, its foot at y = 0."""
    wide, tall, depth = DOOR_RIGHT - DOOR_LEFT - 0.008, DOOR_TOP - 0.012, 0.02
    mesh = Mesh()
    xs, ys = leaf_side(mesh, wide, tall, depth, 1)
    leaf_side(mesh, wide, tall, depth, -1)
    for a, b in zip(xs, xs[1:]):
        mesh.flat([(a, 0, -depth), (b, 0, -depth), (b, 0, depth), (a, 0, depth)])
        mesh.flat([(a, tall, depth), (b, tall, depth), (b, tall, -depth), (a, tall, -depth)])
    for a, b in zip(ys, ys[1:]):
        mesh.flat([(0, a, -depth), (0, a, depth), (0, b, depth), (0, b, -depth)])
        mesh.flat([(wide, a, depth), (wide, a, -depth), (wide, b, -depth), (wide, b, depth)])
    mesh.write("ajar-door", "A door leaf with six panels; hinges at x = 0. Metres.", closed=True)

    metal = Mesh()
    x, y = wide - 0.065, 1.02
    for side in (1, -1):
        chamfered_box(
            metal,
            (x - 0.022, y - 0.13, min(side * (depth - 0.001), side * (depth + 0.006))),
            (x + 0.022, y + 0.06, max(side * (depth - 0.001), side * (depth + 0.006))),
            0.0025,
        )
        lever = [(x, y, side * depth), (x, y, side * (depth + 0.045)), (x - 0.02, y, side * (depth + 0.058))]
        lever += [(x - 0.06, y, side * (depth + 0.06)), (x - 0.115, y - 0.004, side * (depth + 0.056))]
        sweep(metal, spline(lever, 5), lambda t: (0.0085 - 0.001 * t, 0.0085 + 0.002 * t), 16)
    metal.write("ajar-handle", "Plates and levers of the door, both sides. Metres.")


def table():
    """1.3 x 0.8 m, its top at y = 0.74, centred; four turned legs, an apron, a top with a moulded edge."""
    mesh = Mesh()
    half_x, half_z = TABLE_X, TABLE_Z
    wood = dict(texture=lambda p, axis: (p[2] / 0.5, p[0] / 1.3) if axis != 2 else (p[1] / 0.5, p[0] / 1.3))
    chamfered_box(mesh, (-half_x, 0.708, -half_z), (half_x, 0.740, half_z), 0.006, **wood)
    inset, thick = 0.075, 0.022
    for z in (-half_z + inset, half_z - inset - thick):
        chamfered_box(mesh, (-half_x + 0.09, 0.612, z), (half_x - 0.09, 0.7125, z + thick), 0.002, **wood)
    for x in (-half_x + inset, half_x - inset - thick):
        chamfered_box(mesh, (x, 0.6125, -half_z + 0.09), (x + thick, 0.7127, half_z - 0.09), 0.002, **wood)
    vase = [(0.017, 0.03), (0.021, 0.10), (0.030, 0.30), (0.034, 0.43), (0.0255, 0.475), (0.021, 0.515)]
    profile = [
        rounded([(0, 0.0005), (0.013, 0.0005), (0.023, 0.012), (0.017, 0.03)], [0.004, 0.006], 3),
        spline(vase, 4),
        rounded([(0.021, 0.515), (0.031, 0.518), (0.031, 0.531), (0.022, 0.534)], [0.005, 0.005], 3),
        rounded([(0.022, 0.534), (0.022, 0.545), (0.036, 0.552), (0.036, 0.575), (0.030, 0.581)], [0.004, 0.004, 0.004], 2),
    ]
    for sx in (-1, 1):
        for sz in (-1, 1):
            x, z = sx * LEG_X, sz * LEG_Z
            chamfered_box(mesh, (x - 0.037, 0.5795, z - 0.037), (x + 0.037, 0.7123, z + 0.037), 0.003, **wood)
    mesh.write("ajar-table", "A table without its legs, its top at y = 0.74, centred. Metres.")
    leg = Mesh(digits=5)
    revolve(leg, profile, 28, texture=lambda p: (p[0] / 0.3 + p[2] / 0.9, p[1] / 1.1))
    leg.write("ajar-table-leg", f"A turned leg of the table; they stand at x = +-{LEG_X}, z = +-{LEG_Z}. Metres.")


def carafe():
    """A solid of glass with its hollow: one closed surface, foot to rim outside and back inside."""
    mesh = Mesh(digits=5)
    foot = rounded([(0, 0.0), (0.058, 0.0), (0.0655, 0.03)], [0.006], 5)
    end, slope = foot[-1]
    belly = [end, (0.0735, 0.058), (0.0725, 0.090), (0.053, 0.132), (0.0325, 0.168), (0.0265, 0.198), (0.0315, 0.226), (0.0415, 0.248)]
    outside = spline(belly, 4)
    outside[0] = (end, slope)
    tip, (tx, ty) = outside[-1]
    nx, ny = -ty, tx
    # The rim: half a turn around a point beside the tip; the wall is 2.6 mm thick.
    wall = 0.0026
    rim = []
    for i in range(7):
        angle = math.pi * i / 6
        c, s = math.cos(angle), math.sin(angle)
        center = (tip[0] + nx * wall / 2, tip[1] + ny * wall / 2)
        point = (center[0] - nx * c * wall / 2 + tx * s * wall / 2, center[1] - ny * c * wall / 2 + ty * s * wall / 2)
        rim.append((point, (nx * s + tx * c, ny * s + ty * c)))
    inside = []
    for (r, y), (dr, dy) in reversed(outside[1:]):
        inside.append(((r - dy * wall, y + dr * wall), (-dr, -dy)))
    # The bottom is 8 mm of glass.
    (r, y), slope = inside[-1]
    bottom = rounded([(r, y), (0.054, 0.010), (0, 0.0085)], [0.014], 6)
    bottom[0] = ((r, y), slope)
    run = foot + outside[1:] + rim[1:] + inside[1:] + bottom[1:]
    run = run[: len(foot) - 1] + [(end, slope_between(foot[-1][1], outside[1][1]))] + run[len(foot) :]
    revolve(mesh, [run], 40)
    mesh.write("carafe", "A carafe of glass, hollow and open above: one closed, smooth surface. Metres.", closed=True)


def slope_between(a, b):
    length = math.hypot(a[0] + b[0], a[1] + b[1])
    return ((a[0] + b[0]) / length, (a[1] + b[1]) / length)


def teapot():
    """Body, lid, spout and handle; the last two run into the body. Stands on y = 0, its spout along +x."""
    mesh = Mesh(digits=5)
    foot = rounded([(0, 0.0), (0.052, 0.0), (0.052, 0.007), (0.048, 0.011)], [0.002, 0.002], 3)
    belly = spline([(0.048, 0.011), (0.078, 0.040), (0.088, 0.078), (0.076, 0.118), (0.050, 0.142)], 6)
    neck = rounded([(0.050, 0.142), (0.052, 0.149), (0.049, 0.152), (0.047, 0.150)], [0.002, 0.001], 3)
    lid = spline([(0.047, 0.150), (0.040, 0.158), (0.020, 0.167), (0.0075, 0.171), (0.006, 0.176)], 3)
    knob = spline([(0.006, 0.176), (0.0125, 0.182), (0.0135, 0.190), (0.009, 0.197), (0.0, 0.199)], 3)
    revolve(mesh, [foot, belly, neck, lid, knob], 40)
    tube = spline([(0.070, 0.050, 0.0), (0.105, 0.064, 0.0), (0.128, 0.105, 0.0), (0.152, 0.146, 0.0)], 5)
    sweep(mesh, tube, lambda t: (0.021 - 0.0125 * t**0.7, 0.021 - 0.0125 * t**0.7), 18)
    bow = [(-0.070, 0.122, 0.0), (-0.105, 0.140, 0.0), (-0.142, 0.116, 0.0), (-0.134, 0.075, 0.0), (-0.080, 0.046, 0.0)]
    sweep(mesh, spline(bow, 5), lambda t: (0.0075, 0.0055), 12)
    mesh.write("teapot", "A teapot, its spout along +x. Metres.")


def jug():
    """A jug of glazed clay: hollow, with a lip and a handle."""
    mesh = Mesh(digits=5)
    outside = [(0.043, 0.006), (0.058, 0.045), (0.060, 0.085), (0.046, 0.135), (0.042, 0.160), (0.052, 0.190)]
    inside = [(0.0485, 0.189), (0.039, 0.160), (0.043, 0.135), (0.056, 0.085), (0.054, 0.045), (0.0, 0.012)]
    foot = rounded([(0, 0.0), (0.041, 0.0), (0.043, 0.006)], [0.002], 3)
    lip = rounded([(0.052, 0.190), (0.0525, 0.1925), (0.049, 0.1925), (0.0485, 0.189)], [0.001, 0.001], 2)
    revolve(mesh, [foot, spline(outside, 5), lip, spline(inside, 4)], 40)
    bow = [(-0.043, 0.172, 0.0), (-0.075, 0.176, 0.0), (-0.092, 0.140, 0.0), (-0.082, 0.095, 0.0), (-0.055, 0.068, 0.0)]
    sweep(mesh, spline(bow, 5), lambda t: (0.008, 0.0055), 12)
    mesh.write("jug", "A jug with a handle along -x. Metres.")


def picture():
    """A frame with a mitre at each corner around a canvas of 0.72 x 0.48; it hangs at z = 0, looking along +z."""
    frame = Mesh()
    wide, tall, bar, out = 0.36, 0.24, 0.045, 0.03
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    # From the canvas outwards: where the bar's section is, (distance from the canvas' edge, z).
    section = [(-0.004, 0.012), (0.0, 0.018), (0.012, 0.020), (0.020, out), (bar - 0.006, out), (bar, out - 0.008), (bar, -0.005)]
    for k in range(4):
        a, b = corners[k], corners[(k + 1) % 4]
        for (d, z), (e, w) in zip(section, section[1:]):
            frame.flat([
                (a[0] * (wide + d), a[1] * (tall + d), z),
                (a[0] * (wide + e), a[1] * (tall + e), w),
                (b[0] * (wide + e), b[1] * (tall + e), w),
                (b[0] * (wide + d), b[1] * (tall + d), z),
            ])
    frame.write("picture-frame", "A picture frame around 0.72 x 0.48. Metres.")


if __name__ == "__main__":
    rooms()
    trim()
    door()
    table()
    carafe()
    teapot()
    jug()
    picture()
