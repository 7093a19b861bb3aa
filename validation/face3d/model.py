"""The pair in three dimensions as a deck of CalculiX, and what CalculiX answers.

Bricks with incompatible modes (C3D8I), a layer of them for every step across the face. The gear's bore is held; the pinion's bore turns as one about its
axis, driven by the torque. Sections of helical gears stand turned along the face: at z by z tan β_b/r_b, the gear's the other way. A lead deviation e turns a section of the pinion by e/r_b, which moves its involutes by e along the path of contact.
Each layer of the gear's flank is a contact pair of its own, so that CalculiX prints its force."""

import os
import re
import subprocess
import sys
from dataclasses import dataclass

import numpy as np

from tooth_mesh import Gear, Section

FACE = {(0, 1): 3, (1, 2): 4, (2, 3): 5, (3, 0): 6}  # side faces of a brick by the corners below them


@dataclass
class Pair:
    """What the study file says of the gears, mm, N, MPa."""

    teeth: tuple
    module: float
    pressure_angle: float  # rad
    addendum: float
    dedendum: float
    fillet: float
    bores: tuple
    width: float
    modulus: float
    poisson: float
    torque: float
    helix: float = 0.0  # rad at the reference circle; all lengths and angles above are of the transverse section
    relief: tuple = (0.0, 1.0)  # at both tips, as in Gear

    def gears(self):
        shape = (self.module, self.pressure_angle, self.addendum, self.dedendum, self.fillet)
        return [Gear(z, *shape, bore, self.relief) for z, bore in zip(self.teeth, self.bores)]

    def base_pitch(self):
        return np.pi * self.module * np.cos(self.pressure_angle)

    def base_helix(self):
        return np.arctan(np.tan(self.helix) * np.cos(self.pressure_angle))


def pair_of(study):
    """The pair of a study file; of helical gears, which it states in the normal section, the transverse one."""
    gears, helix = study["gears"], np.radians(study.get("face", {}).get("helix_angle", 0.0))
    both = [gears["pinion"], gears["gear"]]
    pair = Pair(
        teeth=tuple(g["teeth"] for g in both),
        module=gears["module"],
        pressure_angle=np.radians(gears["pressure_angle"]),
        addendum=gears["addendum"],
        dedendum=gears["dedendum"],
        fillet=gears["fillet_radius"],
        bores=tuple(g["bore_diameter"] for g in both),
        width=gears["face_width"],
        modulus=study["material"]["youngs_modulus"],
        poisson=study["material"]["poisson_ratio"],
        torque=1e3 * study["operation"]["torque"],
        helix=helix,
    )
    if helix:
        normal, cos = pair.pressure_angle, np.cos(helix)
        pair.module /= cos
        pair.pressure_angle = np.arctan(np.tan(normal) / cos)
        pair.addendum *= cos
        pair.dedendum *= cos
        # a circle that touches root line and flank at the depth where the normal section's does
        pair.fillet *= cos * (1 - np.sin(normal)) / (1 - np.sin(pair.pressure_angle))
        pair.relief = (1e-3 * both[0]["tip_relief_amount"], both[0]["tip_relief_length"])
    return pair


@dataclass
class Mesh:
    size: float  # mm, edges where the flanks touch
    half: float  # mm, how far to both sides
    layers: np.ndarray  # mm from mid-face, ascending
    body: float = 1.0  # edges elsewhere, over the usual ones
    stiffness: float = 1e8  # MPa/mm, pressure over overlap
    steps: int = 1
    square: bool = False  # ends of helical teeth at right angles to the flank that carries, not in the transverse plane


def layers(width, strips, end):
    """Even strips, the outermost ones cut again, `end` pieces each."""
    even = np.linspace(-0.5 * width, 0.5 * width, strips + 1)
    if end == 1:
        return even
    cut = lambda a, b: list(np.linspace(a, b, end + 1))
    return np.array(cut(even[0], even[1])[:-1] + list(even[1:-2]) + cut(even[-2], even[-1]))


def squared(gear, nodes, slope):
    """Nodes of a section and how far each moves along the axis so that teeth end at right angles to the helix of the flank that carries.

    Flanks that carry stay where they are, and so does all below the root circle; between the two the shift fades. `slope`: of the base helix, with the gear's hand."""
    radius, angle = np.hypot(*nodes.T), np.arctan2(nodes[:, 1], nodes[:, 0])
    pitch = 2 * np.pi / gear.teeth
    tooth = np.clip(np.round(angle / pitch), -1, 1)
    inside = radius * (gear.flank(np.maximum(radius, gear.form())) - (angle - tooth * pitch))
    along = inside * slope * radius / gear.base * np.clip((radius - gear.root) / (gear.form() - gear.root), 0.0, 1.0)
    turn = along * slope / gear.base
    c, s = np.cos(turn), np.sin(turn)
    return np.column_stack([c * nodes[:, 0] - s * nodes[:, 1], s * nodes[:, 0] + c * nodes[:, 1]]), along


