"""Writes 8-bit RGB and 16-bit grey pictures as PNG files (W3C PNG specification), with no library beyond Python's own."""

import struct
import zlib
from pathlib import Path

TEXTURES = Path(__file__).resolve().parents[1] / "textures"


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write(name, width, height, color):
    """Writes scenes/textures/NAME.png; `color(x, y)` gives sRGB values in 0..1, row 0 at the top."""

    def pixel(x, y):
        return bytes(min(255, max(0, round(255 * c))) for c in color(x, y))

    save(name, width, height, (8, 2), pixel)


def write_grey(name, width, height, value):
    """The same with one number in 0..1 a pixel, in 65536 steps."""
    save(name, width, height, (16, 0), lambda x, y: struct.pack(">H", min(65535, max(0, round(65535 * value(x, y))))))


def save(name, width, height, kind, pixel):
    rows, before = [], None
    for y in range(height):
        row = b"".join(pixel(x, y) for x in range(width))
        before = before or bytes(len(row))
        # Each byte as the difference to the one above (filter type 2), which compresses better.
        rows.append(b"\x02" + bytes((a - b) & 255 for a, b in zip(row, before)))
        before = row
    header = struct.pack(">IIBBBBB", width, height, *kind, 0, 0, 0)
    data = zlib.compress(b"".join(rows), 9)
    TEXTURES.mkdir(exist_ok=True)
    path = TEXTURES / f"{name}.png"
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")
    )
    print(f"{path.name}: {width} x {height}, {path.stat().st_size / 1024:.0f} KiB")
