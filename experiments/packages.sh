# shellcheck shell=bash disable=SC2034
# What the scripts of this project have in common: the packages they need. Sourced, not run.

# Debian and Ubuntu packages, each with a file that shows it is there.
build_packages=(
  "g++:/usr/bin/g++"
  "cmake:/usr/bin/cmake"
  "ninja-build:/usr/bin/ninja"
  "git:/usr/bin/git"
  "nlohmann-json3-dev:/usr/include/nlohmann/json.hpp"
  "libcli11-dev:/usr/include/CLI/CLI.hpp"
  "zlib1g-dev:/usr/include/zlib.h"
  "libpng-dev:/usr/include/png.h"
)
test_packages=("libgtest-dev:/usr/include/gtest/gtest.h")
tidy_packages=(
  "clang:/usr/bin/clang++"
  "clang-tidy:/usr/bin/clang-tidy"
)
# For the tests of system faults, which are skipped without them.
fault_packages=(
  "python3:/usr/bin/python3"
  "faketime:/usr/bin/faketime"
)
# Programs that fill our meshes, for tests that are skipped without them; so are those with python3-vtk9.
other_program_packages=(
  "tetgen:/usr/bin/tetgen"
  "gmsh:/usr/bin/gmsh"
)

# For the Python module and its tests, and for the library's, which are skipped without them.
python_packages=(
  "python3-dev:/usr/bin/python3-config"
  "python3-numpy:/usr/lib/python3/dist-packages/numpy/__init__.py"
  "python3-pybind11:/usr/lib/python3/dist-packages/pybind11/__init__.py"
  "pybind11-dev:/usr/include/pybind11/pybind11.h"
  "python3-pip:/usr/lib/python3/dist-packages/pip/__init__.py"
  "python3-setuptools:/usr/lib/python3/dist-packages/setuptools/__init__.py"
  "python3-wheel:/usr/lib/python3/dist-packages/wheel/__init__.py"
  "pkg-config:/usr/bin/pkg-config"
)

# For the tests of the page of lessons in a browser, which are skipped without it.
browser_packages=("chromium:/usr/bin/chromium")

# The package with libFuzzer and the sanitizers for the clang++ that is there.
fuzz_package() {
  local version
  version=$(clang++ -dumpversion)
  printf 'libclang-rt-%s-dev:%s' "${version%%.*}" "$(clang++ -print-resource-dir)/lib/linux/libclang_rt.fuzzer-$(uname -m).a"
}

say() { printf '== %s\n' "$*"; }

die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Runs a command as root, without ever asking for a password.
as_root() {
  if [[ $(id -u) -eq 0 ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo -n "$@" || die "sudo needs a password; run this first: sudo $*"
  else
    die "this needs root; run it first: $*"
  fi
}

# install_missing "package:file" ...: installs the packages whose file is missing. A program that is on the PATH counts
# as there wherever it lies. Does nothing, and needs no root, when nothing is missing.
install_missing() {
  local entry package file missing=()
  for entry in "$@"; do
    package=${entry%%:*}
    file=${entry#*:}
    if [[ -e $file ]]; then continue; fi
    if [[ $file == /usr/bin/* ]] && command -v "$(basename "$file")" >/dev/null; then continue; fi
    missing+=("$package")
  done
  if [[ ${#missing[@]} -eq 0 ]]; then return; fi
  command -v apt-get >/dev/null ||
    die "missing: ${missing[*]} (names of Debian packages; without apt-get please install them by hand)"
  say "installing ${missing[*]}"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# configure_preset PRESET [OPTION ...]: with ccache when it is there, which needs leave to store what was compiled with
# precompiled headers.
configure_preset() {
  if command -v ccache >/dev/null; then
    set -- "$@" "-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime;ccache"
  fi
  cmake --preset "$@"
}
