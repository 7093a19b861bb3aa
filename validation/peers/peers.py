"""Lets other programs solve single mesh positions of the paper's pair on gearwear's own meshes, and compares answers and processor time.

    python3 validation/peers/peers.py target/release/gearwear WORKFOLDER

Writes results.json beside this file and the tables of README.md. Peers are CalculiX (`ccx`) and Kratos Multiphysics (Python packages); what is not installed is
skipped, and that is said. One thread each. What a peer has solved stays in WORKFOLDER and is not solved again."""

import json
import math
import os
import re
import sys
import tomllib
from pathlib import Path

import calculix
import kratos
from deck import Deck
from spent import timed

HERE = Path(__file__).parent
PAPER = HERE.parent / "paper/study.toml"
PEERS = (calculix, kratos)
# elements and base pitches from the pitch point: one pair of teeth at the pitch point, two pairs that share the load unevenly
CASES = (("quadratic", 0.0), ("quadratic", 0.3), ("linear", 0.3))
ORDER = {"linear": 1, "quadratic": 2}


def gearwear(program, study, position, folder):
    """The deck, what gearwear finds, and the processor time of meshes, compliance and this one position."""
    words = [program, "export", study, "--position", position, "-o", folder, "--threads", 1, "--quiet"]
    seconds = timed(words, folder.with_suffix(".log"))
    found = json.loads((folder / "expected.json").read_text())
    file = folder / found["deck"]
    deck = Deck(file)
    # pairs that do not touch are left out of the list
    load = {pair["pair"]: pair["line_load"] for pair in found["pairs"]}
    teeth = [int(n) for n in re.findall(r"^\*\* tooth pair (-?\d+)", file.read_text(), re.M)]
    answer = {
        "turn_urad": found["angle_urad"],
        "peak_pressure": found["peak_pressure"],
        "line_loads": [load.get(tooth, 0.0) for tooth in teeth],
        "processor_seconds": seconds,
        "peak_by_hertz": hertz(found),
    }
    return file, deck, answer


def hertz(found):
    """Largest pressure by Hertz of what gearwear finds for every pair: line load, and radii where it touches."""
    study = tomllib.loads(PAPER.read_text())
    gears, steel = study["gears"], study["material"]
    alpha = math.radians(gears["pressure_angle"])
    modulus = 0.5 * steel["youngs_modulus"] / (1 - steel["poisson_ratio"] ** 2)
    radii = [0.5 * gears["module"] * gears[gear]["teeth"] * math.sin(alpha) for gear in ("pinion", "gear")]
    largest = 0.0
    for pair in found["pairs"]:
        a, b = radii[0] + pair["path"], radii[1] - pair["path"]
        largest = max(largest, math.sqrt(pair["line_load"] * modulus / (math.pi * a * b / (a + b))))
    return largest


def history(program, folder):
    """The paper's wear study: processor time of all of it, and what it consists of."""
    words = [program, "run", PAPER, "-o", folder, "--threads", 1, "--quiet"]
    seconds = timed(words, folder.with_suffix(".log"))
    cost = json.loads((folder / "summary.json").read_text())["cost"]
    keep = {key: cost[key] for key in ("contact_solves", "wear_steps", "factorisations", "stages")}
    return {"processor_seconds": seconds, **keep}


def largest_share(answer):
    return max(answer["line_loads"]) / sum(answer["line_loads"])


def solved(peer, file, deck, folder):
    """The peer's answer, kept in `folder`."""
    kept = folder / "answer_kept.json"
    if not kept.exists():
        answer = peer.solve(file, deck, folder)
        kept.write_text(json.dumps(answer))
    return json.loads(kept.read_text())


