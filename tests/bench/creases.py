#!/usr/bin/env python3
"""Vertices, two-sided error and angles with and without stage2.h_min and smoothing: the table of tests/bench/README.md.

    tests/bench/creases.py build/release/experiments/deliso [--only NAME,...]

White noise, a mask of random bits, a mask of a smooth shape and, where $DELISO_DATA is set, ENGINE, BABY and ANEURISM,
each with the paper's criteria alone, at several thresholds and bounds on the radius, and with several values of h_min.
Every mesh is made and measured by `deliso run`. Only the standard library is needed.
"""

import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import tempfile

PUBLIC = [("ENGINE", "engine.nrrd", 40.1), ("BABY", "baby.nrrd", 35.8), ("ANEURISM", "aneurism.nrrd", 124.6)]
OFF = {"stage2.h_min": 0, "shape.smoothing": 0}
VARIANTS = [
    ("criteria of the paper", OFF),
    ("epsilon 0.14, 0.28", {**OFF, "stage2.epsilon1": 0.14, "stage2.epsilon2": 0.28}),
    ("epsilon 0.2, 0.4", {**OFF, "stage2.epsilon1": 0.2, "stage2.epsilon2": 0.4}),
    ("r_min 0.002", {**OFF, "stage2.r_min": 0.002}),
    ("r_min 0.004", {**OFF, "stage2.r_min": 0.004}),
    ("smoothing alone", {"stage2.h_min": 0}),
    ("default, h_min 0.025", {}),
    ("h_min 0.025 without smoothing", {"shape.smoothing": 0}),
    ("h_min 0.05", {"stage2.h_min": 0.05}),
    ("h_min 0.1", {"stage2.h_min": 0.1}),
]


def write_mask(path, side, value):
    samples = bytes(value(i, j, k) for k in range(side) for j in range(side) for i in range(side))
    header = f"NRRD0005\ntype: uint8\ndimension: 3\nsizes: {side} {side} {side}\nencoding: raw\n\n"
    path.write_bytes(header.encode() + samples)


def made(program, folder):
    """The volumes of our own: name, file, isovalue."""
    subprocess.run([program, "generate", "noise", "--size", "12", "--seed", "5", "-o", folder / "noise.nrrd"], check=True,
                   stdout=subprocess.DEVNULL)
    bits = random.Random(2)
    write_mask(folder / "bits.nrrd", 12, lambda i, j, k: bits.randrange(2))

    def in_ring_or_plate(i, j, k):
        x, y, z = i - 15.6, j - 15.6, k - 15.6
        return (math.hypot(math.hypot(x, y) - 9, z) < 3.7
                or (abs(x + 0.3 * y) < 2.2 and math.sqrt(x * x + y * y + z * z) < 13))

    write_mask(folder / "mask.nrrd", 32, lambda i, j, k: int(in_ring_or_plate(i, j, k)))
    return [("noise 12^3", folder / "noise.nrrd", 127.5), ("random bits 12^3", folder / "bits.nrrd", 0.5),
            ("mask 32^3", folder / "mask.nrrd", 0.5)]


def records(program, volume, isovalue, folder):
    experiment = {
        "title": "creases", "question": "How far off, for how many vertices?", "distances": True,
        "datasets": [{"name": "it", "file": volume.name, "isovalue": isovalue,
                      "get": "this script makes it, or DELISO_DATA has it"}],
        "base": {"name": "default", "parameters": {}},
        "variants": [{"name": name, "extends": "default", "set": changes} for name, changes in VARIANTS],
        "metrics": [{"name": "vertices", "value": "vertices"}],
    }
    (folder / "experiment.json").write_text(json.dumps(experiment))
    out = folder / f"out-{volume.stem}"
    subprocess.run([program, "run", folder / "experiment.json", "--data", volume.parent, "--out", out], check=False,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return [json.loads(line) for line in (out / "records.jsonl").read_text().splitlines()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    data = os.environ.get("DELISO_DATA")
    print("| field | rule | vertices | mesh to isosurface, mean and largest | isosurface to mesh, mean and largest | "
          "smallest angle, and mean | proven |\n|---|---|---:|---:|---:|---:|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        public = [(n, pathlib.Path(data) / f, k) for n, f, k in PUBLIC] if data else []
        for field, volume, isovalue in made(arguments.program, folder) + public:
            if arguments.only and field.split()[0] not in arguments.only.split(","):
                continue
            for run in records(arguments.program, volume, isovalue, folder):
                far, angles = run["distances"], run["quality"]
                print(f"| {field} | {run['variant']} | {run['vertices']} | "
                      f"{far['mesh_to_isosurface_mean_voxels']:.4f}, {far['mesh_to_isosurface_max_voxels']:.2f} | "
                      f"{far['isosurface_samples_to_mesh_mean_voxels']:.4f}, "
                      f"{far['isosurface_samples_to_mesh_max_voxels']:.2f} | "
                      f"{angles['min_angle_degrees']:.1f}, {angles['mean_min_angle_degrees']:.1f} | "
                      f"{'yes' if run['certificate']['proven'] else 'no'} |", flush=True)


if __name__ == "__main__":
    main()
