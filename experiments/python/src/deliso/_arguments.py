"""What people give, as the compiled part takes it; what cannot be taken is a ValueError that names the argument."""

from __future__ import annotations

import operator
import os
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy

from . import _deliso

_MOST_VERTEX = 2**63 - 1

ProgressCallback = Callable[[str, float], Optional[bool]]


def _path(path: Any) -> bytes:
    try:
        return os.fsencode(path)
    except (TypeError, UnicodeEncodeError):
        raise ValueError(f"path: expected a file name, found {_shown(path)}") from None


def _text(text: str) -> str:
    """What C++ takes: characters that are none, as those of odd file names, are spelled out."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def _shown(value: Any) -> str:
    """A value as an error shows it, on one line."""
    shown = _text(" ".join(repr(value).split()))
    return shown if len(shown) <= 80 else shown[:77] + "..."


def _callback(progress: Any) -> Optional[ProgressCallback]:
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: expected a function of a stage and a fraction, or None, found {_shown(progress)}")
    return progress


def _array(array: Any) -> numpy.ndarray:
    own = _as_array(array, "array")
    if not own.dtype.isnative:
        own = own.astype(own.dtype.newbyteorder("="))
    # Strides of 0 alone would be taken for none: one number for all samples is copied.
    return own.copy() if own.size > 1 and not any(own.strides) else own


def _as_array(values: Any, name: str) -> numpy.ndarray:
    if numpy.ma.is_masked(values):
        raise ValueError(f"{name}: some values are masked; give them one, as filled(value) does")
    try:
        return numpy.asarray(values)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: expected an array of numbers ({error})") from None


def _count(value: Any, name: str, most: int) -> int:
    try:
        count = operator.index(value)
    except TypeError:
        count = -1
    if not 0 <= count <= most:
        raise ValueError(f"{name}: expected a whole number, 0 to {most}, found {_shown(value)}")
    return count


def _numbers(values: Any, name: str) -> numpy.ndarray:
    own = _as_array(values, name)
    if numpy.iscomplexobj(own):
        raise ValueError(f"{name}: expected real numbers, found complex ones")
    try:
        return numpy.ascontiguousarray(own, dtype=numpy.float64)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: expected numbers ({error})") from None


def _whole(triangles: Any) -> numpy.ndarray:
    own = _as_array(triangles, "triangles")
    if own.size > 0 and own.dtype.kind not in "iu":
        raise ValueError(f"triangles: expected whole numbers, found the dtype {own.dtype}")
    if own.size > 0 and own.max() > _MOST_VERTEX:
        raise ValueError(f"triangles: expected the numbers of vertices, found {own.max()}")
    return numpy.ascontiguousarray(own, dtype=numpy.int64)


def _number(value: Any, name: str) -> float:
    try:
        if isinstance(value, (str, bytes, bytearray)) or numpy.ndim(value) > 0:
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name}: expected a number, found {_shown(value)}") from None


def _isovalue(array: numpy.ndarray, isovalue: Union[float, str, None], named: Mapping[str, Any]) -> float:
    if isovalue is None and named.get("field.label") is not None:
        return float("nan")  # what the surface of a label has
    if not isinstance(isovalue, str):
        return _number(isovalue, "isovalue")
    region = {key: value for key, value in named.items() if key.startswith("region.")}
    return _deliso.named_isovalue(array, _text(isovalue), region)


def _rows(spacing: Union[Sequence[float], str, None], affine: Any) -> list:
    if isinstance(spacing, str):
        spacing = None  # the parameter of this name
    if affine is None:
        own = numpy.ones(3) if spacing is None else _numbers(spacing, "spacing")
        if own.shape != (3,):
            raise ValueError(f"spacing: expected three lengths, found {_shown(spacing)}")
        lengths = own.tolist()
        if not all(length > 0 for length in lengths):
            raise ValueError(f"spacing: expected three lengths > 0, found {_shown(spacing)}; an affine map may turn axes "
                             "the other way round")
        return [[lengths[row] if row == column else 0.0 for column in range(4)] for row in range(3)]
    if spacing is not None:
        raise ValueError("expected spacing or affine, found both: an affine map has the spacing in it")
    own = _numbers(affine, "affine")
    if own.shape not in ((4, 4), (3, 4)) or (own.shape == (4, 4) and own[3].tolist() != [0, 0, 0, 1]):
        raise ValueError(f"affine: expected an array of the shape (3, 4), or (4, 4) with the last row 0 0 0 1, "
                         f"found {_shown(affine)}")
    return own[:3].tolist()


def _named(given: Mapping[str, Any], spacing: Any) -> dict:
    """The parameters by their own names: `stage2_rho`, `"stage2.rho"` and `stage2={"rho": ...}` are one."""
    known = {name.replace(".", "_"): name for name, *_ in _deliso.parameters()}
    groups = {name.split(".")[0] for name in known.values() if "." in name}
    found: dict = {"spacing": _plain(spacing)} if isinstance(spacing, str) else {}

    def take(name: str, value: Any) -> None:
        if name in found:
            raise ValueError(f"{name}: given twice, expected once")
        found[name] = _plain(value)

    for key, value in given.items():
        if isinstance(value, Mapping) and key in groups:
            for inner, of_inner in value.items():
                take(_text(f"{key}.{inner}"), of_inner)
            continue
        group = key.split("_")[0]  # of unknown names, too, so that the nearest one is found in it
        take(known.get(key) or _text(key.replace("_", ".", 1) if group in groups and "." not in key else key), value)
    return found


def _plain(value: Any) -> Union[None, bool, int, float, str]:
    """A parameter's value as None, bool, int, float or str; what is none of them as a text, which is refused."""
    if isinstance(value, (numpy.ndarray, numpy.generic)) and value.ndim == 0 and not numpy.ma.is_masked(value):
        value = value.item()
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, (numpy.ndarray, bytes, bytearray)) or numpy.ma.is_masked(value):
        return _shown(value)
    for kind in (operator.index, float):
        try:
            return kind(value)
        except (TypeError, ValueError, OverflowError):
            pass
    return _shown(value)
