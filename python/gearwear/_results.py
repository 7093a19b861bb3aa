"""Result folders as frames and dictionaries."""

import html
import json
from pathlib import Path

import pandas

# the documents that a command leaves, the first one that is there is the result's own
DOCUMENTS = ["summary.json", "models.json", "comparison.json", "diagnosis.json", "climb.json", "ladder.json", "sweep.json"]


class Result:
    """A finished result folder: its tables by their names (`result.wear` is wear.csv), its document as `result.summary`."""

    def __init__(self, folder, held=None):
        self.folder = Path(folder)
        # keeps a folder that is not the user's own until nobody needs it
        self._held = held

    @property
    def tables(self):
        """Names of the tables."""
        return sorted(path.stem for path in self.folder.glob("*.csv"))

    @property
    def summary(self):
        """The document of the command as a dictionary."""
        for name in DOCUMENTS:
            path = self.folder / name
            if path.is_file():
                return json.loads(path.read_text(encoding="utf-8"))
        raise FileNotFoundError(f"{self.folder} holds none of {', '.join(DOCUMENTS)}")

    def table(self, name):
        """A table as a frame with the columns of its file."""
        # numbers are read to the last bit; from 3.0 on pandas does it of itself
        old = int(pandas.__version__.split(".")[0]) < 3
        exact = {"float_precision": "round_trip"} if old else {}
        return pandas.read_csv(self.folder / f"{name}.csv", comment="#", **exact)

    def __getattr__(self, name):
        if not name.startswith("_") and (self.folder / f"{name}.csv").is_file():
            return self.table(name)
        raise AttributeError(f"{name}: the tables of this result are {', '.join(self.tables)}")

    def __dir__(self):
        return [*super().__dir__(), *self.tables]

    def fields(self, number=-1):
        """A state of the fields as a PyVista mesh, or one of meshio where PyVista is not installed; by default the last."""
        paths = sorted((self.folder / "fields").glob("*.vtu"))
        if not paths:
            raise FileNotFoundError("the run wrote no fields; see [numerics] fields")
        try:
            import pyvista
        except ImportError:
            import meshio

            return meshio.read(paths[number])
        return pyvista.read(paths[number])

    def __repr__(self):
        return f"<gearwear result in {self.folder}: {', '.join(self.tables)}>"

    def _repr_html_(self):
        pictures = sorted(self.folder.rglob("*.svg"))
        shown = "".join(path.read_text(encoding="utf-8") for path in pictures[:6])
        return f"<p><b>{html.escape(str(self.folder))}</b>: {html.escape(', '.join(self.tables))}</p>{shown}"
