"""Metamorphic relations: what must not change, or must change exactly so, when a study is told in another way.

    python3 metamorphic.py run PROGRAM RECORDS.jsonl --seed 1 --count 100 [--least-load 0.05]
    python3 metamorphic.py summary RECORDS.jsonl

The studies are those of studies.py without effects. Differences are the largest of any worn depth over the largest depth, and of any peak
pressure over the largest (tip corners of sharp teeth included). Python's standard library only."""

import argparse
import copy
import csv
import json
import statistics
import sys
import tempfile
from pathlib import Path

from studies import as_toml, draw, execute, read

LENGTHS = [
    ("gears", "module"), ("gears", "face_width"), ("operation", "misalignment"),
    *((f"gears.{m}", k) for m in ("pinion", "gear") for k in ("bore_diameter", "tip_relief_amount", "tip_relief_length", "tip_rounding")),
]  # fmt: skip


def scale(study, keys, factor):
    for table, key in keys:
        if key in study[table]:
            study[table][key] *= factor


def lengths(study):
    """Twice as large gears under the same pressures wear twice as deep."""
    scale(study, LENGTHS, 2.0)
    scale(study, [("operation", "torque")], 8.0)
    return {"depth": 2.0}


def moduli(study):
    """Twice as stiff gears under twice the torque, half the wear coefficient: the same depth, twice the pressure."""
    scale(study, [("material.pinion", "youngs_modulus"), ("material.gear", "youngs_modulus"), ("operation", "torque")], 2.0)
    scale(study, [("wear", "coefficient")], 0.5)
    return {"pressure": 2.0}


def face(study):
    """Twice the face under twice the torque: the same in every plane."""
    scale(study, [("gears", "face_width"), ("operation", "torque")], 2.0)
    return {}


def time(study):
    """Half the wear coefficient over twice the cycles."""
    scale(study, [("wear", "coefficient")], 0.5)
    scale(study, [("wear", "cycles")], 2.0)
    return {}


def mirrored(study):
    """The other direction of drive."""
    study["test"] = {"id": "other", "reversed": True}
    return {"arguments": ["--test", "other"]}


def exchanged(study):
    """Driver and driven change places at ratio 1: each wears as it did in the other's place of a mirrored path."""
    for table in ("gears", "material"):
        one, other = f"{table}.pinion", f"{table}.gear"
        study[one], study[other] = study[other], study[one]
    return {"swap": True}


# relation: what makes the other study, and the difference that passes;
# exchanged members are another mesh, and at sharp tip corners, where pressure is singular, depths follow the mesh: their worn area is compared.
RELATIONS = {
    "lengths and forces": (lengths, 1e-9),
    "modulus and torque": (moduli, 1e-9),
    "face and torque": (face, 1e-9),
    "coefficient and cycles": (time, 1e-9),
    "drive mirrored": (mirrored, 1e-9),
    "members exchanged": (exchanged, 1e-2),
}


def toml(study):
    study = dict(study)
    test = study.pop("test", None)
    text = as_toml(study, [])
    return text + (f'\n[[test]]\nid = "{test["id"]}"\nreversed = true\n' if test else "")


def solve(program, study, arguments=()):
    with tempfile.TemporaryDirectory(prefix="metamorphic-") as folder:
        path = Path(folder) / "study.toml"
        path.write_text(toml(study))
        record = execute(program, path, folder, arguments)
        if record["exit"] != 0:
            return record, None, None
        tables = [list(csv.DictReader((Path(folder) / "run" / f"{name}.csv").open())) for name in ("wear", "contact")]
    last = max(float(row["cycles"]) for row in tables[0])
    depths = {
        m: [float(r["depth"]) for r in tables[0] if r["member"] == m and float(r["cycles"]) == last] for m in ("pinion", "gear")
    }
    peaks = [float(r["peak_pressure"]) for r in tables[1] if float(r["cycles"]) == last]
    return record, depths, peaks


