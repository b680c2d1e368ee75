"""Turns the measured spectra of the Cornell box into the linear sRGB values of our scenes.

Source of the measurements: Cornell University Program of Computer Graphics, "Cornell Box Data",
https://www.graphics.cornell.edu/online/box/data.html (reflectances at 400 to 700 nm in steps of
4 nm, emission at four wavelengths, reflectance of the light 0.78).

Conversion, and why:

* Reflectances are taken under illuminant D65, the white of sRGB: a channel is the average of the
  reflectance weighted with D65 times that channel's colour matching function, so a perfectly
  white surface becomes exactly (1, 1, 1), a grey one stays grey, and no surface gains energy.
  Under an equal-energy illuminant, which some renderers use here, sRGB's own white turns pink and
  the nearly neutral white paint becomes (0.89, 0.70, 0.67), which then tints every bounce.
* The emission is a light in its own right and is not divided by any white: its tristimulus values
  are divided by the integral of y-bar alone, so an emission of 1 at every wavelength has
  luminance 1 and the published numbers keep their scale.
* Beyond the measured range a reflectance keeps its end value; the emission is zero below 400 nm,
  where it has fallen to zero, and keeps its end value above 700 nm. All of this is outside the
  part of the spectrum that the eye weighs (under 0.5 percent of y-bar).
* Negative values, colours outside sRGB, are set to zero, since a renderer cannot carry them.

    python3 cornell_spectra.py          prints the values
"""

import numpy as np

from spectral_tables import CIE_1931, D65, SILVER

REFLECTANCE_NM = np.arange(400, 701, 4)

WHITE = """
    0.343 0.445 0.551 0.624 0.665 0.687 0.708 0.723 0.715 0.710 0.745 0.758 0.739 0.767 0.777
    0.765 0.751 0.745 0.748 0.729 0.745 0.757 0.753 0.750 0.746 0.747 0.735 0.732 0.739 0.734
    0.725 0.721 0.733 0.725 0.732 0.743 0.744 0.748 0.728 0.716 0.733 0.726 0.713 0.740 0.754
    0.764 0.752 0.736 0.734 0.741 0.740 0.732 0.745 0.755 0.751 0.744 0.731 0.733 0.744 0.731
    0.712 0.708 0.729 0.730 0.727 0.707 0.703 0.729 0.750 0.760 0.751 0.739 0.724 0.730 0.740
    0.737
"""
GREEN = """
    0.092 0.096 0.098 0.097 0.098 0.095 0.095 0.097 0.095 0.094 0.097 0.098 0.096 0.101 0.103
    0.104 0.107 0.109 0.112 0.115 0.125 0.140 0.160 0.187 0.229 0.285 0.343 0.390 0.435 0.464
    0.472 0.476 0.481 0.462 0.447 0.441 0.426 0.406 0.373 0.347 0.337 0.314 0.285 0.277 0.266
    0.250 0.230 0.207 0.186 0.171 0.160 0.148 0.141 0.136 0.130 0.126 0.123 0.121 0.122 0.119
    0.114 0.115 0.117 0.117 0.118 0.120 0.122 0.128 0.132 0.139 0.144 0.146 0.150 0.152 0.157
    0.159
"""
RED = """
    0.040 0.046 0.048 0.053 0.049 0.050 0.053 0.055 0.057 0.056 0.059 0.057 0.061 0.061 0.060
    0.062 0.062 0.062 0.061 0.062 0.060 0.059 0.057 0.058 0.058 0.058 0.056 0.055 0.056 0.059
    0.057 0.055 0.059 0.059 0.058 0.059 0.061 0.061 0.063 0.063 0.067 0.068 0.072 0.080 0.090
    0.099 0.124 0.154 0.192 0.255 0.287 0.349 0.402 0.443 0.487 0.513 0.558 0.584 0.620 0.606
    0.609 0.651 0.612 0.610 0.650 0.638 0.627 0.620 0.630 0.628 0.642 0.639 0.657 0.639 0.635
    0.642
"""
EMISSION_NM = [400.0, 500.0, 600.0, 700.0]
EMISSION = [0.0, 8.0, 15.6, 18.4]
LIGHT_REFLECTANCE = 0.78

