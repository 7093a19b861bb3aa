"""Holds helical gears in slices against the pair in three dimensions, solved by CalculiX.

    cargo build --release --example face_loads
    python3 validation/face3d/helical.py target/release/gearwear WORKFOLDER [CASE ...]

Writes helical.json and helical.svg beside this file; of cases that are not asked for they keep what they have. What CalculiX has solved stays in WORKFOLDER and is not solved again; without `ccx` the figures of
bricks are those that helical.json has. Needs numpy."""

import dataclasses
import json
import re
import resource
import shutil
import subprocess
import tomllib
from pathlib import Path
from typing import NamedTuple

from face3d import COARSE, LEADS, STIFFNESS, STRIPS, asked_for, picture, rows

HERE = Path(__file__).parent
ROUGH = (0.08, 1.8, 20, 1)
FINER_FACE = (0.08, 1.8, 40, 1)
FINEST_FACE = (0.08, 1.8, 80, 1)
# layers of 0.16 mm within 2.5 mm of mid-face, where contact lines end between two pairs, and ten of 0.75 mm on either side
FINE_MIDDLE = (0.08, 1.8, (10, 32, 2.5), 1)
# layers of 0.25 mm within 3 mm of either end, where the next tooth comes in at the pitch point, and 1 mm between
FINE_ENDS = (0.08, 1.8, (12, 14, 7.0), 1)
# the layers of FINE_MIDDLE on finer sections
FINER_MIDDLE = (*COARSE[:2], *FINE_MIDDLE[2:])


class Case(NamedTuple):
    """A pair in contact: `position` in base pitches from the pitch point (tooth 0, mid-face), `ends` and `square` as in model.py."""

    lead: str
    position: float
    mesh: tuple
    ends: str = "free"
    stiffness: float = STIFFNESS
    square: bool = False


CASES = {
    "even, between two pairs": Case("even", 0.5, ROUGH),
    "even, between two pairs, rims held": Case("even", 0.5, ROUGH, "rim"),
    "even, at the pitch point": Case("even", 0.0, ROUGH),
    "even, at the pitch point, rims held": Case("even", 0.0, ROUGH, "rim"),
    "crown, between two pairs": Case("crown", 0.5, ROUGH),
    "crown, between two pairs, rims held": Case("crown", 0.5, ROUGH, "rim"),
    "even, finer mesh": Case("even", 0.5, COARSE),
    "even, finer face": Case("even", 0.5, FINER_FACE),
    "even, finest face": Case("even", 0.5, FINEST_FACE),
    "even, finer face, rims held": Case("even", 0.5, FINER_FACE, "rim"),
    "even, at the pitch point, finer face, rims held": Case("even", 0.0, FINER_FACE, "rim"),
    "even, at the pitch point, finer face, mirrors": Case("even", 0.0, FINER_FACE, "mirror"),
    "crown, finer face, rims held": Case("crown", 0.5, FINER_FACE, "rim"),
    "even, fine middle": Case("even", 0.5, FINE_MIDDLE),
    "crown, fine middle": Case("crown", 0.5, FINE_MIDDLE),
    "even, fine middle, rims held": Case("even", 0.5, FINE_MIDDLE, "rim"),
    "crown, fine middle, rims held": Case("crown", 0.5, FINE_MIDDLE, "rim"),
    "even, fine middle, stiff contact": Case("even", 0.5, FINE_MIDDLE, stiffness=1e8),
    "even, fine middle, finer mesh": Case("even", 0.5, FINER_MIDDLE),
    "even, at the pitch point, finer mesh": Case("even", 0.0, COARSE),
    "even, at the pitch point, fine ends": Case("even", 0.0, FINE_ENDS),
    "even, at the pitch point, fine ends, square": Case("even", 0.0, FINE_ENDS, square=True),
}
# ten minutes of processor time each and more, or not needed for the others: solved only where they are asked for, and not drawn
BY_NAME = {name for name, case in CASES.items() if case.mesh in (FINEST_FACE, FINE_MIDDLE, FINER_MIDDLE, FINE_ENDS, COARSE) or "finer face, " in name} | {
    "even, at the pitch point, rims held",
    "crown, between two pairs, rims held",
}
COUPLINGS = "teeth", "none"
TEETH = {0.0: (-1, 0, 1), 0.5: (-1, 0)}  # of the pinion, that carry there


def study():
    return tomllib.loads((HERE / "helical.toml").read_text())


def solved():
    """What helical.json has."""
    return json.loads((HERE / "helical.json").read_text())


