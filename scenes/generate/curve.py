"""Plane and space curves as lists of (point, unit tangent)."""

import math

from mesh import add, scale, sub, unit


def spline(points, steps):
    """A Catmull-Rom curve through `points`, `steps` samples from each to the next, the ends included.

    The tangent at an end points to the next point but one as a parabola would have it.
    """
    n = len(points)

    def tangent(i):
        if n == 2:
            return sub(points[1], points[0])
        if i == 0:
            return sub(scale(sub(points[1], points[0]), 2), scale(sub(points[2], points[0]), 0.5))
        if i == n - 1:
            return sub(scale(sub(points[-1], points[-2]), 2), scale(sub(points[-1], points[-3]), 0.5))
        return scale(sub(points[i + 1], points[i - 1]), 0.5)

    samples = []
    for i in range(n - 1):
        p, q, m, k = points[i], points[i + 1], tangent(i), tangent(i + 1)
        for j in range(steps + (i == n - 2)):
            t = j / steps
            h = (2 * t**3 - 3 * t**2 + 1, t**3 - 2 * t**2 + t, 3 * t**2 - 2 * t**3, t**3 - t**2)
            d = (6 * t**2 - 6 * t, 3 * t**2 - 4 * t + 1, 6 * t - 6 * t**2, 3 * t**2 - 2 * t)
            point = add(add(scale(p, h[0]), scale(m, h[1])), add(scale(q, h[2]), scale(k, h[3])))
            slope = add(add(scale(p, d[0]), scale(m, d[1])), add(scale(q, d[2]), scale(k, d[3])))
            samples.append((point, unit(slope)))
    return samples


def line(a, b):
    return [(a, unit(sub(b, a))), (b, unit(sub(b, a)))]


def arc(center, radius, start, end, steps):
    """A circular arc in the plane, angles in degrees; counter-clockwise where `end` is larger."""
    sign = 1 if end > start else -1
    samples = []
    for i in range(steps + 1):
        angle = math.radians(start + (end - start) * i / steps)
        c, s = math.cos(angle), math.sin(angle)
        samples.append(((center[0] + radius * c, center[1] + radius * s), (-sign * s, sign * c)))
    return samples


def rounded(points, radius, steps=4):
    """A polyline in the plane whose corners are rounded by arcs that touch both sides, as one smooth run.

    `radius` is one number, or one for each inner corner, larger than zero.
    """
    inner = points[1:-1]
    radii = radius if isinstance(radius, (list, tuple)) else [radius] * len(inner)
    samples = [(points[0], unit(sub(points[1], points[0])))]
    for before, at, after, r in zip(points, inner, points[2:], radii):
        a, b = unit(sub(before, at)), unit(sub(after, at))
        half = math.acos(max(-1.0, min(1.0, a[0] * b[0] + a[1] * b[1]))) / 2
        away = r / math.tan(half)
        first = add(at, scale(a, away))
        center = add(at, scale(unit(add(a, b)), r / math.sin(half)))
        turn = math.pi - 2 * half
        sign = 1 if (-a[0]) * b[1] - (-a[1]) * b[0] > 0 else -1
        start = math.atan2(first[1] - center[1], first[0] - center[0])
        for i in range(steps + 1):
            angle = start + sign * turn * i / steps
            c, s = math.cos(angle), math.sin(angle)
            samples.append(((center[0] + r * c, center[1] + r * s), (-sign * s, sign * c)))
    samples.append((points[-1], unit(sub(points[-1], points[-2]))))
    return samples
