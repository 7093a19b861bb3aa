"""Random valid studies: drawn, written, run and judged.

    python3 studies.py run PROGRAM RECORDS.jsonl --seed 1 --count 60 [--processes 2] [--numerics coarse|default] [--keep DIR]
    python3 studies.py summary RECORDS.jsonl [OTHER.jsonl ...]
    python3 studies.py write SEED NUMBER FILE

Study NUMBER of a SEED is the same on every machine. A record is kept as soon as a study is done; studies that have one are not run
again. Python's standard library only."""

import argparse
import concurrent.futures
import json
import os
import random
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from math import pi
from pathlib import Path

from gears import Pair, contact_modulus, nominal_line_load

TIMEOUT = 600.0  # seconds of processor time
SLOW = 60.0

NUMERICS = {
    "coarse": {"elements_per_half_width": 3, "positions": 24, "fields": 1, "stored_states": 2},
    "default": {"fields": 1, "stored_states": 2},
}


def log_uniform(rng, low, high):
    return low * (high / low) ** rng.random()


def clip(value, low, high):
    return min(max(value, low), high)


def draw_material(rng):
    kind = rng.random()
    if kind < 0.5:
        return 2.1e5 * rng.uniform(0.97, 1.0), 0.3, 7850.0
    if kind < 0.65:
        return log_uniform(rng, 4e4, 1.9e5), rng.uniform(0.25, 0.35), 7000.0
    return log_uniform(rng, 800.0, 3600.0), rng.uniform(0.35, 0.42), 1300.0


def draw_pair(rng):
    """Gears that run, with the radial misalignment at which they still do."""
    while True:
        module = log_uniform(rng, 0.5, 20.0)
        angle = rng.choice([14.5, 17.5, 20.0, 20.0, 20.0, 22.5, 25.0])
        first = round(log_uniform(rng, 12, 120))
        ratio = log_uniform(rng, 1.0, 6.0)
        teeth = [first, round(first * ratio)]
        if teeth[1] > 120:
            continue
        if rng.random() < 0.15:
            teeth.reverse()
        shifted = rng.random() < 0.6
        shift = [rng.uniform(-0.3, 0.8) if shifted else 0.0 for _ in teeth]
        misalignment = rng.uniform(0.0, 0.25) * module if rng.random() < 0.5 else 0.0
        if Pair(module, angle, teeth, shift).runs():
            pair = Pair(module, angle, teeth, shift, misalignment)
            if pair.runs():
                return pair, angle, misalignment


