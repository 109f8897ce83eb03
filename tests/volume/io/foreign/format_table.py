#!/usr/bin/env python3
"""The table of formats: what other tools read in their files, and what DelIso makes of them.

Usage: format_table.py DELISO [FOUND]. The files are written anew by foreign_volumes.py; each is read by DELISO and
meshed as it lies in the world. "equal samples": files whose samples are those that the tool reads. "apart": how far
the vertices are from where the tool puts them, which is the mesh of the tool's samples without a place, through the
tool's map from index to world. FOUND: the folder in which tests/fuzz/run.sh leaves its logs (build/asan/found).
Fails where samples differ or a vertex is farther off than 1e-9.
"""
import importlib.metadata
import os
import re
import subprocess
import sys
import tempfile

import numpy

PROGRAM = sys.argv[1]
FOUND = sys.argv[2] if len(sys.argv) > 2 else ""
HERE = os.path.dirname(os.path.abspath(__file__))
FORMATS = (  # name, extensions, names of fuzz runs
    ("NRRD", (".nrrd", ".nhdr"), ("nrrd", "nhdr")),
    ("NIfTI-1, -2", (".nii", ".nii.gz", ".hdr"), ("nii", "hdr")),
    ("MetaImage", (".mha", ".mhd"), ("mha", "mhd")),
    ("VTK, legacy", (".vtk",), ("vtk",)),
    ("VTI", (".vti",), ("vti",)),
    ("NumPy", (".npy",), ("npy",)),
    ("MRC, CCP4", (".mrc", ".ccp4"), ("mrc",)),
    ("INR", (".inr", ".inr.gz"), ("inr",)),
    ("PVM", (".pvm",), ("pvm",)),
    ("raw", (".raw",), ("raw",)),
)


def version_of(tool):
    """As the tool itself says it."""
    if tool == "VTK":
        import vtk
        return vtk.vtkVersion.GetVTKVersion()
    if tool == "Teem":
        out = subprocess.run(["teem-unu", "about"], capture_output=True, text=True)
        return re.search(r"Teem version ([0-9.]+)", out.stdout + out.stderr).group(1).rstrip(".")
    if tool == "CGAL":
        with open("/usr/include/CGAL/version.h") as header:
            return re.search(r"CGAL_VERSION (\S+)", header.read()).group(1)
    return importlib.metadata.version(tool.lower())


def options_of(expected):
    options = ["--array", expected["array"]] if expected["array"] else []
    return options + (["--channel", str(expected["channel"])] if expected["channel"] is not None else [])


def ply_points(path):
    with open(path, "rb") as file:
        head, data = file.read().split(b"end_header\n", 1)
    count = int(re.search(rb"element vertex (\d+)", head).group(1))
    assert b"property double x\nproperty double y\nproperty double z\nelement face" in head
    return numpy.frombuffer(data, "<f8", 3 * count).reshape(count, 3)


def mesh_of(path, isovalue, folder, options):
    mesh = os.path.join(folder, "mesh.ply")
    run = subprocess.run([PROGRAM, "mesh", path, "--isovalue", repr(isovalue), "-o", mesh, "--quiet", *options],
                         capture_output=True, text=True)
    assert run.returncode == 0, path + ": " + run.stderr
    return ply_points(mesh)


def vertices_off(path, expected, samples, affine, folder):
    """The largest distance, and how many vertices there are."""
    low, high = float(samples.min()), float(samples.max())
    isovalue = low + 0.4375 * (high - low)
    points = mesh_of(path, isovalue, folder, options_of(expected))
    steps = numpy.linalg.norm(affine[:, :3], axis=0)
    plain = os.path.join(folder, "plain.nrrd")
    names = {"u1": "uchar", "i1": "int8", "i2": "int16", "u2": "uint16", "i4": "int32", "f4": "float", "f8": "double"}
    with open(plain, "wb") as file:
        file.write(("NRRD0004\ntype: %s\ndimension: 3\nsizes: %d %d %d\nspacings: %r %r %r\nendian: little\n"
                    "encoding: raw\n\n" % (names[samples.dtype.str[1:]], *samples.shape, *map(float, steps))).encode())
        file.write(samples.tobytes(order="F"))
    index = mesh_of(plain, isovalue, folder, []) / steps
    if len(index) != len(points):
        return numpy.inf, len(points)
    placed = index @ affine[:, :3].transpose() + affine[:, 3]
    return numpy.linalg.norm(points - placed, axis=1).max(), len(points)


def fuzz_runs(names):
    counts = []
    for name in names:
        log = os.path.join(FOUND, "volume." + name, "log")
        if FOUND and os.path.exists(log):
            with open(log, errors="replace") as file:
                found = re.search(r"stat::number_of_executed_units: *(\d+)", file.read())
            counts.append(".%s %s" % (name, format(int(found.group(1)), ",")) if found else ".%s unfinished" % name)
    return ", ".join(counts) or "-"


def main():
    with tempfile.TemporaryDirectory() as folder:
        sys.argv = ["foreign_volumes.py", folder, "1"]
        sys.path.insert(0, HERE)
        import foreign_volumes as foreign
        rows, failed = {name: [] for name, _, _ in FORMATS}, False
        for expected, (samples, affine) in zip(foreign.EXPECTED, foreign.READ):
            path = os.path.join(folder, expected["file"])
            info = subprocess.run([PROGRAM, "info", path, *options_of(expected)], capture_output=True, text=True)
            found = re.search(r"sha256 +(\w+)", info.stdout)
            equal = found is not None and found.group(1) == expected["sha256"]
            far, vertices = vertices_off(path, expected, samples, affine, folder)
            if not equal or not far <= 1e-9:
                failed = True
                print("%s: samples equal: %s, vertices %g off. %s" % (expected["file"], equal, far, info.stderr),
                      file=sys.stderr)
            name = next(n for n, extensions, _ in FORMATS if expected["file"].endswith(extensions))
            rows[name].append((expected["tool"], equal, far, vertices))
        print("| format | another tool | files | equal samples | vertices | apart | fuzz runs |")
        print("|---|---|---|---|---|---|---|")
        for name, _, fuzz in FORMATS:
            row = rows[name]
            if not row:
                print("| %s | none at hand | - | - | - | - | %s |" % (name, fuzz_runs(fuzz)))
                continue
            tools = ", ".join("%s %s" % (tool, version_of(tool)) for tool in sorted({r[0] for r in row}))
            print("| %s | %s | %d | %d | %s | %.1e | %s |" % (
                name, tools, len(row), sum(r[1] for r in row), format(sum(r[3] for r in row), ","),
                max(r[2] for r in row), fuzz_runs(fuzz)))
        return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
