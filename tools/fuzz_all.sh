#!/bin/sh
# Runs each reader's fuzzer for a number of executions, one after the other, and prints a table.
#   tools/fuzz_all.sh BUILD_DIR WORK_DIR [RUNS [PARSER...]]
# BUILD_DIR was configured with -DCAMBER_FUZZ=ON (tests/fuzz/CMakeLists.txt). WORK_DIR keeps the
# corpora, the logs and any input that is a finding; a second run goes on from its corpora with
# another seed, and the table counts all runs: ten times a million is as good as ten million.
# Fails if there is a finding. Limits: 10 s an input; 4 times the file plus 64 MiB of memory
# (tests/fuzz/one_input.hpp counts it); leaks, undefined behaviour and wrong addresses end a run.
set -eu
build=$1
work=$2
runs=${3:-10000000}
if [ $# -gt 3 ]; then
  shift 3
else
  set -- stl ugrid su2 meshb meshlink vtu gmsh
fi
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/tools/fuzz_seeds.py" "$work/seeds"
# -entropic=0: its bookkeeping took 40 % of the time of the SU2 fuzzer.
# Faster, and not weaker: short stacks of allocations, a small quarantine, no second copy of stacks.
export ASAN_OPTIONS=malloc_context_size=3:quarantine_size_mb=8:detect_stack_use_after_return=0
printf '| parser | runs | of all | seconds | runs/s | peak RSS, MB | finding |\n|---|---|---|---|---|---|---|\n'
status=0
for parser; do
  mkdir -p "$work/corpus/$parser" "$work/found/$parser"
  log=$work/$parser.log
  start=$(date +%s)
  finding=none
  nice -n 19 "$build/tests/fuzz/fuzz_$parser" -runs="$runs" -max_len=1024 -timeout=10 \
    -rss_limit_mb=1024 -use_value_profile=0 -entropic=0 -print_final_stats=1 \
    -artifact_prefix="$work/found/$parser/" "$work/corpus/$parser" "$work/seeds/$parser" \
    > /dev/null 2> "$log" || {
    finding=$(ls "$work/found/$parser" | tail -1)
    status=1
  }
  seconds=$(($(date +%s) - start))
  done_runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  total=$(($(cat "$work/$parser.total" 2> /dev/null || echo 0) + ${done_runs:-0}))
  echo "$total" > "$work/$parser.total"
  rss=$(sed -n 's/^stat::peak_rss_mb: *//p' "$log")
  printf '| %s | %s | %s | %s | %s | %s | %s |\n' "$parser" "${done_runs:-0}" "$total" "$seconds" \
    "$((${done_runs:-0} / (seconds > 0 ? seconds : 1)))" "${rss:-?}" "$finding"
done
exit $status
