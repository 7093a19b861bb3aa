"""Commands as the program does them, in a process of their own: Ctrl-C ends it, and nothing is left behind."""

import re
import subprocess
import sys

from . import _progress
from ._errors import GearwearError, StudyError

PLACE = re.compile(r"--> (?P<file>.*?):(?P<line>\d+):(?P<column>\d+)")


def run(arguments, progress):
    """Runs the program; returns what it prints on standard output. `progress` shows its progress in a terminal or a notebook."""
    command = [sys.executable, "-m", "gearwear", *arguments]
    if progress and _progress.in_notebook():
        code, out, message = _progress.written_below_the_cell(command)
        if code != 0:
            raise error(message, code)
        return out
    err = None if progress and _progress.in_terminal() else subprocess.PIPE
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=err, text=True, encoding="utf-8")
    try:
        out, message = process.communicate()
    except BaseException:
        process.terminate()
        process.wait()
        raise
    if process.returncode != 0:
        raise error(message or "the program came to no result; its message stands above", process.returncode)
    return out


def error(message, code):
    """The exception for a message of the program."""
    message = message.strip()
    place = PLACE.search(message)
    if place is None:
        return GearwearError(message, code)
    key = re.search(r"`([\w.\[\]]+)`", message)
    return StudyError(
        message,
        file=place["file"],
        line=int(place["line"]),
        column=int(place["column"]),
        key=key[1] if key else "",
    )
