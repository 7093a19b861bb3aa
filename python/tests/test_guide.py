"""The guide's lines for Python and samplers run as they stand there, one after the other, in an empty folder."""

import importlib.util
import os
import re
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

GUIDE = Path(__file__).resolve().parents[2] / "guide"
BLOCKS = re.compile(r"```(sh|python)\n(.*?)```", re.DOTALL)


def blocks(page):
    return BLOCKS.findall((GUIDE / page).read_text(encoding="utf-8"))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty folder, with the program on the path as `pip install` puts it there."""
    bin = tmp_path / "bin"
    bin.mkdir()
    (bin / "gearwear").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m gearwear "$@"\n')
    (bin / "gearwear").chmod(0o755)
    monkeypatch.setenv("PATH", f"{bin}{os.pathsep}{os.environ['PATH']}")
    home = tmp_path / "home"
    home.mkdir()
    monkeypatch.chdir(home)
    return home


def shell(lines):
    subprocess.run(["bash", "-euc", lines], check=True)


def test_the_page_on_python(folder):
    if not any(importlib.util.find_spec(name) for name in ("pyvista", "meshio")):
        pytest.skip("neither pyvista nor meshio is installed (pip install './python[fields]')")
    names = {}
    for language, text in blocks("python.md"):
        if language == "python":
            exec(text, names)
        elif "pip install" not in text:
            shell(text)
    assert names["found"].values.shape[0] == 20 and names["found"].reasons == [None] * 20


def test_the_page_on_clusters(folder, monkeypatch):
    """All but the lines for Slurm and for the program `hq`, which are no part of a Python environment."""
    start, *others = [text for language, text in blocks("cluster.md") if language == "sh"]
    (farm,) = [text for language, text in blocks("cluster.md") if language == "python"]
    smaller = {"saltelli:128": "saltelli:8", "sobol:256": "sobol:16", "--fidelity middle": "--fast"}

    def run(text):
        for long, short in smaller.items():
            text = text.replace(long, short)
        shell(text)

    run(start)
    monkeypatch.chdir(folder / "study")
    Path("farm.py").write_text(farm, encoding="utf-8")
    for text in others:
        if "sbatch" in text or "SBATCH" in text or text.startswith("hq "):
            continue
        if "farm.py" not in text:
            run(text)
        elif importlib.util.find_spec("hyperqueue"):
            run(text.replace("python3", sys.executable))
        else:
            run(text.splitlines()[0])  # the lines that the next block reads
    assert Path("whole/sweep.csv").exists() and Path("archive.out/diagnose-each/each.csv").exists()


def listens():
    try:
        urllib.request.urlopen("http://localhost:4242/Info")
    except OSError:
        return False
    return True


def test_the_page_on_samplers(folder):
    pytest.importorskip("emcee")
    pytest.importorskip("umbridge")
    (_, start), (_, sampling) = blocks("samplers.md")
    *lines, serve = start.splitlines()
    if listens():
        pytest.skip("something else listens at port 4242")
    shell("\n".join(lines))
    server = subprocess.Popen(["bash", "-euc", f"exec {serve}"], stderr=subprocess.DEVNULL)
    try:
        for _ in range(100):
            if listens():
                break
            time.sleep(0.1)
        names = {}
        # fewer steps than the page takes, all else as it stands
        exec(sampling.replace("start, 200", "start, 5"), names)
        assert names["sampler"].get_chain().shape == (5, 24, sum(names["sizes"]))
    finally:
        server.terminate()
        assert server.wait() == 0
