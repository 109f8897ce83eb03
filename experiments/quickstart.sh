#!/usr/bin/env bash
# From a fresh checkout to a certified mesh: installs what is missing, builds, meshes a built-in volume, checks the mesh
# and draws it. Results go to out/quickstart. From any folder: experiments/quickstart.sh
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
# shellcheck source=experiments/packages.sh
source experiments/packages.sh

out=out/quickstart
isovalue=100.5

install_missing "${build_packages[@]}"
say "building the program in build/release"
configure_preset release -DDELISO_TESTS=OFF # tests/run.sh switches them on again
cmake --build --preset release --target deliso --parallel "$(nproc)"

deliso=build/release/experiments/deliso
mkdir -p "$out"
say "a volume to start with: $out/shells.nrrd"
"$deliso" generate shells -o "$out/shells.nrrd"
say "meshing its isosurface at $isovalue: $out/shells.ply, $out/report.json"
"$deliso" mesh "$out/shells.nrrd" --isovalue "$isovalue" -o "$out/shells.ply" \
  --stage1-out "$out/shells-recover.ply" --report "$out/report.json"
say "checking the mesh with code of its own: $out/verification.txt, $out/verification.json"
"$deliso" verify "$out/shells.ply" "$out/shells.nrrd" --isovalue "$isovalue" --report "$out/verification.json" \
  >"$out/verification.txt"
tail -n 1 "$out/verification.txt"
say "a picture of the surface, the mesh after Recover and the mesh, cut open: $out/shells.png"
"$deliso" render "$out/shells.nrrd" --isovalue "$isovalue" --surface --mesh "$out/shells-recover.ply" \
  --mesh "$out/shells.ply" --clip x=32 --size 1080x360 -o "$out/shells.png"
say "a lesson on how that is done, to be opened in a browser: $out/lesson.html"
"$deliso" explain -o "$out/lesson.html" >/dev/null
say "done; the mesh is $root/$out/shells.ply, its picture $root/$out/shells.png, the lesson $root/$out/lesson.html"
