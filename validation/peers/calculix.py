"""One mesh position by CalculiX (the program `ccx`), on the deck as it is; only the load of every pair of flanks is printed besides."""

import os
import re
import shutil
import subprocess

from spent import timed

NAME = "CalculiX"


def absent():
    """Why this peer cannot run here, or nothing."""
    return None if shutil.which("ccx") else "the program ccx is not installed (Debian: calculix-ccx)"


def version():
    return re.search(r"[\d.]+", subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout)[0]


def block(printed, heading):
    """Rows of numbers below the last line that holds `heading`."""
    rows = []
    for line in printed[printed.rindex(heading) :].splitlines()[1:]:
        try:
            cells = [float(cell) for cell in line.split()]
        except ValueError:
            break
        if cells:
            rows.append(cells)
        elif rows:
            break
    return rows


def solve(file, deck, folder):
    folder.mkdir(parents=True, exist_ok=True)
    forces = "".join(f"*CONTACT PRINT, SLAVE=GEAR_{p}, MASTER=PINION_{p}\nCF\n" for p in range(1, deck.pairs() + 1))
    (folder / "position.inp").write_text(file.read_text().replace("*NODE FILE", f"{forces}*NODE FILE"))
    seconds = timed(["ccx", "position"], folder / "log.txt", cwd=folder, env={**os.environ, "OMP_NUM_THREADS": "1"})
    printed = (folder / "position.dat").read_text()
    loads = []
    for pair in range(1, deck.pairs() + 1):
        statistics = printed[printed.rindex(f"statistics for slave set GEAR_{pair},") :]
        force = block(statistics[: statistics.index("center of gravity")], "total surface force")[0][:3]
        loads.append(sum(f * f for f in force) ** 0.5)
    words = (folder / "log.txt").read_text()
    return {
        "turn_urad": 1e6 * block(printed, "displacements (vx,vy,vz)")[0][1],
        "peak_pressure": max(row[2] for row in block(printed, "contact stress (")),
        "line_loads": loads,
        "iterations": len(re.findall(r"^ *iteration \d+", words, re.M)),
        "processor_seconds": seconds,
        "version": version(),
    }
