"""The program itself: `gearwear` on the path, and `python -m gearwear`."""

import signal
import sys

from . import _gearwear


def main():
    # Ctrl-C ends the program as it would have ended without Python
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_gearwear.main(["gearwear", *sys.argv[1:]]))
