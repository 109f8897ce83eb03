#!/usr/bin/env python3
"""What the shape stage does to angles, and what it costs: the table of tests/bench/README.md.

    tests/bench/shape_angles.py build/release/experiments/deliso [--threads N] [--set KEY=VALUE ...]

Each field is meshed without the stage (shape.rounds = 0) and with it: built-in fields, noise, and the public volumes
that are in $DELISO_DATA. Only the standard library is needed.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

BUILT_IN = [("knot", 80, 0.89), ("torus", 48, 0.7), ("double_torus", 64, 500.5), ("linked_tori", 64, 0.9),
            ("gyroid", 64, 0.1), ("gyroid_ball", 64, 0.1), ("gyroid_scan", 64, 135.5), ("marschner_lobb", 41, 127.5),
            ("shells", 64, 100.5), ("bubbles", 48, 0.1), ("blobs", 64, 0.6), ("noise", 12, 127.5)]
PUBLIC = [("fuel", 70.1), ("hydrogen_atom", 20.1), ("engine", 40.1), ("baby", 35.8), ("baby", 131.6),
          ("aneurism", 124.6), ("leg", 22.1), ("engine", 20.3), ("aneurism", 30.5)]


def meshed(program, volume, isovalue, folder, more):
    """The report of a run, and how many of its triangles have an angle below 5 degrees."""
    report = folder / "report.json"
    subprocess.run([program, "mesh", volume, "--isovalue", str(isovalue), "-o", folder / "mesh.ply", "--quiet",
                    "--report", report, *more], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads(report.read_text())


def row(program, name, volume, isovalue, folder, more):
    before = meshed(program, volume, isovalue, folder, [*more, "--set", "shape.rounds=0"])
    after = meshed(program, volume, isovalue, folder, more)
    histograms = [run["quality"]["min_angle_histogram"][0] for run in (before, after)]
    angles = [run["quality"]["min_angle_degrees"] for run in (before, after)]
    shape = after["stages"]["shape"]
    share = 100 * shape["seconds"] / after["total_seconds"]
    verdict = "yes" if after["certificate"]["proven"] else "no"
    print(f"| {name} {isovalue} | {after['vertices']} | {angles[0]:.3g} | {angles[1]:.3g} | {histograms[0]} | "
          f"{histograms[1]} | {shape['bad_before']} | {shape['bad_after']} | {shape['seconds']:.2f} | {share:.0f} % | "
          f"{verdict} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--threads", default="1")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    arguments = parser.parse_args()
    more = ["--threads", arguments.threads]
    for assignment in arguments.set:
        more += ["--set", assignment]
    print("| field, isovalue | vertices | least angle before | after | below 5 degrees before | after | bad before | "
          "after | seconds | of the run | proven |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        data = os.environ.get("DELISO_DATA")
        for volume, isovalue in PUBLIC if data else []:
            path = pathlib.Path(data) / f"{volume}.nrrd"
            if path.exists():
                row(arguments.program, volume, path, isovalue, folder, more)
        for field, size, isovalue in BUILT_IN:
            path = folder / f"{field}.nrrd"
            subprocess.run([arguments.program, "generate", field, "--size", str(size), "-o", path], check=True,
                           stdout=subprocess.DEVNULL)
            row(arguments.program, field, path, isovalue, folder, more)


if __name__ == "__main__":
    main()
