"""A path tracer in NumPy that shares nothing with Mitsuba or chainlight, to check both.

It is as plain as possible: double precision, every triangle tested, directions drawn from the
surfaces alone, and light found only by running into it. It is slow and noisy, and there is little
in it to be wrong. It knows what cornell-box.ron and cornell-glass.ron use.
"""

from pathlib import Path

import numpy as np

import ron

# In millimetres, in double precision: rays start this far along.
NEAREST = 1e-6


def load_obj(path):
    """Triangles [n, 3 corners, 3] of a mesh of `v` and `f` lines."""
    vertices, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            triangles.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return np.array(vertices)[np.array(triangles)]


class Scene:
    """Triangles and spheres, each with the number of its entry in the scene file."""

    def __init__(self, path):
        path = Path(path)
        description = ron.load(path)
        self.max_depth = description["settings"]["max_depth"]
        camera = description["camera"].fields
        self.origin = np.array(camera["origin"], float)
        forward = np.array(camera["target"], float) - self.origin
        self.forward = forward / np.linalg.norm(forward)
        right = np.cross(self.forward, np.array(camera["up"], float))
        self.right = right / np.linalg.norm(right)
        self.up = np.cross(self.right, self.forward)
        self.half_width = np.tan(np.radians(camera["fov"]) / 2)
        self.triangles, self.spheres = [], []
        self.materials, self.emission = [], []
        for index, entry in enumerate(description["shapes"]):
            f = entry["shape"].fields
            if entry["shape"].name == "Sphere":
                self.spheres.append((np.array(f["center"], float), float(f["radius"]), index))
            elif entry["shape"].name == "Obj":
                self.triangles += [(t, index) for t in load_obj(path.parent / f["file"])]
            else:
                c, u, v = (np.array(f[name], float) for name in ("corner", "edge_u", "edge_v"))
                halves = [c, c + u, c + u + v], [c, c + u + v, c + v]
                self.triangles += [(np.array(half), index) for half in halves]
            self.materials.append(description["materials"][entry["material"]])
            self.emission.append(entry.get("emission", [0.0, 0.0, 0.0]))
        self.emission = np.array(self.emission, float)
        self.prepare_triangles()

    def prepare_triangles(self):
        """Planes and barycentric coordinates as linear functions of a point: u = U . p - offset."""
        a, b, c = np.moveaxis(np.array([t for t, _ in self.triangles]), 1, 0)
        self.entries = np.array([index for _, index in self.triangles])
        normals = np.cross(b - a, c - a)
        area2 = (normals**2).sum(1, keepdims=True)
        self.across_u = np.cross(c - a, normals) / area2
        self.across_v = np.cross(normals, b - a) / area2
        self.offset_u = (self.across_u * a).sum(1)
        self.offset_v = (self.across_v * a).sum(1)
        self.normals = normals / np.sqrt(area2)
        self.plane = (self.normals * a).sum(1)

    def intersect(self, o, d):
        """Distance, entry (-1: none) and geometric normal of the nearest hit of each ray."""
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (self.plane - o @ self.normals.T) / (d @ self.normals.T)
            u = o @ self.across_u.T - self.offset_u + t * (d @ self.across_u.T)
            v = o @ self.across_v.T - self.offset_v + t * (d @ self.across_v.T)
            t[~((u >= 0) & (v >= 0) & (u + v <= 1) & (t > NEAREST))] = np.inf
        first = t.argmin(1)
        nearest = t[np.arange(len(o)), first]
        entry = np.where(np.isfinite(nearest), self.entries[first], -1)
        normal = self.normals[first]
        for center, radius, index in self.spheres:
            s = o - center
            b = (s * d).sum(1)
            # The closest approach to the centre, so that nothing cancels for distant origins.
            inside = radius**2 - ((s - b[:, None] * d) ** 2).sum(1)
            root = np.sqrt(np.maximum(inside, 0.0))
            t = np.where(-b - root > NEAREST * radius, -b - root, -b + root)
            hit = (inside > 0) & (t > NEAREST * radius) & (t < nearest)
            nearest[hit], entry[hit] = t[hit], index
            normal[hit] = (o[hit] + t[hit, None] * d[hit] - center) / radius
        return nearest, entry, normal


def conductor_fresnel(cos, eta, k):
    """Unpolarised reflectance at a conductor in air, one row per angle, one column per channel."""
    cos2 = cos[:, None] ** 2
    sin2 = 1.0 - cos2
    difference = eta**2 - k**2 - sin2
    a2b2 = np.sqrt(difference**2 + 4 * eta**2 * k**2)
    a = np.sqrt(np.maximum(0.5 * (a2b2 + difference), 0.0))
    s = (a2b2 + cos2 - 2 * a * cos[:, None]) / (a2b2 + cos2 + 2 * a * cos[:, None])
    t1, t2 = cos2 * a2b2 + sin2**2, 2 * a * cos[:, None] * sin2
    return 0.5 * (s + s * (t1 - t2) / (t1 + t2))


