#!/usr/bin/env python3
"""What adding the named effects does: chi^2 per point of the fit tests and of a held-out test under other conditions.

    python3 validation/blind/refit.py PROGRAM DATA RESULTS OUT [--jobs N] [--most N]

DATA holds the sets of `blind make`, RESULTS the diagnoses of run.sh. Of every set in which the diagnosis named an effect or two, those
are added to the study as it says, one `gearwear add` after another; the sealed test, to which Gaussian noise of its stated sigma is added
(seeded by the set's name), stands in the measurements as a held-out one. Both are also compared with the base model. Writes one JSON
document a set into OUT, which a second run does not repeat, and validation/blind/REFIT.md; standard library only.
"""
import argparse
import csv
import json
import random
import re
import shutil
import statistics
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PAGE = Path(__file__).resolve().parent / "REFIT.md"
ADD = re.compile(r'gearwear add STUDY (\w+)(?: --form (own|"[^"]+"))?')


def told(diagnosis):
    """The effects and forms that the diagnosis says to add; none if it names nothing."""
    if diagnosis["effect"] is None:
        return []
    return [(effect, form.strip('"') or None) for effect, form in ADD.findall(diagnosis["next_step"])]


def prepare(source, folder, name):
    """Study and measurements with the sealed test, noise added, as a held-out one."""
    noise = random.Random(name)
    text = (source / "study.toml").read_text() + "\n" + (source / "sealed.toml").read_text()
    (folder / "study.toml").write_text(text)
    with open(source / "measurements.csv") as measured, open(source / "sealed.csv") as sealed:
        rows = list(csv.reader(measured))
        for row in list(csv.reader(sealed))[1:]:
            row[5] = f"{float(row[5]) + noise.gauss(0.0, float(row[6])):.4f}"
            rows.append(row)
    with open(folder / "measurements.csv", "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(rows)


def chi2(document):
    share = lambda part: (document.get(part) or {}).get("chi2_per_point")
    return [share("fit"), share("holdout")]


def refit(program, source, effects, out, threads):
    name = source.name
    folder = out / f".{name}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    prepare(source, folder, name)

    def call(*arguments):
        command = [program, "--json", "--quiet", *arguments, "--threads", str(threads)]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        return json.loads(done.stdout) if done.returncode == 0 else {"error": done.stderr}

    start = time.time()
    before = call("compare", "study.toml", "-o", "base")
    study, steps = "study.toml", []
    for number, (effect, form) in enumerate(effects):
        new = f"with{number + 1}.toml"
        document = call("add", study, effect, *(["--form", form] if form else []), "-o", new)
        fit = document.get("fit") or {}
        steps.append({"effect": effect, "form": fit.get("form"), "chi2": chi2(fit), "error": document.get("error")})
        if steps[-1]["error"]:
            break
        study = new
    result = {"name": name, "before": chi2(before), "steps": steps, "seconds": round(time.time() - start, 1)}
    (out / f"{name}.json").write_text(json.dumps(result, indent=1) + "\n")
    shutil.rmtree(folder)


def page(results, truths):
    rows, after, wrong = [], {}, 0
    for result in results:
        truth = truths[result["name"]]
        kinds = sorted(effect["kind"] for effect in truth["effects"])
        right = kinds == sorted(step["effect"] for step in result["steps"])
        last = result["steps"][-1]
        forms = ", ".join(f"{step['effect']} ({step['form']})" for step in result["steps"])
        number = lambda value: "-" if value is None else f"{value:.3f}"
        rows.append(
            f"| {result['name']} | {'+'.join(kinds)} | {truth['noise']} | {truth['d']:.0f} | {forms} | "
            f"{number(result['before'][0])} / {number(result['before'][1])} | "
            + (f"failed: {last['error'][:60]} |" if last["error"] else f"{number(last['chi2'][0])} / {number(last['chi2'][1])} |")
            + f" {result['seconds']:.0f} |"
        )
        wrong += not right
        if right and not last["error"]:
            after.setdefault(truth["class"], []).append(last["chi2"])
            after.setdefault("all", []).append(last["chi2"])
    lines = [
        "# After adding what was named",
        "",
        "Made by `refit.py` (its head tells how): chi^2 per point of the fit tests / of a held-out test under other conditions.",
        f"{len(results)} sets; {wrong} of them not named rightly, which the medians leave out.",
        "",
        "| class | sets | fit: median (5 to 95 %) | held out: median (5 to 95 %) | fit <= 1.1 | held out <= 1.15 |",
        "|---|---|---|---|---|---|",
    ]
    for kind, list_ in sorted(after.items()):
        cells = []
        for part in (0, 1):
            values = sorted(pair[part] for pair in list_ if pair[part] is not None)
            at = lambda q: values[min(len(values) - 1, int(q * len(values)))]
            cells.append(f"{statistics.median(values):.3f} ({at(0.05):.3f} to {at(0.95):.3f})")
        good = [sum(pair[part] is not None and pair[part] <= bar for pair in list_) for part, bar in ((0, 1.1), (1, 1.15))]
        lines.append(f"| {kind} | {len(list_)} | {cells[0]} | {cells[1]} | {good[0]} | {good[1]} |")
    lines += ["", "| set | truth | noise | d | added (form) | before | after | s |", "|---|---|---|---|---|---|---|---|", *rows]
    PAGE.write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda text: str(Path(text).resolve()))
    for folder in ("data", "results", "out"):
        parser.add_argument(folder, type=Path)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--most", type=int, default=10**9)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    wanted = []
    for path in sorted(args.results.glob("*/diagnosis.json")):
        source = args.data / path.parent.name
        effects = told(json.loads(path.read_text()))
        if effects and not (args.out / f"{source.name}.json").exists():
            wanted.append((source, effects))
    random.Random(1).shuffle(wanted)
    with ThreadPoolExecutor(args.jobs) as pool:
        threads = 1 if args.jobs > 1 else 2
        list(pool.map(lambda w: refit(args.program, w[0], w[1], args.out, threads), wanted[: args.most]))
    results = [json.loads(path.read_text()) for path in sorted(args.out.glob("*.json"))]
    truths = {r["name"]: json.loads((args.data / r["name"] / "truth.json").read_text()) for r in results}
    page(results, truths)


if __name__ == "__main__":
    main()
