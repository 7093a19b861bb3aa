"""The page and the picture of calibration.py: ranks of true values in stated posteriors, and how often intervals hold them."""
import math
from collections import Counter
from pathlib import Path
from statistics import NormalDist

HERE = Path(__file__).resolve().parent
LEVELS = (0.5, 0.9, 0.95)
BINS = 10
# What is asked of the 90 % intervals, and the chance below which ranks are not uniform; fits from which on each is judged.
ASKED, CHANCE = (0.87, 0.93), 1e-3
ENOUGH, ENOUGH_TO_BIN = 20, 5 * BINS
# Fall of χ² up to which `add` says that an effect betters nothing, and χ² per point from which a fit is far off: it states no interval then.
UNSEEN, TOO_LARGE = 11.3, 2.0
# Distance from the truth that no fit at its end has, standard deviations.
FAR = 5.0
K = "wear.coefficient"


class Normal:
    """A normal cut by two ends."""

    def __init__(self, centre, sd, low=-math.inf, high=math.inf):
        self.centre, self.sd, self.low, self.high = centre, sd, low, high

    @classmethod
    def stated(cls, value, sd, interval, low, high):
        """That of which a 95 % interval is stated, all on the scale on which it is normal.

        An interval is stretched to hold its value where that lies on an end: the other end tells the centre then."""
        stretched = interval[1] <= value
        known, share = (interval[0], 0.025) if stretched else (interval[1], 0.975)
        below, above = known - 40.0 * sd, known + 40.0 * sd
        for _ in range(100):
            centre = 0.5 * (below + above)
            if cls(centre, sd, low, high).share(known) > share:
                below = centre
            else:
                above = centre
        return cls(centre, sd, low, high)

    def share(self, x):
        """The share below x."""
        a, b, x = ((end - self.centre) / self.sd for end in (self.low, self.high, min(max(x, self.low), self.high)))
        # by the tails that do not cancel
        sign = -1.0 if a > 0.0 else 1.0
        tail = lambda z: 0.5 * math.erfc(-sign * z / math.sqrt(2.0))  # noqa: E731
        mass = tail(b) - tail(a)
        return (tail(x) - tail(a)) / mass if mass else 0.5

    def quantile(self, p):
        below, above = max(self.low, self.centre - 40 * self.sd), min(self.high, self.centre + 40 * self.sd)
        for _ in range(100):
            middle = 0.5 * (below + above)
            below, above = (middle, above) if self.share(middle) < p else (below, middle)
        return middle


def natural(parameter, card, truth):
    """The stated posterior, the true value and the 95 % interval on the scale on which a fit's posterior is normal: ln where the prior is log-normal."""
    value, sd, interval = parameter["value"], parameter["sigma"], parameter["interval_95"]
    low, high = float(card["lower"]), float(card["upper"])
    if card["unit"] == "rad" and abs(high - low - 2.0 * math.pi) < 1e-9:
        # the other side of the turn is near
        turned = truth - 2.0 * math.pi * round((truth - value) / (2.0 * math.pi))
        return Normal(value, sd), turned, interval
    if card["prior"].startswith("uniform"):
        ends = [float(words.split()[-1]) for words in card["prior"].split(" to ")]
        low, high = max(low, ends[0]), min(high, ends[1])
    scale = float
    if card["prior"].startswith("log-normal"):
        scale, sd = (lambda x: math.log(x) if x > 0.0 else -math.inf), sd / value
    interval = [*map(scale, interval)]
    return Normal.stated(scale(value), sd, interval, scale(low), scale(high)), scale(truth), interval


