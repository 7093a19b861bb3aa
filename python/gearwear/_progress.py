"""How far something is: the program's own line in a terminal and below a notebook's cell, a line of the same kind for `simulate`."""

import os
import re
import subprocess
import sys
import threading

# what a terminal does, but for going back to the start of the line
CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
CLEARED = "\x1b[2K"


def in_terminal():
    return sys.stderr is sys.__stderr__ and sys.stderr.isatty()


def in_notebook():
    return "ipykernel" in sys.modules and sys.stderr is not sys.__stderr__ and os.name == "posix"


def written_below_the_cell(command):
    """Runs a command that thinks its errors go to a terminal, and shows below the cell what it writes there; returns its code, output and last words."""
    import pty

    master, slave = pty.openpty()
    environment = {**os.environ, "NO_COLOR": "1", "TERM": "xterm"}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=slave, text=True, encoding="utf-8", env=environment)
    os.close(slave)
    written = bytearray()
    shown = sys.stderr

    def show():
        while True:
            try:
                piece = os.read(master, 4096)
            except OSError:
                return
            if not piece:
                return
            written.extend(piece)
            text = piece.decode("utf-8", errors="ignore")
            # a line that is written again begins where it began
            shown.write(CONTROL.sub("", text.replace(CLEARED, "\r")))
            shown.flush()

    reader = threading.Thread(target=show, daemon=True)
    reader.start()
    try:
        out, _ = process.communicate()
    except BaseException:
        process.terminate()
        process.wait()
        raise
    finally:
        reader.join(timeout=2)
        os.close(master)
    words = written.decode("utf-8", errors="replace").rpartition(CLEARED)[2]
    return process.returncode, out, CONTROL.sub("", words).replace("\r\n", "\n")


def line(done, count):
    """The progress of `simulate`: `simulate(..., progress=True)`."""
    width = 30
    full = width * done // max(count, 1)
    end = "\n" if done >= count else ""
    sys.stderr.write(f"\r{done} of {count} histories [{'=' * full}{' ' * (width - full)}]{end}")
    sys.stderr.flush()