def of_program(program, folder, lead, coupling, rotation):
    """Turn in µrad, and by tooth the line load of the strips, N per mm of face; what the example found stays in the folder."""
    import numpy as np

    name, file = folder / f"helical_{lead}_{coupling}_{rotation}.json", folder / f"helical_{lead}_{coupling}.toml"
    if not name.exists():
        file.write_text((HERE / "helical.toml").read_text() + f'coupling = "{coupling}"\n\n[face.pinion]\n{LEADS[lead][0]}\n')
        found = subprocess.run([program.parent / "examples" / "face_loads", file, str(rotation)], check=True, stdout=subprocess.PIPE)
        name.write_bytes(found.stdout)
    [found] = json.loads(name.read_text())
    none = [0.0] * study()["face"]["slices"]
    strips = lambda tooth: np.reshape(found["load_N_per_mm"].get(str(tooth), none), (STRIPS, -1)).mean(axis=1)
    return found["lag_urad"], {tooth: strips(tooth) for tooth in TEETH[rotation]}


def new_flanks(file):
    return [row for row in rows(file) if float(row["cycles"]) == 0]


def face_layers(width, count, end):
    """Even layers, or fine ones in the middle: so many on either side, so many in the middle, and how far that reaches, mm."""
    import numpy as np

    from model import layers

    if not isinstance(count, tuple):
        return layers(width, count, end)
    outside, middle, reach = count
    half = np.linspace(reach, 0.5 * width, outside + 1)
    return np.concatenate([-half[:0:-1], np.linspace(-reach, reach, middle + 1), half[1:]])


def turn_of(run, rotation):
    """Turn of the pinion in µrad, between the positions of the program."""
    import numpy as np

    angles = sorted((float(row["position"]), float(row["angle"])) for row in new_flanks(run / "transmission_error.csv"))
    return float(np.interp(rotation, *zip(*angles), period=1.0))


def of_bricks(folder, name, pair):
    """The same of CalculiX, kept in `folder`."""
    import numpy as np

    from model import Mesh, solve

    case = CASES[name]
    lead, rotation, (size, body, count, end) = case.lead, case.position, case.mesh
    kept = folder / f"helical_{name.replace(', ', '_').replace(' ', '_')}.json"
    if not kept.exists() and not shutil.which("ccx"):
        return solved()[name]["bricks"]
    if not kept.exists():
        z = face_layers(pair.width, count, end)
        missing = lambda at: LEADS[lead][1](at, pair.width)
        base = pair.gears()[0].base
        guess = (max(map(missing, z)) + 0.003) / base  # at first the flanks overlap by 3 µm where they do least
        mesh = Mesh(size=size, half=5 * size + 0.04, layers=z, body=body, stiffness=case.stiffness, steps=2, square=case.square)
        spent = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
        started = spent()
        found = solve(pair, mesh, rotation, TEETH[rotation], missing, guess, case.ends, folder, kept.stem)
        edges, loads = np.linspace(z[0], z[-1], STRIPS + 1), {}
        for tooth, force in found["forces"].items():
            total = np.concatenate([[0.0], np.cumsum(force)]) * np.cos(pair.base_helix())
            loads[tooth] = (np.diff(np.interp(edges, z, total)) / np.diff(edges)).tolist()
        answer = {"turn_urad": 1e6 * found["turn"], "load_N_per_mm": loads, "nodes": found["nodes"], "processor_seconds": round(spent() - started)}
        kept.write_text(json.dumps(answer))
    return json.loads(kept.read_text())


def straight(program, folder, pair):
    """Turn of straight teeth of the transverse section by one section of the program, tooth 0 at the pitch point, µrad."""
    import numpy as np

    name, file = folder / "helical_straight", folder / "helical_straight.toml"
    text = (HERE / "helical.toml").read_text().split("[face]")[0]
    angle = np.degrees(pair.pressure_angle)
    stated = {"module": pair.module, "pressure_angle": angle, "addendum": pair.addendum, "dedendum": pair.dedendum, "fillet_radius": pair.fillet}
    for key, value in stated.items():
        text = re.sub(rf"(?m)^{key} = [\d.]+", f"{key} = {float(value)!r}", text)
    file.write_text(text)
    if not (name / "summary.json").exists():
        subprocess.run([program, "run", file, "-o", name, "--quiet"], check=True)
    return turn_of(name, 0.0)


def rigid(lead, pair):
    """What the pinion turns by for the mean lead deviation alone, µrad."""
    return 1e6 * sum(LEADS[lead][1](pair.width * ((i + 0.5) / 1000 - 0.5), pair.width) for i in range(1000)) / 1000 / pair.gears()[0].base


def mesh_error(folder, pair):
    """Turns, µrad, of straight teeth of the transverse section in plane strain, tooth 0 at the pitch point, by mesh."""
    import numpy as np

    from model import Mesh, solve

    kept = folder / "helical_plane.json"
    if not kept.exists() and not shutil.which("ccx"):
        return {mesh: solved()["plane"][mesh] for mesh in ("rough", "finest")}
    if not kept.exists():
        straight = dataclasses.replace(pair, helix=0.0, torque=pair.torque / pair.width)
        turns = {}
        for name, (size, body) in {"rough": ROUGH[:2], "finest": (0.025, 0.5)}.items():
            mesh = Mesh(size=size, half=5 * size + 0.04, layers=np.array([-0.5, 0.5]), body=body, stiffness=STIFFNESS, steps=2)
            guess = 0.003 / pair.gears()[0].base
            turns[name] = 1e6 * solve(straight, mesh, 0.0, (0,), lambda z: 0.0, guess, "plane", folder, f"helical_plane_{name}")["turn"]
        kept.write_text(json.dumps(turns))
    return json.loads(kept.read_text())