def solve(pair, mesh, rotation, teeth, lead, closing, ends, folder, name):
    """Turn of the pinion (rad) and the force in every layer by tooth (N).

    `rotation`: base pitches from the pitch point; `teeth`: of the pinion, that touch; `lead(z)`: mm missing; `closing`: rad, a guess of the turn, by
    which the flanks overlap at first. `ends`: "free", "mirror" (do not move along the axis), "half" (so the first one
    only: mid-face, where the rest is its mirror image; the torque is that of the half), "rim" (so all below the
    root circles: axial forces bend no wheel) or "plane" (no node does)."""
    gears = pair.gears()
    base_pitch = 2 * np.pi * gears[0].base / pair.teeth[0]
    tangent = [g.base * np.tan(g.alpha) for g in gears]
    z = mesh.layers
    count = len(z) - 1
    advance = rotation * base_pitch + z * np.tan(pair.base_helix())
    # where tooth t touches in section k, by member and by its own number
    on_circle = lambda side, y: float(np.hypot(gears[side].base, max(tangent[side] + (1 - 2 * side) * y, 0.0)))
    touch = [[{t * (1 - 2 * side): on_circle(side, a + t * base_pitch) for t in teeth} for a in advance] for side in (0, 1)]
    counted = [g.middle() if pair.helix else None for g in gears]
    of = lambda side, k: Section(gears[side], touch[side][k], mesh.size, mesh.half, mesh.body, counted[side])
    sections = [[of(side, k) for k in range(count + 1)] if pair.helix else [of(side, 0)] * (count + 1) for side in (0, 1)]
    ends_of_path = [tangent[1] - np.sqrt(gears[1].tip ** 2 - gears[1].base ** 2), np.sqrt(gears[0].tip ** 2 - gears[0].base ** 2) - tangent[0]]
    # at the pitch point the flanks of teeth 0 touch where the pitch circles do
    turns = [
        -0.5 * np.pi / pair.teeth[0] + advance / gears[0].base,
        np.pi - 0.5 * np.pi / pair.teeth[1] - advance / gears[1].base,
    ]
    centres = [0.0, gears[0].pitch + gears[1].pitch]
    lines = []
    offset, cells = [], []
    node, element = 0, 0
    bore = [[], []]
    placed = {}
    for side, across in enumerate(sections):
        section = across[0]
        offset.append(node)
        cells.append(element)
        n, q = len(section.nodes), len(section.quads)
        lines.append(f"*NODE, NSET=N{side}")
        for k, height in enumerate(z):
            turn = turns[side][k]
            if side == 0:
                turn += closing - lead(height) / gears[0].base
            c, s = np.cos(turn), np.sin(turn)
            nodes, along = across[k].nodes, np.zeros(n)
            if mesh.square:
                nodes, along = squared(gears[side], nodes, (1 - 2 * side) * np.tan(pair.base_helix()))
            x = nodes @ np.array([[c, s], [-s, c]]) + [centres[side], 0.0]
            for i, (px, py) in enumerate(x):
                lines.append(f"{node + k * n + i + 1}, {px:.12e}, {py:.12e}, {height + along[i]:.9e}")
            for i in section.bore_nodes:
                placed[node + k * n + i + 1] = x[i]
                bore[side].append(node + k * n + i + 1)
        lines.append(f"*ELEMENT, TYPE=C3D8I, ELSET=E{side}")
        for k in range(count):
            for i, quad in enumerate(section.quads):
                low = [node + k * n + a + 1 for a in quad]
                lines.append(", ".join(map(str, [element + k * q + i + 1, *low, *[a + n for a in low]])))
        node += n * len(z)
        element += q * count
    reference = node + 1
    lines.append(f"*NODE, NSET=TURN\n{reference}, 0., 0., 0.")
    lines.append(f"*MATERIAL, NAME=STEEL\n*ELASTIC\n{pair.modulus}, {pair.poisson}")
    lines += [f"*SOLID SECTION, ELSET=E{side}, MATERIAL=STEEL" for side in (0, 1)]
    reach = mesh.half + 0.3 * pair.module
    names = []
    for tooth in sorted(teeth):
        path = advance + tooth * base_pitch
        inside = (path > ends_of_path[0]) & (path < ends_of_path[1])
        touching = [k for k in range(count) if inside[k] or inside[k + 1]]
        for side in (0, 1):
            own = tooth if side == 0 else -tooth
            for k in touching:
                around = range(k, k + 1) if side == 1 else range(max(k - 1, 0), min(k + 2, count))
                lines.append(f"*SURFACE, NAME=S{side}_{tooth + 1}_{k}, TYPE=ELEMENT")
                for layer in around:
                    section = sections[side][layer]
                    for quad, edge in section.edges[own]:
                        ends_of = section.nodes[[section.quads[quad][edge], section.quads[quad][(edge + 1) % 4]]]
                        if abs(np.hypot(*ends_of.mean(axis=0)) - touch[side][layer][own]) < reach:
                            lines.append(f"{cells[side] + layer * len(section.quads) + quad + 1}, S{FACE[edge, (edge + 1) % 4]}")
        names += [(tooth, k) for k in touching]
    lines.append(f"*SURFACE INTERACTION, NAME=FLANKS\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{mesh.stiffness:.6e}")
    for tooth, k in names:
        lines.append(f"*CONTACT PAIR, INTERACTION=FLANKS, TYPE=SURFACE TO SURFACE\nS1_{tooth + 1}_{k}, S0_{tooth + 1}_{k}")
    lines.append("*BOUNDARY")
    lines += [f"{i}, 1, 3" for i in bore[1]]
    lines += [f"{i}, 3, 3" for i in bore[0]]
    lines.append(f"{reference}, 2, 3")
    if ends == "plane":
        lines.append("N0, 3, 3\nN1, 3, 3")
    else:
        for side in (0, 1):
            n = len(sections[side][0].nodes)
            for k in {"free": (), "mirror": (0, count), "half": (0,), "rim": ()}[ends]:
                lines += [f"{offset[side] + k * n + i + 1}, 3, 3" for i in range(n)]
            if ends == "rim":
                below = np.flatnonzero(np.hypot(*sections[side][0].nodes.T) < gears[side].root - 1e-6)
                lines += [f"{offset[side] + k * n + i + 1}, 3, 3" for k in range(count + 1) for i in below]
    lines.append("*EQUATION")
    for i in bore[0]:
        x, y = placed[i]
        lines.append(f"2\n{i}, 1, 1., {reference}, 1, {y:.12e}\n2\n{i}, 2, 1., {reference}, 1, {-x:.12e}")
    for step in range(mesh.steps):
        # from the second on at the same load: what still touches where is settled
        lines.append(f"*STEP, INC=50\n*STATIC, DIRECT\n1., 1.\n*CLOAD\n{reference}, 1, {pair.torque:.9e}\n*NODE PRINT, NSET=TURN\nU")
        for tooth, k in names:
            lines.append(f"*CONTACT PRINT, MASTER=S0_{tooth + 1}_{k}, SLAVE=S1_{tooth + 1}_{k}\nCF")
        lines.append("*END STEP")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.inp").write_text("\n".join(lines) + "\n")
    answer = folder / f"{name}.dat"
    answer.unlink(missing_ok=True)
    with open(folder / f"{name}.log", "w") as log:
        subprocess.run(["ccx", name], cwd=folder, stdout=log, stderr=subprocess.STDOUT, env={**os.environ})
    turn, forces = read(answer.read_text() if answer.exists() else "")
    if len(forces) != len(names) * mesh.steps:
        sys.exit(f"CalculiX gave no whole solution of {name!r}: see {folder / (name + '.log')}")
    by_place = dict(zip(names, forces[-len(names) :]))
    return {
        "turn": closing + turn,
        "forces": {tooth: np.array([by_place.get((tooth, k), 0.0) for k in range(count)]) for tooth in teeth},
        "nodes": node,
        "elements": element,
    }


def read(printed):
    turns = re.findall(r"displacements \(vx,vy,vz\).*?\n\n\s*\d+\s+(\S+)", printed)
    turn = float(turns[-1]) if turns else 0.0
    forces = []
    for part in re.split(r"statistics for slave set", printed)[1:]:
        rows = re.search(r"total surface force.*?\n\s*\n?\s*(\S+)\s+(\S+)\s+(\S+)", part)
        forces.append(float(np.linalg.norm([float(v) for v in rows.groups()])) if rows else 0.0)
    return turn, forces
