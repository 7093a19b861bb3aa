#!/usr/bin/env python3
"""Whether the intervals that `gearwear add` states are right: simulation-based calibration (Talts et al. 2018) of every effect's fit.

    cargo build --release
    python3 validation/calibration.py target/release/gearwear WORKFOLDER [--draws N] [--contact hertz|fem] [--part I/N] [EFFECT ...]
    python3 validation/calibration.py target/release/gearwear WORKFOLDER --draw NUMBER EFFECT ...
    python3 validation/calibration.py --page WORKFOLDER
    python3 validation/calibration.py --self-check

A draw takes an effect's fitted parameters from their priors and k from a log-normal, lets `synthesize` measure the study of recovery.py with them and
`add` fit the effect to that from the catalogue's defaults; once more it is fitted with the true values given, which tells whether the fit ended at
the best place. Each answer is kept in WORKFOLDER/answers_I.jsonl and not asked for again; draws come one after another over all effects, so that
every effect has had as many. With --part I/N every Nth draw is made, so that N of these share the work. --draw makes one draw again, in a folder of
its own, to look into it. --page writes validation/CALIBRATION.md and calibration.svg of all answers. Only the standard library is needed.
"""
import json
import math
import random
import subprocess
import sys
import time
from pathlib import Path

import calibration_page
from calibration_page import K, Normal
from recovery import EFFECTS, NOISE, START_K, STUDY, TRUE_K, program

# One standard deviation of k as a factor: the prior of fits, a factor of 18, would leave most flanks new or without teeth.
K_FACTOR = 1.5


def catalogue(binary):
    """Fitted parameters of every effect, as the program lists them."""
    listed = json.loads(subprocess.run([binary, "effects", "--json"], capture_output=True, text=True, check=True).stdout)
    return {card["name"]: [p for p in card["parameters"] if p["fitted"]] for card in listed}


def drawn(parameter, source):
    """A value from a parameter's prior between its bounds, as fits have it."""
    kind, *numbers = parameter["prior"].replace(" to ", ", ").split(", ")
    first, *second = [float(words.split()[-1]) for words in numbers]
    while True:
        z = source.gauss(0.0, 1.0)
        value = {
            "log-normal": lambda: first * math.exp(z * math.log(second[0])),
            "normal": lambda: first + z * second[0],
            "half-normal": lambda: abs(z) * first,
            "uniform": lambda: source.uniform(first, second[0]),
        }[kind]()
        if float(parameter["lower"]) <= value <= float(parameter["upper"]):
            return value


def draw(effect, parameters, number):
    """What is true in a draw, and the seed of its noise: the same whenever it is asked for."""
    source = random.Random(f"{effect} {number}")
    k = TRUE_K * math.exp(source.gauss(0.0, 1.0) * math.log(K_FACTOR))
    truth = {K: k} | {f"{effect}.{p['name']}": drawn(p, source) for p in parameters}
    return truth, source.getrandbits(32)


def fitted(binary, folder, effect, truth, seed, contact):
    """What one synthesis and one fit come to."""
    folder.mkdir(parents=True, exist_ok=True)
    extra = EFFECTS.get(effect, ({}, ""))[1]
    table = "".join(f"{name.split('.')[1]} = {value!r}\n" for name, value in truth.items() if name != K)
    true = STUDY.format(effect=effect, k=truth[K], contact=contact, extra=extra)
    (folder / "true.toml").write_text(f'{true}[[effect]]\nkind = "{effect}"\n{table}')
    made = folder / "made"
    try:
        program(binary, "synthesize", folder / "true.toml", "-o", made, "--noise", NOISE, "--seed", seed)
    except RuntimeError as error:
        return {"not_simulated": str(error).splitlines()[0]}
    start = STUDY.format(effect=effect, k=START_K, contact=contact, extra=extra)
    (made / "start.toml").write_text(f'{start}[measurements]\nfile = "measurements.csv"\n')

    def add(*settings):
        return program(binary, "add", made / "start.toml", effect, "--form", "own", "-o", made / "fitted.toml", "--force", *settings)["fit"]

    try:
        fit = add()
        at_truth = add(*(word for name, value in truth.items() if name != K for word in ("--set", f"{name.split('.')[1]}={value!r}")))
    except RuntimeError as error:
        return {"failure": str(error).splitlines()[0]}
    return {
        "parameters": fit["parameters"],
        "converged": fit["converged"],
        "chi2": fit["fit"]["chi2_per_point"],
        "truth_chi2": at_truth["fit"]["chi2_per_point"],
        "without_chi2": fit["without_chi2_per_point"],
        "points": fit["fit"]["points"],
        "given_up": fit["given_up_explaining"],
    }


def read(work):
    """All answers so far."""
    return [json.loads(line) for file in sorted(work.glob("answers*.jsonl")) for line in file.read_text().splitlines()]


