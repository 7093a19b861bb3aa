#!/usr/bin/env python3
"""What the decision rule of `gearwear diagnose` would say with other thresholds, on the same fits.

    python3 validation/blind/thresholds.py DATA RESULTS [--from N] [--to N]

DATA holds the sets of `blind make`, RESULTS the answers of run.sh. A diagnosis keeps the evidence and the fall of chi^2 of all that it
fitted, so its rule (src/learn/diagnose/rank.rs and verdict.rs) can be repeated here with every threshold varied in turn. The
rule as it is must give the verdicts of its own program in RESULTS again: the page says how many it does. --from and --to take the sets with these numbers
only, so that thresholds chosen on some can be looked at on others. Writes validation/blind/THRESHOLDS.md; standard library only.
"""
import json
import math
import sys
from collections import Counter
from pathlib import Path

PAGE = Path(__file__).resolve().parent / "THRESHOLDS.md"

# As in rank.rs and, the last three, verdict.rs.
RULE = {
    "SHARE": 0.85,  # least share of the attainable fall of chi^2 for one effect
    "PAIR_SHARE": 0.95,  # the same for two
    "SECOND": 0.10,  # least part of a pair's weaker effect, over the stronger one alone
    "TEMPER": 1.8,  # divides differences of log evidence between effects
    "PRIOR_NOTHING": 0.5,
    "PRIOR_PAIRS": 0.05,
    "UNKNOWN_LACKS": 1.2,  # added to the log evidence of the unknown
    "UNTOLD": 0.5,  # odds of another cause where the data say nothing of what an effect is known by
    "CLAIM": 0.85,  # least probability of a name
    "DOUBT": 0.2,  # probability of nothing missing from which no name is said
    "ALIKE": 0.03,  # share of the leader's probability from which others are named with it
}
TRIED = {
    "SHARE": [0.5, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9],
    "PAIR_SHARE": [0.7, 0.8, 0.85, 0.9, 0.95, 1.0],
    "SECOND": [0.0, 0.05, 0.1, 0.15, 0.2, 0.3],
    "TEMPER": [1.0, 1.4, 1.8, 2.5, 4.0],
    "PRIOR_NOTHING": [0.05, 0.2, 0.5, 0.8],
    "PRIOR_PAIRS": [0.01, 0.05, 0.2],
    "UNKNOWN_LACKS": [0.0, 0.6, 1.2, 1.8],
    "UNTOLD": [0.0, 0.25, 0.5, 1.0, 2.0],
    "CLAIM": [0.5, 0.7, 0.8, 0.85, 0.9, 0.95],
    "DOUBT": [0.05, 0.1, 0.2, 0.4],
    "ALIKE": [0.001, 0.01, 0.03, 0.1],
}
SHARE_WIDTH, PAIR_SHARE_WIDTH, SECOND_WIDTH = 0.03, 0.025, 0.012
PAIR_SPREADS = 1.5
PRIOR_UNKNOWN, PRIOR_SINGLES = 0.1, 0.35
NOTHING, UNKNOWN = "nothing_missing", "unknown"


# As in untold.rs: a resonance is unknown if its standard deviation is larger than this, over its value (ln 4 is its prior's); that it is so too where all
# tests have one speed is left out here.
KEPT = 0.4 * math.log(4)


def untold(found):
    """Effects whose best form the data say nothing about of what they are known by."""
    of = lambda r: [p for p in r["parameters"] if p["name"] == "resonance_speed"]
    return {r["effect"] for r in found["ranking"] if any(p["sigma"] > KEPT * p["value"] for p in of(r))}


def soft(x):
    """ln(1 + e^x)"""
    return max(x, 0.0) + math.log1p(math.exp(-abs(x)))


