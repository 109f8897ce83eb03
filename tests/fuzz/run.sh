#!/usr/bin/env bash
# Runs fuzz targets of the preset asan for some seconds each: tests/fuzz/run.sh SECONDS [TARGET ...]
# A target volume.FORMAT (volume.nii) gives every input to the reader of that format alone, beginning with its inputs.
# DELISO_FUZZ_RUNS: each target ends after so many inputs, too. DELISO_FUZZ_SEED: of the random changes, each time
# another by default. DELISO_FUZZ_JOBS: targets at a time, by default two.
# New inputs, those that fail, and logs go to build/asan/found/TARGET.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
seconds=${1:?usage: tests/fuzz/run.sh SECONDS [TARGET ...]}
targets=("${@:2}")
if [[ ${#targets[@]} -eq 0 ]]; then targets=(volume mesh_file config meshing); fi
jobs=${DELISO_FUZZ_JOBS:-2}

# corpus_of TARGET: a folder with the inputs to begin with; of a format those whose names begin with it.
corpus_of() {
  local target=${1%%.*} format=${1#*.} corpus=build/asan/found/$1/corpus
  if [[ $1 != *.* ]]; then
    printf 'tests/fuzz/corpus/%s' "$target"
    return
  fi
  rm -rf "$corpus"
  mkdir -p "$corpus"
  cp "tests/fuzz/corpus/$target/$format"_* "$corpus"
  printf '%s' "$corpus"
}

# fuzz TARGET: its log, and 0 when no input failed.
fuzz() {
  local found=build/asan/found/$1 target=${1%%.*} corpus dictionary=() runs=()
  corpus=$(corpus_of "$1")
  if [[ $1 == *.* ]]; then export DELISO_FUZZ_FORMAT=${1#*.}; fi
  if [[ -f tests/fuzz/$target.dict ]]; then dictionary=("-dict=tests/fuzz/$target.dict"); fi
  if [[ -n ${DELISO_FUZZ_RUNS:-} ]]; then runs=("-runs=$DELISO_FUZZ_RUNS"); fi
  mkdir -p "$found/inputs"
  ASAN_OPTIONS=malloc_context_size=8:quarantine_size_mb=16 \
    "build/asan/tests/fuzz/fuzz_$target" "$found/inputs" "$corpus" "${dictionary[@]}" "${runs[@]}" \
    "-max_total_time=$seconds" -timeout=60 "-seed=${DELISO_FUZZ_SEED:-0}" \
    -rss_limit_mb=2000 -malloc_limit_mb=1000 "-artifact_prefix=$found/" -print_final_stats=1 >"$found/log" 2>&1
}

failed=()
for ((i = 0; i < ${#targets[@]}; i += jobs)); do
  pids=()
  for target in "${targets[@]:i:jobs}"; do
    mkdir -p "build/asan/found/$target"
    fuzz "$target" &
    pids+=($!)
  done
  for n in "${!pids[@]}"; do
    target=${targets[i + n]}
    log=build/asan/found/$target/log
    if wait "${pids[n]}"; then
      printf '%s: %s runs, no input failed\n' "$target" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
    else
      failed+=("$target")
      tail -n 60 "$log"
    fi
  done
done
if [[ ${#failed[@]} -gt 0 ]]; then
  printf 'inputs failed: %s (build/asan/found)\n' "${failed[*]}" >&2
  exit 1
fi