def scatter(material, d, n, rng):
    """New directions and throughput factors where rays along `d` meet a surface of normal `n`."""
    f = material.fields
    outside = (d * n).sum(1) < 0
    facing = np.where(outside[:, None], n, -n)
    cos = np.abs((d * n).sum(1))
    mirrored = d + 2 * cos[:, None] * facing
    if material.name == "Diffuse":
        # A point on the unit sphere around the tip of the normal is cosine distributed.
        z, phi = rng.uniform(-1, 1, len(d)), rng.uniform(0, 2 * np.pi, len(d))
        r = np.sqrt(1 - z**2)
        new = facing + np.stack([r * np.cos(phi), r * np.sin(phi), z], 1)
        new /= np.linalg.norm(new, axis=1, keepdims=True)
        return new, np.broadcast_to(np.array(f["reflectance"], float), d.shape)
    if material.name == "Conductor":
        return mirrored, conductor_fresnel(cos, np.array(f["eta"], float), np.array(f["k"], float))
    if material.name == "Dielectric":
        relative = f["interior_ior"] / f["exterior_ior"]
        ratio = np.where(outside, 1 / relative, relative)
        sin2_t = ratio**2 * (1 - cos**2)
        cos_t = np.sqrt(np.maximum(1 - sin2_t, 0.0))
        s = (ratio * cos - cos_t) / (ratio * cos + cos_t)
        p = (cos - ratio * cos_t) / (cos + ratio * cos_t)
        reflect = rng.uniform(size=len(d)) < np.where(sin2_t >= 1, 1.0, 0.5 * (s**2 + p**2))
        bent = ratio[:, None] * d + (ratio * cos - cos_t)[:, None] * facing
        return np.where(reflect[:, None], mirrored, bent), np.ones_like(d)
    raise ValueError(f"material {material.name}")


def trace(scene, o, d, rng):
    """Radiance along each ray, by one random path each."""
    radiance, weight = np.zeros_like(o), np.ones_like(o)
    alive = np.arange(len(o))
    for depth in range(1, scene.max_depth + 1):
        t, entry, n = scene.intersect(o, d)
        front = (entry >= 0) & ((d * n).sum(1) < 0)
        radiance[alive[front]] += weight[front] * scene.emission[entry[front]]
        keep = entry >= 0
        # Roulette, once paths are long.
        survival = np.clip(weight.max(1), 0.05, 1.0) if depth > 4 else np.ones(len(o))
        keep &= rng.uniform(size=len(o)) < survival
        weight = (weight / survival[:, None])[keep]
        o, d, n, entry, alive = (o + t[:, None] * d)[keep], d[keep], n[keep], entry[keep], alive[keep]
        new, factor = np.empty_like(d), np.empty_like(d)
        for index in np.unique(entry):
            at = entry == index
            new[at], factor[at] = scatter(scene.materials[index], d[at], n[at], rng)
        d, weight = new, weight * factor
        if len(o) == 0:
            break
    return radiance


def render(scene, size, spp, seed):
    """The picture [row, column, channel] of `size` x `size` pixels, box filter, row 0 at the top."""
    rng = np.random.default_rng(seed)
    row, column = (axis.ravel() for axis in np.mgrid[0:size, 0:size])
    picture = np.zeros((size * size, 3))
    # Positions inside a pixel: the additive sequence of the plastic number, shifted at random.
    steps, shift = np.array([0.7548776662466927, 0.5698402909980532]), rng.uniform(size=(2, size**2))
    batch = max(1, 32_768 // size**2)
    for start in range(0, spp, batch):
        count = min(batch, spp - start)
        sample = np.arange(start, start + count)[:, None]
        x = ((column + (shift[0] + steps[0] * sample) % 1.0) / size).ravel()
        y = ((row + (shift[1] + steps[1] * sample) % 1.0) / size).ravel()
        d = scene.forward + scene.half_width * (
            (2 * x - 1)[:, None] * scene.right + (1 - 2 * y)[:, None] * scene.up
        )
        d /= np.linalg.norm(d, axis=1, keepdims=True)
        o = np.broadcast_to(scene.origin, d.shape)
        picture += trace(scene, o, d, rng).reshape(count, size * size, 3).sum(0)
    return (picture / spp).reshape(size, size, 3)
