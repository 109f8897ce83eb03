"""The Python module, as its users call it. DELISO_PYTHON_PACKAGE names the folder that holds the package."""

import os
import signal
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

import numpy

sys.path.insert(0, os.environ.get("DELISO_PYTHON_PACKAGE", ""))
import deliso  # noqa: E402

ISOVALUE = 20.5


def two_balls(order="C", dtype=numpy.float64):
    """Two balls that overlap, as whole numbers from 0 to 100; no symmetry of the box maps them to themselves."""
    i, j, k = numpy.meshgrid(numpy.arange(14), numpy.arange(16), numpy.arange(18), indexing="ij")
    a = numpy.sqrt((i - 5.3) ** 2 + (j - 6.1) ** 2 + (k - 6.7) ** 2)
    b = numpy.sqrt((i - 7.9) ** 2 + (j - 9.2) ** 2 + (k - 11.1) ** 2) + 0.7
    return numpy.clip(numpy.round(60 - 10 * numpy.minimum(a, b)), 0, 100).astype(dtype, order=order)


def signed_volume(vertices, triangles):
    a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
    return float(numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6)


class Meshes(unittest.TestCase):
    def test_shapes_types_and_verdict(self):
        vertices, triangles, report = deliso.mesh(two_balls(), ISOVALUE)
        self.assertEqual((vertices.dtype, triangles.dtype), (numpy.float64, numpy.int32))
        self.assertEqual((vertices.shape[1], triangles.shape[1]), (3, 3))
        self.assertEqual(report["verdict"], "proven")
        self.assertEqual(report["vertices"], len(vertices))
        self.assertGreater(signed_volume(vertices, triangles), 0)  # normals point outwards, to lower values

    def test_index_0_is_x_in_every_order_without_a_copy(self):
        reference = two_balls("F")
        low = reference.nonzero()[0].min(), reference.nonzero()[1].min(), reference.nonzero()[2].min()
        for array in (reference, two_balls("C"), two_balls("C").transpose(2, 1, 0).copy().transpose(2, 1, 0),
                      two_balls("C")[::-1, :, ::-1].copy()[::-1, :, ::-1]):
            vertices, triangles, report = deliso.mesh(array, ISOVALUE)
            self.assertFalse(report["volume"]["copied_samples"])
            self.assertEqual(report["verdict"], "proven")
            self.assertTrue(deliso.verify(vertices, triangles, reference, ISOVALUE)["proven"])
            for axis in range(3):
                self.assertGreater(vertices[:, axis].min(), low[axis])
        foreign = two_balls().astype(two_balls().dtype.newbyteorder())
        for copied in (two_balls()[:, :, :17], foreign, two_balls().tolist()):
            self.assertTrue(deliso.mesh(copied, ISOVALUE).report["volume"]["copied_samples"])

    def test_every_dtype(self):
        expected = deliso.mesh(two_balls(), ISOVALUE)
        for dtype in ("u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f2", "f4", ">f4", ">i2"):
            found = deliso.mesh(two_balls(dtype=dtype), ISOVALUE)
            numpy.testing.assert_array_equal(found.vertices, expected.vertices, dtype)
            numpy.testing.assert_array_equal(found.triangles, expected.triangles, dtype)
        mask = two_balls() > 20
        numpy.testing.assert_array_equal(deliso.mesh(mask, 0.5).vertices, deliso.mesh(mask.astype("u1"), 0.5).vertices)

    def test_spacing_and_affine(self):
        array = two_balls()
        plain = deliso.mesh(array, ISOVALUE, spacing=(0.5, 0.5, 0.5))
        numpy.testing.assert_allclose(plain.vertices, deliso.mesh(array, ISOVALUE).vertices / 2, rtol=0, atol=1e-9)
        affine = numpy.array([[0, -0.5, 0, 7], [0.5, 0, 0, 8], [0, 0, -0.5, 9], [0, 0, 0, 1]])
        vertices, triangles, report = deliso.mesh(array, ISOVALUE, affine=affine)
        self.assertEqual(report["verdict"], "proven")
        self.assertTrue(deliso.verify(vertices, triangles, array, ISOVALUE, affine=affine)["proven"])
        self.assertGreater(signed_volume(vertices, triangles), 0)  # though the map reflects
        indices = numpy.linalg.solve(affine[:3, :3], (vertices - affine[:3, 3]).T).T
        self.assertTrue(((indices >= 0) & (indices <= numpy.array(array.shape) - 1)).all())

    def test_parameters_by_name(self):
        array = two_balls()
        ways = [{"size_max_error": 0.2}, {"size.max_error": 0.2}, {"size": {"max_error": 0.2}},
                {"size_max_error": numpy.float32(0.2).astype(float)}]
        found = [deliso.mesh(array, ISOVALUE, **way) for way in ways]
        for way in found[1:3]:
            numpy.testing.assert_array_equal(way.vertices, found[0].vertices)
        self.assertLess(len(found[0].vertices), len(deliso.mesh(array, ISOVALUE).vertices))
        self.assertEqual(found[0].report["parameters"]["size"]["max_error"], 0.2)
        self.assertEqual(deliso.parameters()["stage2.epsilon1"]["default"], 0.1)
        self.assertEqual(deliso.mesh(array, ISOVALUE, spacing="ignore").report["parameters"]["spacing"], "ignore")
        self.assertEqual(deliso.mesh(array, ISOVALUE, budget_max_vertices=50).report["verdict"], "stopped")

    def test_isovalues_by_name(self):
        array = two_balls()
        self.assertEqual(deliso.mesh(array, "50%").report["isovalue"], array.max() / 2)
        self.assertEqual(deliso.mesh(array, "otsu").report["isovalue"], deliso.info(array)["named_isovalues"]["otsu"])

    def test_the_same_from_two_threads_at_once(self):
        array, found = two_balls(), {}
        expected = deliso.mesh(array, ISOVALUE)
        workers = [threading.Thread(target=lambda n=n: found.update({n: deliso.mesh(array, ISOVALUE, threads=n)}))
                   for n in (1, 2)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        for n in (1, 2):
            numpy.testing.assert_array_equal(found[n].vertices, expected.vertices)


class SecondOpinions(unittest.TestCase):
    def test_verify_judges_anybodys_mesh(self):
        array = two_balls()
        vertices, triangles, _ = deliso.mesh(array, ISOVALUE)
        reversed_report = deliso.verify(vertices, triangles[:, ::-1], array, ISOVALUE)
        self.assertFalse(reversed_report["proven"])
        self.assertFalse(reversed_report["checks"]["orientation"]["pass"])
        moved = deliso.verify(vertices + 2.5, triangles, array, ISOVALUE)
        self.assertFalse(moved["checks"]["distance"]["pass"])
        self.assertAlmostEqual(moved["checks"]["distance"]["isosurface_to_mesh"]["max_voxels"], 2.5 * 3**0.5, delta=1)
        open_mesh = deliso.verify(vertices.tolist(), triangles[1:].tolist(), array, ISOVALUE)
        self.assertIn("boundary", " ".join(open_mesh["failures"]))

    def test_topology_is_exact(self):
        found = deliso.topology(two_balls(), ISOVALUE)
        self.assertEqual((found["components"], found["euler_characteristic"], found["boundary_loops"]), (1, 2, 0))

    def test_topology_is_that_of_the_field_with_its_spacing(self):
        # Smoothing by 1.2 of the smallest spacing reaches less far along a coarse axis.
        array = numpy.zeros((12, 12, 12))
        array[5, 5, 2:10:2] = 1
        found = []
        for spacing in ((1, 1, 1), (1, 1, 4)):
            exact = deliso.topology(array, 0.06, spacing=spacing, field_smooth=0.8)
            made = deliso.mesh(array, 0.06, spacing=spacing, field_smooth=0.8).report
            self.assertEqual(made["verdict"], "proven")
            self.assertEqual(exact["components"], made["components"])
            found.append(exact["components"])
        self.assertEqual(found, [1, 4])

    def test_info(self):
        array = two_balls()
        array[3, 2, 1] = numpy.nan
        found = deliso.info(array)
        self.assertEqual(found["dims"], [14, 16, 18])
        self.assertEqual(found["not_finite"], {"nan": 1, "infinite": 0})
        self.assertEqual(found["range"], [0, numpy.nanmax(array)])


class Mistakes(unittest.TestCase):
    def expect(self, sentence, call):
        with self.assertRaises(ValueError) as raised:
            call()
        self.assertIn(sentence, str(raised.exception))

    def test_each_is_a_value_error_with_a_sentence(self):
        array = two_balls()
        self.expect("isovalue 1000", lambda: deliso.mesh(array, 1000))
        self.expect("the nearest known key is 'stage2.rho'", lambda: deliso.mesh(array, 1, stage2={"roh": 2}))
        self.expect("boundary must be one of 'open', 'closed', found \"shut\"", lambda: deliso.mesh(array, 1, boundary="shut"))
        self.expect("stage2.rho must be a number >= 1, found \"[1]\"", lambda: deliso.mesh(array, 1, stage2_rho=[1]))
        self.expect("three dimensions, found 2", lambda: deliso.mesh(array[0], 1))
        self.expect("found the dtype complex128", lambda: deliso.mesh(array * 1j, 1))
        self.expect("each must be at least 2", lambda: deliso.mesh(array[:1], 1))
        self.expect("spacing", lambda: deliso.mesh(array, 1, spacing=(1, 1)))
        self.expect("found both", lambda: deliso.mesh(array, 1, spacing=(1, 1, 1), affine=numpy.eye(4)))
        self.expect("'P%'", lambda: deliso.mesh(array, "most"))
        self.expect("names the vertex 9", lambda: deliso.verify(numpy.zeros((3, 3)), [[0, 1, 9]], array, 1))
        self.expect("shape (n, 3)", lambda: deliso.verify(numpy.zeros((3, 2)), [[0, 1, 2]], array, 1))
        self.expect("vertices: expected real numbers", lambda: deliso.verify(1j * numpy.ones((3, 3)), [[0, 1, 2]], array, 1))
        self.expect("whole numbers", lambda: deliso.verify(numpy.zeros((3, 3)), [[0, 1.5, 2]], array, 1))
        for wrong in (-1, 1.5, "one", None, 2**64):
            self.expect("seed: expected a whole number", lambda: deliso.mesh(array, 1, seed=wrong))
            self.expect("threads: expected a whole number", lambda: deliso.topology(array, 1, threads=wrong))
            self.expect("dropped_components: expected a whole number",
                        lambda: deliso.verify(numpy.zeros((3, 3)), [[0, 1, 2]], array, 1, dropped_components=wrong))
        for wrong in (None, [1], 10**400):
            self.expect("isovalue: expected a number", lambda: deliso.mesh(array, wrong))
        self.expect("found \"1180591620717411303424\"", lambda: deliso.mesh(array, 1, shape_rounds=2**70))
        self.expect("found nan", lambda: deliso.mesh(array, 1, stage2_rho=numpy.nan))
        self.expect("three lengths", lambda: deliso.mesh(array, 1, spacing=[[1], [1], [1]]))
        self.expect("masked", lambda: deliso.mesh(numpy.ma.masked_greater(array, 50), 1))
        # One number for all samples; its memory holds no others.
        for order in "<>":
            seven = numpy.broadcast_to(numpy.array(7, dtype=order + "f8"), (9, 9, 9))
            self.expect("the data's range is 7 to 7", lambda: deliso.mesh(seven, 7))
        array[3, 2, 1] = numpy.nan
        self.expect("sample (3, 2, 1) is NaN", lambda: deliso.mesh(array, 1))
        self.expect("none.nrrd", lambda: deliso.load_volume("none.nrrd"))


class Interruptions(unittest.TestCase):
    # Enough work to be interrupted: a fine mesh that takes far longer than the test.
    def long_run(self, progress=None):
        i, j, k = numpy.meshgrid(*3 * [numpy.arange(26.0)], indexing="ij")
        waves = numpy.sin(i / 2.3) + numpy.sin(j / 2.7) + numpy.sin(k / 3.1)
        return deliso.mesh(waves, 0.1, size_max_error=0.0005, progress=progress)

    def test_progress_is_told_and_stops(self):
        told = []
        deliso.mesh(two_balls(), ISOVALUE, progress=lambda stage, fraction: told.append((stage, fraction)))
        fractions = [fraction for _, fraction in told]
        self.assertEqual(fractions, sorted(fractions))
        vertices, triangles, report = self.long_run(lambda stage, fraction: stage != "refine")
        self.assertEqual((report["verdict"], report["stopped_early"]), ("stopped", True))
        report = self.long_run(lambda stage, fraction: numpy.bool_(stage != "refine")).report
        self.assertEqual(report["verdict"], "stopped")
        self.assertGreater(len(triangles), 0)
        self.assertLess(triangles.max(), len(vertices))

    def test_an_exception_of_the_callback_comes_out(self):
        def fail(stage, fraction):
            raise KeyError(stage)
        with self.assertRaises(KeyError):
            self.long_run(fail)

    def interrupt(self, *delays):
        def press():
            for delay in delays:
                time.sleep(delay)
                os.kill(os.getpid(), signal.SIGINT)
        presser = threading.Thread(target=press)
        presser.start()
        return presser

    def test_ctrl_c_ends_with_the_partial_mesh(self):
        presser = self.interrupt(1.0)
        begun = time.monotonic()
        _, triangles, report = self.long_run()
        presser.join()
        self.assertEqual(report["verdict"], "stopped")
        self.assertGreater(len(triangles), 0)
        self.assertLess(time.monotonic() - begun, 60)

    def test_a_second_ctrl_c_raises_at_once(self):
        presser = self.interrupt(1.0, 0.12)
        with self.assertRaises(KeyboardInterrupt):
            self.long_run()
            time.sleep(5)  # where the first one has been enough by itself, the second one comes here
        presser.join()


class Files(unittest.TestCase):
    def test_meshes_and_volumes_of_files(self):
        vertices, triangles, _ = deliso.mesh(two_balls(), ISOVALUE)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mesh.ply"
            deliso.save_mesh(path, vertices, triangles)
            again = deliso.load_mesh(path)
            numpy.testing.assert_array_equal(again[0], vertices)
            numpy.testing.assert_array_equal(again[1], triangles)
            numpy.save(Path(folder) / "volume.npy", two_balls("F", "i2"))
            volume = deliso.load_volume(Path(folder) / "volume.npy")
            self.assertEqual(volume.affine.shape, (4, 4))
            numpy.testing.assert_array_equal(numpy.sort(volume.array, axis=None), numpy.sort(two_balls(), axis=None))
            array = volume.array
            del volume
            self.assertFalse(array.flags.writeable)
            self.assertEqual(deliso.mesh(array, ISOVALUE).report["verdict"], "proven")

    def test_arrays_are_in_the_order_of_the_file(self):
        samples = numpy.arange(60, dtype="u1").reshape((5, 4, 3), order="F")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "backwards.nrrd"
            path.write_bytes(b"NRRD0005\ntype: uint8\ndimension: 3\nsizes: 5 4 3\nencoding: raw\nspace dimension: 3\n"
                             b"space directions: (-0.5,0,0) (0,1,0) (0,0,-1)\nspace origin: (9,0,7)\n\n"
                             + samples.tobytes(order="F"))
            volume = deliso.load_volume(path)
            numpy.testing.assert_array_equal(volume.array, samples)
            numpy.testing.assert_array_equal(numpy.diag(volume.affine), [-0.5, 1, -1, 1])
            numpy.testing.assert_array_equal(volume.affine[:3, 3], [9, 0, 7])


if __name__ == "__main__":
    unittest.main()
