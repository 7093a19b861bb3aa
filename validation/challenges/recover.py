#!/usr/bin/env python3
"""What `gearwear add` makes of the six challenges: the base model, the true effect and two wrong ones, all by finite elements.

    cargo build --release
    python3 validation/challenges/recover.py target/release/gearwear WORKFOLDER [NAME[:EFFECT] ...]

Each fit is one run of the program on the study with its sealed test joined as a held-out one. Its answer is kept as
WORKFOLDER/NAME/EFFECT.json and not asked for again, so an interrupted run goes on. Names choose some of the challenges or fits.
Then validation/CHALLENGES.md is written anew from all answers in WORKFOLDER. Only the standard library is needed.
"""
import json
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent / "CHALLENGES.md"

# Effect, true values by the parameters' names here, two wrong effects. `lambda0` and the like are the same formula as the truth's.
CASES = {
    "none_L2": (None, {}, ["running_in", "pressure_exponent"]),
    "running_in_L1": ("running_in", {"amplitude": "A", "decay_cycles": "n0"}, ["approach_recess", "member_hardness"]),
    "micropitting_L1": ("micropitting", {"rate": "c", "exponent": "q"}, ["approach_recess", "member_hardness"]),
    "film_thickness_L2": ("film_thickness", {"lambda0": "lambda0", "exponent": "q"}, ["approach_recess", "member_hardness"]),
    "pressure_exponent_L2": ("pressure_exponent", {"exponent": "m"}, ["member_hardness", "sliding_speed_exponent"]),
    "tip_relief_L2": ("tip_relief", {"amount": "amount", "length": "length"}, ["approach_recess", "member_hardness"]),
}
# Most a fit test's χ² per point may be; of the sealed test; the sealed test's over the base model's; sigmas off the truth;
# what no effect may gain where nothing is missing, and what a wrong one may gain elsewhere.
FIT, SEALED, SHARE, SIGMAS, NOTHING, WRONG = 1.15, 0.2, 0.25, 3.0, 0.02, 0.02


def joined(name, folder):
    """The study with its sealed test as a held-out one, and both measurement files in one."""
    source = HERE / name
    folder.mkdir(parents=True, exist_ok=True)
    study = (source / "study.toml").read_text()
    before, after = study.split("[measurements]")
    sealed = (source / "sealed.toml").read_text()
    (folder / "study.toml").write_text(f"{before}{sealed}\n[measurements]{after}")
    rows = (source / "sealed.csv").read_text().splitlines()
    rows = [row for row in rows if not row.startswith("#")][1:]
    measured = (source / "measurements.csv").read_text().rstrip("\n")
    (folder / "measurements.csv").write_text("\n".join([measured, *rows]) + "\n")
    return folder / "study.toml"


def asked(program, name, effect, work):
    """The program's answer for one fit; from the work folder if it is there."""
    folder = work / name
    kept = folder / f"{effect or 'base'}.json"
    if kept.exists():
        return json.loads(kept.read_text())
    study = joined(name, folder)
    if effect is None:
        command = [program, "compare", study, "-o", folder / "base.out"]
    else:
        command = [program, "add", study, effect, "-o", folder / f"{effect}.toml", "--force"]
    began = time.time()
    done = subprocess.run([*map(str, command), "--json", "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{name} {effect}: {done.stderr}")
    answer = json.loads(done.stdout)
    answer = answer if effect is None else answer["fit"]
    wanted = ["fit", "holdout", "parameters", "converged", "warnings"]
    answer = {key: answer.get(key) for key in wanted} | {"seconds": round(time.time() - began)}
    kept.write_text(json.dumps(answer, indent=1))
    print(f"{name} {effect or 'base'}: {answer['fit']['chi2_per_point']:.3f}, sealed {answer['holdout']['chi2_per_point']:.4f}", flush=True)
    return answer


def known(name, effect, work):
    kept = work / name / f"{effect or 'base'}.json"
    return json.loads(kept.read_text()) if kept.exists() else None


def verdict(passed):
    return "yes" if passed else "**no**"


def rows_of(name, work):
    """Table rows of one challenge, and its parameters beside the truth."""
    true, names, wrong = CASES[name]
    truth = json.loads((HERE / name / "truth.json").read_text())
    base = known(name, None, work)
    table, parameters = [], []
    for effect in [None, *([true] if true else []), *wrong]:
        answer = known(name, effect, work)
        kind = "base" if effect is None else "true" if effect == true else "wrong"
        if answer is None:
            table.append(f"| `{name}` | {kind} | {effect or '–'} | not run | | | |")
            continue
        fit, sealed = (answer[key]["chi2_per_point"] for key in ("fit", "holdout"))
        if kind == "base":
            asked_for = "–"
        elif base is None:
            asked_for = "base not run"
        elif kind == "true":
            before = base["holdout"]["chi2_per_point"]
            asked_for = verdict(fit <= FIT and sealed <= SEALED and sealed <= SHARE * before)
        else:
            gain = base["holdout"]["chi2_per_point"] - sealed
            asked_for = verdict(gain <= (NOTHING if true is None else WRONG))
        converged = verdict(answer["converged"])
        table.append(f"| `{name}` | {kind} | {effect or '–'} | {fit:.3f} | {sealed:.4f} | {converged} | {asked_for} |")
        if kind == "true":
            of_truth = truth["effects"][0]["parameters"]
            for p in answer["parameters"]:
                short = p["name"].split(".", 1)[1]
                value = truth["k_true"] if p["name"] == "wear.coefficient" else of_truth[names[short]]
                off = (p["value"] - value) / p["sigma"]
                parameters.append(
                    f"| `{name}` | `{p['name']}` | {value:.4g} | {p['value']:.4g} ± {p['sigma']:.2g} "
                    f"| {100 * (p['value'] / value - 1):+.1f} % | {off:+.1f} | {verdict(abs(off) <= SIGMAS)} |"
                )
    return table, parameters


def page(work):
    table, parameters = [], []
    for name in CASES:
        of_name = rows_of(name, work)
        table += of_name[0]
        parameters += of_name[1]
    notes = HERE / "recover_notes.md"
    PAGE.write_text(
        f"""# The six challenges, added

Written by `challenges/recover.py`; `challenges/README.md` says what the data are. Each study gets its sealed test as a held-out one: it
is noise-free, so χ² per point there is the model's own error in units of the noise. `gearwear add` fits each effect's parameters, k and
its scatter by finite elements.

Asked of the true effect: χ² per point ≤ {FIT} on the fit tests, ≤ {SEALED} and ≤ a quarter of the base model's on the sealed one.
Asked of a wrong one: the sealed χ² per point falls by no more than {WRONG}. Parameters: within {SIGMAS:.0f} of their own standard deviations.

| challenge | | effect | χ² fit | χ² sealed | converged | as asked |
|---|---|---|---|---|---|---|
{chr(10).join(table)}

| challenge | parameter | true | fitted | off | in sigmas | as asked |
|---|---|---|---|---|---|---|
{chr(10).join(parameters)}

{notes.read_text() if notes.exists() else ''}"""
    )


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program, work, only = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    for name, (true, _, wrong) in CASES.items():
        for effect in [None, *([true] if true else []), *wrong]:
            if not only or name in only or f"{name}:{effect or 'base'}" in only:
                asked(program, name, effect, work)
    page(work)


if __name__ == "__main__":
    main()