def compare(bricks, turn, loads, torque_of):
    """Differences of slices from bricks."""
    import numpy as np

    theirs = {tooth: np.array(bricks["load_N_per_mm"][str(tooth)]) for tooth in loads}
    both = [sum(theirs.values()), sum(loads.values())]
    factor = [float(load.max() / load.mean()) for load in both]
    part = lambda of, tooth: float(of[tooth].sum() / sum(of.values()).sum())
    return {
        "turn_urad": turn,
        "load_N_per_mm": {str(tooth): load.tolist() for tooth, load in loads.items()},
        "k_hbeta": {"bricks": factor[0], "slices": factor[1]},
        "share_of_tooth": {str(tooth): {"bricks": part(theirs, tooth), "slices": part(loads, tooth)} for tooth in loads},
        "torque_of_loads_over_stated": {"bricks": torque_of(both[0]), "slices": torque_of(both[1])},
        "error": {
            "turn": turn / bricks["turn_urad"] - 1,
            "turn_mesh_error_removed": turn / bricks["turn_mesh_error_removed_urad"] - 1 if "turn_mesh_error_removed_urad" in bricks else None,
            "k_hbeta": factor[1] / factor[0] - 1,
            "load": float(abs(both[1] - both[0]).max() / both[0].max()),
            "load_of_teeth": float(max(abs(loads[t] - theirs[t]).max() for t in loads) / max(load.max() for load in theirs.values())),
        },
    }


def curves(entry):
    """Of both models the load of all teeth and of each, over the mean."""
    import numpy as np

    out = []
    for key in ("bricks", *COUPLINGS):
        loads = np.array(list(entry[key]["load_N_per_mm"].values()))
        out += [(key, load / loads.sum(axis=0).mean()) for load in [loads.sum(axis=0), *loads]]
    return out


def main():
    from model import pair_of

    program, folder, wanted = asked_for(__doc__, ("plane", *CASES), BY_NAME, needs_ccx=False)
    pair = pair_of(study())
    torque_of = lambda strips: float(strips.mean() * pair.width * pair.gears()[0].base / pair.torque)
    results, stiff = {name: entry for name, entry in solved().items() if name in ("plane", *CASES)}, None
    if "plane" in wanted:
        results["plane"] = {**mesh_error(folder, pair), "section": straight(program, folder, pair)}
        stiff = results["plane"]["finest"] / results["plane"]["rough"]
        print("plane:", ", ".join(f"{key} {turn:.1f} µrad" for key, turn in results["plane"].items()))
    for name in wanted:
        if name == "plane":
            continue
        case = CASES[name]
        lead, rotation = case.lead, case.position
        bricks = of_bricks(folder, name, pair)
        freed = stiff and case.mesh[:2] == ROUGH[:2]  # of other sections the error is not known
        if freed:
            bricks["turn_mesh_error_removed_urad"] = rigid(lead, pair) + (bricks["turn_urad"] - rigid(lead, pair)) * stiff
        results[name] = {"lead": lead, "position": rotation, "ends": case.ends, "bricks": bricks}
        print(f"{name}: {bricks['nodes']} nodes, {bricks['processor_seconds']} s")
        for coupling in COUPLINGS:
            found = compare(bricks, *of_program(program, folder, lead, coupling, rotation), torque_of)
            results[name][coupling] = found
            error, factor = found["error"], found["k_hbeta"]
            print(f"  {coupling}: turn {bricks['turn_urad']:.1f} µrad by bricks, {found['turn_urad']:.1f} by slices ({100 * error['turn']:+.1f} %)")
            if freed:
                print(f"    mesh freed {bricks['turn_mesh_error_removed_urad']:.1f} µrad ({100 * error['turn_mesh_error_removed']:+.1f} %)")
            print(f"    K_Hbeta {factor['bricks']:.3f}, {factor['slices']:.3f} ({100 * error['k_hbeta']:+.1f} %)")
            print(f"    load off by {100 * error['load']:.1f} % of the largest, of single teeth by {100 * error['load_of_teeth']:.1f} %")
            print(f"    shares {found['share_of_tooth']}, torque {found['torque_of_loads_over_stated']}", flush=True)
    (HERE / "helical.svg").write_text(picture({name: curves(entry) for name, entry in results.items() if name not in {"plane", *BY_NAME}}, pair.width, most=2.25))
    (HERE / "helical.json").write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
