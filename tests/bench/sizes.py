#!/usr/bin/env python3
"""Vertices, seconds, two-sided error and smallest angle at stated errors: the tables of tests/bench/README.md.

    tests/bench/sizes.py build/release/experiments/deliso [--threads N] [--errors 0.05,0.1] [--only NAME,...] [--targets]

A ball, masks and, where $DELISO_DATA is set, the paper's volumes, each beside marching cubes (by `deliso run`); with
--targets ENGINE at stated numbers of vertices. Every mesh is judged by `deliso verify`, whose distances are given: from
samples of the mesh to the isosurface, and from its crossings of grid edges to the mesh. Marching cubes has these
crossings for vertices, so its second distance is 0. Only the standard library is needed.
"""

import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import tempfile
import time

PUBLIC = [("fuel", 70.1), ("hydrogen_atom", 20.1), ("engine", 40.1), ("leg", 22.1), ("baby", 35.8), ("aneurism", 124.6)]


def write_nrrd(path, side, value):
    samples = bytes(value(i, j, k) for k in range(side) for j in range(side) for i in range(side))
    header = f"NRRD0005\ntype: uint8\ndimension: 3\nsizes: {side} {side} {side}\nencoding: raw\n\n"
    path.write_bytes(header.encode() + samples)


def made(folder):
    """The volumes of our own: name, file, isovalue."""
    middle = 19.5
    radius = lambda i, j, k: math.dist((i, j, k), (middle, middle, middle))
    write_nrrd(folder / "ball.nrrd", 40, lambda i, j, k: max(0, min(255, round(127.5 + 40 * (18 - radius(i, j, k))))))
    write_nrrd(folder / "mask.nrrd", 40, lambda i, j, k: 255 if radius(i, j, k) < 18 else 0)
    # Three labels that touch: sectors of the ball.
    label = lambda i, j, k: 1 + (j > middle) + (i > middle and j > middle)
    write_nrrd(folder / "labels.nrrd", 40, lambda i, j, k: label(i, j, k) if radius(i, j, k) < 14 else 0)
    rng = random.Random(1)
    noise = [rng.randrange(2) for _ in range(10 ** 3)]
    write_nrrd(folder / "noise.nrrd", 10, lambda i, j, k: noise[i + 10 * (j + 10 * k)])
    return [("ball", folder / "ball.nrrd", 127.3), ("mask", folder / "mask.nrrd", 127.5),
            ("labels", folder / "labels.nrrd", 1.5), ("random mask", folder / "noise.nrrd", 0.5)]


def report_of(command, report):
    subprocess.run([*command, "--report", report], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads(report.read_text())


def meshed(program, volume, isovalue, folder, more):
    mesh = [program, "mesh", volume, "--isovalue", str(isovalue), "-o", folder / "mesh.ply", "--quiet", *more]
    run = report_of(mesh, folder / "report.json")
    judged = report_of([program, "verify", folder / "mesh.ply", volume, "--isovalue", str(isovalue)], folder / "v.json")
    return run, judged


def row(name, run, judged):
    distance = judged["checks"]["distance"]
    both = [distance[way]["max_voxels"] for way in ("mesh_to_isosurface", "isosurface_to_mesh")]
    proven = "yes" if run["certificate"]["proven"] and judged["proven"] else "no"
    print(f"| {name} | {run['vertices']} | {run['total_seconds']:.2f} | {both[0]:.3f} | {both[1]:.3f} | "
          f"{run['quality']['min_angle_degrees']:.2f} | {proven} |", flush=True)


def marching_cubes(program, name, volume, isovalue, folder):
    experiment = {
        "title": "marching cubes", "question": "How far off?", "distances": True,
        "datasets": [{"name": "it", "file": pathlib.Path(volume).name, "isovalue": isovalue,
                      "get": "this script makes it, or DELISO_DATA has it"}],
        "base": {"name": "default", "parameters": {}},
        "variants": [{"name": "cubes", "extends": "default", "mesher": "marching_cubes"}],
        "metrics": [{"name": "vertices", "value": "vertices"}],
    }
    (folder / "experiment.json").write_text(json.dumps(experiment))
    out = folder / f"out{time.monotonic_ns()}"
    subprocess.run([program, "run", folder / "experiment.json", "--data", pathlib.Path(volume).parent, "--out", out],
                   check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    run = json.loads((out / "records.jsonl").read_text().splitlines()[0])
    distances = run["distances"]
    print(f"| {name}, marching cubes | {run['vertices']} | {run['total_seconds']:.2f} | "
          f"{distances['mesh_to_isosurface_max_voxels']:.3f} | {distances['isosurface_to_mesh_max_voxels']:.3f} | "
          f"{run['quality']['min_angle_degrees']:.2f} | |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--threads", default="1")
    parser.add_argument("--errors", default="0.05,0.1,0.25,0.5")
    parser.add_argument("--only", default="")
    parser.add_argument("--targets", action="store_true")
    arguments = parser.parse_args()
    more = ["--threads", arguments.threads]
    data = os.environ.get("DELISO_DATA")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print("| field, error (voxels) | vertices | seconds | mesh to isosurface | isosurface to mesh | least angle | "
              "proven |\n|---|---|---|---|---|---|---|")
        if arguments.targets:
            for count in (5000, 20000, 200000):
                run = meshed(arguments.program, f"{data}/engine.nrrd", 40.1, folder,
                             [*more, "--target-vertices", str(count)])
                row(f"ENGINE 40.1, {count} vertices", *run)
            return
        fields = made(folder) + [(n, f"{data}/{n}.nrrd", k) for n, k in (PUBLIC if data else [])]
        for field, volume, isovalue in fields:
            if arguments.only and field not in arguments.only.split(","):
                continue
            for error in arguments.errors.split(","):
                row(f"{field}, {error}",
                    *meshed(arguments.program, volume, isovalue, folder, [*more, "--max-error", error]))
            marching_cubes(arguments.program, field, volume, isovalue, folder)


if __name__ == "__main__":
    main()
