"""DelIso: isosurfaces of volumes as Delaunay triangle meshes, each checked against the exact topology.

    import deliso
    vertices, triangles, report = deliso.mesh(array, 0.5)
    assert report["verdict"] == "proven"

Arrays have three dimensions, and index 0 is x: sample array[i, j, k] lies at (i, j, k), times the spacing, or where an
affine map puts it (as in nibabel and scikit-image). The isosurface is that of the trilinear interpolant of the samples.

No sample is copied where the array is packed, in C or in Fortran order or in any other order of its axes, forwards or
backwards, in native byte order, and its dtype is uint8, int8, uint16, int16, int32, float32, float64 or bool. Other
arrays are copied once; uint32, uint64, int64 and float16 are converted without loss, or refused. An array must not be
written to while a function is working on it. The axis along which samples follow each other in memory decides where the
mesher begins: a C and a Fortran array of the same samples give two different meshes, both proven.

Functions may be called from several threads; the interpreter's lock is released. Every result is the same for any number
of threads. Mistakes are ValueError with one sentence.
"""

from __future__ import annotations

import json
from typing import Any, Mapping, NamedTuple, Optional, Sequence, Union

import numpy

from . import _deliso
from ._arguments import (ProgressCallback, _array, _callback, _count, _isovalue, _named, _number, _numbers, _path, _rows,
                         _shown, _text, _whole)

__all__ = ["mesh", "verify", "topology", "info", "parameters", "load_volume", "load_mesh", "save_mesh", "MeshResult",
           "Volume", "__version__"]

__version__: str = _deliso.version

_MOST_SEED = 2**64 - 1
_MOST_THREADS = 2**31 - 1


class MeshResult(NamedTuple):
    """What mesh() returns."""

    vertices: numpy.ndarray  # (n, 3) float64
    triangles: numpy.ndarray  # (m, 3) int32
    report: dict


class Volume(NamedTuple):
    """What load_volume() returns."""

    array: numpy.ndarray  # (nx, ny, nz), read-only, in the order of the file
    affine: numpy.ndarray  # (4, 4): from indices to the world
    space: str  # "left-posterior-superior", ...; empty where the file does not say
    units: str  # "mm", ...; likewise


def mesh(array: Any, isovalue: Union[float, str, None], *, spacing: Union[Sequence[float], str, None] = None,
         affine: Any = None, seed: int = 1, threads: int = 1, progress: Optional[ProgressCallback] = None,
         **parameters: Any) -> MeshResult:
    """Meshes the isosurface of a volume and proves the mesh.

    array      (nx, ny, nz) numbers, all finite; each dimension at least 2; array[i, j, k] is the sample at x index i
    isovalue   between the lowest and the highest sample; or "otsu", "mean", "median", "P%" of the range
               (of the region, if there is one); None or 0.5 where field_label names a label
    spacing    three lengths > 0, default (1, 1, 1): array[i, j, k] lies at (i sx, j sy, k sz)
               ("ignore": meshed as if it were 1, as the parameter of that name says)
    affine     instead of spacing: (4, 4) or (3, 4), from indices to the world, as nibabel's img.affine
    seed       of the random choices
    threads    0: as many as the machine has; the mesh is the same for any number
    progress   progress(stage, fraction) is called now and then, in this thread; False ends the run
    parameters by their names in deliso.parameters() with an underscore for the dot (stage2_epsilon1=0.05,
               size_max_error=0.1, boundary="closed", budget_seconds=60), or as groups (size={"max_error": 0.1}).
               Lengths are in voxels: of the smallest spacing.

    Returns (vertices, triangles, report): (n, 3) float64 in the world, (m, 3) int32 rows of vertices, counterclockwise
    seen from the side of lower values, and a dict with all that is known of the run. report["verdict"] is "proven",
    "not proven" (report["certificate"] says what differs), "not checked" or "stopped".

    Ctrl-C ends the run with the mesh as it is, valid and with the verdict "stopped"; where it comes too late to stop
    anything, or a second time, it raises KeyboardInterrupt (what is being worked on then ends by itself).
    """
    own, named = _array(array), _named(parameters, spacing)
    vertices, triangles, text = _deliso.mesh(own, _isovalue(own, isovalue, named), _rows(spacing, affine), named,
                                             _count(seed, "seed", _MOST_SEED),
                                             _count(threads, "threads", _MOST_THREADS), _callback(progress))
    report = json.loads(text)
    report["volume"]["copied_samples"] |= own is not array and not numpy.may_share_memory(own, array)
    proven = report["certificate"]["proven"]
    report["verdict"] = ("stopped" if report["stopped_early"] else "not checked" if proven is None
                         else "proven" if proven else "not proven")
    return MeshResult(vertices, triangles, report)


