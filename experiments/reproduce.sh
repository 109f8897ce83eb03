#!/usr/bin/env bash
# Makes every table and figure of the READMEs that the volumes at hand allow. From any folder, without arguments:
#   experiments/reproduce.sh
# Builds the program and, where CGAL is there, the other meshers; runs experiments/regenerate_tables.py and
# experiments/figures.sh. All goes to out/reproduced: pages/ has the READMEs with their tables, tables/ the records,
# figures/ the pictures, environment.txt where it ran. The checkout's own pages stay as they are. A second call goes on where
# the first was interrupted. Says at the end what it left out, and why. Volumes: $DELISO_DATA, else data/.
# DELISO_ONLY="table3 compare_fields_error" makes these sections alone; OUT another folder.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
# shellcheck source=experiments/packages.sh
source experiments/packages.sh

out=${OUT:-$root/out/reproduced}
data=${DELISO_DATA:-$root/data}
deliso=${DELISO:-$root/build/release/experiments/deliso}
read -r -a only <<<"${DELISO_ONLY:-}"
left_out=()
mkdir -p "$out" "$data"

# The program, unless one is given.
if [[ -z ${DELISO:-} ]]; then
  configure_preset release >"$out/build.log"
  cmake --build --preset release --parallel --target deliso >>"$out/build.log" || die "the build failed; see $out/build.log"
  if ! cmake --build --preset release --parallel --target peers >>"$out/build.log" 2>&1; then
    say "the adapters of other meshers could not be built; see $out/build.log"
  fi
fi
[[ -x $deliso ]] || die "$deliso is not there"

# Where it ran.
{
  date -u '+%Y-%m-%d %H:%M UTC'
  "$deliso" --version
  printf 'processor %s\n' "$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1)"
  printf 'cores     %s\n' "$(nproc)"
  printf 'memory    %s\n' "$(sed -n 's/^MemTotal:[[:space:]]*//p' /proc/meminfo)"
  printf 'kernel    %s\n' "$(uname -sr)"
  printf 'checkout  %s\n' "$(git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)"
  if command -v dpkg-query >/dev/null; then
    printf '\npackages\n'
    sed -n 's/^| `\([^`]*\)` |.*/\1/p' experiments/environment.md | sort -u |
      xargs dpkg-query -W -f='${Package} ${Version}\n' 2>/dev/null || true
  fi
} >"$out/environment.txt"
cat "$out/environment.txt"

# Tables. Pages are copies, so that the checkout, and with it the commit of the program, stays clean.
rm -rf "$out/pages"
mkdir -p "$out/pages"
while IFS= read -r page; do
  mkdir -p "$out/pages/$(dirname "$page")"
  cp "$page" "$out/pages/$page"
done < <(grep -rl --include=README.md '<!-- generated:' README.md configs)
while IFS= read -r section; do
  if [[ ${#only[@]} -gt 0 && " ${only[*]} " != *" $section "* ]]; then
    left_out+=("table $section: not among DELISO_ONLY")
    continue
  fi
  say "table $section"
  if ! python3 experiments/regenerate_tables.py --only "$section" --data "$data" --deliso "$deliso" --out "$out/tables" \
    --pages "$out/pages" --allow-absent --allow-dirty 2>"$out/section.log"; then
    left_out+=("table $section: $(grep -v '^\[' "$out/section.log" | tail -n 1)")
  fi
  while IFS= read -r line; do left_out+=("table $section: ${line#deliso: }"); done < <(grep '^deliso: absent' "$out/section.log")
done < <(python3 experiments/regenerate_tables.py --list)

# Figures.
if [[ ${#only[@]} -eq 0 || " ${only[*]} " == *" figures "* ]]; then
  DELISO=$deliso DELISO_DATA=$data experiments/figures.sh "$out/figures" | tee "$out/figures.log"
  while IFS= read -r line; do left_out+=("${line#== }"); done < <(grep ': absent, ' "$out/figures.log")
else
  left_out+=("figures: not among DELISO_ONLY")
fi

rm -f "$out/section.log"
say "done; all is in $out"
if [[ ${#left_out[@]} -gt 0 ]]; then
  say "left out:"
  printf '   %s\n' "${left_out[@]}" | sort -u | tee "$out/left_out.txt"
fi
