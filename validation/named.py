#!/usr/bin/env python3
"""What `gearwear diagnose` says of each effect of the catalogue in measurements of the model itself, by finite elements.

    cargo build --release
    python3 validation/named.py target/release/gearwear WORKFOLDER [--fidelity middle|full] [EFFECT ...]

The studies and true values are those of recovery.py, the noise is 5 %. Unlike validation/blind, model and data share the contact and the
formulas here: this asks whether every effect can be reached at all, also those and the transmission errors that the blind generator does not
make. `nothing` is a case too, and some are diagnosed once more without the transmission errors. Each answer is kept in
WORKFOLDER/named.jsonl and not asked for again. Then validation/NAMED.md is written anew. Only the standard library is needed.
"""
import json
import sys
import time
from pathlib import Path

from recovery import EFFECTS, START_K, STUDY, TRUE_K, program

PAGE = Path(__file__).resolve().parent / "NAMED.md"
NOISE, SEED = 0.05, 77
# Without transmission errors besides: what acts on the contact and no blind data hold.
WEAR_ONLY = ["lead_misalignment", "pitch_error", "friction_load", "energy_wear"]
NOTHING = "nothing_missing"
CASES = [(e, True) for e in [NOTHING, *EFFECTS]] + [(e, False) for e in WEAR_ONLY]


def made(binary, work, effect):
    """Measurements with the effect, and a study without it beside them."""
    truth, extra = EFFECTS.get(effect, ({}, ""))
    folder = work / effect
    if (folder / "made" / "start.toml").exists():
        return folder / "made"
    folder.mkdir(parents=True, exist_ok=True)
    text = STUDY.format(effect=effect, k=TRUE_K, contact="fem", extra=extra)
    if truth:
        text += f'[[effect]]\nkind = "{effect}"\n' + "".join(f"{n} = {v!r}\n" for n, v in truth.items())
    (folder / "true.toml").write_text(text)
    program(binary, "synthesize", folder / "true.toml", "-o", folder / "made", "--noise", NOISE, "--seed", SEED)
    start = STUDY.format(effect=effect, k=START_K, contact="fem", extra=extra)
    (folder / "made" / "start.toml").write_text(f'{start}[measurements]\nfile = "measurements.csv"\n')
    return folder / "made"


def diagnosed(binary, work, effect, everything, fidelity):
    """What is said of one case."""
    data = made(binary, work, effect)
    if not everything:
        fewer = work / effect / "wear_only"
        fewer.mkdir(exist_ok=True)
        lines = (data / "measurements.csv").read_text().splitlines(keepends=True)
        (fewer / "measurements.csv").write_text("".join(l for l in lines if "transmission_error" not in l))
        (fewer / "start.toml").write_text((data / "start.toml").read_text())
        data = fewer
    began = time.time()
    said = program(binary, "diagnose", data / "start.toml", "--fidelity", fidelity, "-o", data / f"diagnosis_{fidelity}")
    group = said["indistinguishable"][0] if said["indistinguishable"] else []
    return {
        "verdict": said["verdict"],
        "said": said["effect"],
        "group": group,
        "probability": said["probabilities"].get(effect, 0.0),
        "seconds": round(time.time() - began, 1),
    }


def how(answer):
    """exact, group or what was said in place of it."""
    if "failure" in answer:
        return f"**failed**: {answer['failure']}"
    own = answer["effect"]
    if answer["verdict"] == NOTHING or answer["verdict"] == "unknown":
        return "exact" if own == answer["verdict"] else f"**{answer['verdict']}**"
    if answer["said"] == own and len(answer["group"]) < 2:
        return "exact"
    named = answer["group"] or [answer["said"]]
    named = ["+".join(n) if isinstance(n, list) else str(n) for n in named]
    said = ", ".join(named)
    return f"group: {said}" if own in named else f"**{said}**"


def page(answers):
    rows = {"middle": [], "full": []}
    for fidelity, told in rows.items():
        for effect, everything in CASES:
            for a in answers:
                if (a["effect"], a["everything"], a["fidelity"]) == (effect, everything, fidelity):
                    measured = "wear and transmission error" if everything else "wear"
                    truth = ", ".join(f"{n} = {v:g}" for n, v in EFFECTS.get(effect, ({}, ""))[0].items())
                    said = how(a)
                    figures = f"{a.get('probability', 0):.3f} | {a['seconds']:.0f}"
                    told.append((said, f"| {effect} | {truth} | {measured} | {fidelity} | {said} | {figures} |"))
    lines = "\n".join(line for told in rows.values() for _, line in told)
    counts = [
        f"Of {len(CASES)} cases {len(told)} were diagnosed by `--fidelity {fidelity}`: {sum(said == 'exact' for said, _ in told)} exact, "
        f"{sum(said.startswith('group') for said, _ in told)} in a group with what these data do not tell apart."
        for fidelity, told in rows.items()
    ]
    notes = Path(__file__).resolve().parent / "named_notes.md"
    PAGE.write_text(
        f"""# What a diagnosis says of every effect in the model's own measurements

Written by `named.py`, which says how to run it. Tests, gears and true values as in `RECOVERY.md`, contact by finite elements, noise
{100 * NOISE:.0f} % of each trace's largest value and 0.02 µm, a datum of 0.3 µm per trace, k scattered by 5 % between tests, one seed. Data and model share
contact and formulas here, unlike `blind/`: the page shows that every effect can be reached, not how often it is.

| hidden | true values | measured | by | said | its probability | s |
|---|---|---|---|---|---|---|
{lines}

{chr(10).join(counts)}

{notes.read_text() if notes.exists() else ''}"""
    )


def main():
    arguments = sys.argv[1:]
    fidelity = "full"
    if "--fidelity" in arguments:
        at = arguments.index("--fidelity")
        fidelity = arguments[at + 1]
        del arguments[at : at + 2]
    if len(arguments) < 2:
        sys.exit(__doc__)
    binary, work, effects = arguments[0], Path(arguments[1]), arguments[2:]
    work.mkdir(parents=True, exist_ok=True)
    kept = work / "named.jsonl"
    for effect, everything in CASES:
        # read anew each time: two of these may run side by side on different effects
        answers = [json.loads(line) for line in kept.read_text().splitlines()] if kept.exists() else []
        known = {(a["effect"], a["everything"], a["fidelity"]) for a in answers}
        if effects and effect not in effects or (effect, everything, fidelity) in known:
            continue
        began = time.time()
        try:
            answer = diagnosed(binary, work, effect, everything, fidelity)
        except RuntimeError as error:
            answer = {"failure": str(error).splitlines()[0], "seconds": round(time.time() - began, 1)}
        answer |= {"effect": effect, "everything": everything, "fidelity": fidelity}
        with kept.open("a") as file:
            file.write(json.dumps(answer) + "\n")
        print(effect, "all" if everything else "wear only", how(answer), answer["seconds"], flush=True)
    page([json.loads(line) for line in kept.read_text().splitlines()])


if __name__ == "__main__":
    main()