def draw_effect(rng, kind, s):
    """Parameters in proportion to the study's own loads, depths and times, so that the effect matters and does not rule."""
    u = rng.uniform
    p, depth, cycles, hours, size = s["pressure"], s["depth"], s["cycles"], s["hours"], s["module"] ** 0.5
    return {
        "running_in": lambda: {"amplitude": log_uniform(rng, 1, 8), "decay_cycles": clip(cycles * log_uniform(rng, 0.02, 1), 100, 1e9)},
        "pressure_exponent": lambda: {"exponent": u(0.7, 3), "reference_pressure": clip(p, 1, 1e4)},
        "severe_transition": lambda: {"ratio": log_uniform(rng, 2, 15), "limit": clip(p * u(0.7, 1.5), 10, 1e4)},
        "film_thickness": lambda: {"lambda0": log_uniform(rng, 0.1, 3)},
        "flash_temperature": lambda: {"sensitivity": u(0, 0.02)},
        "sliding_speed_exponent": lambda: {"exponent": u(-0.5, 0.5)},
        "oxidative": lambda: {"part": u(0.1, 1)},
        "surface_layer": lambda: {"ratio": log_uniform(rng, 0.3, 5), "thickness": clip(depth * u(0.1, 1), 0.2, 500)},
        "coating": lambda: {"ratio": log_uniform(rng, 2, 10), "thickness": clip(depth * u(0.1, 1), 0.05, 100)},
        "micropitting": lambda: {
            "rate": clip(depth * u(0.05, 0.5) / cycles * 1e6, 0, 1000),
            "exponent": u(2, 6),
            "reference_pressure": clip(p, 100, 1e4),
        },
        "debris_abrasion": lambda: {"amplitude": u(0.3, 3), "reference_volume": clip(s["volume"], 1e-3, 1e6)},
        "lubricant_ageing": lambda: {"ratio": u(0.5, 4), "life": clip(hours * u(0.1, 1), 0.01, 1e5)},
        "corrosive_loss": lambda: {"rate": clip(depth * u(0.05, 0.5) * 100 / hours, 0, 100)},
        "approach_recess": lambda: {"asymmetry": u(-0.5, 1.5), "width": clip(0.045 * s["module"], 1e-3, 2)},
        "member_hardness": lambda: {"log_ratio": u(-1, 1)},
        "energy_wear": lambda: {"exponent": u(0.5, 1.5)},
        "roughness_polish": lambda: {"height": min(1.0, depth) * u(0.1, 1), "settling_contacts": clip(0.1 * cycles, 10, 1e8)},
        "plastic_deformation": lambda: {
            "depth_limit": clip(depth * u(0.05, 0.3), 0, 50),
            "yield_pressure": clip(p * u(0.7, 1.5), 50, 5000),
            "width": clip(0.2 * p, 1, 5000),
            "settling_contacts": clip(0.02 * cycles, 10, 1e7),
        },
        "friction_load": lambda: {"coefficient": u(0.02, 0.15)},
        "dynamic_load": lambda: {"amplitude": u(0.05, 0.3), "phase": u(-3, 3)},
        "extra_flexibility": lambda: {"flexibility": clip(u(0.1, 0.5) * s["compliance"], 0, 1)},
        "bearing_compliance": lambda: {"flexibility": clip(u(0, 0.05) * 1e3 * s["module"] / s["force"], 0, 1)},
        "thermal_expansion": lambda: {"heating": u(0, 20) / s["power"]},
        "lead_misalignment": lambda: {"slope": clip(s["deflection"] * u(0.2, 1), 0, 200)},
        "radial_misalignment": lambda: {"amount": u(0, 0.05) * s["module"]},
        "tip_relief": lambda: {"amount": u(1, 8) * size, "length": u(0.3, 0.6) * s["base_pitch"]},
        "profile_slope": lambda: {"slope": u(-4, 4) * size, "crowning": u(-2, 2) * size},
        "profile_form": lambda: {"amplitude": u(0.3, 2) * size, "phase": u(-3, 3), "waves": u(1, 6)},
        "pitch_error": lambda: {"deviation": u(-8, 8) * size},
    }[kind]()


EFFECTS = [
    "running_in", "pressure_exponent", "severe_transition", "film_thickness", "flash_temperature", "sliding_speed_exponent",
    "oxidative", "surface_layer", "coating", "micropitting", "debris_abrasion", "lubricant_ageing", "corrosive_loss",
    "approach_recess", "member_hardness", "energy_wear", "roughness_polish", "plastic_deformation", "friction_load",
    "dynamic_load", "extra_flexibility", "bearing_compliance", "thermal_expansion", "lead_misalignment", "radial_misalignment",
    "tip_relief", "profile_slope", "profile_form", "pitch_error",
]  # fmt: skip


