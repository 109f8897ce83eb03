#!/usr/bin/env bash
# Finds the volumes of the paper among what you have downloaded, and puts them where `deliso run` looks for them:
#   experiments/datasets.sh FOLDER ... [--data DIR]
# Looks at every file below the folders, plain or packed with gzip, whatever its name: a volume is told by the SHA-256 of its
# samples. One that the paper pads with zeros is padded. Each is written as NRRD into DIR (default: $DELISO_DATA, else
# data in the checkout) under the name of configs/reference/datasets.json. Says what it found, and what is still missing
# and where to get it. Files that are there already are checked, too. Needs Python 3 alone.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=experiments/packages.sh
source "$root/experiments/packages.sh"

data=${DELISO_DATA:-$root/data}
folders=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --data)
      [[ $# -ge 2 ]] || die "--data: expected a folder"
      data=$2
      shift
      ;;
    -h | --help)
      sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
      exit 0
      ;;
    -*) die "unknown option $1; see --help" ;;
    *)
      [[ -d $1 ]] || die "$1 is no folder"
      folders+=("$1")
      ;;
  esac
  shift
done
[[ ${#folders[@]} -gt 0 ]] || die "which folder holds your downloads? experiments/datasets.sh FOLDER"
mkdir -p "$data"

exec python3 - "$root/configs/reference" "$data" "${folders[@]}" <<'PYTHON'
import gzip
import hashlib
import json
import os
import re
import sys
from pathlib import Path

REFERENCE, DATA, *FOLDERS = sys.argv[1:]
REFERENCE, DATA = Path(REFERENCE), Path(DATA)
LARGEST = 2 ** 31  # bytes of a file that is looked at


def manifest():
    """file name -> what is known of it; several data sets may share a file."""
    files = {}
    shapes = json.loads((REFERENCE / "volumes.json").read_text(encoding="utf-8"))["volumes"]
    for item in json.loads((REFERENCE / "datasets.json").read_text(encoding="utf-8"))["datasets"]:
        entry = files.setdefault(item["file"], {"names": [], **item, **shapes.get(item["file"], {})})
        entry["names"].append(item["name"])
    return files


def samples_of(path):
    """Every reading of a file's bytes that may be samples: after an NRRD header, or as they are, unpacked or not."""
    with open(path, "rb") as stream:
        data = stream.read()
    if data[:2] == b"\x1f\x8b":
        try:
            data = gzip.decompress(data)
        except (OSError, EOFError):
            return []
    if data[:4] != b"NRRD":
        return [data]
    for end in (data.find(b"\n\n"), data.find(b"\r\n\r\n")):
        if end < 0:
            continue
        header = data[:end].decode(errors="replace")
        body = data[end + 2:] if data[end:end + 2] == b"\n\n" else data[end + 4:]
        if re.search(r"^encoding:\s*(gz|gzip)\s*$", header, re.M):
            try:
                body = gzip.decompress(body)
            except (OSError, EOFError):
                continue
        return [body]
    return []


def sha256(data):
    return hashlib.sha256(data).hexdigest()


def padded(data, entry):
    """The samples with slices of zeros around them, when between their own zeros they are the core of this volume."""
    nx, ny, nz = entry["dims"]
    of_slice = nx * ny
    if len(data) % of_slice or not 0 < len(data) < of_slice * nz or not any(data):
        return None
    zero = bytes(of_slice)
    begin, end = 0, len(data)
    while data[begin:begin + of_slice] == zero:
        begin += of_slice
    while data[end - of_slice:end] == zero:
        end -= of_slice
    if sha256(data[begin:end]) != entry["core_sha256"]:
        return None
    before = bytes(of_slice * entry["slices_before"])
    return before + data[begin:end] + bytes(of_slice * nz - len(before) - (end - begin))


def write(entry, data):
    dims = entry["dims"]
    header = (f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {dims[0]} {dims[1]} {dims[2]}\n"
              "spacings: 1 1 1\nencoding: raw\n\n")
    part = DATA / (entry["file"] + ".part")
    part.write_bytes(header.encode() + data)
    os.replace(part, DATA / entry["file"])


def candidates():
    for folder in [str(DATA), *FOLDERS]:
        for where, _, names in os.walk(folder):
            for name in sorted(names):
                path = Path(where) / name
                if path.is_file() and 0 < path.stat().st_size <= LARGEST and not name.endswith(".part"):
                    yield path


def main():
    files = manifest()
    wanted = {entry["sha256"]: entry for entry in files.values() if "sha256" in entry}
    cores = [entry for entry in files.values() if "core_sha256" in entry]
    found, wrong = {}, {}
    for path in candidates():
        for data in samples_of(path):
            entry, how = wanted.get(sha256(data)), ""
            for core in cores if entry is None else []:
                whole = padded(data, core)
                if whole is not None and sha256(whole) == core["sha256"]:
                    entry, data, how = core, whole, ", padded with zeros"
            if entry is None:
                if path.parent == DATA and path.name in files and "sha256" in files[path.name]:
                    wrong[path.name] = path
                continue
            if entry["file"] in found:
                continue
            found[entry["file"]] = path
            if path != DATA / entry["file"]:
                write(entry, data)
            print(f"{', '.join(entry['names'])}: {path}{how} -> {DATA / entry['file']}", flush=True)
    missing = [entry for entry in files.values() if entry["file"] not in found]
    for entry in missing:
        file = entry["file"]
        if file in wrong:
            print(f"{', '.join(entry['names'])}: {wrong[file]} is another volume: its samples have another SHA-256")
        elif "sha256" not in entry and (DATA / file).exists():
            print(f"{', '.join(entry['names'])}: {DATA / file} is there; no SHA-256 of it is known")
        else:
            print(f"{', '.join(entry['names'])}: missing; {entry['get']}")
    sys.exit(1 if wrong else 0)


main()
PYTHON
