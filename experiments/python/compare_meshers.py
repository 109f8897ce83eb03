"""One field, three meshers, one judge: scikit-image, VTK and DelIso before deliso.verify. Those that are absent are skipped."""

import numpy
import deliso

x, y, z = numpy.meshgrid(*3 * [numpy.linspace(0, 9, 40)], indexing="ij")
FIELD, ISOVALUE = (numpy.sin(x) * numpy.cos(y) + numpy.sin(y) * numpy.cos(z) + numpy.sin(z) * numpy.cos(x)), 0.61


def scikit_image():
    from skimage.measure import marching_cubes
    return marching_cubes(FIELD, ISOVALUE, gradient_direction="ascent")[:2]  # faces lower values


def vtk_flying_edges():
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    image, mesher = vtk.vtkImageData(), vtk.vtkFlyingEdges3D()
    image.SetDimensions(FIELD.shape)
    image.GetPointData().SetScalars(numpy_to_vtk(FIELD.ravel(order="F"), deep=True))
    mesher.SetInputData(image)
    mesher.SetValue(0, ISOVALUE)
    mesher.Update()
    mesh = mesher.GetOutput()
    return vtk_to_numpy(mesh.GetPoints().GetData()), vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


for mesher in (scikit_image, vtk_flying_edges, lambda: deliso.mesh(FIELD, ISOVALUE)[:2]):
    name = mesher.__name__.replace("<lambda>", "deliso")
    try:
        vertices, triangles = mesher()
    except ImportError as absent:
        print(f"{name:18}skipped: {absent}")
        continue
    report = deliso.verify(vertices, triangles, FIELD, ISOVALUE)
    print(f"{name:18}{len(vertices):7} vertices, smallest angle {report['quality']['min_angle_degrees']:5.1f}, "
          f"{'proven' if report['proven'] else 'not proven: ' + '; '.join(report['failures'])}")