def compare(base, other, how):
    depths, peaks = base[1:]
    changed, changed_peaks = other[1:]
    factor = how.get("depth", 1.0)
    if how.get("swap"):
        changed = {"pinion": changed["gear"], "gear": changed["pinion"]}
    largest = max(max(d) for d in depths.values())
    worst = 0.0
    for member, depth in depths.items():
        if len(depth) != len(changed[member]):
            return {"depth": 1.0, "why": f"{len(depth)} and {len(changed[member])} stations"}
        worst = max(worst, max(abs(b / factor - a) for a, b in zip(depth, changed[member])) / largest)
    out = {"depth": worst}
    out["area"] = max(abs(sum(changed[m]) / factor / sum(d) - 1) for m, d in depths.items())
    if not how.get("swap") and len(peaks) == len(changed_peaks):
        by = how.get("pressure", 1.0)
        out["pressure"] = max(abs(b / by - a) for a, b in zip(peaks, changed_peaks)) / max(peaks)
    return out


def base_study(seed, number, relation):
    study, _, facts = draw(seed, number)
    if relation == "members exchanged":
        first, second = study["gears.pinion"], study["gears.gear"]
        second["teeth"] = first["teeth"]
        second["profile_shift"] = first["profile_shift"]
        second["bore_diameter"] = first["bore_diameter"]
        first["tip_relief_amount"] = 5.0 * study["gears"]["module"] ** 0.5
        first["tip_relief_length"] = 0.5 * study["gears"]["module"]
        study["numerics"].pop("friction", None)
    return study, facts


def run(arguments):
    records = Path(arguments.records)
    done = {(r["seed"], r["number"]) for r in read(records)} if records.exists() else set()
    for number in range(arguments.count):
        facts = draw(arguments.seed, number)[2]
        if (arguments.seed, number) in done or facts["load_factor"] < arguments.least_load:
            continue
        record = {"seed": arguments.seed, "number": number, "differences": {}}
        plain = solve(arguments.program, base_study(arguments.seed, number, "")[0])
        for name, (change, _) in RELATIONS.items():
            study = base_study(arguments.seed, number, name)[0]
            base = plain if name != "members exchanged" else solve(arguments.program, study)
            other = copy.deepcopy(study)
            how = change(other)
            solved = solve(arguments.program, other, how.get("arguments", ()))
            if base[1] is None or solved[1] is None:
                # both or none
                same = base[0]["exit"] == solved[0]["exit"]
                record["differences"][name] = {"exits": [base[0]["exit"], solved[0]["exit"]], "same": same,
                                               "message": (solved[0]["message"] or base[0]["message"])[:200]}  # fmt: skip
            else:
                record["differences"][name] = compare(base, solved, how)
        with records.open("a") as out:
            out.write(json.dumps(record) + "\n")
        print(number, {k: v.get("depth", v.get("exits")) for k, v in record["differences"].items()}, flush=True)


def summary(arguments):
    records = read(arguments.records)
    print(f"{len(records)} studies")
    for name, (_, limit) in RELATIONS.items():
        found = [(r["number"], r["differences"][name]) for r in records if name in r["differences"]]
        figure = "area" if name == "members exchanged" else "depth"
        values = sorted(d[figure] for _, d in found if figure in d)
        pressures = [d["pressure"] for _, d in found if "pressure" in d]
        if not values:
            continue
        off = [n for n, d in found if d.get(figure, 0.0) > limit]
        exits = [n for n, d in found if d.get("same") is False]
        print(
            f"  {name}: {figure} median {statistics.median(values):.1e}, largest {values[-1]:.1e}; pressure largest "
            f"{max(pressures, default=float('nan')):.1e}; {len(off)} of {len(values)} beyond {limit:.0e} {off}; other exits {exits}"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    runs = commands.add_parser("run")
    runs.add_argument("program")
    runs.add_argument("records")
    runs.add_argument("--seed", type=int, default=1)
    runs.add_argument("--count", type=int, default=100)
    runs.add_argument("--least-load", type=float, default=0.0)
    runs.set_defaults(action=run)
    tables = commands.add_parser("summary")
    tables.add_argument("records")
    tables.set_defaults(action=summary)
    arguments = parser.parse_args()
    arguments.action(arguments)


if __name__ == "__main__":
    sys.exit(main())
