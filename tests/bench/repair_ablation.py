#!/usr/bin/env python3
"""What repair's mechanisms are worth: runs programs by turns on inputs that need repair and adds up what they report.

    tests/bench/repair_ablation.py base=build/release/experiments/deliso pruned=../pruned/build/release/experiments/deliso

Each program is NAME=COMMAND; the command may be several words, such as `env KEY=VALUE deliso`. Groups of inputs:

    noise       uniform noise, 8 to 12 samples a side, isovalues near the middle
    masks       zero or one, 8 to 10 samples a side, from sparse to dense
    smoothed    uniform noise of 16 samples a side, smoothed once or twice
    integers    small integers with an isovalue that samples have
    regression  tests/regression
    pairs       ENGINE 40.1, BABY 35.8 and 131.6, ANEURISM 124.6, FUEL 70.1, ATOM 20.1
    valleys     isovalues in the noise of ENGINE, BABY and ANEURISM, stage 2 coarse
    NAME@K      the volume NAME at isovalue K, stage 2 coarse

Each of the first four makes --seeds fields, each meshed with open and with closed boundary. The last three need the
volumes in $DELISO_DATA or --data. Only the standard library is needed.
"""

import argparse
import array
import collections
import json
import os
import pathlib
import random
import shlex
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

REGRESSION = {
    "cut_neck_0": 200.5, "cut_neck_1": 200.5, "cut_neck_2": 200.5, "crossing_copies": 0.5, "far_home": 127.5,
    "half_speck": 128.9, "left_out_tip_0": 128.1, "left_out_tip_1": 128.9, "off_surface_edge": 128.2,
    "face_saddle": 128.2, "mixed_magnitudes_0": 0, "mixed_magnitudes_1": 0, "mixed_magnitudes_2": 0,
    "mixed_magnitudes_3": 0, "swallowed_disk": 0.1, "folded_mask_0": 0.5, "folded_mask_1": 0.5, "folded_mask_2": 0.5,
}
PAIRS = [("engine", 40.1), ("baby", 35.8), ("baby", 131.6), ("aneurism", 124.6), ("fuel", 70.1), ("hydrogen_atom", 20.1)]
VALLEYS = ([("engine", isovalue) for isovalue in (10.3, 12.4, 14.6, 16.3, 18.4, 20.3, 22.5)] +
           [("baby", isovalue) for isovalue in (14.3, 16.4, 18.2, 20.6, 22.5, 25.3, 28.7)] +
           [("aneurism", isovalue) for isovalue in (20.6, 24.4, 28.2, 32.6, 36.7, 40.3, 44.5)])
# Stage 2 is not what is measured; with this it hardly takes time.
COARSE = ["--set", "stage2.r_min=0.5", "--set", "stage2.epsilon1=1", "--set", "stage2.epsilon2=1"]

Input = collections.namedtuple("Input", "name path isovalue options")


def write_nrrd(path, dims, values, is_integer):
    kind, code = ("uint8", "B") if is_integer else ("float", "f")
    header = f"NRRD0004\ntype: {kind}\ndimension: 3\nsizes: {dims[0]} {dims[1]} {dims[2]}\nendian: little\nencoding: raw\n\n"
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(array.array(code, values).tobytes())


def smoothed(values, size):
    """Means of each sample, twice, and its two neighbours along each axis."""
    for stride in (1, size, size * size):
        before = values
        values = []
        for i, value in enumerate(before):
            place = i // stride % size
            low = before[i - stride] if place > 0 else value
            high = before[i + stride] if place + 1 < size else value
            values.append((low + 2 * value + high) / 4)
    return values


def make_field(group, seed):
    """Dims, samples, whether these are integers, isovalue."""
    rng = random.Random(f"{group} {seed}")
    if group == "noise":
        size = 8 + seed % 5
        return [size] * 3, [rng.randrange(256) for _ in range(size**3)], True, 100.5 + rng.randrange(56)
    if group == "masks":
        size = 8 + seed % 3
        share = rng.uniform(0.2, 0.8)
        return [size] * 3, [int(rng.random() < share) for _ in range(size**3)], True, 0.5
    if group == "smoothed":
        size = 16
        values = [rng.random() for _ in range(size**3)]
        for _ in range(1 + seed % 2):
            values = smoothed(values, size)
        return [size] * 3, values, False, 0.5 + rng.uniform(-0.05, 0.05)
    size = 8 + seed % 4
    most = 2 + seed % 5
    return [size] * 3, [rng.randrange(most + 1) for _ in range(size**3)], True, 1 + rng.randrange(most)


def random_inputs(group, seeds, directory):
    inputs = []
    for seed in range(seeds):
        dims, values, is_integer, isovalue = make_field(group, seed)
        path = directory / f"{group}_{seed}.nrrd"
        write_nrrd(path, dims, values, is_integer)
        for boundary in ("open", "closed"):
            inputs.append(Input(f"{group} {seed} {boundary}", path, isovalue, ["--set", f"boundary={boundary}"]))
    return inputs


