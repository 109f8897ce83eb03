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

    def test_a_run_that_stops_is_not_proven(self):
        report = deliso.mesh(two_balls(), ISOVALUE, budget_max_vertices=50).report
        self.assertEqual((report["verdict"], report["certificate"]["proven"]), ("stopped", False))
        self.assertIn("the run was stopped before", report["certificate"]["broken"][-1])

    def test_numbers_of_numpy_are_numbers(self):
        array = two_balls()
        for value in (numpy.array(1.9), numpy.float32(1.875), numpy.array(3), numpy.int8(3), numpy.longdouble(1.5)):
            found = deliso.mesh(array, ISOVALUE, stage2_rho=value).report["parameters"]["stage2"]["rho"]
            self.assertEqual(found, float(value))
        for value in (numpy.False_, numpy.array(False)):
            self.assertEqual(deliso.mesh(array, ISOVALUE, certify=value).report["verdict"], "not checked")
        self.assertEqual(deliso.mesh(array, numpy.array(ISOVALUE)).report["isovalue"], ISOVALUE)

    def test_isovalues_by_name(self):
        array = two_balls()
        array[0, 0, 0] = 1e6
        region = {"i0": 2, "k1": 12}
        part = array[2:, :, :13]
        for name in ("otsu", "50%"):
            of_part = deliso.mesh(part, name).report["isovalue"]
            self.assertNotEqual(of_part, deliso.mesh(array, name, field_smooth=0.1).report["isovalue"])
            for report in (deliso.mesh(array, name, region=region).report, deliso.topology(array, name, region=region)):
                self.assertEqual(report["isovalue"], of_part)
        array = two_balls()
        self.assertEqual(deliso.mesh(array, "50%").report["isovalue"], array.max() / 2)
        self.assertEqual(deliso.mesh(array, "otsu").report["isovalue"], deliso.info(array)["named_isovalues"]["otsu"])

    def test_labels_have_one_isovalue(self):
        labels = (two_balls() > 20) * 3
        for isovalue in (None, 0.5):
            vertices, triangles, report = deliso.mesh(labels, isovalue, field_label=3)
            self.assertEqual((report["verdict"], report["isovalue"]), ("proven", 0.5))
            self.assertTrue(deliso.verify(vertices, triangles, labels, isovalue, field_label=3)["proven"])
        with self.assertRaisesRegex(ValueError, "found 77 beside field.label, expected 0.5"):
            deliso.mesh(labels, 77, field_label=3)

    def test_angles_are_those_before_a_shear(self):
        array, affine = two_balls(), [[1, 3, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
        vertices, triangles, report = deliso.mesh(array, ISOVALUE, affine=affine)
        judged = deliso.verify(vertices, triangles, array, ISOVALUE, affine=affine)
        self.assertAlmostEqual(report["quality"]["min_angle_degrees"], judged["quality"]["min_angle_degrees"], places=6)

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
        self.expect("three lengths > 0, found (-1, 1, 1)", lambda: deliso.mesh(array, 1, spacing=(-1, 1, 1)))
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
        self.parameters(array)
        self.arguments(array)
        # One number for all samples; its memory holds no others.
        for order in "<>":
            seven = numpy.broadcast_to(numpy.array(7, dtype=order + "f8"), (9, 9, 9))
            self.expect("the data's range is 7 to 7", lambda: deliso.mesh(seven, 7))
        array[3, 2, 1] = numpy.nan
        self.expect("sample (3, 2, 1) is NaN", lambda: deliso.mesh(array, 1))
        self.expect("none.nrrd", lambda: deliso.load_volume("none.nrrd"))


    def parameters(self, array):
        self.expect("size.max_error must be a number >= 1e-6 or null, found \"array([0.1, 0.2])\"",
                    lambda: deliso.mesh(array, 1, size_max_error=numpy.array([0.1, 0.2])))
        self.expect("found \"array([0.1])\"", lambda: deliso.mesh(array, 1, size_max_error=numpy.array([0.1])))
        self.expect("found \"1j\"", lambda: deliso.mesh(array, 1, size_max_error=1j))
        self.expect("found \"b'1'\"", lambda: deliso.mesh(array, 1, size_max_error=b"1"))
        self.expect("unknown key 'direction'", lambda: deliso.mesh(array, 1, direction=numpy.eye(3)))
        self.expect("'stage2.epsilon1'", lambda: deliso.mesh(array, 1, stage2_epsilon=0.1))
        self.expect("found \"clo\\\\udce9\"", lambda: deliso.mesh(array, 1, boundary="clo\udce9"))
        self.expect("unknown key", lambda: deliso.mesh(array, 1, **{"boundary\udce9": 1}))
        self.expect("stage2.epsilon1: given twice",
                    lambda: deliso.mesh(array, 1, stage2_epsilon1=0.2, stage2={"epsilon1": 0.3}))

    def arguments(self, array):
        corner, triangle = numpy.zeros((3, 3)), [[0, 1, 2]]
        for wrong in ("0.5", [1], 1j):
            self.expect("max_distance: expected a number", lambda: deliso.verify(corner, triangle, array, 1, max_distance=wrong))
        self.expect("max_distance: expected a number > 0, found nan",
                    lambda: deliso.verify(corner, triangle, array, 1, max_distance=numpy.nan))
        for wrong in (3, False):
            self.expect("progress: expected a function", lambda: deliso.mesh(array, 1, progress=wrong))
        ragged = [[0, 1, 2], [0]]
        self.expect("array: expected an array", lambda: deliso.info(ragged))
        self.expect("vertices: expected an array", lambda: deliso.verify(ragged, triangle, array, 1))
        self.expect("triangles: expected an array", lambda: deliso.verify(corner, ragged, array, 1))
        masked = numpy.ma.masked_array(corner, mask=True)
        self.expect("vertices: some values are masked", lambda: deliso.verify(masked, triangle, array, 1))
        self.expect("found 18446744073709551615",
                    lambda: deliso.verify(corner, numpy.array([[0, 1, 2**64 - 1]], dtype="u8"), array, 1))
        self.expect("names the vertex 0, but there are none", lambda: deliso.verify(corner[:0], triangle, array, 1))
        self.expect("name: expected the name of an array, found 3", lambda: deliso.load_volume("v.vtk", name=3))
        for wrong in (None, 3.5):
            self.expect("path: expected a file name", lambda: deliso.load_volume(wrong))
            self.expect("path: expected a file name", lambda: deliso.load_mesh(wrong))
            self.expect("path: expected a file name", lambda: deliso.save_mesh(wrong, corner, triangle))
        self.expect("'a' followed by a null character", lambda: deliso.save_mesh("a\0b.ply", corner, triangle))
        self.expect("a\\udce9.ply".replace("udc", "x"), lambda: deliso.load_mesh("a\udce9.ply"))
        self.expect("report: expected the report", lambda: deliso.save_mesh("m.ply", corner, triangle, {}))


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

    def test_without_a_partial_result_a_stop_is_an_error(self):
        array = numpy.sin(numpy.arange(90**3).reshape(3 * [90]))
        with self.assertRaisesRegex(RuntimeError, "stopped by the caller's callback"):
            deliso.verify([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], array, 0.1, progress=lambda *told: False)

    def test_ctrl_c_is_never_lost(self):
        def press(stage, fraction):
            if stage == "certify":
                raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(100):  # once in a while the run is over before it is told of this stage
                deliso.mesh(two_balls(), ISOVALUE, progress=press)
        presser = self.interrupt(0.3)
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(2000):
                if deliso.mesh(two_balls(), ISOVALUE).report["verdict"] == "stopped":
                    raise KeyboardInterrupt
        presser.join()

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

    def test_names_of_files_are_those_of_the_system(self):
        vertices, triangles, _ = deliso.mesh(two_balls(), ISOVALUE)
        with tempfile.TemporaryDirectory() as folder:
            for name in (os.path.join(folder, "a\udce9.ply"), os.fsencode(folder) + b"/b.ply"):
                deliso.save_mesh(name, vertices, triangles)
                self.assertTrue(os.path.exists(name))
                numpy.testing.assert_array_equal(deliso.load_mesh(name)[0], vertices)
            self.assertEqual(sorted(os.listdir(folder)), ["a\udce9.ply", "b.ply"])

    def test_meshes_are_saved_with_what_a_verification_needs(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mesh.ply"
            deliso.save_mesh(path, *deliso.mesh(two_balls(), ISOVALUE, field_invert=True, promise_max_distance=0.75))
            head = path.read_bytes()[:400]
            self.assertIn(b"comment field.invert true", head)
            self.assertIn(b"comment promise.max_distance 0.75", head)

    def test_numpy_files_have_the_transpose(self):
        array = two_balls("C", "i2")
        with tempfile.TemporaryDirectory() as folder:
            numpy.save(Path(folder) / "v.npy", array)
            numpy.testing.assert_array_equal(deliso.load_volume(Path(folder) / "v.npy").array, array.T)

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
