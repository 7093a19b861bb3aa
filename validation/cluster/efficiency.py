"""2,000 points by every way of guide/cluster.md: one machine, 7 shards, HyperQueue, Slurm. The same bytes? How efficient?

    python3 validation/cluster/efficiency.py target/release/gearwear [POINTS [shards] [hyperqueue] [slurm]]
    validation/cluster/one_node_slurm.sh python3 validation/cluster/efficiency.py target/release/gearwear

HyperQueue's server and workers come with its Python package (pip install hyperqueue). Slurm runs the job file of the guide as it stands there, but for
the number of cores of a task. What is not installed is skipped, and that is said. Times are of whole ways, merge included: by the clock, and processor time
(user and system) of all calls of the program. Other work on the machine changes both, processor time up to a half where cores share their units; so each way
stands against a plain sweep right before it.
"""

import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROGRAM = Path(sys.argv[1]).absolute()
POINTS = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
HERE = Path(__file__).resolve().parent
GUIDE = (HERE.parents[1] / "guide/cluster.md").read_text()
SWEEP = ["gearwear", "sweep", "study.toml", "--points", "points.csv"]
FILES = ["sweep.csv", "sweep.json", "sweep.svg"]
# what stands for the program on the path: it notes the processor time of each call
NOTING = """#!/bin/bash
"{program}" "$@"; code=$?
times > "{folder}/$$.$RANDOM"
exit $code
"""


def gearwear(*arguments):
    subprocess.run([*SWEEP, *arguments, "--quiet"], check=True)


def plain():
    gearwear("-o", "plain", "--threads", "2")


def shards():
    for i in range(1, 8):
        gearwear("--shard", f"{i}/7", "-o", "shards", "--threads", "2")
    gearwear("--merge", "shards", "-o", "by-shards")


def hyperqueue():
    from hyperqueue import Job, LocalCluster
    from hyperqueue.cluster import WorkerConfig

    gearwear("--emit", "points.jsonl", "--per-line", str(max(1, POINTS // 8)))
    with LocalCluster() as cluster:
        for _ in range(2):
            cluster.start_worker(WorkerConfig(cores=1))
        client = cluster.client()
        job = Job(default_workdir=Path.cwd())
        for line in Path("points.jsonl").read_text().splitlines():
            arguments = [*SWEEP, "--point", "-", "-o", "tasks", "--threads", "1", "--quiet"]
            job.program(arguments, env={"HQ_ENTRY": line, "PATH": os.environ["PATH"]}, stdout=None, stderr=None)
        client.wait_for_jobs([client.submit(job)])
    gearwear("--merge", "tasks", "-o", "by-hyperqueue")


def slurm():
    script = re.search(r"#!/bin/bash\n#SBATCH.*?(?=```)", GUIDE, re.DOTALL)[0]
    Path("sweep.sbatch").write_text(re.sub(r"(--cpus-per-task)=\d+", r"\1=1", script))
    lines = re.search(r"```sh\n(job=.*?)```", GUIDE, re.DOTALL)[1]
    # the guide's last line hands the merge to Slurm and is done; here it is waited for
    subprocess.run(["bash", "-euc", lines.replace("sbatch --dependency", "sbatch --wait --dependency")], check=True)
    Path("whole").rename("by-slurm")


def processor_time(folder):
    def seconds(text):
        minutes, rest = text.strip().rstrip("s").split("m")
        return 60 * float(minutes) + float(rest)

    # the first line of `times` is the shell's own, the second its children's
    return sum(seconds(one) for file in folder.iterdir() for one in file.read_text().splitlines()[1].split())


def measured(way):
    """Time by the clock and of the processor, s."""
    noted = Path("noted")
    shutil.rmtree(noted, ignore_errors=True)
    noted.mkdir()
    begun = time.monotonic()
    way()
    return time.monotonic() - begun, processor_time(noted)


def same(folder):
    return all((Path("plain") / name).read_bytes() == (Path(folder) / name).read_bytes() for name in FILES)


def possible(way):
    if way is hyperqueue:
        try:
            import hyperqueue as _
        except ImportError:
            return "the Python package hyperqueue is not installed"
    if way is slurm and shutil.which("sbatch") is None:
        return "there is no sbatch"
    if way is slurm and subprocess.run(["sinfo"], capture_output=True).returncode != 0:
        return "no Slurm answers; see one_node_slurm.sh"
    return None


with tempfile.TemporaryDirectory() as home:
    os.chdir(home)
    os.chmod(home, 0o755)
    Path("study.toml").write_text((HERE / "study.toml").read_text())
    dice = random.Random(1)
    rows = ["operation.torque,operation.misalignment,wear.coefficient,operation.speed"]
    for _ in range(POINTS):
        rows.append(f"{dice.uniform(50, 200):.4f},{dice.uniform(0, 0.5):.5f},{10 ** dice.uniform(-10, -9):.5e},{dice.uniform(500, 3000):.2f}")
    Path("points.csv").write_text("\n".join(rows) + "\n")
    Path("bin").mkdir()
    Path("bin/gearwear").write_text(NOTING.format(program=PROGRAM, folder=Path.cwd() / "noted"))
    Path("bin/gearwear").chmod(0o755)
    os.environ["PATH"] = f"{Path.cwd() / 'bin'}:{os.environ['PATH']}"
    ways = [way for way in (shards, hyperqueue, slurm) if len(sys.argv) < 4 or way.__name__ in sys.argv[3:]]
    for way in ways:
        name = way.__name__
        if why := possible(way):
            print(f"{name:11} skipped: {why}")
            continue
        shutil.rmtree("plain", ignore_errors=True)
        whole = measured(plain)
        print(f"plain sweep {POINTS} points, 2 threads: {whole[0]:6.1f} s, {whole[1]:6.1f} s of processor time", flush=True)
        found = measured(way)
        bytes_are = "the same bytes" if same(f"by-{name}") else "OTHER BYTES"
        print(
            f"{name:11} {found[0]:6.1f} s, {found[1]:6.1f} s of processor time; efficiency {whole[0] / found[0]:.2f} by the clock, "
            f"{whole[1] / found[1]:.2f} by processor time; {bytes_are}",
            flush=True,
        )
