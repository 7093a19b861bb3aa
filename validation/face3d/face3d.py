"""Holds the face in slices against the pair in three dimensions, solved by CalculiX.

    python3 validation/face3d/face3d.py PROGRAM WORKFOLDER [CASE ...]

Writes results.json and load.svg beside this file, of the cases asked for or of those of README.md. What CalculiX has solved stays in WORKFOLDER and is not solved again.
Needs numpy and `ccx`."""

import csv
import json
import math
import os
import resource
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).parent
SLICES = 20
STRIPS = 10  # that loads are compared in: a brick's own load is rough by some per cent from layer to layer
LEADS = {
    "even": ("", lambda z, width: 0.0),
    "wedge": ("lead_slope = 12.0", lambda z, width: 0.012 * z / width),
    "crown": ("crowning = 8.0", lambda z, width: 0.008 * (2 * z / width) ** 2),
}
SINGLE, DOUBLE = -0.105, 0.495  # base pitches from the pitch point
TEETH = {SINGLE: (0,), DOUBLE: (0, -1)}  # of the pinion, that carry there
# edges where the flanks touch (mm), edges elsewhere (over the usual ones), layers in the face, pieces of the outermost one
COARSE = (0.06, 1.4, 20, 2)
PROFILE = (0.045, 1.0, 20, 2)
FACE = (0.06, 1.4, 40, 1)
# lead, position, mesh, ends of the face. The even and the crowned face are their own mirror images: half of it is solved.
CASES = {
    "plane": ("even", SINGLE, COARSE, "plane"),
    "plane, finer profile": ("even", SINGLE, PROFILE, "plane"),
    "plane, finest": ("even", SINGLE, (0.025, 0.5, 20, 1), "plane"),
    "even": ("even", SINGLE, COARSE, "free"),
    "wedge": ("wedge", SINGLE, COARSE, "free"),
    "crown": ("crown", SINGLE, COARSE, "free"),
    "crown, finer profile": ("crown", SINGLE, PROFILE, "free"),
    "crown, finer face": ("crown", SINGLE, FACE, "free"),
    "wedge, mirrors": ("wedge", SINGLE, COARSE, "mirror"),
    "crown, mirrors": ("crown", SINGLE, COARSE, "mirror"),
    "crown, softer contact": ("crown", SINGLE, COARSE, "free"),
    "crown, two pairs": ("crown", DOUBLE, COARSE, "free"),
}
# solved only where they are asked for
BY_NAME = {"wedge, mirrors", "crown, finer face", "crown, softer contact"}
STIFFNESS, SOFTER = 3e7, 1e7  # MPa/mm


def study():
    return tomllib.loads((HERE / "study.toml").read_text())


def path_of(rotation, tooth=0):
    """Where a pair touches, mm along the path of contact from the pitch point."""
    import numpy as np

    gears = study()["gears"]
    return (rotation + tooth) * np.pi * gears["module"] * np.cos(np.radians(gears["pressure_angle"]))


def slices(program, folder, lead, coupling, ends):
    """A run of the program; `coupling` None is one section, `ends` are those of the bricks."""
    of_program = "held" if ends == "mirror" else "free"
    name = folder / f"slices_{lead}_{coupling}_{of_program}"
    text = (HERE / "study.toml").read_text()
    if coupling:
        text += f'\n[face]\nslices = {SLICES}\ncoupling = "{coupling}"\nends = "{of_program}"\n[face.pinion]\n{LEADS[lead][0]}\n'
    file = name.with_suffix(".toml")
    file.write_text(text)
    if not (name / "summary.json").exists():
        subprocess.run([program, "run", file, "-o", name, "--quiet"], check=True)
    return name


def rows(file, **where):
    with open(file, newline="") as text:
        for row in csv.DictReader(text):
            if all(row[key] == value for key, value in where.items()):
                yield row


def share(run, path):
    """Line load of every slice over the mean of the face where the pair touches at `path`: that of the worn depth, the mean of both members."""
    import numpy as np

    out = []
    for member in ("pinion", "gear"):
        found = list(rows(run / "wear.csv", member=member))
        end = max(float(row["cycles"]) for row in found)
        traces = {}
        for row in found:
            if float(row["cycles"]) == end:
                traces.setdefault(float(row["face"]), []).append((float(row["path"]), float(row["depth"])))
        depths = np.array([np.interp(path, *zip(*sorted(traces[face]))) for face in sorted(traces)])
        out.append(depths / depths.mean())
    return sum(out) / 2