def exceeded(square, freedom):
    """The chance of a larger χ², of an odd number of degrees of freedom."""
    term, total = math.sqrt(square), 0.0
    for r in range(1, (freedom - 1) // 2 + 1):
        total += term
        term *= square / (2 * r + 1)
    return math.erfc(math.sqrt(square / 2.0)) + math.sqrt(2.0 / math.pi) * math.exp(-square / 2.0) * total


def counts(shares):
    found = Counter(min(int(BINS * u), BINS - 1) for u in shares)
    return [found[i] for i in range(BINS)]


def uniformity(shares):
    """The chance of ranks as uneven as these, if they are uniform."""
    mean = len(shares) / BINS
    return exceeded(sum((n - mean) ** 2 for n in counts(shares)) / mean, BINS - 1)


def wilson(hits, count):
    """The 95 % interval of a share."""
    z, p = 1.96, hits / count
    middle = (p + z * z / (2 * count)) / (1 + z * z / count)
    half = z * math.sqrt(p * (1 - p) / count + z * z / (4 * count * count)) / (1 + z * z / count)
    return middle - half, middle + half


class Row:
    """One parameter in all the fits that state an interval of it."""

    def __init__(self, effect, card, name, answers):
        self.effect, self.name = effect, name
        self.shares, self.far, held = [], [], 0
        for answer in answers:
            parameter = next(p for p in answer["parameters"] if p["name"] == name)
            posterior, truth, interval = natural(parameter, card, answer["truth"][name])
            self.shares.append(posterior.share(truth))
            held += interval[0] <= truth <= interval[1]
            if abs(truth - posterior.centre) > FAR * posterior.sd:
                self.far.append(answer["draw"])
        n = self.count = len(answers)
        # the 95 % interval is the stated one, the others are of the same normal
        self.hits = [sum(abs(2.0 * u - 1.0) <= level for u in self.shares) for level in LEVELS[:2]] + [held]
        self.p = uniformity(self.shares) if n >= ENOUGH_TO_BIN else math.nan
        low, high = wilson(self.hits[1], n) if n else (0.0, 1.0)
        self.off = high < ASKED[0] or low > ASKED[1]
        self.judged = n >= ENOUGH
        self.flagged = self.judged and (self.off or self.p < CHANCE)

    def verdict(self):
        if not self.judged:
            return "too few"
        reasons = [f"90 % interval too {'narrow' if self.hits[1] < 0.9 * self.count else 'wide'}"] * self.off
        reasons += ["ranks not uniform"] * (self.p < CHANCE)
        return f"**no**: {', '.join(reasons)}" if reasons else "yes"

    def cells(self):
        def cell(hits):
            low, high = wilson(hits, self.count)
            return f"{100 * hits / self.count:.0f} % ({100 * low:.0f}–{100 * high:.0f})"

        if not self.count:
            return ["–"] * 5
        chance = "–" if math.isnan(self.p) else "< 1e-6" if self.p < 1e-6 else f"{self.p:.2g}"
        return [*map(cell, self.hits), chance, str(len(self.far))]


def why_none(answer):
    """Why a fit states no interval of some parameter; None where it states all."""
    if "failure" in answer:
        return "failed"
    if all(p["interval_95"] is not None for p in answer["parameters"]):
        return None
    if answer["given_up"] is not None:
        return "given up"
    if answer["without_chi2"] is not None and (answer["without_chi2"] - answer["chi2"]) * answer["points"] < UNSEEN:
        return "not seen"
    if not answer["converged"]:
        return "not converged"
    return "far off" if answer["chi2"] > TOO_LARGE else "not determined"


def elsewhere(answer):
    """Whether a fit ended at a place that is worse than the true values."""
    return "failure" not in answer and (answer["chi2"] - answer["truth_chi2"]) * answer["points"] > UNSEEN


class Effect:
    """All draws of one effect with one contact model."""

    def __init__(self, name, parameters, answers):
        self.name, self.draws = name, len(answers)
        self.unmade = [a for a in answers if "not_simulated" in a]
        made = [a for a in answers if "not_simulated" not in a]
        self.none = Counter(why for a in made if (why := why_none(a)))
        self.fits = [a for a in made if not why_none(a)]
        self.elsewhere = [a for a in made if elsewhere(a)]
        self.failures = Counter(a["failure"].removeprefix("error: ") for a in made if "failure" in a)
        self.parameters = parameters
        self.rows = self.of(self.fits)

    def of(self, fits):
        """A row for each parameter, of some fits."""
        return [Row(self.name, card, f"{self.name}.{card['name']}", fits) for card in self.parameters]

    def table(self):
        none = ", ".join(f"{n} {why}" for why, n in self.none.most_common()) or "0"
        return [
            f"| {row.effect} | {row.name.split('.')[1]} | {self.draws} | {len(self.unmade)} | {none} | {len(self.elsewhere)} | {row.count} | {' | '.join(row.cells())} | {row.verdict()} |"
            for row in self.rows
        ]

    def unmade_because(self):
        return f"{self.name} {len(self.unmade)} ({self.unmade[0]['not_simulated'].removeprefix('error: ')})"


def band(count):
    """Counts between which 99 % of a bin's lie, if ranks are uniform."""
    half = NormalDist().inv_cdf(0.995) * math.sqrt(count * (1 - 1 / BINS) / BINS)
    return max(0.0, count / BINS - half), count / BINS + half


def picture(rows):
    """Histograms of all parameters' ranks."""
    columns, width, height, gap = 6, 150, 70, 42
    lines = -(-len(rows) // columns)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {columns * (width + 14) + 14} {lines * (height + gap) + 10}" font-family="sans-serif" font-size="10">',
        '<rect width="100%" height="100%" fill="white"/>',
    ]
    for number, row in enumerate(rows):
        x, y = 14 + number % columns * (width + 14), 30 + number // columns * (height + gap)
        bins, (low, high) = counts(row.shares), band(row.count)
        scale = height / max(1.0, *bins, 1.15 * high)
        colour = "#c44e52" if row.flagged else "#4c72b0" if row.judged else "#999"
        out.append(f'<rect x="{x}" y="{y + height - scale * high:.1f}" width="{width}" height="{scale * (high - low):.1f}" fill="#e8e8e8"/>')
        for i, n in enumerate(bins):
            out.append(f'<rect x="{x + i * width / BINS + 1:.1f}" y="{y + height - scale * n:.1f}" width="{width / BINS - 2:.1f}" height="{scale * n:.1f}" fill="{colour}"/>')
        out.append(f'<line x1="{x}" x2="{x + width}" y1="{y + height}" y2="{y + height}" stroke="#444"/>')
        effect, name = row.name.split(".") if row.effect in row.name else (row.effect, row.name)
        out.append(f'<text x="{x}" y="{y - 14}">{effect}</text><text x="{x}" y="{y - 3}" fill="#555">{name}, {row.count}</text>')
    return "\n".join([*out, "</svg>", ""])


def listed(names):
    names = list(names)
    return ", ".join(names) if names else "none"


def some(numbers, most=5):
    numbers = list(numbers)
    return ", ".join(map(str, numbers[:most])) + (", …" if len(numbers) > most else "")


def answer(judged, flagged, draws):
    """What the study says, in a sentence."""
    if not judged:
        return f"No parameter has had {ENOUGH} fits after {draws} draws of each effect, so none is judged yet."
    right = f"{len(judged) - len(flagged) or 'none'} are covered by their 90 % intervals as asked, {100 * ASKED[0]:.0f} to {100 * ASKED[1]:.0f} % within the uncertainty of {draws} draws of each effect"
    wrong = f"; these are not: {listed(row.name for row in flagged)}" if flagged else ""
    return f"Of {len(judged)} parameters with {ENOUGH} fits or more {right}, with uniform ranks{wrong}."


def write(answers, cards):
    hertz, fem = ([a for a in answers if a["contact"] == contact] for contact in ("hertz", "fem"))
    effects = [Effect(name, parameters, [a for a in hertz if a["effect"] == name]) for name, parameters in cards.items()]
    rows = [row for effect in effects for row in effect.rows]
    k_card = {"prior": "log-normal, median 3.2e-10, factor 18.0", "lower": 1e-16, "upper": 1e-4, "unit": "mm2/N"}
    of_k = Row("all effects", k_card, K, [a for effect in effects for a in effect.fits])
    judged = [row for row in rows if row.judged]
    flagged = [row for row in judged if row.flagged]
    (HERE / "calibration.svg").write_text(picture([*rows, of_k]))
    draws = [effect.draws for effect in effects]
    each = f"{min(draws)}" if min(draws) == max(draws) else f"{min(draws)} to {max(draws)}"
    made = sum(draws) - sum(len(effect.unmade) for effect in effects)
    without = sum((effect.none for effect in effects), Counter())
    unmade = [effect.unmade_because() for effect in effects if effect.unmade]
    failed = [f"{effect.name} {n} ({why})" for effect in effects for why, n in effect.failures.items()]
    astray = [f"{effect.name} {len(effect.elsewhere)} (draws {some(a['draw'] for a in effect.elsewhere)})" for effect in effects if effect.elsewhere]
    few = [row.name for row in rows if not row.judged]
    # the same of the fits that ended at the best place
    there = [row for effect in effects for row in effect.of([a for a in effect.fits if not elsewhere(a)])]
    held, asked = (sum(row.hits[2] for row in there), sum(row.count for row in there)) if there else (0, 0)
    pooled = [sum(row.hits[i] for row in rows) / max(1, sum(row.count for row in rows)) for i in range(3)]
    far = [f"{row.name} {len(row.far)} (draws {some(row.far)})" for row in rows if row.far]
    table = "\n".join(line for effect in effects for line in effect.table())
    notes = HERE / "calibration_notes.md"
    (HERE / "CALIBRATION.md").write_text(
        f"""# Whether stated intervals are right

{answer(judged, flagged, each)}
Of all intervals together those of 50, 90 and 95 % hold the true value in {', '.join(f'{100 * share:.1f}' for share in pooled)} % of the fits.

Simulation-based calibration ([Talts et al. 2018](https://arxiv.org/abs/1804.06788)): true values are drawn from the priors with which they are fitted, measurements are made of
them, and the fit's posterior is asked for the share of it that lies below the true value. If posteriors are right that share, the rank, is uniform between 0 and 1, and an interval of 90 % holds 90 % of the true values.
Written by `calibration.py`:

```sh
python3 validation/calibration.py target/release/gearwear WORKFOLDER --draws {max(draws)}
python3 validation/calibration.py --page WORKFOLDER
```

Each draw takes an effect's fitted parameters from their priors (`gearwear effects EFFECT`), cut at their ranges as fits cut them, and k from a log-normal about 5e-10 mm²/N (one standard deviation is a factor of 1.5). `synthesize` measures the study
of [RECOVERY.md](RECOVERY.md) with these, noise and datums and the scatter of k as the fit assumes them; `add --form own` fits it from the catalogue's defaults. Contact is the analytic model's (`hertz`).

What is not as the method asks: k is drawn from a narrower distribution than the fit's prior (one standard deviation is a factor of 18 there), which matters only where the measurements leave k open. Ranks are those of the normal that `add`
states, cut at the parameter's range, not of draws from the posterior; that is meant, since it is what a reader of the intervals gets. True values that could not be simulated are missing from the tails of some priors;
fits without an interval are left out by what was measured, not by what is true, which leaves ranks uniform. Measurements are made with finer wear steps than those with which fits begin.

## Parameters

*Not simulated*: draws of which `synthesize` made no measurements. *No interval*: fits that state none: the effect is *not seen* in the measurements (χ² falls by less than {UNSEEN}), the fit was *given up*, ended
*far off* (χ² above {TOO_LARGE:g} per point) or did *not converge*. *Elsewhere*: fits, with or without an interval, whose χ² is larger by more than {UNSEEN} than at the true values: they ended in a worse place. *Fits*: those
with intervals, of which ranks are. 50, 90 and 95 %: intervals that hold the true value, in brackets the 95 % range of that share (Wilson's). *p*: chance of ranks as uneven as these (χ² of {BINS} bins, from {ENOUGH_TO_BIN} fits on).
*Far*: fits more than {FAR:.0f} standard deviations from the truth. A parameter is not calibrated where the range of its 90 % coverage lies wholly outside {100 * ASKED[0]:.0f} to {100 * ASKED[1]:.0f} %, or where p < {CHANCE:g}; with fewer than {ENOUGH} fits it is not judged.

| effect | parameter | draws | not simulated | no interval | elsewhere | fits | 50 % | 90 % | 95 % | p | far | calibrated |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
{table}
| all effects | {K} | {sum(draws)} | {sum(draws) - made} | {sum(without.values())} | {sum(len(effect.elsewhere) for effect in effects)} | {of_k.count} | {' | '.join(of_k.cells())} | {of_k.verdict()} |

![Histograms of the ranks of the true values in the stated posteriors, one for each parameter](calibration.svg)

Ranks of the true values from 0 to 1 in {BINS} bins, with the number of fits; between the edges of the grey band lie 99 % of a bin's counts if ranks are uniform. Red: not calibrated.

Of {sum(draws)} draws {made} were simulated and {made - sum(without.values())} of these fits end with an interval; of the others {listed(f'{n} {why}' for why, n in without.most_common())}.
Of the intervals of fits that did not end elsewhere those of 95 % hold the true value in {100 * held / max(1, asked):.1f} %; this tells where misses come from, and not how good intervals are, as it takes the true values to say it.

- Not judged, with fewer than {ENOUGH} fits: {listed(few)}.
- Not simulated: {listed(unmade)}.
- Failed fits: {listed(failed)}.
- Ended elsewhere: {listed(astray)}.
- Far from the truth: {listed(far)}.

{by_elements(fem, cards)}{notes.read_text() if notes.exists() else ''}"""
    )


def by_elements(answers, cards):
    """What finite elements say, of few draws: all parameters together."""
    if not answers:
        return ""
    effects = [Effect(name, parameters, own) for name, parameters in cards.items() if (own := [a for a in answers if a["effect"] == name])]
    rows = [row for effect in effects for row in effect.rows]
    held, count = sum(row.hits[2] for row in rows), sum(row.count for row in rows)
    fits, made = sum(len(effect.fits) for effect in effects), sum(effect.draws - len(effect.unmade) for effect in effects)
    return f"""## By finite elements

The same with `--contact fem`: of {len(answers)} draws of {len(effects)} effects ({listed(effect.name for effect in effects)}) {made} were simulated and {fits} fits end with an interval; {held} of {count} intervals of 95 % hold the true value.

"""
