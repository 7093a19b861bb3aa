#!/usr/bin/env bash
# Fuzzes every reader: RUNS executions each (ten million if not stated), of at most five seconds and 1 GiB. Goes on from the corpus that an earlier run left.
#
#   validation/fuzz/run.sh              all readers, one after another
#   RUNS=100000 validation/fuzz/run.sh study formula
#   TIME=600 validation/fuzz/run.sh         no longer than ten minutes each
#   TIMEOUT=120 nice -n 19 validation/fuzz/run.sh   beside other work: the five seconds are those of the clock
#
# Wants cargo-fuzz (`cargo install cargo-fuzz`). Coverage needs switches that stable compilers take with RUSTC_BOOTSTRAP only.
set -euo pipefail
cd "$(dirname "$0")"
runs=${RUNS:-10000000}
readers=("$@")
if [ ${#readers[@]} = 0 ]; then
  readers=(study measurements tests_table profile lead import formula msh vtu checkpoint)
fi
export RUSTC_BOOTSTRAP=1
cargo fuzz build --fuzz-dir . --sanitizer none readers
for reader in "${readers[@]}"; do
  mkdir -p "corpus/$reader" "artifacts/$reader"
  echo "== $reader: $runs runs"
  READER=$reader cargo fuzz run --fuzz-dir . --sanitizer none readers "corpus/$reader" "seeds/$reader" -- \
    -runs="$runs" -max_total_time="${TIME:-0}" -timeout="${TIMEOUT:-5}" -rss_limit_mb=1024 -max_len=20000 -dict=words.dict \
    -artifact_prefix="artifacts/$reader/" -print_final_stats=1 -verbosity=0
done
