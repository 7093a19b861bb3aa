"""Many wear histories at once."""

from dataclasses import dataclass

import numpy
import pandas

from . import _gearwear, _progress


@dataclass
class Simulated:
    """The measured rows of N histories.

    `values`: N x M doubles, a NaN row where a history failed. `reasons`: N texts or None. `jacobian`: N x M x p derivatives per unit of the
    parameters, exact along each history's steps, or None. `rows`: where the M rows stand, with what was measured there.
    """

    values: numpy.ndarray
    reasons: list
    jacobian: "numpy.ndarray | None"
    rows: pandas.DataFrame

    def __array__(self, dtype=None, copy=None):
        return numpy.array(self.values, dtype=dtype)

    def __len__(self):
        return len(self.values)


def simulate(study, names, theta, jacobian=False, progress=None):
    """The measured rows of `study` at every row of `theta` (N x p: a column for each of `names`, such as "wear.coefficient" or
    "running_in.amplitude", in their units), on all cores.

    `progress(done, count)` is called as it goes on, True shows a line of it; Ctrl-C stops it after the histories under way. Raises `StudyError` if the study cannot be used;
    single histories that fail are NaN rows with reasons.
    """
    names = list(names)
    theta = numpy.ascontiguousarray(theta, dtype=float)
    if theta.ndim == 1 and len(names) == 1:
        theta = theta[:, None]
    if theta.ndim != 2 or theta.shape[1] != len(names):
        raise ValueError(f"theta has the shape {theta.shape}; it is N x {len(names)}, a column for each of {names}")
    if isinstance(progress, bool):
        progress = _progress.line if progress else None
    found = _gearwear.simulate(study.text, str(study.path), names, theta.tobytes(), jacobian, progress)
    rows = pandas.DataFrame(found["rows"])
    shape = (len(theta), len(rows))

    def array(name, *more):
        return numpy.frombuffer(found[name], dtype=float).reshape(*shape, *more).copy()

    return Simulated(
        values=array("values"),
        reasons=found["reasons"],
        jacobian=array("jacobian", len(names)) if jacobian else None,
        rows=rows,
    )
