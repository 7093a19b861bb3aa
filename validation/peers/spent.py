"""Runs a program and tells its processor time (user and system), which other work on the machine changes far less than the clock does."""

import resource
import subprocess


def timed(command, log, **keys):
    """Processor seconds of `command`, whose words go to the file `log`."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(log, "w") as words:
        subprocess.run([str(word) for word in command], check=True, stdout=words, stderr=subprocess.STDOUT, **keys)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
