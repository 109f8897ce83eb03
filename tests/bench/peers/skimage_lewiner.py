#!/usr/bin/python3
"""scikit-image's marching cubes: skimage_lewiner.py VOLUME ISOVALUE MESH REPORT.

As its manual recommends: the method of Lewiner et al., whose topology is that of the trilinear interpolant, with steps of
one sample, and allow_degenerate=False, "if the output must be free of degenerate triangles". Debian: python3-skimage.
"""
import json
import sys
import time

from peer_volume import read_nrrd, write_ply


def main(path, isovalue, mesh, report):
    import numpy
    import skimage
    from skimage.measure import marching_cubes

    samples, spacing, origin = read_nrrd(path)
    samples = numpy.ascontiguousarray(samples.transpose(2, 1, 0).astype(numpy.float32))

    def contour():
        begin = time.perf_counter()
        points, triangles, _, _ = marching_cubes(samples, float(isovalue), spacing=tuple(spacing), method="lewiner",
                                                 gradient_direction="ascent", allow_degenerate=False)
        return time.perf_counter() - begin, points, triangles

    cold = contour()[0]
    warm, points, triangles = contour()
    write_ply(mesh, points.astype(numpy.float64) + numpy.array(origin), triangles)
    with open(report, "w", encoding="utf-8") as stream:
        json.dump({"version": f"scikit-image {skimage.__version__}", "settings": "lewiner, no degenerate triangles",
                   "total_seconds": cold, "warm_seconds": warm}, stream)


main(*sys.argv[1:])
