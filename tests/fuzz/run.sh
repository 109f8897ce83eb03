#!/usr/bin/env bash
# Runs fuzz targets of the preset fuzz for some seconds each, two at a time: tests/fuzz/run.sh SECONDS [TARGET ...]
# New inputs, those that fail, and logs go to build/fuzz/found/TARGET.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
seconds=${1:?usage: tests/fuzz/run.sh SECONDS [TARGET ...]}
targets=("${@:2}")
if [[ ${#targets[@]} -eq 0 ]]; then targets=(volume mesh_file config meshing); fi

# fuzz TARGET: its log, and 0 when no input failed.
# DELISO_FUZZ_SEED: of the random changes, each time another by default.
fuzz() {
  local found=build/fuzz/found/$1 corpus=tests/fuzz/corpus/$1 dictionary=()
  if [[ -f tests/fuzz/$1.dict ]]; then dictionary=("-dict=tests/fuzz/$1.dict"); fi
  mkdir -p "$found/inputs"
  ASAN_OPTIONS=malloc_context_size=8:quarantine_size_mb=16 \
    "build/fuzz/tests/fuzz/fuzz_$1" "$found/inputs" "$corpus" "${dictionary[@]}" "-max_total_time=$seconds" -timeout=60 \
    "-seed=${DELISO_FUZZ_SEED:-0}" \
    -rss_limit_mb=2000 -malloc_limit_mb=1000 "-artifact_prefix=$found/" -print_final_stats=1 >"$found/log" 2>&1
}

failed=()
for ((i = 0; i < ${#targets[@]}; i += 2)); do
  pids=()
  for target in "${targets[@]:i:2}"; do
    mkdir -p "build/fuzz/found/$target"
    fuzz "$target" &
    pids+=($!)
  done
  for n in "${!pids[@]}"; do
    target=${targets[i + n]}
    log=build/fuzz/found/$target/log
    if wait "${pids[n]}"; then
      printf '%s: %s runs, no input failed\n' "$target" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
    else
      failed+=("$target")
      tail -n 60 "$log"
    fi
  done
done
if [[ ${#failed[@]} -gt 0 ]]; then
  printf 'inputs failed: %s (build/fuzz/found)\n' "${failed[*]}" >&2
  exit 1
fi
