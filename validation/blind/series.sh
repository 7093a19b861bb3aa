#!/bin/sh
# Makes the benchmark's data: 620 sets, seeds 101 to 105. What exists is skipped, so it can be stopped and started again.
#
#   validation/blind/series.sh FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
blind=${BLIND:-$here/target/debug/blind}
out=$1
make() {
    nice -n 19 "$blind" make --out "$out" "$@"
}
# In rounds, so that a part of the series is a fair part of the whole.
for round in 0 1 2 3 4 5 6 7 8 9; do
    make --class none --seed 101 --from $((round * 21)) --count 21
    make --class single --seed 102 --from $((round * 12)) --count 12 --rivals
    make --class foreign --seed 103 --from $((round * 15)) --count 15 --rivals
    make --class outside --seed 104 --from $((round * 8)) --count 8 --rivals
    make --class pair --seed 105 --from $((round * 6)) --count 6
done
