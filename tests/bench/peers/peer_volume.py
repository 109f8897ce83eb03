"""Volumes and meshes for the adapters in Python: raw NRRD in, binary PLY out. Needs numpy (Debian: python3-numpy)."""
import re

import numpy

TYPES = {"uint8": "u1", "int8": "i1", "uint16": "u2", "int16": "i2", "uint32": "u4", "int32": "i4", "float": "f4",
         "double": "f8", "uchar": "u1", "unsigned char": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"}


def read_nrrd(path):
    """samples[k, j, i], spacing and origin of a volume as `deliso run` writes it for another program."""
    with open(path, "rb") as stream:
        data = stream.read()
    end = data.index(b"\n\n")
    fields = dict(re.findall(r"^([^#:\n]+):=?\s*(.*)$", data[:end].decode(), re.M))
    if fields.get("encoding") != "raw":
        raise SystemExit(f"{path}: expected the encoding raw, found {fields.get('encoding')}")
    dims = [int(n) for n in fields["sizes"].split()]
    order = ">" if fields.get("endian") == "big" else "<"
    samples = numpy.frombuffer(data, order + TYPES[fields["type"]], count=dims[0] * dims[1] * dims[2], offset=end + 2)
    if "space directions" in fields:
        rows = re.findall(r"\(([^)]*)\)", fields["space directions"])
        spacing = [float(row.split(",")[axis]) for axis, row in enumerate(rows)]
    else:
        spacing = [float(s) for s in fields.get("spacings", "1 1 1").split()]
    origin = [float(x) for x in re.findall(r"[^(),\s]+", fields.get("space origin", "(0,0,0)"))]
    return samples.reshape(dims[::-1]).astype(samples.dtype.newbyteorder("=")), spacing, origin


def write_ply(path, points, triangles):
    """Coordinates as doubles; triangles counterclockwise as seen from the side of lower values."""
    faces = numpy.empty(len(triangles), dtype=[("n", "u1"), ("v", "<i4", 3)])
    faces["n"] = 3
    faces["v"] = triangles
    with open(path, "wb") as stream:
        stream.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty double x\n"
                     f"property double y\nproperty double z\nelement face {len(triangles)}\n"
                     "property list uchar int vertex_indices\nend_header\n".encode())
        stream.write(points.astype("<f8").tobytes())
        stream.write(faces.tobytes())
