"""Finite-element contact and wear of spur and helical gears, and what the model lacks when measurements disagree.

>>> import gearwear as gw
>>> study = gw.Study.read("study.toml")
>>> study["wear.coefficient"] = 3e-10
>>> run = study.run()
>>> run.wear                    # a pandas frame with the columns of wear.csv
>>> gw.simulate(study, ["wear.coefficient"], theta).values
"""

from ._errors import GearwearError, StudyError
from ._gearwear import __version__
from ._results import Result
from ._simulate import Simulated, simulate
from ._study import Study

__all__ = [
    "GearwearError",
    "Result",
    "Simulated",
    "Study",
    "StudyError",
    "__version__",
    "simulate",
]
