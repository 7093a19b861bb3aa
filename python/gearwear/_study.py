"""The study: its text, checked at every change."""

import json
import tempfile
from pathlib import Path

from . import _gearwear, _run
from ._results import Result

try:
    import tomllib
except ImportError:  # Python 3.10
    import tomli as tomllib


class Study:
    """A study file. Values are read and set by their keys: `study["operation.torque"] = 120.0`, also those of effects
    (`study["running_in.amplitude"]`). The file itself stays as it is until `write`."""

    def __init__(self, text, path):
        self._path = Path(path).absolute()
        _gearwear.check(text, str(self._path))
        self._text = text

    @classmethod
    def read(cls, path):
        """Reads a study file. Raises `StudyError` with file, line and key."""
        path = Path(path)
        return cls(path.read_text(encoding="utf-8-sig"), path)

    @classmethod
    def from_toml(cls, text, folder="."):
        """A study from its text; relative paths in it start from `folder`."""
        return cls(text, Path(folder) / "study.toml")

    @property
    def text(self):
        """The study as it stands, comments and all."""
        return self._text

    @property
    def path(self):
        """The file it was read from, or would stand in."""
        return self._path

    def to_dict(self):
        """All that the text states, as a dictionary."""
        return tomllib.loads(self._text)

    def __getitem__(self, key):
        value = self.to_dict()
        head, _, name = key.rpartition(".")
        for effect in value.get("effect", []):
            if head and head in (effect.get("name"), effect.get("kind")) and name in effect:
                return effect[name]
        try:
            for part in key.split("."):
                value = value[part]
        except (KeyError, TypeError):
            raise KeyError(f"{key}: the study does not state it") from None
        return value

    def __setitem__(self, key, value):
        self._text = _gearwear.put(self._text, str(self._path), key, toml(value))

    def write(self, path):
        """Writes the study to a file, with its paths as they are from there."""
        path = Path(path)
        path.write_text(self._placed(path.absolute().parent), encoding="utf-8")

    def _placed(self, folder):
        if folder == self._path.parent:
            return self._text
        return _gearwear.moved(self._text, str(self._path), str(folder))

    def _command(self, name, output, arguments, progress):
        with tempfile.TemporaryDirectory(prefix="gearwear-") as home:
            file = Path(home) / "study.toml"
            file.write_text(self._placed(Path(home)), encoding="utf-8")
            held = None
            if output is None:
                held = tempfile.TemporaryDirectory(prefix=f"gearwear-{name}-")
                output = Path(held.name) / name
            quiet = [] if progress else ["--quiet"]
            _run.run([name, str(file), "-o", str(output), *arguments, *quiet], progress)
        return Result(output, held)

    def run(self, output=None, test=None, progress=True):
        """Mesh, contact and wear history: `gearwear run`. Without `output` the result lives as long as the object."""
        return self._command("run", output, ["--test", test] if test else [], progress)

    def models(self, output=None, progress=True):
        """The contact models side by side: `gearwear models`."""
        return self._command("models", output, [], progress)

    def compare(self, output=None, progress=True):
        """The fitted model against the measurements: `gearwear compare`."""
        return self._command("compare", output, [], progress)

    def diagnose(self, output=None, progress=True):
        """Which effect is missing: `gearwear diagnose`."""
        return self._command("diagnose", output, [], progress)

    def climb(self, output=None, progress=True):
        """One missing effect after the other: `gearwear climb`."""
        return self._command("climb", output, [], progress)

    def synthesize(self, output, noise=0.02, seed=1, progress=True):
        """Measurements of the study's own model in the folder `output`; returns the study that names them."""
        self._command("synthesize", output, ["--noise", repr(noise), "--seed", str(seed)], progress)
        return Study.read(Path(output) / "study.toml")

    def add(self, effect, output, progress=True, **values):
        """The study with one more effect, fitted to the measurements unless its values are given; written to the file `output`."""
        given = [part for name, value in values.items() for part in ("--set", f"{name}={value!r}")]
        with tempfile.TemporaryDirectory(prefix="gearwear-") as home:
            file = Path(home) / "study.toml"
            file.write_text(self._placed(Path(home)), encoding="utf-8")
            quiet = [] if progress else ["--quiet"]
            _run.run(["add", str(file), effect, "-o", str(output), "--force", *given, *quiet], progress)
        return Study.read(output)

    def __repr__(self):
        return f"<gearwear study {self._path}>"


def toml(value):
    """A value as TOML writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(one) for one in value) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    number = float(value)
    return str(int(value)) if number.is_integer() and isinstance(value, int) else repr(number)