def of_program(run, rotation):
    """Turn in µrad and line load in the strips over the mean, all pairs together."""
    at = lambda file: rows(run / file)
    here = lambda row: float(row["cycles"]) == 0 and abs(float(row["position"]) - rotation % 1.0) < 1e-6
    turn = next(float(row["angle"]) for row in at("transmission_error.csv") if here(row))
    if not any("face" in row for row in list(at("wear.csv"))[:1]):
        return turn, [1.0] * STRIPS
    pairs = [row for row in at("contact.csv") if here(row) and float(row["load_share"]) > 1e-9]
    load = sum(float(row["load_share"]) * share(run, float(row["path"])) for row in pairs)
    return turn, load.reshape(STRIPS, -1).mean(axis=1).tolist()


def of_bricks(folder, name):
    """The same of CalculiX, kept in `folder`."""
    import numpy as np

    from model import Mesh, layers, pair_of, solve

    lead, rotation, (size, body, count, end), ends = CASES[name]
    kept = folder / f"{name.replace(', ', '_').replace(' ', '_')}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    pair = pair_of(study())
    width = pair.width
    z = layers(width, count, end)
    half = lead != "wedge" and ends != "plane"
    if ends == "plane":
        z = np.array([-0.5, 0.5])
    elif half:
        z = z[z > -1e-9]
    pair.torque *= (z[-1] - z[0]) / width
    # at first the flanks overlap by 3 µm where they do least: so all of the face touches, and what touches has little to shrink by
    base = 0.5 * pair.module * pair.teeth[0] * np.cos(pair.pressure_angle)
    guess = (max(LEADS[lead][1](at, width) for at in z) + 0.003) / base
    mesh = Mesh(size=size, half=5 * size + 0.04, layers=z, body=body, stiffness=SOFTER if name.endswith("softer contact") else STIFFNESS, steps=2)
    spent = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    started = spent()
    held = "half" if half and ends == "free" else ends
    found = solve(pair, mesh, rotation, TEETH[rotation], lambda at: LEADS[lead][1](at, width), guess, held, folder, kept.stem)
    force = sum(found["forces"].values())
    if half:
        z, force = np.concatenate([-z[:0:-1], z]), np.concatenate([force[::-1], force])
    if ends == "plane":
        strips = [1.0] * STRIPS
    else:
        total = np.concatenate([[0.0], np.cumsum(force)])
        edges = np.linspace(-0.5 * width, 0.5 * width, STRIPS + 1)
        strips = (np.diff(np.interp(edges, z, total)) / (total[-1] / STRIPS)).tolist()
    answer = {
        "turn_urad": 1e6 * found["turn"],
        "load": strips,
        "nodes": found["nodes"],
        "layers": len(mesh.layers) - 1,
        "processor_seconds": round(spent() - started),
    }
    kept.write_text(json.dumps(answer))
    return answer


def mesh_error(folder, wanted):
    """By mesh of the section: the turn of the finest one in plane strain over that of this one. Empty where these are not asked for."""
    planes = {CASES[name][2][:2]: name for name in CASES if CASES[name][3] == "plane"}
    if not set(planes.values()) <= set(wanted):
        return {}
    turns = {mesh: of_bricks(folder, name)["turn_urad"] for mesh, name in planes.items()}
    finest = turns[min(turns)]
    return {mesh: finest / turn for mesh, turn in turns.items()}


def without_mesh_error(bricks, lead, factor):
    """The turn in µrad, what it owes to elasticity times `factor`; the rest is the mean lead deviation."""
    gears = study()["gears"]
    base = 0.5 * gears["module"] * gears["pinion"]["teeth"] * math.cos(math.radians(gears["pressure_angle"]))
    width = gears["face_width"]
    mean = sum(LEADS[lead][1](width * ((i + 0.5) / 1000 - 0.5), width) for i in range(1000)) / 1000
    rigid = 1e6 * mean / base
    return rigid + factor * (bricks["turn_urad"] - rigid)


PANELS = {"wedge": "wedge of 12 µm, one pair", "crown": "crown of 8 µm, one pair", "crown, two pairs": "crown of 8 µm, two pairs"}
COLOURS = {"bricks": ("#222222", "none", "CalculiX, bricks"), "teeth": ("#c44e52", "7 4", 'slices, coupling = "teeth"'), "none": ("#4c72b0", "2 3", 'slices, coupling = "none"')}


