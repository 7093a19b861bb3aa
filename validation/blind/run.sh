#!/bin/sh
# Diagnoses every data set of a folder with gearwear, in parts; what is done is skipped.
#
#   validation/blind/run.sh DATA RESULTS [PART/PARTS] [-- more arguments of `gearwear diagnose`]
#
# GEARWEAR: the program (default target/debug/gearwear beside the repository's root). TIMEOUT: seconds per set (900).
# MODEL=screening|middle|full is `--fidelity` (full); MODEL=mixed is full for every fifth set and middle for the others.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
data=$1
results=$2
shift 2
part=1
parts=1
if [ $# -gt 0 ] && [ "$1" != "--" ]; then
    part=${1%/*}
    parts=${1#*/}
    shift
fi
[ "${1:-}" != "--" ] || shift
program=${GEARWEAR:-$here/../../target/debug/gearwear}
model=${MODEL:-full}
mkdir -p "$results"
count=0
for set in "$data"/*/; do
    name=$(basename "$set")
    [ -f "$set/truth.json" ] || continue
    count=$((count + 1))
    [ $(((count - 1) % parts + 1)) -eq "$part" ] || continue
    [ -f "$results/$name/diagnosis.json" ] && continue
    # Only what a user would have goes to the program.
    work=$results/.$name.work
    rm -rf "$work"
    mkdir -p "$work"
    cp "$set/measurements.csv" "$work/"
    kind=$model
    if [ "$model" = mixed ]; then
        kind=middle
        [ $((count % 5)) -ne 0 ] || kind=full
    fi
    cp "$set/study.toml" "$work/"
    start=$(date +%s)
    if timeout "${TIMEOUT:-900}" nice -n 19 "$program" --quiet --json diagnose --fidelity "$kind" "$work/study.toml" -o "$work/out" "$@" >"$work/stdout.json" 2>"$work/stderr.txt"; then
        mkdir -p "$results/$name"
        echo "$kind $(($(date +%s) - start))" >"$results/$name/seconds.txt"
        if [ -f "$work/out/diagnosis.json" ]; then
            mv "$work/out/diagnosis.json" "$results/$name/diagnosis.json"
        else
            mv "$work/stdout.json" "$results/$name/diagnosis.json"
        fi
        echo "$name done ($kind, $(($(date +%s) - start)) s)"
    else
        code=$?
        mkdir -p "$results/failed"
        cp "$work/stderr.txt" "$results/failed/$name.txt"
        echo "$name failed with exit code $code, see $results/failed/$name.txt" >&2
    fi
    rm -rf "$work"
done
