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
import operator
from typing import Any, Callable, Mapping, NamedTuple, Optional, Sequence, Union

import numpy

from . import _deliso

__all__ = ["mesh", "verify", "topology", "info", "parameters", "load_volume", "load_mesh", "save_mesh", "MeshResult",
           "Volume", "__version__"]

__version__: str = _deliso.version

_MOST_SEED = 2**64 - 1
_MOST_THREADS = 2**31 - 1

ProgressCallback = Callable[[str, float], Optional[bool]]


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


def mesh(array: Any, isovalue: Union[float, str], *, spacing: Union[Sequence[float], str, None] = None, affine: Any = None,
         seed: int = 1, threads: int = 1, progress: Optional[ProgressCallback] = None, **parameters: Any) -> MeshResult:
    """Meshes the isosurface of a volume and proves the mesh.

    array      (nx, ny, nz) numbers, all finite; each dimension at least 2; array[i, j, k] is the sample at x index i
    isovalue   between the lowest and the highest sample; or "otsu", "mean", "median", "P%" of the range
    spacing    three lengths, default (1, 1, 1): array[i, j, k] lies at (i sx, j sy, k sz)
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

    Ctrl-C ends the run with the mesh as it is, valid and with the verdict "stopped"; a second one raises
    KeyboardInterrupt at once (what is being worked on then ends by itself).
    """
    own = _array(array)
    vertices, triangles, text = _deliso.mesh(own, _isovalue(own, isovalue), _rows(spacing, affine), _named(parameters, spacing),
                                             _count(seed, "seed", _MOST_SEED), _count(threads, "threads", _MOST_THREADS),
                                             progress)
    report = json.loads(text)
    report["volume"]["copied_samples"] |= own is not array and not numpy.may_share_memory(own, array)
    proven = report["certificate"]["proven"]
    report["verdict"] = ("stopped" if report["stopped_early"] else "not checked" if proven is None
                         else "proven" if proven else "not proven")
    return MeshResult(vertices, triangles, report)


