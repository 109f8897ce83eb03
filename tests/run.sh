#!/usr/bin/env bash
# Installs what is missing, builds, and runs every quick test. From any folder: tests/run.sh [PRESET ...]
# Presets: release (default), and with every warning an error dev (the same), clang (clang++), tidy (clang++ and
# clang-tidy), asan (these with address and undefined-behaviour sanitizers, and the fuzz targets), tsan (thread sanitizer,
# tests with several threads).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
# shellcheck source=experiments/packages.sh
source experiments/packages.sh

presets=("${@:-release}")
install_missing "${build_packages[@]}" "${test_packages[@]}"
for preset in "${presets[@]}"; do
  if [[ $preset == tidy || $preset == clang || $preset == asan ]]; then install_missing "${tidy_packages[@]}"; fi
  if [[ $preset == asan ]]; then install_missing "$(fuzz_package)"; fi
done

for preset in "${presets[@]}"; do
  say "preset $preset: configure and build in build/$preset"
  configure_preset "$preset"
  cmake --build --preset "$preset" --parallel "$(nproc)"
  say "preset $preset: the quick tests"
  ctest --preset "$preset"
done
say "all quick tests passed (${presets[*]})"