def draw(seed, number, numerics="coarse", wear=None):
    """Study `number` of `seed` as nested tables, and what is known of it; worn by `wear` modules instead of the depth drawn."""
    rng = random.Random(f"gearwear {seed} {number}")
    pair, angle, misalignment = draw_pair(rng)
    first = draw_material(rng)
    materials = [first, first if rng.random() < 0.7 else draw_material(rng)]
    elastic = [m[:2] for m in materials]
    modulus = contact_modulus(elastic)
    nominal, pressure = nominal_line_load(pair, elastic)
    # three of four between a tenth and twice the nominal load, the rest over the whole range
    factor = log_uniform(rng, 0.1, 2.0) if rng.random() < 0.75 else log_uniform(rng, 1e-3, 5.0)
    line_load = factor * nominal
    width = rng.uniform(5, 15) * pair.module
    coefficient = log_uniform(rng, 1e-11, 1e-7)
    wear_share = log_uniform(rng, 1e-3, 1e-1 if rng.random() < 0.2 else 4e-2)
    wear_share = wear or wear_share
    depth = wear_share * pair.module
    # at the ends of the path flanks slide by a third to twice what they pass over
    cycles = clip(2 * depth / (coefficient * line_load), 10.0, 1e12)
    speed = log_uniform(rng, 100, 5000)
    steel = min(e for e, _ in elastic) / 2.1e5
    compliance = 0.05 / steel  # mm um/N: a steel pair has about 20 N/(mm um)
    scales = {
        "pressure": pair.hertz(line_load, modulus),
        "depth": 1e3 * depth,
        "cycles": cycles,
        "hours": cycles / speed / 60,
        "module": pair.module,
        "base_pitch": pair.base_pitch,
        "volume": 0.5 * depth * 2 * pair.module * width * sum(pair.teeth),
        "compliance": compliance,
        "deflection": compliance * line_load,
        "force": line_load * width,
        "power": max(1e-6 * line_load * width * pair.base[0] * speed * 2 * pi / 60, 0.2),  # kW
    }
    kinds = rng.sample(EFFECTS, rng.choice([0, 0, 1, 1, 2]))
    # every fourth as the catalogue has it, whatever that does to these gears
    effects = [{"kind": kind, **(draw_effect(rng, kind, scales) if rng.random() < 0.75 else {})} for kind in kinds]
    member = [
        {
            "teeth": z,
            "profile_shift": round(x, 4),
            "bore_diameter": round(2 * rng.uniform(0.2, 0.6) * (root - pair.module), 4),
        }
        for z, x, root in zip(pair.teeth, pair.shift, pair.root)
    ]
    if rng.random() < 0.25:
        for table in member:
            table["tip_relief_amount"] = round(rng.uniform(2, 20) * pair.module**0.5, 3)
            table["tip_relief_length"] = round(rng.uniform(0.2, 0.6) * pair.base_pitch, 4)
    if rng.random() < 0.25:
        for table in member:
            table["tip_rounding"] = round(rng.uniform(0.005, 0.05) * pair.module, 5)
    study = {
        "": {"title": f"random study {number} of seed {seed}"},
        "gears": {"module": round(pair.module, 4), "pressure_angle": angle, "face_width": round(width, 3), "fillet_radius": pair.fillet},
        "gears.pinion": member[0],
        "gears.gear": member[1],
        **{
            f"material.{name}": {"youngs_modulus": round(e, 1), "poisson_ratio": round(nu, 3), "density": density}
            for name, (e, nu, density) in zip(["pinion", "gear"], materials)
        },
        "lubricant": {"viscosity": 0.015, "pressure_viscosity": 18.0, "roughness": 0.5, "friction_coefficient": 0.06},
        "thermal": {"bulk_temperature": 60.0, "conductivity": 46.0, "specific_heat": 470.0},
        "operation": {
            "torque": 1e-3 * line_load * width * pair.base[0],
            "speed": round(speed, 1),
            "misalignment": round(misalignment, 5),
        },
        "wear": {"coefficient": coefficient, "cycles": cycles},
        "numerics": {**NUMERICS[numerics], **({"friction": True} if rng.random() < 0.08 else {})},
    }
    facts = {
        "load_factor": factor,
        "wear_share": wear_share,
        "contact_ratio": round(pair.contact_ratio, 3),
        "pressure": round(scales["pressure"], 2),
        "softest": min(e for e, _ in elastic),
        "effects": kinds,
        "friction": "friction" in study["numerics"],
    }
    return study, effects, facts


def as_toml(study, effects):
    lines = []

    def table(values):
        for key, value in values.items():
            text = json.dumps(value) if isinstance(value, str | bool) else repr(value)
            lines.append(f"{key} = {text}")

    for name, values in study.items():
        if name:
            lines.append(f"\n[{name}]")
        table(values)
    for effect in effects:
        lines.append("\n[[effect]]")
        table(effect)
    return "\n".join(lines) + "\n"


