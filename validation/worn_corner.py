"""Draws the peak pressures where the gear's tip corner runs in, by three resolutions: worn_corner.svg beside this file.

    python3 worn_corner.py PROGRAM

The paper's pair after 50 000 pinion revolutions (validation/paper/study.toml). Python's standard library only."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
RESOLUTIONS = [(5, 100, "#c44e52", "2 3"), (10, 200, "#4c72b0", "7 4"), (20, 200, "#222222", "none")]
PATH, PRESSURE = (-5.8, -4.0), (0.0, 800.0)  # mm, MPa
LEFT, TOP, WIDTH, HEIGHT = 70, 20, 560, 300


def peaks(program, edges, positions, folder):
    study = (HERE / "paper" / "study.toml").read_text()
    study += f"\n[numerics]\nelements_per_half_width = {edges}\npositions = {positions}\nfields = 1\nstored_states = 2\n"
    (folder / "study.toml").write_text(study)
    subprocess.run([program, "run", folder / "study.toml", "-o", folder / f"{edges}_{positions}", "--quiet"], check=True)
    with open(folder / f"{edges}_{positions}" / "contact.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    end = max(float(row["cycles"]) for row in rows)
    points = [
        (float(row["path"]), float(row["peak_pressure"]))
        for row in rows
        if float(row["cycles"]) == end and PATH[0] <= float(row["path"]) <= PATH[1]
    ]
    return sorted(points)


def place(path, pressure):
    x = LEFT + WIDTH * (path - PATH[0]) / (PATH[1] - PATH[0])
    y = TOP + HEIGHT * (1 - (pressure - PRESSURE[0]) / (PRESSURE[1] - PRESSURE[0]))
    return f"{x:.1f},{y:.1f}"


def picture(curves):
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 30} {TOP + HEIGHT + 60}" font-family="sans-serif" font-size="13">',
        '<rect width="100%" height="100%" fill="white"/>',
        f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#888"/>',
    ]
    for step in range(10):
        path = PATH[0] + 0.2 * step
        x = place(path, PRESSURE[0]).split(",")[0]
        out.append(f'<text x="{x}" y="{TOP + HEIGHT + 18}" text-anchor="middle">{path:.1f}</text>')
    for pressure in range(0, 801, 200):
        y = float(place(PATH[0], pressure).split(",")[1])
        out.append(f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{pressure}</text>')
        out.append(f'<line x1="{LEFT}" x2="{LEFT + WIDTH}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
    for number, ((edges, positions, colour, dash), points) in enumerate(curves):
        line = " ".join(place(*point) for point in points)
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.8" stroke-dasharray="{dash}"/>')
        y = TOP + 24 + 20 * number
        out.append(f'<line x1="{LEFT + 20}" x2="{LEFT + 60}" y1="{y - 4}" y2="{y - 4}" stroke="{colour}" stroke-width="1.8" stroke-dasharray="{dash}"/>')
        out.append(f'<text x="{LEFT + 68}" y="{y}">{edges} edges per half width, {positions} positions</text>')
    out.append(f'<text x="{LEFT + WIDTH / 2}" y="{TOP + HEIGHT + 42}" text-anchor="middle">path of contact from the pitch point, mm</text>')
    middle = TOP + HEIGHT / 2
    out.append(f'<text x="18" y="{middle}" text-anchor="middle" transform="rotate(-90 18 {middle})">peak pressure, MPa</text>')
    return "\n".join([*out, "</svg>", ""])


def main():
    with tempfile.TemporaryDirectory() as folder:
        curves = [(resolution, peaks(sys.argv[1], *resolution[:2], Path(folder))) for resolution in RESOLUTIONS]
    (HERE / "worn_corner.svg").write_text(picture(curves))


if __name__ == "__main__":
    main()
