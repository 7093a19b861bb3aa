"""Random pairs worn to a fifth of the tooth's thickness: does every run end, does its worn area balance, is its memory flat?

    python3 deep.py PROGRAM FOLDER [--pairs 20] [--seed 1] [--share 0.2] [--only N ...] [--numerics default|coarse]

Pairs, materials and loads (a tenth to twice nominal) are those of studies.py without effects, tip relief and tip rounding, of
teeth at least half a module thick at the tip: a thinner one is worn to a point before. The number of cycles is found by shorter
runs (contacts spread as they wear, so depth lags behind the cycles); the first that wears so deep is judged. Exit code 1 if a pair does not end or its worn area does not balance within 0.5 %.
Python's standard library only."""

import argparse
import json
import math
import random
import resource
import subprocess
import sys
from pathlib import Path

from gears import contact_modulus, nominal_line_load
from studies import NUMERICS, as_toml, draw_material, draw_pair, log_uniform

BALANCE = 5e-3
LEAST_TIP = 0.5  # modules
RUNS = 7


def draw(seed, number, numerics):
    """Study `number` of `seed` for one cycle, and an estimate of its depth per cycle (mm)."""
    rng = random.Random(f"gearwear deep {seed} {number}")
    while True:
        pair, angle, misalignment = draw_pair(rng)
        if min(pair.tip_thickness(0), pair.tip_thickness(1)) >= LEAST_TIP:
            break
    material = draw_material(rng)
    elastic = [material[:2]] * 2
    nominal, _ = nominal_line_load(pair, elastic)
    line_load = log_uniform(rng, 0.1, 2.0) * nominal
    width = 10 * pair.module
    coefficient = 1e-9
    study = {
        "": {"title": f"deep wear {number} of seed {seed}"},
        "gears": {"module": round(pair.module, 4), "pressure_angle": angle, "face_width": round(width, 3), "fillet_radius": pair.fillet},
        **{
            f"gears.{name}": {"teeth": z, "profile_shift": round(x, 4), "bore_diameter": round(0.8 * (root - pair.module), 4)}
            for name, z, x, root in zip(["pinion", "gear"], pair.teeth, pair.shift, pair.root)
        },
        "material": {"youngs_modulus": round(material[0], 1), "poisson_ratio": round(material[1], 3), "density": material[2]},
        "operation": {"torque": 1e-3 * line_load * width * pair.base[0], "speed": 1000.0, "misalignment": round(misalignment, 5)},
        "wear": {"coefficient": coefficient, "cycles": 1.0},
        "numerics": NUMERICS[numerics],
    }
    facts = {"hertz": pair.hertz(line_load, contact_modulus(elastic)), "rate": 0.5 * coefficient * line_load}
    return study, facts


def run(program, study, name):
    """Exit code, summary or message, processor seconds."""
    file = name.with_suffix(".toml")
    file.write_text(as_toml(study, []))
    command = ["nice", "-n", "15", program, "run", file, "-o", name.with_suffix(".out"), "--threads", "1", "--quiet", "--json"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode == 0:
        return 0, json.loads(done.stdout), seconds
    return done.returncode, " ".join(done.stderr.split())[:400], seconds


def deepest(summary):
    return 1e-3 * max(summary["wear"][side]["max_depth_um"] for side in ("pinion", "gear"))


def one(program, folder, seed, number, share, numerics):
    """The judged run of one pair: a line about it, None or its balance, processor seconds and memory (MB) of a first and of it."""
    study, facts = draw(seed, number, numerics)
    module = study["gears"]["module"]
    wanted = share * 0.5 * math.pi * module
    teeth = [study[f"gears.{name}"]["teeth"] for name in ("pinion", "gear")]
    label = (
        f"{number:2} m {module:6.2f} z {teeth[0]:3}/{teeth[1]:<3} E {study['material']['youngs_modulus']:8.0f} "
        f"p {facts['hertz']:6.1f} MPa"
    )
    cycles, memory = 0.02 * wanted / facts["rate"], []
    for step in range(RUNS):
        study["wear"]["cycles"] = cycles
        code, result, seconds = run(program, study, folder / f"deep{number:02}")
        if code:
            return f"{label}: exit {code} after {seconds:.0f} s: {result}", None
        memory.append(result["cost"]["peak_memory_mb"])
        if deepest(result) >= wanted:
            break
        cycles *= [0.05, 1.0][step] * wanted / deepest(result) if step < 2 else 1.1 * wanted / deepest(result)
    balance = result["wear"]["balance_error"]
    line = (
        f"{label}: {deepest(result) / wanted * share:.3f} of the thickness, balance {100 * balance:.4f} %, {seconds:.0f} s, "
        f"{memory[-1]:.0f} MB ({memory[0]:.0f} MB new), {result['cost']['wear_steps']} steps, "
        f"{result['cost']['factorisations']} factorisations"
    )
    return line, balance


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--pairs", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--share", type=float, default=0.2)
    parser.add_argument("--only", type=int, nargs="*")
    parser.add_argument("--numerics", choices=NUMERICS, default="default")
    a = parser.parse_args()
    a.folder.mkdir(parents=True, exist_ok=True)
    numbers = a.only if a.only else range(a.pairs)
    balances = []
    for number in numbers:
        line, balance = one(a.program, a.folder, a.seed, number, a.share, a.numerics)
        print(line, flush=True)
        if balance is not None:
            balances.append(balance)
    balances.sort()
    good = sum(b <= BALANCE for b in balances)
    if balances:
        print(f"balance: median {100 * balances[len(balances) // 2]:.4f} %, largest {100 * balances[-1]:.4f} %")
    print(f"{len(balances)} of {len(numbers)} ended, {good} of them balanced")
    sys.exit(good < len(numbers))


if __name__ == "__main__":
    main()
