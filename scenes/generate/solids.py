"""Surfaces made of curves: of revolution, swept along a curve, boxes with broken edges, flat panels."""

import math

from mesh import add, cross, dot, scale, sub, unit


def revolve(mesh, runs, segments, degrees=360.0, start=0.0, texture=None):
    """Turns a profile in the (r, y) plane about the y axis.

    `runs` are lists of (point, tangent), end to end. Inside a run the surface is smooth; between runs it has an
    edge. Going along the profile the outside is on the right: an outer wall goes up. `texture(point)` gives
    texture coordinates.
    """
    turns = [math.radians(start + degrees * k / segments) for k in range(segments + 1)]
    if degrees == 360.0:
        turns[-1] = turns[0]
    for run in runs:
        rows = []
        for (r, y), (dr, dy) in run:
            row = []
            for turn in turns:
                c, s = math.cos(turn), math.sin(turn)
                # On the axis the normal is along it.
                normal = (dy * c, -dr, -dy * s) if r > 1e-9 else (0.0, -math.copysign(1.0, dr), 0.0)
                point = (r * c, y, -r * s)
                row.append((point, normal, None if texture is None else texture(point)))
            rows.append(row)
        mesh.grid(rows)


def frames(path):
    """A frame (across, up) at each sample of a space curve, turned no more than the curve turns."""
    tangent = path[0][1]
    helper = (0.0, 1.0, 0.0) if abs(tangent[1]) < 0.9 else (1.0, 0.0, 0.0)
    across = unit(cross(helper, tangent))
    result = []
    for _, tangent in path:
        across = unit(sub(across, scale(tangent, dot(across, tangent))))
        result.append((across, cross(tangent, across)))
    return result


def sweep(mesh, path, section, segments, caps=True):
    """A tube along a space curve; `section(t)` gives its half widths (across, up) at t in [0, 1] of its length."""
    n = len(path) - 1
    rows = []
    for i, ((point, tangent), (across, up)) in enumerate(zip(path, frames(path))):
        a, b = section(i / n)
        before, after = section(max(i - 1, 0) / n), section(min(i + 1, n) / n)
        length = math.dist(path[max(i - 1, 0)][0], path[min(i + 1, n)][0])
        grows = ((after[0] - before[0]) / length, (after[1] - before[1]) / length)
        row = []
        for k in range(segments + 1):
            angle = 2 * math.pi * (k % segments) / segments
            c, s = math.cos(angle), math.sin(angle)
            position = add(point, add(scale(across, a * c), scale(up, b * s)))
            normal = add(scale(across, c / a), scale(up, s / b))
            taper = grows[0] * c * c / a + grows[1] * s * s / b
            row.append((position, unit(sub(normal, scale(tangent, taper))), None))
        rows.append(row)
    mesh.grid(rows)
    if caps:
        for row, tangent, sign in ((rows[0], path[0][1], -1.0), (rows[-1], path[-1][1], 1.0)):
            ring = [(p, scale(tangent, sign), None) for p, _, _ in row[:-1]]
            ring = ring if sign > 0 else ring[::-1]
            for b, c in zip(ring[1:], ring[2:]):
                mesh.face([ring[0], b, c])


def chamfered_box(mesh, low, high, bevel, texture=None):
    """A box along the axes whose edges are broken by `bevel`. `texture(point, axis)` gives coordinates."""
    center = scale(add(low, high), 0.5)

    def flat(points):
        a, b, c = points[:3]
        normal = cross(sub(b, a), sub(c, a))
        middle = scale(add(add(a, b), c), 1 / 3)
        if dot(normal, sub(middle, center)) < 0:
            points = points[::-1]
        axis = max(range(3), key=lambda k: abs(normal[k]))
        mesh.flat(points, None if texture is None else [texture(p, axis) for p in points])

    def vertex(signs, axis):
        """The corner at `signs` that lies on the face across `axis`."""
        side = [(high if s > 0 else low)[k] for k, s in enumerate(signs)]
        return tuple(side[k] - (0 if k == axis else signs[k] * bevel) for k in range(3))

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (-1, 1):
            signs = []
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                sign = [0, 0, 0]
                sign[axis], sign[u], sign[v] = side, a, b
                signs.append(tuple(sign))
            flat([vertex(s, axis) for s in signs])
        # The four edges along this axis.
        for a in (-1, 1):
            for b in (-1, 1):
                ends = []
                for end in (-1, 1):
                    sign = [0, 0, 0]
                    sign[axis], sign[u], sign[v] = end, a, b
                    ends.append(tuple(sign))
                flat([vertex(ends[0], u), vertex(ends[1], u), vertex(ends[1], v), vertex(ends[0], v)])
    for x in (-1, 1):
        for y in (-1, 1):
            for z in (-1, 1):
                flat([vertex((x, y, z), axis) for axis in range(3)])


def panel(mesh, corner, u, v, us, vs, holes=(), texture=None):
    """A flat panel: cells between the distances `us` along the unit vector u and `vs` along v from `corner`.

    Cells in `holes`, pairs (index along u, index along v), are left out. Its normal is u x v.
    """
    for i in range(len(us) - 1):
        for j in range(len(vs) - 1):
            if (i, j) in holes:
                continue
            cell = [(us[i], vs[j]), (us[i + 1], vs[j]), (us[i + 1], vs[j + 1]), (us[i], vs[j + 1])]
            points = [add(corner, add(scale(u, a), scale(v, b))) for a, b in cell]
            mesh.flat(points, None if texture is None else [texture(a, b) for a, b in cell])