def verify(vertices: Any, triangles: Any, array: Any, isovalue: Union[float, str, None], *,
           spacing: Union[Sequence[float], str, None] = None, affine: Any = None, max_distance: Optional[float] = None,
           dropped_components: int = 0, threads: int = 1, progress: Optional[ProgressCallback] = None,
           **parameters: Any) -> dict:
    """Judges any mesh, whoever made it, as an image of an isosurface.

    vertices            (n, 3) finite numbers in the world: where spacing or affine put the samples
    triangles           (m, 3) whole numbers, rows of vertices, counterclockwise seen from the side of lower values
    array, isovalue, spacing, affine, threads, progress, parameters: as in mesh(); of the parameters those count that say
                        which surface is meant: field, region, boundary, spacing, promise_max_distance, size_max_error
    max_distance        how far mesh and isosurface may be from each other, in voxels; default: what the parameters say, or 1
    dropped_components  so many components of the isosurface were left out on purpose

    Returns a dict: "proven"; "failures", a sentence for each condition that fails; "checks" with the figures of each
    (manifold, orientation, boundary, topology, self_intersection, residual, distance; normals and delaunay_balls do not
    count); "quality". Distances are in voxels. Ctrl-C raises KeyboardInterrupt, and a callback that returns False
    RuntimeError: there is no partial result.
    """
    own, named = _array(array), _named(parameters, spacing)
    most = 0.0 if max_distance is None else _number(max_distance, "max_distance")
    if max_distance is not None and not most > 0:
        raise ValueError(f"max_distance: expected a number > 0, found {most}")
    return json.loads(_deliso.verify(_numbers(vertices, "vertices"), _whole(triangles), own,
                                     _isovalue(own, isovalue, named), _rows(spacing, affine), named, most,
                                     _count(dropped_components, "dropped_components", _MOST_THREADS),
                                     _count(threads, "threads", _MOST_THREADS), _callback(progress)))


def topology(array: Any, isovalue: Union[float, str, None], *, spacing: Union[Sequence[float], str, None] = None,
             affine: Any = None, threads: int = 1, progress: Optional[ProgressCallback] = None, **parameters: Any) -> dict:
    """The exact topology of an isosurface, without a mesh.

    array, isovalue, spacing, affine, threads, progress, parameters: as in mesh(); of the parameters field, region,
    boundary and spacing count. Lengths between samples matter only where field.smooth is given.

    Returns a dict: "components", "euler_characteristic", "boundary_loops" of the whole, and "isosurface", a list of
    {"euler_characteristic", "boundary_loops", "count"} of components that are alike. Ctrl-C raises KeyboardInterrupt,
    and a callback that returns False RuntimeError.
    """
    own, named = _array(array), _named(parameters, spacing)
    return json.loads(_deliso.topology(own, _isovalue(own, isovalue, named), _rows(spacing, affine), named,
                                       _count(threads, "threads", _MOST_THREADS), _callback(progress)))


def info(array: Any) -> dict:
    """What an array (nx, ny, nz) holds.

    Returns a dict: "dims", "range" of the finite samples, "not_finite" counts, "kind" ("field", "mask" or "labels"), and
    "named_isovalues": "otsu", "mean" and "median", each in the middle of its gap between two sample values.
    """
    return json.loads(_deliso.info(_array(array)))


def parameters() -> dict:
    """All parameters of mesh(): their names, and for each "default", "allowed", "unit" and "effect"."""
    return {name: {"default": json.loads(default), "allowed": allowed, "unit": unit, "effect": effect}
            for name, default, allowed, unit, effect in _deliso.parameters()}


def load_volume(path: Any, *, channel: Optional[int] = None, name: Optional[str] = "") -> Volume:
    """Reads NRRD, NIfTI, MetaImage, VTK, NumPy, MRC, INR, PVM or .raw files, packed or not: (array, affine, space, units).

    channel   of a file with several values a voxel, or several volumes: which one, counted from 0
    name      of a .vtk or .vti file with several arrays: which one

    Index 0 of the array is the file's x. Of a .npy file that is the last index, as in the program: its array is the
    transpose of what numpy.load gives.
    """
    number = None if channel is None else _count(channel, "channel", _MOST_SEED)
    if name is not None and not isinstance(name, str):
        raise ValueError(f"name: expected the name of an array, found {_shown(name)}")
    array, rows, space, units = _deliso.load_volume(_path(path), number, _text(name or ""))
    return Volume(array, numpy.array(rows + [[0, 0, 0, 1]]), space, units)


def load_mesh(path: Any) -> tuple:
    """Reads .ply, .off, .obj, .stl, .mesh, .vtk or .vtp: ((n, 3) float64 vertices, (m, 3) int32 triangles)."""
    return _deliso.load_mesh(_path(path))


def save_mesh(path: Any, vertices: Any, triangles: Any, report: Optional[Mapping[str, Any]] = None) -> None:
    """Writes a mesh, whole or not at all: .ply, .off, .obj, .stl, .mesh, .msh, .smesh, .vtk, .vtp or .glb.

    report   what mesh() has returned with it, save_mesh(path, *mesh(...)): the file then says what `deliso verify` has
             to know of field, region, components left out and the distance promised
    """
    comments = [] if report is None else report.get("comments") if isinstance(report, Mapping) else None
    if not isinstance(comments, list) or not all(isinstance(line, str) for line in comments):
        raise ValueError("report: expected the report that mesh() returns, with its 'comments'")
    _deliso.save_mesh(_path(path), _numbers(vertices, "vertices"), _whole(triangles),
                      [_text(line) for line in comments])