def once_more(binary, work, effects, contact, number):
    """One draw of some effects, with its files kept."""
    cards = catalogue(binary)
    for effect in effects:
        truth, seed = draw(effect, cards[effect], number)
        folder = work / f"{contact}_draw_{number}" / effect
        print(json.dumps({"folder": str(folder), "truth": truth} | fitted(binary, folder, effect, truth, seed, contact), indent=2))


def study(binary, work, effects, contact, draws, part, parts):
    cards = catalogue(binary)
    work.mkdir(parents=True, exist_ok=True)
    (work / "catalogue.json").write_text(json.dumps(cards))
    known = {(a["contact"], a["effect"], a["draw"]) for a in read(work)}
    kept = work / f"answers_{part}.jsonl"
    for number in range(part, draws + 1, parts):
        for effect in effects or cards:
            if (contact, effect, number) in known:
                continue
            began = time.time()
            truth, seed = draw(effect, cards[effect], number)
            folder = work / f"{contact}_{part}" / effect
            answer = {"contact": contact, "effect": effect, "draw": number, "truth": truth}
            answer |= fitted(binary, folder, effect, truth, seed, contact)
            answer["seconds"] = round(time.time() - began, 2)
            with kept.open("a") as file:
                file.write(json.dumps(answer) + "\n")
            print(effect, number, answer.get("chi2", answer.get("not_simulated", answer.get("failure"))), answer["seconds"], flush=True)


def self_check():
    """That ranks in right posteriors are found uniform, cut ones by a bound too, and ranks in too narrow, too wide or shifted ones not."""
    source = random.Random(1)

    def p(prior_sd, sd, width=1.0, shift=0.0, low=-math.inf):
        """Of 400 draws: truth from a normal above `low`, measured with error `sd`, posterior in closed form."""
        shares = []
        for _ in range(400):
            truth = source.gauss(0.0, prior_sd)
            while truth < low:
                truth = source.gauss(0.0, prior_sd)
            precision = prior_sd**-2 + sd**-2
            centre = source.gauss(truth, sd) * sd**-2 / precision
            exact = Normal(centre + shift * sd, width * precision**-0.5, low, math.inf)
            # as a fit states it
            ends = [exact.quantile(0.025), exact.quantile(0.975)]
            value = min(max(exact.centre, low), 1e9)
            shares.append(Normal.stated(value, exact.sd, [min(ends[0], value), max(ends[1], value)], low, math.inf).share(truth))
        return calibration_page.uniformity(shares)

    right, cut = p(1.0, 0.5), p(1.0, 0.5, low=0.0)
    narrow, wide, shifted = p(1.0, 0.5, width=0.6), p(1.0, 0.5, width=1.7), p(1.0, 0.5, shift=0.5)
    print(f"p right {right:.3g}, cut by a bound {cut:.3g}; too narrow {narrow:.1g}, too wide {wide:.1g}, shifted {shifted:.1g}")
    assert min(right, cut) > 1e-3 and max(narrow, wide, shifted) < 1e-3
    # closed forms: nine degrees of freedom exceed 16.919 in 5 %; Wilson's interval of 81 of 90
    assert abs(calibration_page.exceeded(16.919, 9) - 0.05) < 1e-5
    assert all(abs(a - b) < 1e-3 for a, b in zip(calibration_page.wilson(81, 90), (0.8212, 0.9465)))
    for prior, low, high in (("log-normal, median 3.0, factor 2.5", 0.0, 50.0), ("normal, mean -1.0, sd 0.5", -2.0, 2.0),
                             ("half-normal, sd 0.03", 0.0, 1.0), ("uniform, -3.0 to -1.0", -5.0, 5.0)):  # fmt: skip
        values = [drawn({"prior": prior, "lower": low, "upper": high}, source) for _ in range(2000)]
        middle = {"log-normal": 3.0, "normal": -1.0, "half-normal": 0.0202, "uniform": -2.0}[prior.split(",")[0]]
        assert abs(sum(v < middle for v in values) - 1000) < 100, prior
    print("self-check passed")


def main():
    arguments = sys.argv[1:]
    options = {"--draws": "200", "--contact": "hertz", "--part": "1/1", "--draw": ""}
    for option in options:
        if option in arguments:
            at = arguments.index(option)
            options[option] = arguments[at + 1]
            del arguments[at : at + 2]
    if arguments == ["--self-check"]:
        self_check()
    elif len(arguments) == 2 and arguments[0] == "--page":
        work = Path(arguments[1])
        calibration_page.write(read(work), json.loads((work / "catalogue.json").read_text()))
    elif len(arguments) >= 3 and options["--draw"]:
        once_more(arguments[0], Path(arguments[1]), arguments[2:], options["--contact"], int(options["--draw"]))
    elif len(arguments) >= 2:
        part, parts = map(int, options["--part"].split("/"))
        study(arguments[0], Path(arguments[1]), arguments[2:], options["--contact"], int(options["--draws"]), part, parts)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
