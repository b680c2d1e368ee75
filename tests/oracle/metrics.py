"""Image metrics of pairs of committed references, computed by NumPy and by the authors' package of FLIP, for the tests to agree with.

    pip install numpy OpenEXR flip-evaluator
    python3 tests/oracle/metrics.py            # -> tests/references/metrics.json

FLIP is of the pictures as a screen shows them at the given exposure: light times two to the power of it, clamped to [0, 1], encoded as sRGB.
"""

import json
from pathlib import Path

import flip_evaluator
import numpy as np
import OpenEXR

FOLDER = Path(__file__).resolve().parent.parent / "references"
PAIRS = [
    ("cornell-glass", "cornell-box", -2.0),
    ("cornell-glossy", "cornell-glass", 0.0),
    ("cornell-near-index-one", "cornell-index-one", 0.0),
    ("veach-plates", "island", 1.0),
    ("depth-of-field", "cornell-window", 2.0),
]


def picture(name):
    """R, G and B as rows of pixels, in double precision."""
    channels = OpenEXR.File(str(FOLDER / f"{name}.exr"), separate_channels=True).channels()
    return np.stack([channels[c].pixels for c in "RGB"], axis=-1).astype(np.float64)


def srgb(linear):
    linear = np.clip(linear, 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def metrics(name, reference, stops):
    a, r = picture(name), picture(reference)
    d = a - r
    relative = d**2 / (r**2 + 0.01)
    of_pixels = np.sort(relative.sum(axis=-1).ravel())
    kept = of_pixels[: len(of_pixels) - int(np.ceil(0.001 * len(of_pixels)))]
    shown = [srgb(light * 2.0**stops).astype(np.float32) for light in (r, a)]
    _, flip, _ = flip_evaluator.evaluate(*shown, "LDR", inputsRGB=True)
    return {
        "image": name,
        "reference": reference,
        "mse": (d**2).mean(),
        "rel_mse": relative.mean(),
        "rel_mse_trimmed": kept.sum() / (3 * len(kept)),
        "mape": (abs(d) / (abs(r) + 0.01)).mean(),
        "smape": (2 * abs(d) / (abs(a) + abs(r) + 0.01)).mean(),
        "mean_ratio": a.mean() / r.mean(),
        "channel_mean_ratio": list(a.mean(axis=(0, 1)) / r.mean(axis=(0, 1))),
        "max_abs_error": abs(d).max(),
        "exposure": stops,
        "flip": float(flip),
    }


if __name__ == "__main__":
    (FOLDER / "metrics.json").write_text(json.dumps([metrics(*pair) for pair in PAIRS], indent=1) + "\n")
