#!/usr/bin/env python3
"""What the blind sets show, row by row of what is asked of a diagnosis.

    python3 validation/blind/bar.py validation/blind/records_401.jsonl validation/blind/records_501.jsonl --last validation/blind/records_last.jsonl

Records are what `blind score --keep` keeps of each set as first judged; after --last those that the last program judged first, which count
with the others and once more alone. Writes validation/blind/BAR.md, with bar_notes.md after the table; standard library only.
"""
import json
import math
import sys
from pathlib import Path

from thresholds import NOTHING, UNKNOWN, outcome

HERE = Path(__file__).resolve().parent


class Set:
    """One set as judged."""

    def __init__(self, record, last):
        self.last = last
        truth, found = record["truth"], record["found"]
        self.kind, self.noise = truth["class"], truth["noise"]
        each = truth["d_each"] if self.kind == "pair" else [truth["d"]]
        self.d = min(each, default=0.0)
        self.verdict = found["verdict"]
        said = found["effect"] or []
        said = [said] if isinstance(said, str) else said
        group = [name for names in found["indistinguishable"] for name in names]
        sets = [name if name in (NOTHING, UNKNOWN) else name.split("+") for name in group]
        self.outcome = outcome(truth, {"verdict": self.verdict, "effects": said, "group": sets})
        self.exact = bool(said) and sorted(said) == sorted(truth["kinds"])
        self.sure = max(found["probabilities"].values())
        drivers = [d for e in truth["effects"] for d in (e["drivers"] or [])]
        self.driver = (found["driver"] or {}).get("name") in drivers
        wanted = {"none": NOTHING, "outside": UNKNOWN}.get(self.kind, "+".join(sorted(truth["kinds"])))
        top = max(found["probabilities"], key=found["probabilities"].get)
        self.top_is_right = "+".join(sorted(top.split("+"))) == wanted

    def named(self):
        return self.verdict in ("effect", "effects")


def interval(hits, count):
    """Wilson's, 95 %."""
    z, p = 1.96, hits / count
    middle = (p + z * z / (2 * count)) / (1 + z * z / count)
    half = z * math.sqrt(p * (1 - p) / count + z * z / (4 * count * count)) / (1 + z * z / count)
    return f"{100 * max(0.0, middle - half):.0f}–{100 * min(1.0, middle + half):.0f} %"


def shown(asked, sets, hit):
    """Hits of the sets with their share and interval; whether that is what is asked."""
    hits, count = sum(map(hit, sets)), len(sets)
    if not count:
        return "–", ""
    sign, limit = asked.split()[:2]
    share = 100 * hits / count
    met = share >= float(limit) if sign == "≥" else share <= float(limit)
    return f"{hits} of {count}, {share:.0f} % ({interval(hits, count)})", "yes" if met else "**no**"


def row(what, asked, sets, hit):
    """The row of all sets, and of those of the last program alone."""
    cells = [cell for own in (sets, [s for s in sets if s.last]) for cell in shown(asked, own, hit)]
    return f"| {what} | {asked} | {' | '.join(cells)} |"


def calibration(sets):
    """Expected error of the largest probability in ten bins."""
    bins = {}
    for s in sets:
        bins.setdefault(min(9, int(10 * s.sure)), []).append(s)
    return sum(abs(sum(s.sure - s.top_is_right for s in own)) for own in bins.values()) / len(sets)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    names = sys.argv[1:]
    last = names[names.index("--last") + 1 :] if "--last" in names else []
    sets = [
        Set(json.loads(line), name in last)
        for name in names
        if name != "--last"
        for line in Path(name).read_text().splitlines()
    ]

    def of(kinds, low=6.0, high=math.inf, noise=None):
        return [s for s in sets if s.kind in kinds and low <= s.d < high and noise in (None, s.noise)]

    def right(s):
        return s.outcome == "right"

    def wrong(s):
        return s.outcome == "wrong"

    one = ("single", "foreign")
    rows = [row(f"one effect, d ≥ 6, noise {100 * noise:.0f} %: named, or in its group", f"≥ {asked} %", of(one, noise=noise), right)
            for noise, asked in ((0.02, 99), (0.05, 97), (0.1, 93))]
    rows += [
        row("the same: exact name, the catalogue's own form", "≥ 90 %", of(("single",)), lambda s: s.exact),
        row("the same: exact name, another form", "≥ 85 %", of(("foreign",)), lambda s: s.exact),
        row("the same: wrong name", "≤ 1 %", of(one), wrong),
        row("weak, 3 ≤ d < 6: named or in its group", "≥ 50 %", of(one, 3.0, 6.0), right),
        row("the same: wrong name", "≤ 3 %", of(one, 3.0, 6.0), wrong),
        row("nothing hidden: `nothing_missing`", "≥ 98 %", of(("none",), 0.0), lambda s: s.verdict == NOTHING),
        row("the same: a name with more than 0.95", "≤ 0 %", of(("none",), 0.0), lambda s: s.named() and s.sure > 0.95),
        row("a cause outside the catalogue, d ≥ 6: `unknown`", "≥ 95 %", of(("outside",)), lambda s: s.verdict == UNKNOWN),
        row("the same: its driver named", "≥ 85 %", of(("outside",)), lambda s: s.driver),
        row("the same: a wrong name with more than 0.9", "≤ 2 %", of(("outside",)), lambda s: s.named() and s.sure > 0.9),
        row("two effects, each d ≥ 6, noise 2 %: both named, or in their group", "≥ 85 %", of(("pair",), noise=0.02), right),
        row("the same, noise 5 %", "≥ 70 %", of(("pair",), noise=0.05), right),
    ]
    cells = []
    for own in (sets, [s for s in sets if s.last]):
        error = calibration(own) if own else math.nan
        cells += [f"{error:.3f}", "yes" if error <= 0.05 else "**no**"] if own else ["–", ""]
    rows.append(f"| expected calibration error of the largest probability | ≤ 0.05 | {' | '.join(cells)} |")
    notes = (HERE / "bar_notes.md").read_text()
    table = "\n".join(rows)
    (HERE / "BAR.md").write_text(
        f"""# Row by row of what is asked

Written by `bar.py` from the records of {len(sets)} sets as first judged, whatever was mended afterwards, and of the {sum(s.last for s in sets)} among them that the
last program judged first; with 95 % intervals.

| | asked | all | met | last program | met |
|---|---|---|---|---|---|
{table}

{notes}"""
    )


if __name__ == "__main__":
    main()