def probabilities(found, rule):
    """Posterior probabilities of nothing, unknown, effects and pairs."""
    fitted, unsaid = found["screened"], untold(found)
    forms = Counter(s["effect"] for s in fitted if "+" not in s["effect"])
    alone = {}
    for s in fitted:
        if "+" not in s["effect"]:
            alone[s["effect"]] = max(alone.get(s["effect"], -math.inf), s["chi2_drop"])
    attainable, spread = max(found["attainable_drop"], 2 * found["unknown_evidence_gain"]), found["attainable_spread"]
    real = attainable > 5 * spread
    pairs = max(1.0, 0.5 * len(forms) * (len(forms) - 1))
    logs = [(NOTHING, math.log(rule["PRIOR_NOTHING"]))]
    cap, most = math.inf, -math.inf

    def posterior(s):
        names = s["effect"].split("+")
        prior = PRIOR_SINGLES / len(forms) if len(names) == 1 else rule["PRIOR_PAIRS"] / pairs
        return s["evidence_gain"] + math.log(prior / math.prod(forms[n] for n in names))

    best = max(map(posterior, fitted))
    for s in fitted:
        names = s["effect"].split("+")
        log = best - (best - posterior(s)) / rule["TEMPER"]
        share = s["chi2_drop"] / attainable if real else 1.0
        doubt = spread / max(attainable, 1.0)
        if len(names) == 1:
            odds = (rule["SHARE"] - share - doubt) / SHARE_WIDTH
        else:
            odds = (rule["PAIR_SHARE"] - share - PAIR_SPREADS * doubt) / PAIR_SHARE_WIDTH
        stronger = max(names, key=lambda n: alone[n])
        if len(names) == 2 and alone[stronger] > 0:
            second = (s["chi2_drop"] - alone[stronger]) / alone[stronger]
            mends = (rule["SECOND"] - second) / SECOND_WIDTH
            logs.append((s["effect"], log - soft(odds) - soft(mends)))
            logs.append((stronger, log - soft(odds) - soft(-mends)))
        else:
            logs.append((s["effect"], log - soft(odds)))
        logs.append((UNKNOWN, log - soft(-odds)))
        if s["effect"] in unsaid and rule["UNTOLD"] > 0:
            logs.append((UNKNOWN, log - soft(odds) + math.log(rule["UNTOLD"])))
        if real and log > most:
            most, cap = log, log + max(odds, found["unknown_evidence_gain"] - s["evidence_gain"])
    logs.append((UNKNOWN, min(found["unknown_evidence_gain"] + rule["UNKNOWN_LACKS"] + math.log(PRIOR_UNKNOWN), cap)))
    top = max(log for _, log in logs)
    total = Counter()
    for name, log in logs:
        total[name] += math.exp(max(log - top, -700))
    whole = sum(total.values())
    return {name: p / whole for name, p in total.items()}


def verdict(probability, rule):
    """Verdict, leading effect, group of those named with it."""
    effects = sorted(((p, n) for n, p in probability.items() if n not in (NOTHING, UNKNOWN)), reverse=True)
    nothing, unknown, named = probability[NOTHING], probability[UNKNOWN], sum(p for p, _ in effects)
    leading, leader = effects[0]
    group = [n for p, n in effects if p > rule["ALIKE"] * leading]
    if nothing >= unknown and nothing >= named or nothing >= rule["DOUBT"] and unknown < named and nothing > leading:
        return NOTHING, leader, group
    if unknown >= named and unknown >= nothing:
        return UNKNOWN, leader, group
    if nothing < rule["DOUBT"] and leading >= rule["CLAIM"]:
        return "effects" if "+" in leader else "effect", leader, group
    group += [name for name, p in ((NOTHING, nothing), (UNKNOWN, unknown)) if p >= rule["DOUBT"]]
    if len(group) < 2:
        group.append(NOTHING if nothing > unknown else UNKNOWN)
    return "ambiguous", leader, group


def outcome(truth, said):
    """right, wrong or other, as `blind score` counts."""
    what, leader, group = said
    kinds, names = sorted(truth["kinds"]), sorted(leader.split("+"))
    wanted = {"none": NOTHING, "outside": UNKNOWN}.get(truth["class"])
    in_group = wanted in group if wanted else kinds in [sorted(n.split("+")) for n in group]
    if what == "ambiguous":
        return "right" if in_group else "other"
    if what in (NOTHING, UNKNOWN):
        return "right" if what == wanted else "wrong" if truth["class"] == "none" else "other"
    return "right" if wanted is None and (names == kinds or in_group) else "wrong"


def row(sets, rule):
    """Right and wrong, in percent, of every class at d >= 6."""
    counts = {c: Counter() for c in ("none", "single", "foreign", "outside", "pair")}
    weak = Counter()
    for truth, found in sets:
        met = outcome(truth, verdict(probabilities(found, rule), rule))
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
    sets, agree = [], 0
    for folder in sorted(data.iterdir()):
        answer = results / folder.name / "diagnosis.json"
        if not answer.exists() or not limits["--from"] <= int(folder.name.split("_")[1]) < limits["--to"]:
            continue
        truth, found = json.loads((folder / "truth.json").read_text()), json.loads(answer.read_text())
        sets.append((truth, found))
        agree += verdict(probabilities(found, RULE), RULE)[0] == found["verdict"]
    classes = Counter(truth["class"] for truth, _ in sets)
    lines = [
        "# Thresholds of the decision",
        "",
        "Written by `thresholds.py`, which says how. Right (name, or group with it) / wrong, in % of the sets with d >= 6 (all where",
        "nothing is hidden; last column: 3 <= d < 6). One threshold is varied at a time; the program's own value is in bold.",
        "",
        f"{len(sets)} sets ({', '.join(f'{n} {c}' for c, n in sorted(classes.items()))}), numbers from {limits['--from']}"
        + (f" to {limits['--to'] - 1}." if limits["--to"] < 10**9 else ".")
        + f" The rule repeated here gives the verdict of the program that judged them on {agree} of {len(sets)}; a later rule may say otherwise.",
        "",
        "| threshold | value | none | single | foreign | outside | pair | weak |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for name, values in TRIED.items():
        for value in values:
            shown = f"**{value}**" if value == RULE[name] else f"{value}"
            lines.append(f"| {name} | {shown} | {row(sets, RULE | {name: value})} |")
    PAGE.write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
