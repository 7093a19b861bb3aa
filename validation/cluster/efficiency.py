"""2,000 points by every way of guide/cluster.md: one machine, 7 shards, HyperQueue, Slurm. The same bytes? How efficient?

    python3 validation/cluster/efficiency.py target/release/gearwear [POINTS] [WAY ...] [cycles=N]
    validation/cluster/one_node_slurm.sh python3 validation/cluster/efficiency.py target/release/gearwear

WAY is shards, hyperqueue, slurm (one job for each core) or slurm_of_seven (the guide's seven jobs); all unless named. HyperQueue's server and workers come
with its Python package (pip install hyperqueue); its script and Slurm's job file are those of the guide as they stand there, but for the numbers of cores and
jobs. `cycles=N` makes points that cost more. What is not installed is skipped, and that is said. Times are of whole ways, until the merged table stands: by
the clock, and processor time (user and system) of all calls of the program. Other work on the machine changes both, processor time up to a half where cores
share their units; so each way stands against a plain sweep right before it.
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
POINTS = next((int(word) for word in sys.argv[2:] if word.isdigit()), 2000)
CYCLES = next((word.removeprefix("cycles=") for word in sys.argv[2:] if word.startswith("cycles=")), None)
NAMED = [word for word in sys.argv[2:] if word.isidentifier()]
HERE = Path(__file__).resolve().parent
GUIDE = (HERE.parents[1] / "guide/cluster.md").read_text()
SWEEP = ["gearwear", "sweep", "study.toml", "--points", "points.csv"]
FILES = ["sweep.csv", "sweep.json", "sweep.svg"]
# what stands for the program on the path: it notes the processor time of each call, in a process of its own, since a shell that becomes its last command
# hands on the time of its other children
NOTING = """#!/bin/bash
(
"{program}" "$@"; code=$?
times > "{folder}/$BASHPID.$RANDOM"
exit $code
)
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
    line = f"--emit points.jsonl --per-line {max(1, POINTS // 8)}"
    emit, submit, merge = re.search(r"(gearwear [^\n]*--emit[^\n]*)\n(python3 [^\n]*)\n(gearwear [^\n]*--merge[^\n]*)", GUIDE).groups()
    Path("farm.py").write_text(re.search(r"```python\n(.*?)```", GUIDE, re.DOTALL)[1])
    emit = re.sub(r"--emit points.jsonl --per-line \d+", line, emit)
    subprocess.run(["bash", "-euc", "\n".join([emit, submit.replace("python3", sys.executable), merge])], check=True)
    Path("whole").rename("by-hyperqueue")


def slurm(jobs=2):
    script = re.search(r"#!/bin/bash\n#SBATCH.*?(?=```)", GUIDE, re.DOTALL)[0]
    script = re.sub(r"(--cpus-per-task)=\d+", r"\1=1", script)
    Path("sweep.sbatch").write_text(script.replace("--array=1-7", f"--array=1-{jobs}").replace("ID/7", f"ID/{jobs}"))
    subprocess.run(["bash", "-euc", re.search(r"```sh\n(job=.*?)```", GUIDE, re.DOTALL)[1]], check=True)
    # the guide's last line hands the merge to Slurm and is done; it is waited for as a user would, by looking (`sbatch --wait` looks after 2, 4, 8 ... s only)
    while subprocess.run(["squeue", "--noheader"], capture_output=True, text=True, check=True).stdout.strip():
        time.sleep(0.2)
    shutil.rmtree("by-slurm", ignore_errors=True)
    Path("whole").rename("by-slurm")
    shutil.rmtree("parts")


def slurm_of_seven():
    slurm(7)
    Path("by-slurm").rename("by-slurm_of_seven")


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
    if way in (slurm, slurm_of_seven) and shutil.which("sbatch") is None:
        return "there is no sbatch"
    if way in (slurm, slurm_of_seven) and subprocess.run(["sinfo"], capture_output=True).returncode != 0:
        return "no Slurm answers; see one_node_slurm.sh"
    return None


with tempfile.TemporaryDirectory() as home:
    os.chdir(home)
    os.chmod(home, 0o755)
    study = (HERE / "study.toml").read_text()
    Path("study.toml").write_text(re.sub(r"(?m)^cycles = .*", f"cycles = {CYCLES}", study) if CYCLES else study)
    dice = random.Random(1)
    rows = ["operation.torque,operation.misalignment,wear.coefficient,operation.speed"]
    for _ in range(POINTS):
        rows.append(f"{dice.uniform(50, 200):.4f},{dice.uniform(0, 0.5):.5f},{10 ** dice.uniform(-10, -9):.5e},{dice.uniform(500, 3000):.2f}")
    Path("points.csv").write_text("\n".join(rows) + "\n")
    Path("bin").mkdir()
    Path("bin/gearwear").write_text(NOTING.format(program=PROGRAM, folder=Path.cwd() / "noted"))
    Path("bin/gearwear").chmod(0o755)
    os.environ["PATH"] = f"{Path.cwd() / 'bin'}:{os.environ['PATH']}"
    ways = [way for way in (shards, hyperqueue, slurm, slurm_of_seven) if not NAMED or way.__name__ in NAMED]
    for way in ways:
        name = way.__name__
        if why := possible(way):
            print(f"{name:14} skipped: {why}")
            continue
        shutil.rmtree("plain", ignore_errors=True)
        whole = measured(plain)
        print(f"plain sweep    {POINTS} points, 2 threads: {whole[0]:6.1f} s, {whole[1]:6.1f} s of processor time", flush=True)
        found = measured(way)
        bytes_are = "the same bytes" if same(f"by-{name}") else "OTHER BYTES"
        print(
            f"{name:14} {found[0]:6.1f} s, {found[1]:6.1f} s of processor time; efficiency {whole[0] / found[0]:.2f} by the clock, "
            f"{whole[1] / found[1]:.2f} by processor time; {bytes_are}",
            flush=True,
        )
