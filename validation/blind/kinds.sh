#!/bin/sh
# Makes the sets of seed 831: some of every cause across the face, tooth by tooth and through forces. What exists is skipped.
#
#   validation/blind/kinds.sh FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
blind=${BLIND:-$here/target/debug/blind}
out=$1
# index, noise, wanted d, where traces are taken, whether the file says so, cause; more arguments of `blind make`
while read -r index noise d trace stated law more; do
    # shellcheck disable=SC2086
    nice -n 10 "$blind" make --out "$out" --seed 831 --from "$index" --noise "$noise" --d "$d" --trace "$trace" --stated "$stated" --law "$law" $more </dev/null
done <<'LIST'
0 0.02 60 mid false lead_misalignment:wedge
1 0.05 20 mid true lead_misalignment:wedge
2 0.02 60 loaded false lead_misalignment:wedge
3 0.05 20 loaded true lead_misalignment:wedge
4 0.02 100 open false lead_misalignment:wedge
5 0.05 30 open true lead_misalignment:wedge
6 0.02 30 mean false lead_misalignment:wedge
7 0.02 100 three true lead_misalignment:wedge
8 0.05 40 three true lead_misalignment:bent
9 0.02 15 loaded false lead_misalignment:wedge --gear paper
10 0.02 30 mean true lead_misalignment:wedge --mesh
20 0.02 60 mid false lead_crowning:parabola
21 0.05 20 mid true lead_crowning:parabola
22 0.02 40 loaded false lead_crowning:parabola
23 0.02 100 three true lead_crowning:parabola
24 0.05 30 three true lead_crowning:end_relief
25 0.02 30 mean false lead_crowning:parabola --mesh
40 0.02 100 mid true pitch_error:one_tooth
41 0.02 30 mid false pitch_error:one_tooth
42 0.05 30 mid false pitch_error:one_tooth
43 0.05 12 mid true pitch_error:one_tooth --gear paper
44 0.02 150 mid false pitch_error:one_tooth --gear paper
45 0.02 100 mid false pitch_error:alternate
46 0.05 30 mid true pitch_error:alternate
47 0.02 20 mid false pitch_error:alternate
48 0.05 60 mid false pitch_error:alternate
60 0.02 40 mid false run_out:indexing --gear paper
61 0.02 30 mid true run_out:indexing
62 0.05 15 mid false run_out:indexing
63 0.02 40 mid false run_out:eccentric --gear paper
64 0.02 20 mid true run_out:eccentric
65 0.05 20 mid false run_out:eccentric
80 0.02 60 mid false friction_load:coulomb --gear paper
81 0.02 25 mid false friction_load:coulomb
82 0.05 12 mid false friction_load:coulomb
83 0.02 60 mid false friction_load:recess
84 0.05 25 mid false friction_load:recess --gear paper
85 0.02 30 mid false friction_load:coulomb --mesh
100 0.02 12 mid false dynamic_load:mean_and_ripple --gear paper
101 0.02 12 mid false dynamic_load:mean_and_ripple
102 0.05 8 mid false dynamic_load:mean_and_ripple
103 0.05 10 mid false dynamic_load:mean_and_ripple
104 0.02 20 mid false dynamic_load:mean_and_ripple
105 0.02 12 mid false dynamic_load:mean_and_ripple --mesh
120 0.02 60 mid false energy_wear:mean_tooth_friction --gear paper
121 0.02 25 mid false energy_wear:mean_tooth_friction
122 0.05 12 mid false energy_wear:mean_tooth_friction
123 0.02 60 mid false energy_wear:rolling_and_sliding
124 0.05 25 mid false energy_wear:rolling_and_sliding
125 0.02 30 mid false energy_wear:mean_tooth_friction --mesh
140 0.02 30 loaded false lead_misalignment:wedge --mesh
141 0.02 30 mid false lead_crowning:parabola --mesh
142 0.02 30 mid false pitch_error:one_tooth --mesh
LIST