def execute(program, study, folder, arguments=(), memory=None):
    """One run of the program on one thread, in at most `memory` GB: exit code, messages, processor seconds, largest memory."""
    output = Path(folder) / "run"
    command = [str(program), "run", str(study), "-o", str(output), "--threads", "1", "--quiet", *arguments]

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (int(TIMEOUT), int(TIMEOUT) + 5))
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (int(memory * 1e9), int(memory * 1e9)))
        os.nice(15)

    with open(Path(folder) / "stderr.txt", "w+") as errors:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=errors, preexec_fn=limit)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        message = errors.read().strip()
    record = {
        "exit": process.returncode,
        "message": message[-2000:],
        "cpu": round(usage.ru_utime + usage.ru_stime, 2),
        "rss_mb": round(usage.ru_maxrss / 1e3),
    }
    summary = output / "summary.json"
    if summary.exists():
        document = json.loads(summary.read_text())
        record["balance"] = document["wear"]["balance_error"]
        record["worn_um"] = [document["wear"][m]["max_depth_um"] for m in ("pinion", "gear")]
        record["checks"] = {c["name"]: [c["value"], c["passed"]] for c in document["checks"]}
        record["steps"] = document["cost"]["wear_steps"]
    record["result_files"] = sorted(p.name for p in output.iterdir())[:40] if output.is_dir() else []
    return record


def run_one(program, seed, number, numerics, keep, memory, wear=None):
    study, effects, facts = draw(seed, number, numerics, wear)
    folder = Path(tempfile.mkdtemp(prefix="random-study-"))
    try:
        path = folder / "study.toml"
        path.write_text(as_toml(study, effects))
        record = execute(program, path, folder, memory=memory)
        if keep:
            shutil.copytree(folder, Path(keep) / f"{seed}_{number}", dirs_exist_ok=True)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    gears = study["gears"]
    described = {
        "module": gears["module"],
        "angle": gears["pressure_angle"],
        "teeth": [study["gears.pinion"]["teeth"], study["gears.gear"]["teeth"]],
        "shift": [study["gears.pinion"]["profile_shift"], study["gears.gear"]["profile_shift"]],
        "misalignment": study["operation"]["misalignment"],
    }
    return {"seed": seed, "number": number, "numerics": numerics, **described, **facts, **record}


def run(arguments):
    records = Path(arguments.records)
    done = {(r["seed"], r["number"], r["numerics"]) for r in read(records)} if records.exists() else set()
    numbers = arguments.only or range(arguments.count)
    if arguments.most_load:
        numbers = [n for n in numbers if draw(arguments.seed, n)[2]["load_factor"] <= arguments.most_load]
    if arguments.least_load:
        numbers = [n for n in numbers if draw(arguments.seed, n)[2]["load_factor"] >= arguments.least_load]
    wanted = [n for n in numbers if (arguments.seed, n, arguments.numerics) not in done]
    lock = threading.Lock()
    with concurrent.futures.ThreadPoolExecutor(arguments.processes) as pool:

        def job(number):
            begun = time.time()
            record = run_one(arguments.program, arguments.seed, number, arguments.numerics, arguments.keep, arguments.memory, arguments.wear)
            with lock, records.open("a") as out:
                out.write(json.dumps(record) + "\n")
                print(f"{number}: {verdict(record)} ({time.time() - begun:.1f} s) {record['message'][:150]}", flush=True)

        list(pool.map(job, wanted))


def read(path):
    return [json.loads(line) for line in Path(path).read_text().splitlines()]


def verdict(record):
    if record["exit"] == 2:
        return "refused"
    if record["exit"] == 1 and record["message"].startswith("error:"):
        return "error"
    if record["exit"] != 0:
        return "killed"
    failed = [name for name, (_, passed) in record["checks"].items() if not passed]
    return f"failed check ({failed[0]})" if failed else "clean"


