#!/usr/bin/env bash
# A wheel for this machine's Linux and every Python from 3.10 on, in python/dist.
set -euo pipefail
cd "$(dirname "$0")"
python3 -m pip install --quiet "maturin>=1.7,<2"
python3 -m maturin build --release --out dist
ls -l dist
