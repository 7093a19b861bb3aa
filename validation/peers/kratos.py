"""One mesh position by Kratos Multiphysics, in a process of its own (kratos_position.py)."""

import importlib.util
import json
import os
import sys
from pathlib import Path

from spent import timed

NAME = "Kratos"
PACKAGES = ("KratosMultiphysics", "KratosStructuralMechanicsApplication", "KratosContactStructuralMechanicsApplication", "KratosLinearSolversApplication")


def absent():
    """Why this peer cannot run here, or nothing."""
    if importlib.util.find_spec("KratosMultiphysics") is None:
        return f"its Python packages are not installed (pip install {' '.join(PACKAGES)})"
    return None


def solve(file, deck, folder):
    folder.mkdir(parents=True, exist_ok=True)
    script = Path(__file__).with_name("kratos_position.py")
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    seconds = timed([sys.executable, script, file, "answer.json"], folder / "log.txt", cwd=folder, env=environment)
    return {**json.loads((folder / "answer.json").read_text()), "processor_seconds": seconds}