def compare(program, folder):
    cases = []
    present = []
    for peer in PEERS:
        reason = peer.absent()
        if reason:
            print(f"skipped: {peer.NAME}: {reason}", flush=True)
        else:
            present.append(peer)
    for elements, position in CASES:
        name = f"{elements}_{position}"
        study = folder / f"{elements}.toml"
        study.write_text(f"{PAPER.read_text()}\n[numerics]\norder = {ORDER[elements]}\n")
        file, deck, ours = gearwear(program, study, position, folder / name)
        answers = {"gearwear": ours}
        for peer in present:
            answers[peer.NAME] = solved(peer, file.resolve(), deck, folder / f"{name}_{peer.NAME}")
        cases.append({"elements": elements, "position": position, "unknowns": deck.unknowns(), "answers": answers})
        for who, answer in answers.items():
            print(
                f"{name}: {who}: turn {answer['turn_urad']:.2f} µrad, peak {answer['peak_pressure']:.1f} MPa, share {largest_share(answer):.4f}, "
                f"{answer['processor_seconds']:.1f} s",
                flush=True,
            )
    return {"cases": cases, "history": history(program, folder / "history")}


def percent(value, target):
    return f"{100 * (value / target - 1):+.2f} %"


def positions_table(results):
    lines = [
        "| elements | position | unknowns | program | turn, µrad | gearwear against it | peak pressure, MPa | it against Hertz | larger load share | iterations | processor time |",
        "| --- | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    for case in results["cases"]:
        ours = case["answers"]["gearwear"]
        for who, answer in case["answers"].items():
            cells = [
                case["elements"],
                case["position"],
                f"{case['unknowns']:,}".replace(",", " "),
                f"{who} {answer.get('version', '')}".strip(),
                f"{answer['turn_urad']:.2f}",
                "" if who == "gearwear" else percent(ours["turn_urad"], answer["turn_urad"]),
                f"{answer['peak_pressure']:.1f}",
                percent(answer["peak_pressure"], ours["peak_by_hertz"]),
                f"{largest_share(answer):.4f}",
                answer.get("iterations", ""),
                f"{answer['processor_seconds']:.2f} s",
            ]
            lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines)


def time_of(seconds):
    return f"{seconds / 3600:.1f} h" if seconds > 7200 else f"{seconds / 60:.0f} min"


def history_table(results):
    whole = results["history"]
    solves = whole["contact_solves"]
    lines = [
        "| program | what | processor time | over gearwear's |",
        "| --- | --- | ---: | ---: |",
        f"| gearwear | measured: the whole run, {solves} positions in {whole['wear_steps']} wear steps, fields and report | {whole['processor_seconds']:.2f} s | |",
    ]
    for peer in PEERS:
        answers = [c["answers"][peer.NAME] for c in results["cases"] if peer.NAME in c["answers"] and c["elements"] == "quadratic"]
        if not answers:
            continue
        position = sum(a["processor_seconds"] for a in answers) / len(answers)
        iteration = sum(a["processor_seconds"] for a in answers) / sum(a["iterations"] for a in answers)
        for words, each in (
            ("extrapolated: every position from nothing, as in the first table", position),
            ("extrapolated: every position from its neighbour's answer, in a single iteration", iteration),
        ):
            total = solves * each
            lines.append(f"| {peer.NAME} | {words} ({each:.2f} s × {solves}) | {time_of(total)} | {round(total / whole['processor_seconds'], -2):.0f} |")
    return "\n".join(lines)


def between_markers(results):
    readme = HERE / "README.md"
    text = readme.read_text()
    for name, table in (("positions", positions_table(results)), ("history", history_table(results))):
        start, end = f"<!-- {name}: written by peers.py -->", f"<!-- end of {name} -->"
        head, rest = text.split(start)
        text = f"{head}{start}\n{table}\n{end}{rest.split(end)[1]}"
    readme.write_text(text)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    os.environ["OMP_NUM_THREADS"] = "1"
    results = compare(program, folder)
    (HERE / "results.json").write_text(json.dumps(results, indent=1) + "\n")
    between_markers(results)


if __name__ == "__main__":
    main()
