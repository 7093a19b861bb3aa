"""2,000 points: the plain sweep, 7 shards merged, and HyperQueue with two workers on this machine. The same bytes? How efficient?

    python3 validation/cluster/efficiency.py target/release/gearwear

HyperQueue's server and workers come with its Python package (pip install hyperqueue). Times are of the whole command, wall clock and processor time of
the children; the plain sweep has two threads, each worker one.
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAM = str(Path(sys.argv[1]).absolute())
POINTS = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
STUDY = Path(__file__).with_name("study.toml").read_text()
DESIGN = [
    "sweep", "study.toml", "--quiet", "--design", f"lhs:{POINTS}", "--seed", "1",
    "--vary", "operation.torque=50..200", "--vary", "operation.misalignment=0..0.5",
    "--vary", "wear.coefficient=1e-10..1e-9:log", "--vary", "operation.speed=500..3000",
]  # fmt: skip
FILES = ["sweep.csv", "sweep.json", "sweep.svg"]


def timed(work):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begun = time.monotonic()
    work()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.monotonic() - begun, processor


def gearwear(*arguments):
    subprocess.run([PROGRAM, *DESIGN, *arguments], check=True)


def shards():
    for i in range(1, 8):
        gearwear("--shard", f"{i}/7", "-o", "shards", "--threads", "2")
    gearwear("--merge", "shards", "-o", "of-shards")


def hyperqueue(lines):
    from hyperqueue import Job, LocalCluster
    from hyperqueue.cluster import WorkerConfig

    with LocalCluster() as cluster:
        for _ in range(2):
            cluster.start_worker(WorkerConfig(cores=1))
        client = cluster.client()
        job = Job(default_workdir=Path.cwd())
        for line in lines:
            arguments = [PROGRAM, *DESIGN, "--point", "-", "-o", "tasks", "--threads", "1"]
            job.program(arguments, env={"HQ_ENTRY": line}, stdout=None, stderr=None)
        client.wait_for_jobs([client.submit(job)])
    gearwear("--merge", "tasks", "-o", "of-tasks")


def same(folder):
    return all((Path("plain") / name).read_bytes() == (Path(folder) / name).read_bytes() for name in FILES)


with tempfile.TemporaryDirectory() as home:
    os.chdir(home)
    Path("study.toml").write_text(STUDY)
    plain = timed(lambda: gearwear("-o", "plain", "--threads", "2"))
    print(f"plain sweep, {POINTS} points: {plain[0]:.1f} s, {plain[1]:.1f} s of processor time", flush=True)
    found = timed(shards)
    print(f"7 shards, one after the other: {found[0]:.1f} s, {found[1]:.1f} s of processor time, same bytes: {same('of-shards')}", flush=True)
    print(f"efficiency of the shards (processor time): {plain[1] / found[1]:.2f}", flush=True)
    gearwear("--emit", "points.jsonl", "--per-line", str(max(1, POINTS // 8)))
    lines = Path("points.jsonl").read_text().splitlines()
    assert sum(len(json.loads(line)["points"]) for line in lines) == POINTS
    found = timed(lambda: hyperqueue(lines))
    print(f"HyperQueue, 2 workers, {len(lines)} tasks: {found[0]:.1f} s, same bytes: {same('of-tasks')}")
    print(f"efficiency (wall clock): {plain[0] / found[0]:.2f}")