def verify(vertices: Any, triangles: Any, array: Any, isovalue: Union[float, str], *,
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
    count); "quality". Distances are in voxels. Ctrl-C raises KeyboardInterrupt.
    """
    own = _array(array)
    if max_distance is not None and not _number(max_distance, "max_distance") > 0:
        raise ValueError(f"max_distance: expected a number > 0, found {max_distance}")
    return json.loads(_deliso.verify(_numbers(vertices, "vertices"), _whole(triangles), own, _isovalue(own, isovalue),
                                     _rows(spacing, affine), _named(parameters, spacing), max_distance or 0.0,
                                     _count(dropped_components, "dropped_components", _MOST_THREADS),
                                     _count(threads, "threads", _MOST_THREADS), progress))


def topology(array: Any, isovalue: Union[float, str], *, spacing: Union[Sequence[float], str, None] = None,
             affine: Any = None, threads: int = 1, progress: Optional[ProgressCallback] = None, **parameters: Any) -> dict:
    """The exact topology of an isosurface, without a mesh.

    array, isovalue, spacing, affine, threads, progress, parameters: as in mesh(); of the parameters field, region,
    boundary and spacing count. Lengths between samples matter only where field.smooth is given.

    Returns a dict: "components", "euler_characteristic", "boundary_loops" of the whole, and "isosurface", a list of
    {"euler_characteristic", "boundary_loops", "count"} of components that are alike.
    """
    own = _array(array)
    return json.loads(_deliso.topology(own, _isovalue(own, isovalue), _rows(spacing, affine),
                                       _named(parameters, spacing), _count(threads, "threads", _MOST_THREADS), progress))


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


def load_volume(path: Any, *, channel: Optional[int] = None, name: str = "") -> Volume:
    """Reads NRRD, NIfTI, MetaImage, VTK, NumPy, MRC, INR, PVM or .raw files, packed or not: (array, affine, space, units).

    channel   of a file with several values a voxel, or several volumes: which one, counted from 0
    name      of a .vtk or .vti file with several arrays: which one
    """
    number = None if channel is None else _count(channel, "channel", _MOST_SEED)
    array, rows, space, units = _deliso.load_volume(str(path), number, name)
    return Volume(array, numpy.array(rows + [[0, 0, 0, 1]]), space, units)


def load_mesh(path: Any) -> tuple:
    """Reads .ply, .off, .obj, .stl, .mesh, .vtk or .vtp: ((n, 3) float64 vertices, (m, 3) int32 triangles)."""
    return _deliso.load_mesh(str(path))


def save_mesh(path: Any, vertices: Any, triangles: Any) -> None:
    """Writes a mesh, whole or not at all: .ply, .off, .obj, .stl, .mesh, .msh, .smesh, .vtk, .vtp or .glb."""
    _deliso.save_mesh(str(path), _numbers(vertices, "vertices"), _whole(triangles))


def _array(array: Any) -> numpy.ndarray:
    if numpy.ma.is_masked(array):
        raise ValueError("array: some samples are masked; give them a value, as array.filled(value) does")
    own = numpy.asarray(array)
    if not own.dtype.isnative:
        own = own.astype(own.dtype.newbyteorder("="))
    # Strides of 0 alone would be taken for none: one number for all samples is copied.
    return own.copy() if own.size > 1 and not any(own.strides) else own


def _count(value: Any, name: str, most: int) -> int:
    try:
        count = operator.index(value)
    except TypeError:
        count = -1
    if not 0 <= count <= most:
        raise ValueError(f"{name}: expected a whole number, 0 to {most}, found {value!r}")
    return count


def _numbers(values: Any, name: str) -> numpy.ndarray:
    if numpy.iscomplexobj(values):
        raise ValueError(f"{name}: expected real numbers, found complex ones")
    try:
        return numpy.ascontiguousarray(values, dtype=numpy.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: expected numbers ({error})") from None


def _whole(triangles: Any) -> numpy.ndarray:
    own = numpy.asarray(triangles)
    if own.size > 0 and own.dtype.kind not in "iu":
        raise ValueError(f"triangles: expected whole numbers, found the dtype {own.dtype}")
    return numpy.ascontiguousarray(own, dtype=numpy.int64)


def _number(value: Any, name: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name}: expected a number, found {value!r}") from None


def _isovalue(array: numpy.ndarray, isovalue: Union[float, str]) -> float:
    if not isinstance(isovalue, str):
        return _number(isovalue, "isovalue")
    found = info(array)
    if isovalue in found["named_isovalues"]:
        return found["named_isovalues"][isovalue]
    try:
        share = float(isovalue[:-1]) / 100 if isovalue.endswith("%") else -1.0
    except ValueError:
        share = -1.0
    if not 0 <= share <= 1:
        raise ValueError(f"isovalue: expected a number, 'otsu', 'mean', 'median' or 'P%', found '{isovalue}'")
    low, high = found["range"]
    return low + share * (high - low)


def _rows(spacing: Union[Sequence[float], str, None], affine: Any) -> list:
    if isinstance(spacing, str):
        spacing = None  # the parameter of this name
    if affine is None:
        own = numpy.ones(3) if spacing is None else _numbers(spacing, "spacing")
        if own.shape != (3,):
            raise ValueError(f"spacing: expected three lengths, found {spacing}")
        lengths = own.tolist()
        return [[lengths[row] if row == column else 0.0 for column in range(4)] for row in range(3)]
    if spacing is not None:
        raise ValueError("expected spacing or affine, found both: an affine map has the spacing in it")
    own = _numbers(affine, "affine")
    if own.shape not in ((4, 4), (3, 4)) or (own.shape == (4, 4) and own[3].tolist() != [0, 0, 0, 1]):
        raise ValueError(f"affine: expected an array of the shape (3, 4), or (4, 4) with the last row 0 0 0 1, found {affine}")
    return own[:3].tolist()


def _named(given: Mapping[str, Any], spacing: Any) -> dict:
    """The parameters by their own names: `stage2_rho`, `"stage2.rho"` and `stage2={"rho": ...}` are one."""
    known = {name.replace(".", "_"): name for name, *_ in _deliso.parameters()}
    groups = {name.split(".")[0] for name in known.values() if "." in name}
    found: dict = {"spacing": spacing} if isinstance(spacing, str) else {}
    for key, value in given.items():
        if isinstance(value, Mapping) and key in groups:
            found.update({f"{key}.{inner}": of_inner for inner, of_inner in value.items()})
        else:
            found[known.get(key, key)] = value
    return found
