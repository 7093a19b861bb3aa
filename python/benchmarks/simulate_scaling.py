"""How `gearwear.simulate` scales over cores, and what Python adds to the histories themselves.

    python python/benchmarks/simulate_scaling.py                        # 1000 histories by the analytic contact model
    python python/benchmarks/simulate_scaling.py --contact fem -n 100   # coarse finite elements

Each number of threads gets a process of its own, in turn, several times. Printed are medians of

- wall: what the clock says, worth something only on a machine that does nothing else;
- busiest: processor time of the busiest thread, which is the wall time on free cores; others' load hardly changes it;
- Python: processor time of the calling thread. The histories run on other threads, so that this is all that Python and the crossing cost.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy

import gearwear as gw

STUDY = """
title = "two tests with running-in"
[gears]
module = 2.0
pressure_angle = 20.0
face_width = 33.0
[gears.pinion]
teeth = 27
bore_diameter = 25.0
[gears.gear]
teeth = 53
bore_diameter = 40.0
[material]
youngs_modulus = 2.1e5
poisson_ratio = 0.3
density = 7850.0
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 3e-10
cycles = 4e5
[model]
contact = "hertz"
[numerics]
elements_per_half_width = 2
positions = 24
[fit]
free = ["wear.coefficient", "running_in.amplitude"]
[[effect]]
kind = "running_in"
amplitude = 3.0
decay_cycles = 1e5
[[test]]
id = "A"
[[test]]
id = "B"
torque = 150.0
"""


def busiest():
    """Processor time of this process's busiest thread so far, s; its other threads are those of the histories."""
    times = []
    for task in Path("/proc/self/task").iterdir():
        fields = (task / "stat").read_text().rpartition(")")[2].split()
        times.append((int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK"))
    return max(times)


def measure(path, count):
    study = gw.Study.read(path)
    generator = numpy.random.default_rng(1)
    theta = numpy.array([3e-10, 3.0]) * numpy.exp(0.2 * generator.standard_normal((count, 2)))
    names = study["fit.free"]
    wall, own, total = time.perf_counter(), time.thread_time(), time.process_time()
    found = gw.simulate(study, names, theta)
    wall, own, total = time.perf_counter() - wall, time.thread_time() - own, time.process_time() - total
    assert found.reasons == [None] * count
    return {"wall": wall, "python": own, "total": total, "busiest": busiest()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--contact", choices=["hertz", "fem"], default="hertz")
    parser.add_argument("-n", "--histories", type=int, default=1000)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, os.cpu_count()])
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--measure", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.measure:
        print(json.dumps(measure(arguments.measure, arguments.histories)))
        return
    with tempfile.TemporaryDirectory() as folder:
        study = gw.Study.from_toml(STUDY)
        study["model.contact"] = arguments.contact
        made = study.synthesize(Path(folder) / "made", progress=False)
        print(f"{arguments.histories} histories of two tests, {arguments.contact}; {arguments.repeat} times; load before {os.getloadavg()[0]:.1f}")
        rounds = [{threads: apart(made.path, threads, arguments) for threads in arguments.threads} for _ in range(arguments.repeat)]
        print("threads   wall s   busiest s   Python   speed-up: wall (range)         busiest")
        for threads in arguments.threads:

            def middle(of):
                return statistics.median(of(found[threads], found[arguments.threads[0]]) for found in rounds)

            gains = [found[arguments.threads[0]]["wall"] / found[threads]["wall"] for found in rounds]
            print(
                f"{threads:7d} {middle(lambda own, _: own['wall']):8.2f} {middle(lambda own, _: own['busiest']):11.2f}"
                f" {middle(lambda own, _: own['python'] / own['total']):8.2%} {statistics.median(gains):15.2f} ({min(gains):.2f} to {max(gains):.2f})"
                f" {middle(lambda own, first: first['busiest'] / own['busiest']):11.2f}"
            )


def apart(path, threads, arguments):
    """The figures of one number of threads."""
    command = [sys.executable, __file__, "--measure", str(path), "-n", str(arguments.histories)]
    environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
    out = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(out.stdout)


if __name__ == "__main__":
    main()