KINDS = {
    "angle": "smallest angle",
    "Jacobian": "Jacobian",
    "contact set": "did not settle",
    "singular": "not positive definite",
    "too soft": "closed by",
    "out of reach": "beyond the teeth prepared",
    "too fine": "unknowns on the flanks",
    "step too small": "too long",
    "check": "check",
}


def kind(record):
    what = verdict(record)
    if what != "error":
        return what
    return "error: " + next((k for k, text in KINDS.items() if text in record["message"]), record["message"][7:80])


def summary(arguments):
    for path in arguments.records:
        records = read(path)
        print(f"{path}: {len(records)} studies")
        tally(records)
        normal = [r for r in records if 0.1 <= r["load_factor"] <= 2.0]
        for name, some in (("at 0.1 to 2 times the nominal load", normal), ("all", records)):
            clean = sum(verdict(r) == "clean" for r in some)
            refused = sum(r["exit"] == 2 for r in some)
            print(f"  {name}: {clean} clean of {len(some) - refused} valid ({100 * clean / max(1, len(some) - refused):.1f} %)")
        balances = sorted(r["balance"] for r in records if "balance" in r)
        if balances:
            print(
                f"  area balance: median {100 * statistics.median(balances):.4f} %, 90 % below {100 * balances[int(0.9 * len(balances))]:.3f} %,"
                f" largest {100 * balances[-1]:.3f} %"
            )
        seconds = [r["cpu"] for r in records]
        print(
            f"  processor seconds: median {statistics.median(seconds):.1f}, largest {max(seconds):.1f}; over {SLOW:.0f} s:"
            f" {sum(s > SLOW for s in seconds)}; largest memory {max(r['rss_mb'] for r in records)} MB"
        )
        for record in sorted(records, key=lambda r: (kind(r), r["number"])):
            what = kind(record)
            if what != "clean" or record["cpu"] > SLOW or arguments.list:
                print(
                    f"    {record['seed']}/{record['number']}: {what}; m {record['module']}, {record['angle']} deg, z {record['teeth']},"
                    f" x {record['shift']}, E {record['softest']:.0f}, load {record['load_factor']:.3g}, wear {100 * record['wear_share']:.2g} % of m,"
                    f" {'+'.join(record['effects']) or 'no effects'}{', friction' if record['friction'] else ''}, {record['cpu']} s;"
                    f" balance {record.get('balance', float('nan')):.2g}; {record['message'][7:160]}"
                )


def tally(records):
    counts = {}
    for record in records:
        counts[kind(record)] = counts.get(kind(record), 0) + 1
    for what, count in sorted(counts.items(), key=lambda item: -item[1]):
        print(f"  {count:4d}  {what}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    runs = commands.add_parser("run")
    runs.add_argument("program")
    runs.add_argument("records")
    runs.add_argument("--seed", type=int, default=1)
    runs.add_argument("--count", type=int, default=60)
    runs.add_argument("--only", type=int, nargs="*")
    runs.add_argument("--least-load", type=float, help="only studies of at least this load factor")
    runs.add_argument("--most-load", type=float, help="only studies of at most this load factor")
    runs.add_argument("--wear", type=float, help="wear depth in modules instead of the one drawn")
    runs.add_argument("--processes", type=int, default=1)
    runs.add_argument("--numerics", choices=list(NUMERICS), default="coarse")
    runs.add_argument("--keep")
    runs.add_argument("--memory", type=float, help="address space of a run in GB; beyond it a run ends as killed")
    runs.set_defaults(action=run)
    tables = commands.add_parser("summary")
    tables.add_argument("records", nargs="+")
    tables.add_argument("--list", action="store_true", help="every study, the clean ones too")
    tables.set_defaults(action=summary)
    writes = commands.add_parser("write")
    writes.add_argument("seed", type=int)
    writes.add_argument("number", type=int)
    writes.add_argument("file")
    writes.add_argument("--numerics", choices=list(NUMERICS), default="coarse")
    writes.set_defaults(action=lambda a: Path(a.file).write_text(as_toml(*draw(a.seed, a.number, a.numerics)[:2])))
    arguments = parser.parse_args()
    arguments.action(arguments)


if __name__ == "__main__":
    sys.exit(main())
