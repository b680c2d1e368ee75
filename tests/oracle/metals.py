"""Turns measured indices of refraction of metals into the RGB table of `src/material/metals.rs`.

    python3 metals.py FOLDER          prints the table's rows

FOLDER holds `NAME.eta.spd` and `NAME.k.spd` (or `NAME_palik...`): text files with one "wavelength in
nm, value" pair per line and comments after `#`, such as the optical constants of luxpop.com that several
renderers ship. The conversion is that of the Cornell box's silver (`cornell_spectra.py`): eta and k are
averaged under D65 times the colour matching function of each channel. Beyond the measured range, which
covers all but the ends of the visible one, they keep their end values.
"""

import sys
from pathlib import Path

import numpy as np

from cornell_spectra import GRID_NM, reflectance_rgb

# Symbol, and what it stands for.
METALS = {
    "Ag": "silver",
    "Al": "aluminium",
    "Au": "gold",
    "Be": "beryllium",
    "Cr": "chromium",
    "Cu": "copper",
    "Hg": "mercury",
    "Ir": "iridium",
    "K": "potassium",
    "Li": "lithium",
    "Mo": "molybdenum",
    "Na": "sodium",
    "Nb": "niobium",
    "Ni": "nickel",
    "Rh": "rhodium",
    "Ta": "tantalum",
    "TiC": "titanium carbide",
    "TiN": "titanium nitride",
    "V": "vanadium",
    "VC": "vanadium carbide",
    "VN": "vanadium nitride",
    "W": "tungsten",
}


def spectrum(folder, metal, part):
    """The file of a metal's `eta` or `k` on the grid."""
    names = [f"{metal}.{part}.spd", f"{metal}_palik.{part}.spd"]
    paths = [folder / name for name in names if (folder / name).exists()]
    if not paths:
        raise SystemExit(f"{folder} has neither {' nor '.join(names)}")
    rows = np.loadtxt(paths[0], comments="#")
    order = np.argsort(rows[:, 0])
    return np.interp(GRID_NM, rows[order, 0], rows[order, 1])


def rust(number):
    """A number as Rust source has it: five digits, grouped by three from the point on."""
    text = f"{float(f'{number:.5g}')}"
    whole, _, digits = text.partition(".")
    return f"{whole}.{'_'.join(digits[i : i + 3] for i in range(0, len(digits), 3))}"


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = Path(sys.argv[1])
    for metal, name in METALS.items():
        eta, k = (reflectance_rgb(spectrum(folder, metal, part)) for part in ("eta", "k"))
        numbers = [", ".join(rust(v) for v in rgb) for rgb in (eta, k)]
        print(f'    metal("{metal}", "{name}", [{numbers[0]}], [{numbers[1]}]),')


if __name__ == "__main__":
    main()
