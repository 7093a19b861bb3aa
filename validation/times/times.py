"""Where gearwear's time goes: every stage against the machine's limits, growth with the size of the problem, one thread against two.

    python3 validation/times/times.py target/release/gearwear target/release/examples/stage_times WORKFOLDER [PART ...]

PART is machine, stages, large, growth, threads or learning; all unless named. Writes results.json and the tables of README.md beside this file; parts that are not asked
for keep their earlier figures. Commands are repeated three times, or REPEATS (environment). Times are of the processor (user and system) unless a column says clock: other work on the machine changes them by some per cent
to a half, the clock by any factor. Needs numpy."""

import json
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
PAPER = HERE.parent / "paper/study.toml"
# edges per Hertz half width and order of the elements: about 20, 90 and 170 thousand unknowns; and 400, which takes minutes and 4 GB
MESHES = ((3, 1), (5, 2), (16, 2))
LARGE = ((46, 2),)
REPEATS = int(os.environ.get("REPEATS", 3))


def spent(command, **keys):
    """Processor and clock seconds of a command."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL, **keys)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.monotonic() - begun


def least(command):
    """The least of some repetitions, processor and clock each."""
    found = [spent(command) for _ in range(REPEATS)]
    return min(p for p, _ in found), min(c for _, c in found)


class Measure:
    def __init__(self, program, stages, folder):
        self.program, self.stage_times, self.folder = program, stages, folder

    def machine(self):
        clean = {key: value for key, value in os.environ.items() if not key.startswith("OPENBLAS_")}
        clean["OPENBLAS_NUM_THREADS"] = "1"
        found = subprocess.run([sys.executable, HERE / "machine.py"], env=clean, check=True, capture_output=True, text=True)
        return {**json.loads(found.stdout), "cores": os.cpu_count()}

    def study(self, name, **numerics):
        """The paper's study with other numerics or cycles."""
        text = PAPER.read_text()
        cycles = numerics.pop("cycles", None)
        if cycles:
            text = text.replace("cycles = 50000 ", f"cycles = {cycles} ")
        file = self.folder / f"{name}.toml"
        keys = "".join(f"{key} = {value}\n" for key, value in numerics.items())
        file.write_text(f"{text}\n[numerics]\n{keys}" if keys else text)
        return file

    def command(self, name, study, *more, threads=1):
        return [self.program, name, study, *more, "-o", self.folder / f"{Path(study).stem}_{name}", "--quiet", "--threads", threads]

    def run(self, study, threads=1):
        """A run: processor time, clock, and what it says of its cost."""
        command = self.command("run", study, threads=threads)
        processor, clock = least(command)
        cost = json.loads((self.folder / f"{Path(study).stem}_run/summary.json").read_text())["cost"]
        return {"processor": processor, "clock": clock, **cost}

    def meshes(self, wanted):
        found = []
        for edges, order in wanted:
            print(f"stages: {edges} edges, order {order}", flush=True)
            text = subprocess.run([self.stage_times, str(edges), str(order)], check=True, capture_output=True, text=True).stdout
            found.append({**json.loads(text), "order": order})
        return found

    def stages(self):
        return {"meshes": self.meshes(MESHES), "run": self.run(self.study("paper")), "without_fields": self.run(self.study("without_fields", fields=0))}

    def large(self):
        return {"meshes": self.meshes(LARGE)}

    def growth(self):
        cases = {
            "positions": [{"positions": n} for n in (50, 100, 200, 400)],
            "wear steps": [{"step_tolerance": tolerance} for tolerance in (8e-3, 2e-3, 5e-4, 1.25e-4)],
            "cycles": [{"cycles": n} for n in (50_000, 200_000, 800_000)],
        }
        out = {}
        for name, settings in cases.items():
            out[name] = []
            for number, setting in enumerate(settings):
                print(f"growth: {setting}", flush=True)
                out[name].append({**setting, **self.run(self.study(f"{name.replace(' ', '_')}_{number}", **setting))})
        return out

    def example(self, tests=2):
        """The study that `gearwear init` writes, its measurements repeated for more tests under other loads."""
        folder = self.folder / f"example_{tests}"
        if not folder.exists():
            subprocess.run([self.program, "init", folder], check=True, stdout=subprocess.DEVNULL)
        study, table = folder / "study.toml", folder / "measurements.csv"
        lines = table.read_text().splitlines()
        if tests > 2 and 'id = "B1"' not in study.read_text():
            text = study.read_text()
            more = ""
            for number in range(1, tests - 1):
                more += f'\n[[test]]\nid = "B{number}"\nrole = "fit"\ntorque = {100.0 + number}\ncycles = 50000\n'
                lines += [line.replace("A,", f"B{number},", 1).replace(",A-", f",B{number}-") for line in lines if line.startswith("A,")]
            place = text.index("[measurements]")
            study.write_text(text[:place] + more.lstrip() + "\n" + text[place:])
            table.write_text("\n".join(lines) + "\n")
        return study

    def learning(self):
        out = {"compare": []}
        for tests in (2, 4, 8):
            study = self.example(tests)
            print(f"learning: compare, {tests} tests", flush=True)
            processor, clock = least(self.command("compare", study))
            out["compare"].append({"tests": tests, "processor": processor, "clock": clock})
        for name, more in (("diagnose --fast", ["--fast"]), ("diagnose", [])):  # once each
            print(f"learning: {name}", flush=True)
            processor, clock = spent(self.command("diagnose", self.example(), *more))
            out[name] = {"processor": processor, "clock": clock}
        return out

    def threads(self):
        sweep = ["--vary", "operation.torque=60,70,80,90,100,110,120,130"]
        jobs = {
            "history (run)": ("run", self.study("threads"), []),
            "sweep of 8 loads": ("sweep", self.study("threads"), sweep),
            "diagnosis, --fast": ("diagnose", self.example(), ["--fast"]),
        }
        out = {}
        for name, (command, study, more) in jobs.items():
            print(f"threads: {name}", flush=True)
            out[name] = []
            for threads in (1, 2):
                processor, clock = least(self.command(command, study, *more, threads=threads))
                out[name].append({"threads": threads, "processor": processor, "clock": clock})
        return out


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, stages, folder = (Path(word).resolve() for word in sys.argv[1:4])
    folder.mkdir(parents=True, exist_ok=True)
    measure = Measure(program, stages, folder)
    kept = HERE / "results.json"
    results = json.loads(kept.read_text()) if kept.exists() else {}
    for part in sys.argv[4:] or ("machine", "stages", "growth", "threads", "learning", "large"):
        results[part] = getattr(measure, part)()
        results[part]["repeats"] = REPEATS
        results[part]["load"] = os.getloadavg()[0]
        kept.write_text(json.dumps(results, indent=1) + "\n")
    import tables

    tables.write(HERE / "README.md", results)


if __name__ == "__main__":
    main()
