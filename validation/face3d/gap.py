"""How far the flanks of a deck are apart before it is loaded, from nothing but its nodes, bricks and contact surfaces.

    python3 validation/face3d/gap.py DECK.inp

For every tooth and every section: the least distance of the gear's nodes from the pinion's flank, µm, negative where they overlap. Conjugate flanks have the same one
all along their contact line: that by which model.py lets them overlap at first. Needs numpy."""

import re
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

CORNERS = {3: (0, 1, 5, 4), 4: (1, 2, 6, 5), 5: (2, 3, 7, 6), 6: (3, 0, 4, 7)}  # of a brick's side faces


def read(deck):
    """Nodes, bricks, and by (side, tooth) the nodes of the flank in the contact surfaces."""
    nodes, bricks, flanks, into = {}, {}, defaultdict(set), None
    for line in deck.read_text().splitlines():
        if line.startswith("*"):
            surface = re.match(r"\*SURFACE, NAME=S(\d)_(\d+)_\d+", line)
            into = "node" if line.startswith("*NODE,") else "brick" if line.startswith("*ELEMENT") else surface and (int(surface[1]), int(surface[2]))
        elif into == "node":
            number, *place = line.split(",")
            nodes[int(number)] = np.array([float(v) for v in place])
        elif into == "brick":
            number, *corners = map(int, line.split(","))
            bricks[number] = corners
        elif into:
            brick, face = line.split(",")
            flanks[into].update(bricks[int(brick)][i] for i in CORNERS[int(face.strip()[1:])])
    return nodes, flanks


def least(gear, pinion):
    """Least distance of points from a polyline, negative on its inner side (that of the pinion's axis at the left of its way outwards)."""
    best = np.inf
    for p in gear:
        a, b = pinion[:-1], pinion[1:]
        along = b - a
        t = np.clip(((p - a) * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
        off = p - (a + t[:, None] * along)
        i = int(np.argmin((off**2).sum(axis=1)))
        if 0.0 < t[i] < 1.0:
            side = along[i, 0] * off[i, 1] - along[i, 1] * off[i, 0]
            best = min(best, np.copysign(np.hypot(*off[i]), side))
    return best


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    nodes, flanks = read(Path(sys.argv[1]))
    for tooth in sorted({tooth for _, tooth in flanks}):
        levels = [defaultdict(list), defaultdict(list)]
        for side in (0, 1):
            for n in flanks[side, tooth]:
                levels[side][nodes[n][2]].append(nodes[n][:2])
        gaps = {}
        for z in sorted(set(levels[0]) & set(levels[1])):
            pinion = np.array(sorted(levels[0][z], key=lambda p: np.hypot(*p)))
            gaps[z] = 1e3 * least(levels[1][z], pinion)
        print(f"tooth {tooth - 1}: " + ", ".join(f"{z:g}: {gap:.2f}" for z, gap in gaps.items()))


if __name__ == "__main__":
    main()
