"""What a gear of helical.toml gives way by under an even load along a contact line, without contact: straight and helical, with and without the axial force.

    python3 validation/face3d/helical_body.py WORKFOLDER

One tooth of one gear at a time, its bore held, ends of the face free, loaded at the nodes of the contact line through the pitch point at mid-face. Prints the mean approach
along the transverse path of contact (work over force), µm at 200 N per mm of face. Needs numpy and `ccx`."""

import subprocess
import sys
from pathlib import Path

import numpy as np

from helical import study
from model import layers, pair_of
from tooth_mesh import Section

LOAD = 200.0  # N per mm of face, transverse
SIZE, HALF, BODY, LAYERS = 0.08, 0.4, 2.2, 14
# by name: are sections turned along the face, is there an axial force, is the rim held along the axis
CASES = {
    "straight": (False, False, False),
    "helical, transverse force only": (True, False, False),
    "helical, rim held along the axis": (True, True, True),
    "helical": (True, True, False),
}


def deck(pair, side, twist, axial, hold):
    """Lines of the deck, and by node the force."""
    gear, sign, slope = pair.gears()[side], 1 - 2 * side, np.tan(pair.base_helix())
    z = layers(pair.width, LAYERS, 1)
    touch = [float(np.hypot(gear.base, gear.base * np.tan(gear.alpha) + sign * at * slope)) for at in z]
    sections = [Section(gear, {0: radius}, SIZE, HALF, BODY, gear.middle()) for radius in touch]
    count, quads = len(sections[0].nodes), sections[0].quads
    lines, forces, still = ["*NODE"], {}, []
    for k, section in enumerate(sections):
        first = k * count + 1
        angle = sign * z[k] * slope / gear.base if twist else 0.0
        c, s = np.cos(angle), np.sin(angle)
        places = section.nodes @ np.array([[c, s], [-s, c]])
        lines += [f"{first + i}, {x:.12e}, {y:.12e}, {z[k]:.9e}" for i, (x, y) in enumerate(places)]
        still += [f"{first + i}, 1, 3" for i in section.bore_nodes]
        if hold:
            below = np.hypot(*section.nodes.T) < gear.root - 1e-6
            below[section.bore_nodes] = False
            still += [f"{first + i}, 3, 3" for i in np.flatnonzero(below)]
        flank = sorted({int(quads[quad][(edge + j) % 4]) for quad, edge in section.edges[0] for j in (0, 1)})
        at = min(flank, key=lambda i: abs(np.hypot(*section.nodes[i]) - touch[k]))
        assert abs(np.hypot(*section.nodes[at]) - touch[k]) < 1e-3, "no node where the flanks touch"
        outwards = places[at] / touch[k]
        alpha = np.arccos(gear.base / touch[k])
        normal = np.cos(alpha) * np.array([-outwards[1], outwards[0]]) + np.sin(alpha) * outwards
        share = 0.5 * (z[min(k + 1, LAYERS)] - z[max(k - 1, 0)])
        forces[first + at] = -LOAD * share * np.array([*normal, -sign * slope if axial else 0.0])
    lines.append("*ELEMENT, TYPE=C3D8I, ELSET=E")
    for k in range(LAYERS):
        for i, quad in enumerate(quads):
            low = [k * count + a + 1 for a in quad]
            lines.append(", ".join(map(str, [k * len(quads) + i + 1, *low, *[a + count for a in low]])))
    lines.append(f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{pair.modulus}, {pair.poisson}\n*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n*NSET, NSET=LINE")
    lines += [f"{i}," for i in forces] + ["*BOUNDARY", *still, "*STEP\n*STATIC\n*CLOAD"]
    lines += [f"{i}, {axis + 1}, {value:.9e}" for i, force in forces.items() for axis, value in enumerate(force)]
    return [*lines, "*NODE PRINT, NSET=LINE\nU\n*END STEP", ""], forces


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    pair = pair_of(study())
    print(f"1/cos beta_b {1 / np.cos(pair.base_helix()):.4f}")
    for side, member in enumerate(("pinion", "gear")):
        for name, how in CASES.items():
            lines, forces = deck(pair, side, *how)
            file = folder / f"body_{member}_{list(CASES).index(name)}"
            file.with_suffix(".inp").write_text("\n".join(lines))
            subprocess.run(["ccx", file.name], cwd=folder, stdout=subprocess.DEVNULL, check=True)
            found = [line.split() for line in file.with_suffix(".dat").read_text().splitlines()]
            moved = {int(row[0]): np.array([float(v) for v in row[1:]]) for row in found if len(row) == 4 and row[0].isdigit()}
            approach = 1e3 * sum(force @ moved[i] for i, force in forces.items()) / (LOAD * pair.width)
            straight = approach if name == "straight" else straight
            print(f"{member}, {name}: {approach:.3f} µm, {approach / straight:.3f} times straight", flush=True)


if __name__ == "__main__":
    main()
