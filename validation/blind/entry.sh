#!/bin/sh
# Packs blind data for other groups to try their methods on: data without answers, answers apart, rules, scorer, what gearwear and three simple judges
# make of it.
#
#   validation/blind/entry.sh FOLDER [SEED]
#
# SEED (901): any number makes new sets nobody has seen. SETS (10): sets of each class. BLIND, GEARWEAR: the programs (default: beside this script, and
# beside the repository's root). DATA, RESULTS: sets made and diagnosed before; both are made here otherwise. What exists is skipped, so it can be stopped and
# started again.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=$1
seed=${2:-901}
count=${SETS:-10}
blind=${BLIND:-$here/target/debug/blind}
mkdir -p "$out"
data=${DATA:-$out/.sets}
results=${RESULTS:-$out/.results}
if [ -z "${DATA:-}" ]; then
    from=0
    for class in none single foreign outside pair mixed three face teeth force; do
        nice -n 19 "$blind" make --out "$data" --seed "$seed" --class $class --from $from --count "$count" >>"$out/.made.txt"
        from=$((from + 1000))
    done
fi
[ -n "${RESULTS:-}" ] || MODEL=${MODEL:-middle} "$here/run.sh" "$data" "$results"
for set in "$data"/*/; do
    name=$(basename "$set")
    [ -f "$set/truth.json" ] || continue
    mkdir -p "$out/data/$name" "$out/answers/$name"
    cp "$set/study.toml" "$set/measurements.csv" "$out/data/$name/"
    cp "$set/truth.json" "$set/sealed.toml" "$set/sealed.csv" "$out/answers/$name/"
done
mkdir -p "$out/scorer"
cp -r "$here/src" "$here/Cargo.toml" "$here/Cargo.lock" "$out/scorer/"
cp "$here/entry_rules.md" "$out/README.md"
{
    echo "# gearwear and three simple judges"
    echo
    "$blind" score "$out/answers" --results "$results"
} >"$out/SCORE.md"
echo "$(ls "$out/data" | wc -l) sets in $out"
