"""The pictures that scenes wear: wood, floor boards, a painting. All are calculated."""

import math

import png


def lattice(x, y, seed):
    """A number in 0..1 for a point of the integer grid (an integer hash)."""
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535


def noise(x, y, seed, period=None):
    """Smooth value noise; with `period` = (columns, rows) it repeats."""
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)

    def at(a, b):
        if period is not None:
            a, b = a % period[0], b % period[1]
        return lattice(a, b, seed)

    low = at(i, j) + u * (at(i + 1, j) - at(i, j))
    high = at(i, j + 1) + u * (at(i + 1, j + 1) - at(i, j + 1))
    return low + v * (high - low)


def mix(a, b, t):
    return tuple(x + t * (y - x) for x, y in zip(a, b))


def grain(x, y, seed, columns):
    """How dark the wood is at (x, y), with fibres along y; repeats every `columns` in x and 4 in y."""
    bend = 0.8 * noise(x * 3 / columns, y, seed, (3, 4))
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (x * 7 / columns + bend))
    fibres = noise(x * 40 / columns, y * 2, seed + 1, (40, 8))
    return 0.45 * rings**2 + 0.35 * fibres + 0.2 * noise(x * 12 / columns, y, seed + 2, (12, 4))


def quantized(color):
    """In steps of 1/64: the eye does not see it here, and the file is half as large."""
    return tuple(round(c * 63) / 63 for c in color)


def wood():
    light, dark = (0.74, 0.55, 0.37), (0.50, 0.33, 0.20)
    png.write("wood", 192, 192, lambda x, y: quantized(mix(light, dark, grain(x / 192, y / 48, 5, 1))))


def boards():
    """Eight boards side by side, each in two lengths, fibres along y; it repeats in both directions."""
    size = 256

    def color(x, y):
        board, across = divmod(x, size // 8)
        shift = (board * 97) % size
        length, along = divmod((y + shift) % size, size // 2)
        tone = lattice(board, length, 31)
        joint = across == 0 or along == 0
        light = mix((0.78, 0.70, 0.60), (0.70, 0.61, 0.50), tone)
        dark = mix((0.62, 0.53, 0.43), (0.55, 0.46, 0.36), tone)
        value = mix(light, dark, grain(across / 32 * 0.5 + board * 0.37, y / 64, 7 + board, 1))
        return quantized(mix(value, (0.08, 0.05, 0.03), 0.8 if joint else 0))

    png.write("boards", size, size, color)


def painting():
    """A low sun over hills and water."""
    width, height = 192, 128

    def color(x, y):
        u, v = (x + 0.5) / width, (y + 0.5) / height
        horizon = 0.62
        sky = mix((0.16, 0.27, 0.47), (0.96, 0.70, 0.42), min(1, v / horizon) ** 1.4)
        sky = mix(sky, (0.98, 0.86, 0.70), 0.35 * noise(u * 5, v * 26, 3) * noise(u * 9, v * 18, 4))
        distance = math.hypot((u - 0.64) * width / height, v - 0.50)
        sun = max(0.0, min(1.0, (0.066 - distance) * 60))
        sky = mix(mix(sky, (1.0, 0.85, 0.55), 0.8 * math.exp(-7 * distance)), (1.0, 0.97, 0.85), sun)
        if v < horizon:
            value = sky
            for k, (tone, base, rise) in enumerate(
                (((0.44, 0.42, 0.55), 0.50, 0.10), ((0.29, 0.33, 0.42), 0.55, 0.09), ((0.15, 0.22, 0.24), 0.60, 0.07))
            ):
                ridge = base - rise * (noise(u * (3 + 2 * k) + 10 * k, 0.5, 20 + k) - 0.25)
                ridge -= 0.02 * (noise(u * 17, 0.5, 30 + k) - 0.5)
                value = mix(value, tone, max(0.0, min(1.0, (v - ridge) * 160)))
        else:
            depth = (v - horizon) / (1 - horizon)
            water = mix((0.62, 0.47, 0.40), (0.10, 0.17, 0.27), depth**0.6)
            ripple = noise(u * 14, depth * 34 + 4 * depth * depth, 40)
            path = math.exp(-(((u - 0.64) / (0.05 + 0.11 * depth)) ** 2))
            value = mix(water, (1.0, 0.85, 0.58), path * max(0.0, ripple * 1.6 - 0.45))
        canvas = 0.03 * (noise(x * 0.9, y * 0.9, 50) - 0.5)
        return quantized(tuple(c + canvas for c in value))

    png.write("painting", width, height, color)


def land(u, v):
    """The height of the island at (u, v) in 0..1, sea level at 0.25."""
    x, y = 2 * u - 1, 2 * v - 1
    away = math.hypot(x + 0.25 * (noise(u * 3, v * 3, 60) - 0.5), 1.15 * y + 0.3 * (noise(u * 4, v * 4, 61) - 0.5))
    slope = max(0.0, 1 - (away / 0.92) ** 2)
    rough = 0.0
    for octave in range(5):
        step = 3 * 2**octave
        # Ridges: folded noise.
        rough += 0.5**octave * (1 - abs(2 * noise(u * step, v * step, 62 + octave) - 1))
    return min(1.0, slope * (0.20 + 0.42 * rough * slope**0.5) + 0.05)


def island():
    size = 96
    png.write_grey("island-heights", size, size, lambda x, y: land(x / (size - 1), 1 - y / (size - 1)))

    def color(x, y):
        u, v = (x + 0.5) / 128, 1 - (y + 0.5) / 128
        height = land(u, v) + 0.05 * (noise(u * 40, v * 40, 80) - 0.5)
        steep = math.hypot(land(u + 0.01, v) - land(u - 0.01, v), land(u, v + 0.01) - land(u, v - 0.01)) / 0.02
        bands = ((0.25, (0.74, 0.68, 0.50)), (0.31, (0.36, 0.45, 0.22)), (0.52, (0.28, 0.36, 0.20)), (0.68, (0.46, 0.42, 0.38)))
        value = bands[0][1]
        for (low, _), (high, tone) in zip(bands, bands[1:]):
            value = mix(value, tone, max(0.0, min(1.0, (height - low) / (high - low) * 2 - 0.6)))
        return quantized(mix(value, (0.45, 0.41, 0.37), max(0.0, min(1.0, steep / 1.2 - 0.9))))

    png.write("island-colors", 128, 128, color)


if __name__ == "__main__":
    island()
    wood()
    boards()
    painting()
