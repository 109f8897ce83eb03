#!/usr/bin/env bash
# Draws the figures of Dey and Levine (SMI 2007) whose volumes are there, and the built-in volume. From any folder:
#   experiments/figures.sh [OUT]
# Volumes are looked for in $DELISO_DATA (default: data in the checkout), the program in $DELISO (default:
# build/release/experiments/deliso). Pictures, meshes and reports go to OUT (default: out/figures).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=experiments/packages.sh
source "$root/experiments/packages.sh"

data=${DELISO_DATA:-$root/data}
deliso=${DELISO:-$root/build/release/experiments/deliso}
out=${1:-$root/out/figures}
[[ -x $deliso ]] || die "$deliso is not there; build it first: experiments/quickstart.sh"
mkdir -p "$out"

# is_there FIGURE FILE: says so when the figure's volume is not there.
is_there() {
  if [[ -e $data/$2 ]]; then return 0; fi
  say "$1: absent, $data/$2 is not there"
  return 1
}

# make_mesh NAME VOLUME ISOVALUE: $out/NAME.ply and, after stage 1, $out/NAME-recover.ply. Exit code 1 means a mesh that
# is not proven: it is drawn too, and its report tells.
make_mesh() {
  local code=0
  say "meshing $1"
  "$deliso" mesh "$2" --isovalue "$3" -o "$out/$1.ply" --stage1-out "$out/$1-recover.ply" --report "$out/$1.json" ||
    code=$?
  [[ $code -le 1 ]] || die "meshing $1 failed"
}

# picture NAME VOLUME ISOVALUE [OPTION ...]: $out/NAME.png
picture() {
  local name=$1
  shift
  say "drawing $out/$name.png"
  "$deliso" render "$1" --isovalue "$2" -o "$out/$name.png" "${@:3}"
}

# The built-in volume: the surface, the mesh after Recover, the mesh after Refine, all cut open.
"$deliso" generate shells -o "$out/shells.nrrd"
make_mesh shells "$out/shells.nrrd" 100.5
picture shells "$out/shells.nrrd" 100.5 --surface --mesh "$out/shells-recover.ply" --mesh "$out/shells.ply" \
  --clip x=32 --size 1080x360

# Figures 1 and 2: marching cubes, DelIso.
if is_there "figure 1 (ATOM)" hydrogen_atom.nrrd; then
  make_mesh atom "$data/hydrogen_atom.nrrd" 20.1
  picture figure1 "$data/hydrogen_atom.nrrd" 20.1 --marching-cubes --mesh "$out/atom.ply" --size 1800x900
fi
if is_there "figure 2 (FUEL)" fuel.nrrd; then
  make_mesh fuel "$data/fuel.nrrd" 70.1
  picture figure2 "$data/fuel.nrrd" 70.1 --marching-cubes --mesh "$out/fuel.ply" --view 60,25 --size 2000x600
fi

# The public leg bears another name.
leg=leg.nrrd
[[ -e $data/$leg ]] || leg=statue_leg_341x341x93_uint8.raw

# Figures 6, 7 and 8: DelIso, after Recover.
if is_there "figure 6 (ENGINE)" engine.nrrd; then
  make_mesh engine "$data/engine.nrrd" 40.1
  picture figure6 "$data/engine.nrrd" 40.1 --mesh "$out/engine.ply" --mesh "$out/engine-recover.ply" --size 2400x960
  picture figure6-cut "$data/engine.nrrd" 40.1 --surface --mesh "$out/engine.ply" --clip x=128 --size 2400x960
fi
if is_there "figure 7 (LEG)" "$leg"; then
  make_mesh leg "$data/$leg" 22.1
  picture figure7 "$data/$leg" 22.1 --mesh "$out/leg.ply" --mesh "$out/leg-recover.ply" --size 2000x1000
fi
if is_there "figure 8 (TOOTH)" tooth.nrrd; then
  make_mesh tooth "$data/tooth.nrrd" 146.9
  picture figure8 "$data/tooth.nrrd" 146.9 --mesh "$out/tooth.ply" --mesh "$out/tooth-recover.ply" --clip y=128 \
    --size 2000x1000
fi

# Figure 10: the whole, and cut open.
if is_there "figure 10 (CHEST)" chest.nrrd; then
  make_mesh chest "$data/chest.nrrd" 82.7
  picture figure10-whole "$data/chest.nrrd" 82.7 --mesh "$out/chest.ply" --view -90,15 --size 1200x1000
  picture figure10-cut "$data/chest.nrrd" 82.7 --mesh "$out/chest.ply" --view -90,15 --clip y=192 --size 1200x1000
fi

# Figure 11: two isosurfaces of one volume, the outer one first.
if is_there "figure 11 (BABY)" baby.nrrd; then
  make_mesh baby1 "$data/baby.nrrd" 35.8
  make_mesh baby2 "$data/baby.nrrd" 131.6
  picture figure11 "$data/baby.nrrd" 35.8 --mesh "$out/baby1.ply" --mesh "$out/baby2.ply" --view -60,25 --size 2400x1200
fi
say "done; the pictures are in $out"
