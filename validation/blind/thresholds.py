#!/usr/bin/env python3
"""What the decision rule of `gearwear diagnose` would say with other thresholds, on the same fits.

    cargo build --release --example decision_rule
    python3 validation/blind/thresholds.py DATA RESULTS [--from N] [--to N]

DATA holds the sets of `blind make`, RESULTS the answers of run.sh. A diagnosis keeps the evidence and the fall of chi^2 of all that it
fitted and the thresholds it was decided with, so the program's own rule (`decide` in src/learn/decision/verdict.rs, by the example
`decision_rule`) is asked again with every threshold varied in turn. With nothing varied it must give the verdicts in RESULTS: the page
says on how many it does. --from and --to take the sets with these numbers only, so that thresholds chosen on some can be looked at on
others. Writes validation/blind/THRESHOLDS.md; standard library only.
"""
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGE = HERE / "THRESHOLDS.md"
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", HERE.parents[1] / "target"))
PROGRAM = TARGET / "release/examples/decision_rule"

# Thresholds by their names in src/learn/decision/rule.rs, which says what each is and where it was chosen.
TRIED = {
    "single_share": [0.5, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9],
    "remainder_denied": [-3.0, -2.0, -1.0, 0.0],
    "pair_share": [0.7, 0.8, 0.85, 0.9, 0.95, 1.0],
    "second_share": [0.0, 0.05, 0.1, 0.15, 0.2, 0.3],
    "temper": [1.0, 1.4, 1.8, 2.5, 4.0],
    "prior_nothing": [0.05, 0.2, 0.5, 0.8],
    "prior_pairs": [0.01, 0.05, 0.2],
    "unknown_offset": [0.0, 0.6, 1.2, 1.8],
    "unidentified_odds": [0.0, 0.25, 0.5, 1.0, 2.0],
    "claim": [0.5, 0.7, 0.8, 0.85, 0.9, 0.95],
    "doubt": [0.05, 0.1, 0.2, 0.4],
    "alike": [0.001, 0.01, 0.03, 0.1],
}
NOTHING, UNKNOWN = "nothing_missing", "unknown"
CHANGES = [{}] + [{name: value} for name, values in TRIED.items() for value in values]


def decided(answers):
    """For each diagnosis what the rule says with each of CHANGES: verdict, leading effects, group of names."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as rules:
        json.dump(CHANGES, rules)
        rules.flush()
        found = subprocess.run([PROGRAM, rules.name, *answers], check=True, capture_output=True, text=True)
    return [json.loads(line) for line in found.stdout.splitlines()]


# causes that the catalogue lacks, as in src/draw.rs
OUTSIDE = {
    "starvation_band", "growing_scuff", "on_off_blocks", "gear_hardness_waves", "load_moved_band",
    "members_swap", "half_flank_oil_failure", "humidity_cycle", "gear_groove", "gear_tip_plating",
}


def outcome(truth, said):
    """right, wrong or other, as `blind score` counts."""
    what, leading, group = said["verdict"], sorted(said["effects"] or []), said["group"]
    kinds = sorted(truth["kinds"])
    wanted = {"none": NOTHING, "outside": UNKNOWN}.get(truth["class"])
    in_group = wanted in group if wanted else kinds in [sorted(names) for names in group if isinstance(names, list)]
    if what == "ambiguous":
        return "right" if in_group else "other"
    known = [kind for kind in kinds if kind not in OUTSIDE]
    if what == "partial":
        # established beside something unknown: one, or one of a group
        named = [leading] if leading else [sorted(n for n in names if n != UNKNOWN) for names in group if isinstance(names, list)]
        if truth["class"] == "mixed":
            return "right" if known in named else "wrong"
        return "other" if truth["class"] not in ("none", "outside") and all(set(n) <= set(kinds) for n in named) else "wrong"
    if truth["class"] == "mixed" and what not in (NOTHING, UNKNOWN):
        return "other" if leading == known else "wrong"
    if what in (NOTHING, UNKNOWN):
        return "right" if what == wanted else "wrong" if truth["class"] == "none" else "other"
    return "right" if wanted is None and (leading == kinds or in_group) else "wrong"


def row(sets, place):
    """Right and wrong, in percent, of every class at d >= 6."""
    counts = {c: Counter() for c in ("none", "single", "foreign", "outside", "pair")}
    weak = Counter()
    for truth, said in sets:
        met = outcome(truth, said[place])
        d = min(truth["d_each"]) if truth["class"] == "pair" else truth["d"]
        if truth["class"] == "none" or d >= 6:
            counts[truth["class"]][met] += 1
        elif d >= 3:
            weak[met] += 1
    cells = []
    for c in [*counts.values(), weak]:
        n = sum(c.values())
        cells.append(f"{100 * c['right'] / n:.0f} / {100 * c['wrong'] / n:.0f}" if n else "-")
    return " | ".join(cells)


def main():
    arguments = sys.argv[1:]
    limits = {"--from": 0, "--to": 10**9}
    for key in limits:
        if key in arguments:
            at = arguments.index(key)
            limits[key] = int(arguments[at + 1])
            del arguments[at : at + 2]
    data, results = map(Path, arguments)
    truths, answers, verdicts, rule = [], [], [], {}
    for folder in sorted(data.iterdir()):
        answer = results / folder.name / "diagnosis.json"
        if not answer.exists() or not limits["--from"] <= int(folder.name.split("_")[1]) < limits["--to"]:
            continue
        found = json.loads(answer.read_text())
        if "rule" not in found:
            sys.exit(f"{answer} was written by a program that kept no rule: diagnose again")
        truths.append(json.loads((folder / "truth.json").read_text()))
        answers.append(answer)
        verdicts.append(found["verdict"])
        rule = found["rule"]
    sets = list(zip(truths, decided(answers)))
    agree = sum(said[0]["verdict"] == verdict for (_, said), verdict in zip(sets, verdicts))
    classes = Counter(truth["class"] for truth, _ in sets)
    lines = [
        "# Thresholds of the decision",
        "",
        "Written by `thresholds.py`, which says how. Right (name, or group with it) / wrong, in % of the sets with d >= 6 (all where",
        "nothing is hidden; last column: 3 <= d < 6). One threshold is varied at a time; the program's own value is in bold.",
        "",
        f"{len(sets)} sets ({', '.join(f'{n} {c}' for c, n in sorted(classes.items()))}), numbers from {limits['--from']}"
        + (f" to {limits['--to'] - 1}." if limits["--to"] < 10**9 else ".")
        + f" Asked again, the rule gives the verdict of the program that judged them on {agree} of {len(sets)}.",
        "",
        "| threshold | value | none | single | foreign | outside | pair | weak |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for place, change in enumerate(CHANGES):
        for name, value in change.items():
            shown = f"**{value}**" if value == rule[name] else f"{value}"
            lines.append(f"| {name} | {shown} | {row(sets, place)} |")
    PAGE.write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
