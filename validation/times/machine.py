"""What this machine can do at most, on one thread: floating-point operations in a dense product of matrices, bytes moved in a copy. Needs numpy.

Run on its own it prints both as JSON; times.py starts it without the settings by which some systems choose an older kernel of OpenBLAS."""

import json
import time

import numpy as np


def least(work, times):
    spent = []
    for _ in range(times):
        begun = time.process_time()
        work()
        spent.append(time.process_time() - begun)
    return min(spent)


def flops(n=1500):
    a, b = np.random.default_rng(1).random((2, n, n))
    return 2.0 * n**3 / least(lambda: a @ b, 8)


def bandwidth(n=25_000_000):
    a, b = np.ones(n), np.zeros(n)

    def copy():
        b[:] = a

    return 2.0 * a.nbytes / least(copy, 8)


def model():
    with open("/proc/cpuinfo") as text:
        return next((line.split(":")[1].strip() for line in text if line.startswith("model name")), "unknown")


if __name__ == "__main__":
    print(json.dumps({"processor": model(), "flops": flops(), "bytes_per_second": bandwidth()}))
