#!/usr/bin/env python3
"""What flat voxel cells cost: the table of tests/bench/README.md.

    tests/bench/flat_cells.py PROGRAM [PROGRAM ...] [--only NAME,...] [--limit SECONDS]

Smooth and white noise, small integers and a mask with spacings of 1:1:1 to 1:1:12 and, where $DELISO_DATA is set, public
volumes of which only every k-th slice is kept. Each program meshes each of them with one thread, by turns. Only the
standard library is needed.
"""

import argparse
import array
import gzip
import json
import os
import pathlib
import random
import re
import subprocess
import tempfile

THINNED = [("engine", 40.1, 5), ("baby", 35.8, 3), ("baby", 35.8, 8), ("aneurism", 124.6, 4), ("leg", 22.1, 3),
           ("leg", 10.5, 4), ("baby", 16.4, 5)]


def write(path, kind, sizes, spacings, data):
    header = (f"NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {sizes[0]} {sizes[1]} {sizes[2]}\n"
              f"spacings: {spacings[0]} {spacings[1]} {spacings[2]}\nendian: little\nencoding: raw\n\n")
    path.write_bytes(header.encode() + data)


def smooth(side, seed, passes):
    """Gaussian noise, averaged with the next samples along each axis, around the ends."""
    draw = random.Random(seed)
    field = [draw.gauss(0, 1) for _ in range(side ** 3)]
    for _ in range(passes):
        for step in (1, side, side * side):
            field = [(field[i] + field[(i + step) % side ** 3]) / 2 for i in range(side ** 3)]
    return field


def made(folder):
    """Fields of our own: name, file, isovalue."""
    fields = [("noise 16^3", 16, smooth(16, 1, 0), 0.1), ("smooth noise 24^3", 24, smooth(24, 2, 3), 0.02),
              ("smoother noise 40^3", 40, smooth(40, 3, 10), 0.01)]
    draw = random.Random(4)
    fields.append(("integers 12^3", 12, [draw.randrange(3) for _ in range(12 ** 3)], 1))
    fields.append(("mask 24^3", 24, [int(v > 0) for v in smooth(24, 5, 4)], 0.5))
    for name, side, field, isovalue in fields:
        for ratio in (1, 2, 5, 12):
            path = folder / f"{name.split()[0]}{side}_{ratio}.nrrd"
            write(path, "float", (side,) * 3, (1, 1, ratio), array.array("f", field).tobytes())
            yield f"{name}, 1:1:{ratio}", path, isovalue


def thinned(folder, data):
    """Every k-th slice of public volumes of bytes."""
    for name, isovalue, step in THINNED:
        raw = (data / f"{name}.nrrd").read_bytes()
        end = raw.index(b"\n\n")
        x, y, z = map(int, re.search(rb"sizes: (\d+) (\d+) (\d+)", raw[:end]).groups())
        samples = raw[end + 2:]
        if b"encoding: gz" in raw[:end]:
            samples = gzip.decompress(samples)
        kept = [samples[k * x * y:(k + 1) * x * y] for k in range(0, z, step)]
        path = folder / f"{name}_{step}.nrrd"
        write(path, "uint8", (x, y, len(kept)), (1, 1, step), b"".join(kept))
        yield f"{name.upper()} {isovalue}, each {step}th slice", path, isovalue


def row(program, volume, isovalue, folder, limit):
    report = folder / "report.json"
    try:
        run = subprocess.run([program, "mesh", volume, "--isovalue", str(isovalue), "-o", folder / "mesh.ply", "--threads",
                              "1", "--quiet", "--report", report], stdout=subprocess.DEVNULL, timeout=limit)
    except subprocess.TimeoutExpired:
        return f"over {limit} |||||"
    made = json.loads(report.read_text())
    stages = made["stages"]
    seconds = made["total_seconds"]
    return (f"{seconds:.1f} | {1e6 * seconds / made['vertices']:.0f} | {made['vertices']} | "
            f"{stages['shape']['bad_before']} | {made['quality']['min_angle_degrees']:.1f} | "
            f"{stages['repair']['components_polygonized']}{'' if run.returncode == 0 else ', not proven'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--only", default="", help="names that begin so, with commas between them")
    parser.add_argument("--limit", type=float, default=600, help="seconds a run may take")
    options = parser.parse_args()
    only = tuple(part for part in options.only.split(",") if part)
    print("| volume | program | seconds | µs per vertex | vertices | bad before the shape stage | least angle | "
          "components from marching cubes |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        volumes = list(made(folder))
        if "DELISO_DATA" in os.environ:
            volumes += thinned(folder, pathlib.Path(os.environ["DELISO_DATA"]))
        for volume, path, isovalue in volumes:
            for number, program in enumerate(options.programs):
                if not only or volume.startswith(only):
                    cells = row(program, path, isovalue, folder, options.limit)
                    print(f"| {volume} | {number + 1} | {cells} |", flush=True)


if __name__ == "__main__":
    main()