# Every table is resampled to this grid and integrated as a plain sum.
GRID_NM = np.arange(380.0, 781.0, 1.0)

# Linear sRGB (IEC 61966-2-1) from CIE XYZ.
SRGB_FROM_XYZ = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)


def column(table, index):
    """Column `index` of a table of (wavelength, value, ...) rows, on the grid."""
    rows = np.array(table, dtype=float)
    return np.interp(GRID_NM, rows[:, 0], rows[:, index])


OBSERVER = np.stack([column(CIE_1931, i) for i in (1, 2, 3)])
ILLUMINANT = column(D65, 1)


def measured(text):
    """A measured reflectance on the grid, constant beyond its ends."""
    values = np.array([float(word) for word in text.split()])
    assert values.shape == REFLECTANCE_NM.shape
    return np.interp(GRID_NM, REFLECTANCE_NM, values)


def emission():
    """The measured emission on the grid, zero below 400 nm, constant above 700 nm."""
    return np.interp(GRID_NM, EMISSION_NM, EMISSION, left=0.0)


def reflectance_rgb(values):
    """Linear sRGB of a reflectance (or another optical constant) under D65; white is (1, 1, 1)."""
    weights = SRGB_FROM_XYZ @ (OBSERVER * ILLUMINANT)
    return np.maximum(weights @ values / weights.sum(axis=1), 0.0)


def emission_rgb(values):
    """Linear sRGB of an emission; an emission of 1 everywhere has luminance 1."""
    return np.maximum(SRGB_FROM_XYZ @ (OBSERVER @ values) / OBSERVER[1].sum(), 0.0)


def silver(index):
    """n (`index` 1) or k (`index` 2) of silver on the grid."""
    return column(SILVER, index)


def scene_values():
    """The values that the scene files hold, by name, rounded as they are written there."""
    exact = {
        "white": reflectance_rgb(measured(WHITE)),
        "green": reflectance_rgb(measured(GREEN)),
        "red": reflectance_rgb(measured(RED)),
        "light reflectance": np.full(3, LIGHT_REFLECTANCE),
        "light emission": emission_rgb(emission()),
        "silver eta": reflectance_rgb(silver(1)),
        "silver k": reflectance_rgb(silver(2)),
    }
    return {name: [round(float(v), 4) for v in rgb] for name, rgb in exact.items()}


def rgb_transport_error(spectra):
    """What RGB costs: relative error per channel of emission times product of `spectra`."""
    spectral = emission_rgb(emission() * np.prod(spectra, axis=0))
    rgb = emission_rgb(emission()) * np.prod([reflectance_rgb(s) for s in spectra], axis=0)
    return rgb / np.where(spectral > 0.0, spectral, np.nan) - 1.0


def normal_reflectance(eta, k):
    """Reflectance of a conductor seen head-on."""
    return ((eta - 1.0) ** 2 + k**2) / ((eta + 1.0) ** 2 + k**2)


def main():
    for name, rgb in scene_values().items():
        print(f"{name:18} ({rgb[0]:.4f}, {rgb[1]:.4f}, {rgb[2]:.4f})")

    print("\nRGB instead of spectral transport, relative error of R, G, B after bounces off:")
    white, green, red = measured(WHITE), measured(GREEN), measured(RED)
    for name, spectra in [
        ("white", [white]),
        ("white, white", [white, white]),
        ("green", [green]),
        ("red", [red]),
        ("red, white", [red, white]),
    ]:
        error = rgb_transport_error(spectra)
        print(f"  {name:14} " + "  ".join(f"{100 * e:+6.2f} %" for e in error))

    spectral = reflectance_rgb(normal_reflectance(silver(1), silver(2)))
    rgb = normal_reflectance(reflectance_rgb(silver(1)), reflectance_rgb(silver(2)))
    print(f"\nsilver head-on, reflectance as spectrum {spectral.round(4)}, from RGB {rgb.round(4)}")


if __name__ == "__main__":
    main()
