"""The tables of README.md from what times.py has measured."""

import math

# how often a run takes a stage, by what it says of itself
OFTEN = {"one wear step": "wear_steps", "fields at one position": "frames"}
# in the order of a run
ORDER = (
    "mesh",
    "elimination order and pattern",
    "element stiffness",
    "assembly and factorisation",
    "compliance of the flanks",
    "mesh cycle, geometry",
    "mesh cycle, compliance",
    "one wear step",
    "contact at all positions, from nothing",
    "worn meshes of a state",
    "fields at one position",
    "displacement under a load",
    "stress at the nodes",
)
# parts of others
PARTS = {
    "contact at all positions, from nothing": "in a step",
    "worn meshes of a state": "in the fields",
    "displacement under a load": "in the fields",
    "stress at the nodes": "in the fields",
}


def number(value, digits=3):
    if value == 0:
        return "0"
    text = f"{value:.{digits}g}"
    return f"{float(text):,.0f}".replace(",", " ") if abs(value) >= 10 ** (digits - 1) else (f"{float(text):g}" if "e" not in text else text)


def row(*cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def table(heads, rows):
    right = ["---" if number == 0 else "---:" for number in range(len(heads))]
    return "\n".join([row(*heads), row(*right), *(row(*cells) for cells in rows)])


def unknowns(mesh):
    return sum(body["unknowns"] for body in mesh["bodies"])


def work(mesh, stage):
    """What a stage must at least do, where that can be counted, with its unit: operations or bytes that are moved."""
    bodies = mesh["bodies"]
    if stage == "assembly and factorisation":
        return sum(body["factor_operations"] for body in bodies), "flop"
    if stage == "compliance of the flanks":
        # inverse of a triangle, and the product of that with its transpose
        return sum(2 / 3 * body["flank_unknowns"] ** 3 for body in bodies), "flop"
    if stage == "displacement under a load":
        # the factor is read forward and back
        return sum(2 * 8 * body["factor_values"] for body in bodies), "B"
    return None


def default(results):
    return next(m for m in results["stages"]["meshes"] if m["edges_per_half_width"] == 5 and m["order"] == 2)


def stages(results):
    mesh, run = default(results), results["stages"]["run"]
    limits = {"flop": results["machine"]["flops"], "B": results["machine"]["bytes_per_second"]}
    counts = {"wear_steps": run["wear_steps"], "frames": 24}
    parts = []
    for stage in ORDER:
        seconds = mesh["seconds"][stage]
        times = counts[OFTEN[stage]] if stage in OFTEN else 1
        parts.append((stage, seconds, times, work(mesh, stage)))
    rest = run["processor"] - sum(seconds * times for stage, seconds, times, _ in parts if stage not in PARTS)
    parts.append(("the rest: reading the study; writing tables, fields, pictures and report", rest, 1, None))
    rows = []
    for stage, seconds, times, least in parts:
        amount, unit = least or (0.0, "")
        part = stage in PARTS
        rows.append(
            (
                stage,
                number(1e3 * seconds),
                PARTS[stage] if part else times,
                "" if part else f"{100 * seconds * times / run['processor']:.0f} %",
                f"{number(1e-9 * amount)} G{unit}" if unit else "",
                f"{number(1e-9 * amount / seconds)} G{unit}/s" if unit else "",
                f"{100 * amount / seconds / limits[unit]:.0f} %" if unit else "",
            )
        )
    heads = ("stage", "once, ms", "times in the run", "share of the run", "least work", "rate", "of the limit")
    less = results["stages"]["without_fields"]["processor"]
    words = f"The whole run takes {number(run['processor'])} s of the processor, with `numerics.fields = 0` {number(less)} s."
    return f"{table(heads, rows)}\n\n{words}"


def sizes(results):
    meshes = results["stages"]["meshes"] + results.get("large", {}).get("meshes", [])
    heads = ["stage, ms", *(f"{number(unknowns(m))} unknowns" for m in meshes), "growth"]
    rows = [
        ("edges on the Hertz half width, order", *(f"{m['edges_per_half_width']:g}, {m['order']}" for m in meshes), ""),
        ("flank unknowns", *(number(sum(b["flank_unknowns"] for b in m["bodies"])) for m in meshes), ""),
        ("values of the factors, million", *(number(1e-6 * sum(b["factor_values"] for b in m["bodies"])) for m in meshes), ""),
    ]
    for stage in ORDER:
        if not all(stage in m["seconds"] for m in meshes):
            continue  # measured on some meshes only
        times = [m["seconds"][stage] for m in meshes]
        quadratic = [m for m in meshes if m["order"] == 2]
        first, last = quadratic[0], quadratic[-1]
        power = math.log(last["seconds"][stage] / first["seconds"][stage]) / math.log(unknowns(last) / unknowns(first))
        rows.append((stage, *(number(1e3 * t) for t in times), f"n^{power:.1f}"))
    return table(heads, rows)


def growth(results):
    rows = []
    for name, cases in results["growth"].items():
        if name in ("load", "repeats"):
            continue
        first, last = cases[0], cases[-1]
        each = (last["processor"] - first["processor"]) / (last["contact_solves"] - first["contact_solves"])
        for case in cases:
            key = next(k for k in ("positions", "step_tolerance", "cycles") if k in case)
            further = number(1e6 * each) if case is last else ""
            rows.append((f"`{key} = {case[key]}`", case["wear_steps"], number(case["contact_solves"], 6), number(case["processor"]), further))
    return table(("setting", "wear steps", "positions solved", "run, s", "each further position, µs"), rows)


def learning(results):
    found = results["learning"]
    rows = [(f"`compare`, {case['tests']} tests", number(case["processor"]), number(case["clock"])) for case in found["compare"]]
    rows += [(f"`{name}`, 2 tests", number(found[name]["processor"]), number(found[name]["clock"])) for name in ("diagnose --fast", "diagnose") if name in found]
    return table(("command", "processor, s", "clock, s"), rows)


def threads(results):
    rows = []
    for name, cases in results["threads"].items():
        if name in ("load", "repeats"):
            continue
        one, two = cases
        rows.append(
            (
                name,
                number(one["processor"]),
                number(two["processor"]),
                f"{100 * (two['processor'] / one['processor'] - 1):+.0f} %",
                number(one["clock"]),
                number(two["clock"]),
                f"{one['clock'] / two['clock']:.2f}",
            )
        )
    heads = ("work", "processor, 1 thread, s", "2 threads, s", "more", "clock, 1 thread, s", "2 threads, s", "faster by")
    return table(heads, rows)


def machine(results):
    found = results["machine"]
    return (
        f"{found['processor']}, {found['cores']} cores: {1e-9 * found['flops']:.0f}·10⁹ operations a second in a dense product of matrices (numpy, double precision), "
        f"{1e-9 * found['bytes_per_second']:.0f}·10⁹ bytes a second in a copy; one thread each."
    )


def write(readme, results):
    text = readme.read_text()
    for name, part in (("machine", machine), ("stages", stages), ("sizes", sizes), ("growth", growth), ("learning", learning), ("threads", threads)):
        if (name if name != "sizes" else "stages") not in results:
            continue
        start, end = f"<!-- {name}: written by times.py -->", f"<!-- end of {name} -->"
        head, rest = text.split(start)
        text = f"{head}{start}\n{part(results)}\n{end}{rest.split(end)[1]}"
    readme.write_text(text)