def picture(panels, width, most=2.0):
    """Line load over the mean across the face: panels by title, each a list of curves, the model and its loads."""
    wide, high, left, top, gap = 330, 260, 60, 40, 60
    full = left + len(panels) * (wide + gap)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {full} {top + high + 100}" font-family="sans-serif" font-size="13">',
        '<rect width="100%" height="100%" fill="white"/>',
    ]
    for number, (title, curves) in enumerate(panels.items()):
        x0 = left + number * (wide + gap)
        at = lambda z, load: (x0 + wide * (z / width + 0.5), top + high * (1 - load / most))
        out.append(f'<rect x="{x0}" y="{top}" width="{wide}" height="{high}" fill="none" stroke="#888"/>')
        out.append(f'<text x="{x0 + wide / 2}" y="{top - 12}" text-anchor="middle">{title}</text>')
        for tick in (0.0, 0.5, 1.0, 1.5, 2.0):
            y = at(0, tick)[1]
            out.append(f'<line x1="{x0}" x2="{x0 + wide}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
            out.append(f'<text x="{x0 - 8}" y="{y + 4:.1f}" text-anchor="end">{tick:.1f}</text>')
        for tick in (-10, -5, 0, 5, 10):
            x = at(tick, 0)[0]
            out.append(f'<text x="{x:.1f}" y="{top + high + 18}" text-anchor="middle">{tick}</text>')
        for key, load in curves:
            colour, dash, _ = COLOURS[key]
            places = [at(width * ((i + 0.5) / len(load) - 0.5), value) for i, value in enumerate(load)]
            line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
            out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.8" stroke-dasharray="{dash}"/>')
            if key == "bricks":
                out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{colour}"/>' for x, y in places]
        out.append(f'<text x="{x0 + wide / 2}" y="{top + high + 40}" text-anchor="middle">mm from mid-face</text>')
    shown = {key for curves in panels.values() for key, _ in curves}
    for number, (colour, dash, words) in enumerate(COLOURS[key] for key in COLOURS if key in shown):
        x, y = left + 240 * number, top + high + 74
        out.append(f'<line x1="{x}" x2="{x + 40}" y1="{y - 4}" y2="{y - 4}" stroke="{colour}" stroke-width="1.8" stroke-dasharray="{dash}"/>')
        out.append(f'<text x="{x + 48}" y="{y}">{words}</text>')
    middle = top + high / 2
    out.append(f'<text x="16" y="{middle}" text-anchor="middle" transform="rotate(-90 16 {middle})">line load over the mean</text>')
    return "\n".join([*out, "</svg>", ""])


def asked_for(words, cases, by_name, needs_ccx=True):
    """Program, folder and cases of the command line; ends where it asks for what is not there, and with 0 where CalculiX is needed and is not."""
    if len(sys.argv) < 3:
        sys.exit(words)
    if needs_ccx and shutil.which("ccx") is None:
        print("skipped: CalculiX (the program ccx) is not installed")
        sys.exit()
    wanted = sys.argv[3:] or [name for name in cases if name not in by_name]
    unknown = [name for name in wanted if name not in cases]
    if unknown:
        sys.exit(f"no case {unknown[0]!r}; there are: {', '.join(map(repr, cases))}")
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    return program, folder, wanted


def main():
    program, folder, wanted = asked_for(__doc__, CASES, BY_NAME)
    results, panels = {}, {}
    stiff = mesh_error(folder, wanted)
    for name in wanted:
        lead, rotation, _, ends = CASES[name]
        bricks = of_bricks(folder, name)
        print(f"{name}: {bricks['nodes']} nodes, turn {bricks['turn_urad']:.1f} µrad, K_Hbeta {max(bricks['load']):.3f}", flush=True)
        entry = {"lead": lead, "position": rotation, "ends": ends, "bricks": bricks}
        if stiff and ends != "plane":
            bricks["turn_mesh_error_removed_urad"] = without_mesh_error(bricks, lead, stiff[CASES[name][2][:2]])
        curves = {"bricks": bricks["load"]}
        for coupling in [None] if ends == "plane" else ["none", "teeth"]:
            turn, load = of_program(slices(program, folder, lead, coupling, ends), rotation)
            off = max(abs(a - b) for a, b in zip(load, bricks["load"])) / max(bricks["load"])
            error = {
                "turn": turn / bricks["turn_urad"] - 1,
                "turn_mesh_error_removed": turn / bricks["turn_mesh_error_removed_urad"] - 1 if stiff and ends != "plane" else None,
                "k_hbeta": max(load) / max(bricks["load"]) - 1,
                "load": off,
            }
            entry[coupling or "section"] = {"turn_urad": turn, "load": load, "error": error}
            print(
                f"  {coupling or 'one section'}: turn {turn:.1f} µrad ({100 * error['turn']:+.1f} %), K_Hbeta {max(load):.3f} ({100 * error['k_hbeta']:+.1f} %), "
                f"load off by {100 * off:.1f} % of the largest",
                flush=True,
            )
            curves[coupling] = load
        results[name] = entry
        if name in PANELS:
            panels[PANELS[name]] = list(curves.items())
    (HERE / "results.json").write_text(json.dumps(results, indent=1) + "\n")
    if panels:
        (HERE / "load.svg").write_text(picture(panels, study()["gears"]["face_width"]))


if __name__ == "__main__":
    main()
