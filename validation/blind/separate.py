#!/usr/bin/env python3
"""Whether the proposed experiment, once it is made, tells apart what the diagnosis could not.

    python3 validation/blind/separate.py PROGRAM DATA RESULTS OUT [--blind BLIND] [--jobs N] [--fidelity middle]

DATA holds the sets of `blind make`, RESULTS the diagnoses of run.sh. Of every set that ended as a group of names, the proposed test and
those proposed beside it are made by `blind extend` (the same hidden cause, a k of its own each, the same noise) and all is diagnosed anew. Writes the new diagnoses into
OUT, which a second run does not repeat, and validation/blind/SEPARATE.md; standard library only.
"""
import argparse
import json
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PAGE = Path(__file__).resolve().parent / "SEPARATE.md"
BLIND = Path(__file__).resolve().parent / "target/debug/blind"


def read(path):
    return json.loads(path.read_text())


def members(diagnosis):
    """Names that the verdict leaves, each a sorted list of effects."""
    if diagnosis["verdict"] == "ambiguous":
        return [sorted(name.split("+")) for name in diagnosis["indistinguishable"][0]]
    effect = diagnosis["effect"]
    if effect is None:
        return [[diagnosis["verdict"]]]
    return [sorted(effect) if isinstance(effect, list) else [effect]]


def tests(proposal):
    return [proposal["test"], *proposal["further"]]


def repeat(args, name):
    proposal = read(args.results / name / "diagnosis.json")["next_experiment"]
    work = args.out / f".{name}"
    shutil.rmtree(work, ignore_errors=True)
    conditions = [
        "--test=" + ",".join(str(test[key]) for key in ("torque", "speed", "misalignment", "cycles")) for test in tests(proposal)
    ]
    subprocess.run([args.blind, "extend", args.data / name, *conditions, "--out", work], check=True)
    # Only what a user would have goes to the program.
    (work / "user").mkdir()
    for file in ("study.toml", "measurements.csv"):
        shutil.copy(work / name / file, work / "user")
    threads = "1" if args.jobs > 1 else "2"
    command = [args.program, "--quiet", "--threads", threads, "diagnose", "--fidelity", args.fidelity, "study.toml", "-o", "out"]
    subprocess.run(command, cwd=work / "user", check=True, capture_output=True)
    shutil.copy(work / "user/out/diagnosis.json", args.out / f"{name}.json")
    shutil.rmtree(work)


def judge(args, name):
    before, after = read(args.results / name / "diagnosis.json"), read(args.out / f"{name}.json")
    truth, proposal = read(args.data / name / "truth.json"), before["next_experiment"]
    cause = sorted(truth["kinds"])
    left, rivals = members(after), [sorted(r.split("+")) for r in proposal["separates"]]
    separated = sum(r in left for r in rivals) < 2
    outside = truth["class"] == "outside"
    right = left == [["unknown"]] if outside else cause in left
    return {
        "name": name,
        "cause": "+".join(cause),
        "expected": proposal["together_chi2"],
        "tests": len(tests(proposal)),
        # Of a group without the true cause the test can only show another one.
        "truth_among": cause in rivals,
        "separated": separated,
        "right": right,
        "exact": right and len(left) == 1,
        "rivals": ", ".join(proposal["separates"]),
        "after": ", ".join("+".join(names) for names in left),
        "probability": max(after["probabilities"].values()),
        "noise": truth["noise"],
        "d": truth["d"],
    }


def page(args, results, reversed_):
    def line(label, of):
        count = lambda key: sum(r[key] for r in of)
        return f"| {label} | {len(of)} | {count('separated')} | {count('exact')} | {count('right')} | {sum(not r['right'] for r in of)} |"

    among = [r for r in results if r["truth_among"]]
    lines = [
        "# Once the proposed experiment is made",
        "",
        f"Made by `separate.py` (its head tells how), all diagnosed with `--fidelity {args.fidelity}`: {len(results)} sets that ended as a group of names. "
        f"{reversed_} more, whose proposals reverse the drive, could not be made.",
        "",
        "| group | sets | no longer both | true name alone | true name among those left | true name gone |",
        "|---|---|---|---|---|---|",
        line("the true cause is one of the two; promised: \"enough to tell them apart\" (χ² ≥ 20)", [r for r in among if r["expected"] >= 20]),
        line("the same; promised: \"enough to favour one clearly\" (6 to 20)", [r for r in among if 6 <= r["expected"] < 20]),
        line("the same; promised: \"still little: other measurements are needed\" (below 6)", [r for r in among if r["expected"] < 6]),
        line("the true cause is neither", [r for r in results if not r["truth_among"]]),
        "",
        "| set | truth | noise | d | to be separated | tests | promised χ² | left afterwards | largest probability |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for r in sorted(results, key=lambda r: -r["expected"]):
        lines.append(
            f"| {r['name']} | {r['cause']} | {r['noise']} | {r['d']:.0f} | {r['rivals']} | {r['tests']} | {r['expected']:.1f} | {r['after']} | {r['probability']:.2f} |"
        )
    PAGE.write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda text: str(Path(text).resolve()))
    for folder in ("data", "results", "out"):
        parser.add_argument(folder, type=Path)
    parser.add_argument("--blind", type=Path, default=BLIND)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--fidelity", default="middle")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    names, reversed_ = [], 0
    for path in sorted(args.results.glob("*/diagnosis.json")):
        diagnosis = read(path)
        proposal = diagnosis["next_experiment"] if diagnosis["verdict"] == "ambiguous" else None
        if proposal and any(test["reversed"] for test in tests(proposal)):
            reversed_ += 1
        elif proposal:
            names.append(path.parent.name)
    with ThreadPoolExecutor(args.jobs) as pool:
        list(pool.map(lambda name: (args.out / f"{name}.json").exists() or repeat(args, name), names))
    page(args, [judge(args, name) for name in names], reversed_)


if __name__ == "__main__":
    main()
