"""The package does what the program does: the same bits, errors with their places, interruptions."""

import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
import urllib.request
from pathlib import Path

import numpy
import pandas
import pytest

import gearwear as gw

GEARS = """
title = "coarse"
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
torque = 100.0  # kept
speed = 2000.0
[wear]
coefficient = 3e-10
cycles = 4e5
[model]
contact = "hertz"
[numerics]
elements_per_half_width = 2
positions = 24
stored_states = 1
fields = 0
"""
RUNNING_IN = """
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
NAMES = ["wear.coefficient", "running_in.amplitude"]


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """A study with measurements of its own model."""
    folder = tmp_path_factory.mktemp("made") / "made"
    return gw.Study.from_toml(GEARS + RUNNING_IN).synthesize(folder, noise=0.02, seed=3, progress=False)


def test_values_are_read_and_set_and_nothing_else_changes(tmp_path):
    study = gw.Study.from_toml(GEARS + RUNNING_IN)
    assert study["operation.torque"] == 100.0
    assert study["running_in.amplitude"] == 3.0
    study["operation.torque"] = 120.0
    study["running_in.amplitude"] = 2.5
    study["model.contact"] = "fem"
    study["numerics.positions"] = 30
    assert study["operation.torque"] == 120.0 and study["running_in.amplitude"] == 2.5
    assert "# kept" in study.text
    with pytest.raises(KeyError):
        study["operation.misalignment"]
    study["operation.misalignment"] = 0.1
    study.write(tmp_path / "other.toml")
    assert gw.Study.read(tmp_path / "other.toml").to_dict() == study.to_dict()


def test_errors_have_their_places(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(GEARS.replace("torque = 100.0", "torqe = 100.0"))
    with pytest.raises(gw.StudyError) as caught:
        gw.Study.read(path)
    line = 1 + GEARS[: GEARS.index("torque")].count("\n")
    assert (caught.value.file, caught.value.line) == (str(path), line)
    assert caught.value.key == "operation.torqe" and "torque" in str(caught.value)
    study = gw.Study.from_toml(GEARS)
    with pytest.raises(gw.StudyError) as caught:
        study["operation.torque"] = -5.0
    assert caught.value.key == "operation.torque"
    # nothing has changed
    assert study["operation.torque"] == 100.0
    with pytest.raises(gw.GearwearError) as caught:
        study.compare(progress=False)
    assert caught.value.code == 2


def test_a_run_is_the_programs(tmp_path):
    study = gw.Study.from_toml(GEARS, tmp_path)
    study["wear.cycles"] = 20000
    result = study.run(progress=False)
    study.write(tmp_path / "study.toml")
    command = [sys.executable, "-m", "gearwear", "run", "study.toml", "-o", "out", "--quiet"]
    subprocess.run(command, cwd=tmp_path, check=True)
    assert (result.folder / "wear.csv").read_bytes() == (tmp_path / "out/wear.csv").read_bytes()
    assert list(result.wear.columns) == ["cycles", "member", "radius", "path", "depth"]
    document = json.loads((tmp_path / "out/summary.json").read_text())
    assert result.summary["wear"] == document["wear"]
    deepest = result.wear[result.wear.member == "pinion"].depth.max()
    assert deepest == pytest.approx(document["wear"]["pinion"]["max_depth_um"], rel=1e-3)
    assert "<svg" in result._repr_html_()
    kept = gw.Result(tmp_path / "out")
    assert "contact" in kept.tables and isinstance(kept.contact, pandas.DataFrame)


def test_compare_finds_what_was_put_in(measured):
    result = measured.compare(progress=False)
    for parameter, truth in zip(result.summary["parameters"], [3e-10, 3.0]):
        assert abs(parameter["value"] - truth) < 4 * parameter["sigma"], parameter


def test_simulated_rows_are_the_servers_to_the_bit(measured):
    """The server is the program's; its numbers come through JSON with all their bits."""
    theta = numpy.array([[3e-10, 3.0], [2e-10, 1.5], [5e-10, 0.7]])
    ours = gw.simulate(measured, NAMES, theta, jacobian=True)
    command = [sys.executable, "-m", "gearwear", "serve", str(measured.path), "--port", "0"]
    server = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        url = re.search(r"http://\S+", server.stderr.readline())[0]

        def ask(path, **body):
            request = urllib.request.Request(url + path, json.dumps({"name": "forward", **body}).encode())
            return json.load(urllib.request.urlopen(request))["output"]

        for point, values, jacobian in zip(theta.tolist(), ours.values, ours.jacobian):
            assert ask("/Evaluate", input=[point])[0] == values.tolist()
            for column, vector in enumerate([[1.0, 0.0], [0.0, 1.0]]):
                moved = ask("/ApplyJacobian", input=[point], outWrt=0, inWrt=0, vec=vector)
                assert numpy.allclose(moved, jacobian[:, column], rtol=1e-13, atol=0)
    finally:
        server.terminate()
        assert server.wait() == 0
    assert ours.reasons == [None] * 3
    # the same alone, and with derivatives or without
    alone = gw.simulate(measured, NAMES, theta[1:2])
    assert (alone.values == ours.values[1:2]).all()
    assert list(ours.rows.columns) == ["test", "member", "cycles", "quantity", "position", "value", "sigma"]
    # at the truth the rows are what was measured, but for noise and datum (0.5 µm)
    depth = (ours.rows.quantity == "wear_depth").to_numpy()
    off = ours.values[0][depth] - ours.rows.value[depth]
    assert numpy.abs(off).mean() < 1.0


