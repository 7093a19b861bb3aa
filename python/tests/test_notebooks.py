"""The notebooks run from the first cell to the last; skipped without jupyter, and each without what it imports."""

import base64
import importlib.util
import io
import re
from pathlib import Path

import pytest
from test_gearwear import GEARS

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

NOTEBOOKS = sorted((Path(__file__).parent.parent / "notebooks").glob("*.ipynb"))
# modules imported at the start of a line; one that a cell tries is indented
IMPORTS = re.compile(r"^(?:import|from) (\w+)", re.MULTILINE)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_runs(path, tmp_path):
    notebook = nbformat.read(path, as_version=4)
    code = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "code")
    missing = sorted({name for name in IMPORTS.findall(code) if importlib.util.find_spec(name) is None})
    if missing:
        pytest.skip(f"not installed: {', '.join(missing)} (pip install './python[notebooks]')")
    run(notebook, tmp_path)


def run(notebook, folder):
    nbclient.NotebookClient(notebook, timeout=900, resources={"metadata": {"path": str(folder)}}).execute()


def test_the_first_study_draws_its_fields(tmp_path):
    """Stress, pressure and worn flanks: pictures that show more than a ground and a body of one colour."""
    pytest.importorskip("pyvista")
    image = pytest.importorskip("PIL.Image")
    notebook = nbformat.read(NOTEBOOKS[0].parent / "first_wear_study.ipynb", as_version=4)
    run(notebook, tmp_path)
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    drawn = [output.data["image/png"] for output in outputs if "image/png" in output.get("data", {})]
    assert len(drawn) == 3
    for text in drawn:
        picture = image.open(io.BytesIO(base64.b64decode(text))).convert("RGB")
        assert len(picture.getcolors(picture.width * picture.height)) > 100


def test_a_cell_tells_how_far_it_is(tmp_path):
    """The program's own progress stands below the cell, and an error of its own is the exception as ever."""
    source = f"""
import gearwear as gw
study = gw.Study.from_toml({GEARS!r})
run = study.run()
try:
    study.compare()
except gw.GearwearError as error:
    print(error.code, error)
"""
    cell = nbformat.v4.new_code_cell(source)
    run(nbformat.v4.new_notebook(cells=[cell]), tmp_path)
    told = {}
    for output in cell.outputs:
        told[output.name] = told.get(output.name, "") + output.text
    assert "%" in told["stderr"] and "\x1b" not in told["stderr"], told
    assert told["stdout"].startswith("2 error: ") and "\x1b" not in told["stdout"], told


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_is_kept_without_outputs(path):
    for cell in nbformat.read(path, as_version=4).cells:
        assert not cell.get("outputs") and cell.get("execution_count") is None
