#!/usr/bin/python3
"""VTK's flying edges or marching cubes: vtk_contour.py flying_edges|marching_cubes VOLUME ISOVALUE MESH REPORT.

As its manual recommends for a surface alone: vtkFlyingEdges3D in place of vtkMarchingCubes, and normals, gradients and
scalars off, since nobody draws it. Both have no other settings. Debian: python3-vtk9.
"""
import json
import sys
import time

from peer_volume import read_nrrd, write_ply


def main(kind, path, isovalue, mesh, report):
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkSMPTools, vtkVersion
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkMarchingCubes

    vtkSMPTools.Initialize(1)
    samples, spacing, origin = read_nrrd(path)
    image = vtkImageData()
    image.SetDimensions(*samples.shape[::-1])
    image.SetSpacing(*spacing)
    image.SetOrigin(*origin)
    image.GetPointData().SetScalars(numpy_to_vtk(samples.ravel()))

    def contour():
        contourer = {"flying_edges": vtkFlyingEdges3D, "marching_cubes": vtkMarchingCubes}[kind]()
        contourer.ComputeNormalsOff()
        contourer.ComputeGradientsOff()
        contourer.ComputeScalarsOff()
        contourer.SetInputData(image)
        contourer.SetValue(0, float(isovalue))
        begin = time.perf_counter()
        contourer.Update()
        return time.perf_counter() - begin, contourer.GetOutput()

    cold, _ = contour()
    warm, surface = contour()
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(numpy.float64)
    triangles = vtk_to_numpy(surface.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
    write_ply(mesh, points, triangles)
    with open(report, "w", encoding="utf-8") as stream:
        json.dump({"version": f"VTK {vtkVersion.GetVTKVersion()}, {kind.replace('_', ' ')}",
                   "settings": "normals, gradients and scalars off", "total_seconds": cold, "warm_seconds": warm}, stream)


main(*sys.argv[1:])