def test_failures_are_rows_with_reasons(measured):
    found = gw.simulate(measured, NAMES, [[3e-10, 3.0], [-1.0, 3.0], [2e-10, 3.0]], jacobian=True)
    for fine in (0, 2):
        assert numpy.isfinite(found.values[fine]).all() and numpy.isfinite(found.jacobian[fine]).all()
        assert found.reasons[fine] is None
    assert numpy.isnan(found.values[1]).all() and numpy.isnan(found.jacobian[1]).all()
    assert "wear.coefficient = -1 is out of range" in found.reasons[1]
    with pytest.raises(ValueError):
        gw.simulate(measured, NAMES, [[1.0, 2.0, 3.0]])
    with pytest.raises(gw.StudyError):
        gw.simulate(measured, ["no.such"], [[1.0]])


def test_others_run_meanwhile_and_ctrl_c_stops(measured):
    # also where the tests themselves run in the background of a shell, which leaves Ctrl-C ignored
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        ctrl_c_stops(measured)
    finally:
        signal.signal(signal.SIGINT, before)


def ctrl_c_stops(measured):
    theta = numpy.tile([3e-10, 3.0], (100_000, 1))
    told = []
    ticks = []

    def tick():
        while len(ticks) < 5:
            ticks.append(time.monotonic())
            time.sleep(0.05)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=tick)
    thread.start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        gw.simulate(measured, NAMES, theta, progress=lambda done, count: told.append((done, count)))
    thread.join()
    assert time.monotonic() - begun < 20
    assert told and told[-1][1] == 100_000 and told[-1][0] < 100_000
    assert len(ticks) == 5


def test_progress_is_a_line(measured, capsys):
    gw.simulate(measured, NAMES, [[3e-10, 3.0]] * 3, progress=True)
    told = capsys.readouterr().err
    assert told.startswith("\r") and told.endswith("3 of 3 histories [==============================]\n")
    gw.simulate(measured, NAMES, [[3e-10, 3.0]], progress=False)
    assert capsys.readouterr().err == ""


def test_the_program_is_on_the_path():
    program = Path(sys.executable).with_name("gearwear")
    command = [str(program)] if program.exists() else [sys.executable, "-m", "gearwear"]
    out = subprocess.run([*command, "--version"], capture_output=True, text=True, check=True).stdout
    assert out.split() == ["gearwear", gw.__version__]
    assert subprocess.run([*command, "rum"], capture_output=True).returncode == 2