def inputs_of(group, arguments, directory):
    if group == "regression":
        return [Input(name, ROOT / "tests" / "regression" / f"{name}.nrrd", isovalue, [])
                for name, isovalue in REGRESSION.items()]
    if "@" in group:
        name, isovalue = group.split("@")
        return [Input(group, pathlib.Path(arguments.data) / f"{name}.nrrd", float(isovalue), COARSE)]
    if group in ("pairs", "valleys"):
        pairs, options = (PAIRS, []) if group == "pairs" else (VALLEYS, COARSE)
        return [Input(f"{name} {isovalue}", pathlib.Path(arguments.data) / f"{name}.nrrd", isovalue, options)
                for name, isovalue in pairs]
    return random_inputs(group, arguments.seeds, directory)


def run(command, given, arguments, directory):
    """What one run reports, in short."""
    mesh, report = directory / "mesh.ply", directory / "report.json"
    report.unlink(missing_ok=True)
    words = command + ["mesh", str(given.path), "--isovalue", str(given.isovalue), "-o", str(mesh), "--report",
                       str(report), "--threads", str(arguments.threads), "--quiet"] + given.options + (COARSE if arguments.coarse else [])
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    code = process.returncode = os.waitstatus_to_exitcode(status)
    processor = usage.ru_utime + usage.ru_stime
    if not report.exists():
        return {"input": given.name, "code": code, "processor_seconds": processor}
    full = json.loads(report.read_text())
    repair = full["stages"]["repair"]
    result = {"input": given.name, "code": code, "processor_seconds": processor}
    for key in ("seconds", "rounds", "vertices_before", "vertices_after", "components_before", "components_polygonized"):
        result[key] = repair[key]
    if arguments.verify:
        words = command + ["verify", str(mesh), str(given.path), "--isovalue", str(given.isovalue)]
        if "boundary=closed" in given.options:
            words.append("--closed")
        result["verified"] = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    return result


def median_of(runs):
    """Of repeats of one run: seconds are medians, all else is the same each time."""
    result = dict(runs[0])
    for key in ("seconds", "processor_seconds"):
        if key in result:
            result[key] = statistics.median(one[key] for one in runs)
    return result


def measure(group, programs, arguments, directory, log):
    results = {name: [] for name in programs}
    for given in inputs_of(group, arguments, directory):
        repeats = {name: [] for name in programs}
        for _ in range(arguments.repeats):
            for name, command in programs.items():
                repeats[name].append(run(command, given, arguments, directory))
        for name, runs in repeats.items():
            result = median_of(runs)
            results[name].append(result)
            log.write(json.dumps({"program": name, "group": group, **result}) + "\n")
            log.flush()
            if result["code"] != 0 or result.get("verified", 0) != 0:
                print(f"{name}: {given.name} at {given.isovalue}: exit code {result['code']}, "
                      f"verify {result.get('verified', 'not run')}", file=sys.stderr)
    return results


def print_group(group, results):
    def total(runs, key):
        return sum(one.get(key, 0) for one in runs)

    for name, runs in results.items():
        proven = sum(one["code"] == 0 for one in runs)
        checked = [one["verified"] for one in runs if "verified" in one]
        verified = f"{checked.count(0)} of {len(checked)}" if checked else ""
        print(f"| {group} | {name} | {len(runs)} | {proven} | {verified} | {total(runs, 'rounds')} | "
              f"{total(runs, 'vertices_after')} | {total(runs, 'components_polygonized')} | "
              f"{total(runs, 'seconds'):.2f} | {total(runs, 'processor_seconds'):.2f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", metavar="NAME=COMMAND")
    parser.add_argument("--groups", default="noise,masks,smoothed,integers,regression,pairs,valleys")
    parser.add_argument("--seeds", type=int, default=80, help="random fields of each kind")
    parser.add_argument("--repeats", type=int, default=1, help="runs of each program on each input, by turns")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--coarse", action="store_true", help="stage 2 coarse for all inputs")
    parser.add_argument("--verify", action="store_true", help="check meshes with `verify`, too")
    parser.add_argument("--data", default=os.environ.get("DELISO_DATA", str(ROOT / "data")))
    parser.add_argument("--log", default=os.devnull, help="a line of JSON for each run")
    arguments = parser.parse_args()
    programs = {}
    for words in arguments.programs:
        name, _, command = words.partition("=")
        programs[name] = shlex.split(command)
    print("| group | program | runs | proven | verified | rounds | vertices after repair | from marching cubes | "
          "repair s | processor s, whole runs |\n|---|---|---|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as directory, open(arguments.log, "a", encoding="utf-8") as log:
        for group in arguments.groups.split(","):
            print_group(group, measure(group, programs, arguments, pathlib.Path(directory), log))


if __name__ == "__main__":
    main()
