"""The Python package: arrays not copied, pictures that are the library's, errors that help.

Run with PYTHONPATH at the package that was built.
"""

import gc
import os
import signal
import sys
import tempfile
import threading
import types
import unittest

import numpy as np

import plume

try:
    import vtkmodules.all as vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
except ImportError:
    vtk = None
    print("plume_test.py: VTK's Python modules are not installed (Debian: python3-vtk9): its data "
          "sets are NOT tested", file=sys.stderr)


def address(array):
    return array.__array_interface__["data"][0]


def cube(n, real=np.float64, integer=np.int64):
    """Points, hexahedra and tetrahedra of the unit cube, n cells along each edge."""
    along = np.linspace(0, 1, n + 1)
    z, y, x = np.meshgrid(along, along, along, indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1).astype(real)
    k, j, i = np.meshgrid(*[np.arange(n)] * 3, indexing="ij")
    corner = (i + (n + 1) * (j + (n + 1) * k)).ravel()
    dy, dz = n + 1, (n + 1) ** 2
    hexahedra = corner[:, None] + np.array(
        [0, 1, 1 + dy, dy, dz, 1 + dz, 1 + dy + dz, dy + dz])
    loop = [1, 1 + dy, dy, dy + dz, dz, 1 + dz, 1]
    tetrahedra = np.concatenate([
        np.stack([corner, corner + a, corner + b, corner + 1 + dy + dz], axis=1)
        for a, b in zip(loop, loop[1:])])
    return points, hexahedra.astype(integer), np.ascontiguousarray(tetrahedra.astype(integer))


def waves(points):
    return np.sin(4 * points[:, 0]) * np.cos(3 * points[:, 1]) + points[:, 2]


SIZE = (48, 36)


class Arrays(unittest.TestCase):
    def test_are_read_where_they_are(self):
        for real, integer in ((np.float32, np.int32), (np.float64, np.int64)):
            points, _, tetrahedra = cube(4, real, integer)
            field = waves(points).astype(real)
            offsets = np.arange(0, tetrahedra.size + 1, 4, dtype=integer)
            kinds = np.full(len(tetrahedra), 10, np.uint8)
            for cells in (tetrahedra, {"tetrahedron": tetrahedra}, {10: tetrahedra},
                          (tetrahedra.reshape(-1), offsets, kinds)):
                mesh = plume.Mesh(points, cells, fields={"waves": field})
                self.assertEqual(address(mesh.points), address(points))
                self.assertEqual(address(mesh.connectivity), address(tetrahedra))
                self.assertEqual(address(mesh.fields["waves"]), address(field))
                self.assertEqual(mesh.points.dtype, real)
                self.assertEqual(mesh.connectivity.dtype, integer)
                self.assertEqual(mesh.copied, [])
                self.assertFalse(mesh.points.flags.writeable)

    def test_that_have_to_be_copied_are_named(self):
        points, _, tetrahedra = cube(3)
        with_counts = np.concatenate([np.full((len(tetrahedra), 1), 4), tetrahedra], axis=1)
        mesh = plume.Mesh(points.astype(np.float16), with_counts[:, 1:],
                          fields={"strided": waves(points).repeat(2)[::2],
                                  "unsigned": np.arange(len(points), dtype=np.uint32)})
        self.assertEqual(mesh.copied,
                         ["points", "connectivity", "field 'strided'", "field 'unsigned'"])
        np.testing.assert_array_equal(mesh.connectivity, tetrahedra.ravel())
        np.testing.assert_array_equal(mesh.fields["unsigned"], np.arange(len(points)))
        lists = plume.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
        self.assertEqual((lists.point_count, lists.cell_count), (4, 1))

    def test_live_as_long_as_they_are_needed(self):
        points, _, tetrahedra = cube(3)
        field = waves(points)
        held = [points, tetrahedra, field]
        before = [sys.getrefcount(array) for array in held]
        scene = plume.Scene(plume.Mesh(points, tetrahedra), field, fields_change=True)
        during = [sys.getrefcount(array) for array in held]
        self.assertTrue(all(now > then for now, then in zip(during, before)), (during, before))
        expected = scene.render(SIZE).rgba
        del scene
        gc.collect()
        self.assertEqual([sys.getrefcount(array) for array in held], before)
        scene = plume.Scene(plume.Mesh(*(a.copy() for a in (points, tetrahedra))), field.copy(),
                            fields_change=True)
        gc.collect()
        scene.set_field()
        np.testing.assert_array_equal(scene.render(SIZE).rgba, expected)

    def test_come_out_without_a_copy(self):
        points, _, tetrahedra = cube(3)
        scene = plume.Scene(plume.Mesh(points, tetrahedra), waves(points))
        picture = scene.render(SIZE, channels=["depth"])
        for array, shape in ((picture.rgba, (36, 48, 4)), (picture.channels["depth"], (36, 48))):
            self.assertEqual((array.shape, array.dtype), (shape, np.float32))
            self.assertTrue(array.flags.c_contiguous and array.flags.writeable)
            # The memory is the image's own, which a capsule gives back.
            self.assertEqual(type(array.base).__name__, "PyCapsule")
        first = picture.rgba.copy()
        again = scene.render(SIZE).rgba
        self.assertNotEqual(address(again), address(picture.rgba))
        again[:] = 7
        np.testing.assert_array_equal(picture.rgba, first)


class Pictures(unittest.TestCase):
    def test_are_the_same_however_cells_are_given(self):
        points, hexahedra, tetrahedra = cube(4)
        field = waves(points)
        image = plume.render(points, tetrahedra, field, size=SIZE)
        self.assertGreater(image[..., 3].max(), 0.3)
        offsets = np.arange(0, tetrahedra.size + 1, 4)
        kinds = np.full(len(tetrahedra), 10, np.uint8)
        half = len(tetrahedra) // 2
        for cells in ({"tetra": tetrahedra}, (tetrahedra.reshape(-1), offsets, kinds),
                      tetrahedra.astype(np.int32)):
            np.testing.assert_array_equal(plume.render(points, cells, field, size=SIZE), image)
        # Hexahedra as a list, as a grid, and as a rectilinear grid.
        listed = plume.render(points, hexahedra, field, size=SIZE)
        grid = plume.render(points, None, field, dimensions=(5, 5, 5), size=SIZE)
        along = np.linspace(0, 1, 5)
        rectilinear = plume.render(None, None, field, axes=(along,) * 3, size=SIZE)
        np.testing.assert_allclose(grid, listed, atol=1e-5)
        np.testing.assert_allclose(rectilinear, listed, atol=1e-5)
        self.assertGreater(np.abs(listed - image).max(), 1e-4)
        # A mesh of several types: the lower half in hexahedra, the upper in tetrahedra.
        upper = tetrahedra[points[tetrahedra].mean(axis=1)[:, 2] > 0.5]
        lower = hexahedra[: len(hexahedra) // 2]
        self.assertEqual(len(upper), half)
        mixed = plume.Mesh(points, {"hexahedron": lower, "tetrahedron": upper})
        self.assertEqual(mixed.cell_count, len(lower) + len(upper))
        scene = plume.Scene(mixed, field)
        t, _, _ = scene.trace((0.31, 0.37, -1), (0, 0, 1))
        self.assertAlmostEqual((t[:, 1] - t[:, 0]).sum(), 1, 6)

    def test_are_those_of_closed_forms(self):
        points, _, tetrahedra = cube(3)
        scene = plume.Scene(plume.Mesh(points, tetrahedra), points[:, 0].copy())
        scene.set_transfer_function([(0, 2, 1, 0.5, 0)])
        camera = scene.camera("+y", 1)
        camera.parallel = True
        camera.parallel_scale = 0.4
        picture = scene.render((16, 16), camera=camera, early_termination=0,
                               channels=["optical_depth"])
        opacity = 1 - np.exp(-2)
        np.testing.assert_allclose(picture.rgba[..., 3], opacity, atol=2e-6)
        np.testing.assert_allclose(picture.rgba[..., 1], 0.5 * opacity, atol=2e-6)
        np.testing.assert_allclose(picture.channels["optical_depth"], 2, atol=1e-5)
        self.assertEqual(picture.statistics["lost_rays"], 0)
        self.assertEqual(picture.statistics["rays_hit"], 256)
        integral = scene.render((16, 16), camera=camera, mode="integral").channels["integral"]
        across = 0.1 + (np.arange(16) + 0.5) / 16 * 0.8
        np.testing.assert_allclose(integral, np.broadcast_to(across, (16, 16)), atol=1e-5)

    def test_keep_to_a_tolerance(self):
        points, hexahedra, _ = cube(3)
        scene = plume.Scene(plume.Mesh(points, hexahedra), waves(points))
        near = scene.render(SIZE, tolerance=1e-3)
        reference = scene.render(SIZE, tolerance=0)
        self.assertLess(np.abs(near.rgba - reference.rgba).max(), 1e-3)
        self.assertLess(near.statistics["cells_visited"],
                        reference.statistics["cells_visited"] + 1)
        with self.assertRaisesRegex(plume.Error, "1.5"):
            scene.render(SIZE, tolerance=1.5)

    def test_of_another_field_are_those_of_a_scene_made_anew(self):
        points, hexahedra, tetrahedra = cube(4)
        first, second = points[:, 0].copy(), waves(points)
        for cells in (tetrahedra, hexahedra):
            scene = plume.Scene(plume.Mesh(points, cells), first, fields_change=True)
            anew = plume.Scene(plume.Mesh(points, cells), second)
            scene.set_field(second)
            scene.set_colors()
            np.testing.assert_array_equal(scene.render(SIZE).rgba, anew.render(SIZE).rgba)
            # In place, in the array that is borrowed.
            values = first.copy()
            scene = plume.Scene(plume.Mesh(points, cells), values, fields_change=True)
            values[:] = second
            scene.set_field()
            scene.set_colors()
            np.testing.assert_array_equal(scene.render(SIZE).rgba, anew.render(SIZE).rgba)
            self.assertEqual(scene.field["range"], anew.field["range"])

    def test_show_surfaces_with_light_and_clip_planes(self):
        points, hexahedra, _ = cube(4)
        scene = plume.Scene(plume.Mesh(points, hexahedra), points[:, 2].copy(), light=True)
        scene.set_surfaces([(0.5, 1, 1, 0, 0)], volume=False)
        picture = scene.render(SIZE, camera="-z", channels=["isovalue", "normal"])
        middle = picture.rgba[18, 24]
        self.assertEqual(middle[3], 1)
        self.assertGreater(middle[0], 0.9)  # lit head on
        self.assertAlmostEqual(picture.channels["normal.z"][18, 24], 1, 5)
        unlit = scene.render(SIZE, camera="-z", light=False).rgba[18, 24]
        np.testing.assert_array_equal(unlit, [1, 0, 0, 1])
        clipped = scene.render(SIZE, camera="-z", clip=[(0, 0, 0.6, 0, 0, 1)]).rgba
        self.assertEqual(clipped.max(), 0)
        scene.set_surfaces([], [(0.2, 0.3, 0.5, 0, 0, 1)], volume=False)
        self.assertAlmostEqual(scene.render(SIZE, camera="-z").rgba[18, 24, 3], 0.5, 5)
        # The choice of surfaces outlives that of colours.
        scene.set_colors("viridis", (0, 1), opacities=[(0, 0), (1, 1)], unit_distance=1)
        self.assertAlmostEqual(scene.render(SIZE, camera="-z").rgba[18, 24, 3], 0.5, 5)

    def test_of_cells_are_constant_or_averaged(self):
        points, hexahedra, _ = cube(2)
        values = np.arange(8.0)
        mesh = plume.Mesh(points, hexahedra, fields={"of cells": values})
        scene = plume.Scene(mesh, "of cells", cell_numbers=True)
        _, s, cells = scene.trace((0.25, 0.25, -1), (0, 0, 1))
        np.testing.assert_array_equal(s, [[0, 0], [4, 4]])
        np.testing.assert_array_equal(cells, [0, 4])
        averaged = plume.Scene(mesh, "of cells", cell_data="averaged")
        self.assertEqual(averaged.field["association"], "point")

    def test_for_screens(self):
        image = np.zeros((1, 4, 4), np.float32)
        image[0, 1] = (1, 1, 1, 1)
        image[0, 2] = (0, 0.5, 0, 1)
        image[0, 3] = (0.25, 0, 0, 0.5)  # half transparent
        shown = plume.to_srgb(image, background=(0, 0, 0))
        np.testing.assert_array_equal(shown[0], [(0, 0, 0), (255, 255, 255), (0, 188, 0),
                                                 (137, 0, 0)])
        np.testing.assert_array_equal(plume.to_srgb(image)[0, 0], (255, 255, 255))
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.ppm")
            plume.write_ppm(file, image, (0, 0, 0))
            with open(file, "rb") as written:
                self.assertEqual(written.read(), b"P6\n4 1\n255\n" + shown.tobytes())


class Errors(unittest.TestCase):
    def refuses(self, words, act):
        with self.assertRaises(plume.Error) as caught:
            act()
        self.assertIsInstance(caught.exception, ValueError)
        self.assertIn(words, str(caught.exception))

    def test_say_what_to_do(self):
        points, hexahedra, tetrahedra = cube(2)
        field = waves(points)
        mesh = plume.Mesh(points, tetrahedra, fields={"waves": field})
        scene = plume.Scene(mesh)
        for words, act in (
                ("give (n, 3)", lambda: plume.Mesh(points[:, :2], tetrahedra)),
                ("give (n, 4) for tetrahedra", lambda: plume.Mesh(points, hexahedra[:, :7])),
                ("either cells or a grid's dimensions", lambda: plume.Mesh(points)),
                ("needs points", plume.Mesh),
                ("no type of cells with rows is called 'blob'",
                 lambda: plume.Mesh(points, {"blob": tetrahedra})),
                ("give numbers", lambda: plume.Mesh(points.astype(str), tetrahedra)),
                ("there are 27 points and 48 cells", lambda: mesh.add_field("short", field[:5])),
                ("no field 'speed'; there are: waves", lambda: plume.Scene(mesh, "speed")),
                ("99", lambda: plume.render(points, tetrahedra + 99, field)),
                ("no cell_data 'best'", lambda: plume.Scene(mesh, cell_data="best")),
                ("fields_change=True", lambda: scene.set_field(field)),
                ("no colour map 'beige'; there are: cool-warm", lambda: scene.set_colors("beige")),
                ("range of two values that ascend", lambda: scene.set_colors(range=(1, 1))),
                ("rows of 5 numbers", lambda: scene.set_transfer_function([(1, 2, 3)])),
                ("no mode 'x-ray'; there are: volume", lambda: scene.render(mode="x-ray")),
                ("order 5", lambda: scene.render(order=5)),
                ("0x10", lambda: scene.render((0, 10))),
                ("no channel 'smell'", lambda: scene.render(SIZE, channels=["smell"])),
                ("sideways", lambda: scene.render(SIZE, camera="sideways")),
                ("Scene(..., light=True)", lambda: scene.render(SIZE, light=True)),
                ("shape (3,)", lambda: plume.to_srgb(np.zeros(3)))):
            with self.subTest(words):
                self.refuses(words, act)

    def test_of_the_users_functions_pass_through(self):
        points, _, tetrahedra = cube(2)
        scene = plume.Scene(plume.Mesh(points, tetrahedra), waves(points))

        def fail(_):
            raise ZeroDivisionError("mine")

        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            scene.render((256, 256), progress=fail)
        shares = []
        done = scene.render((256, 256), progress=shares.append)
        self.assertFalse(done.cancelled)
        self.assertEqual((len(shares), shares[-1]), (64, 1))
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(scene.render((256, 256), progress=lambda share: share < 0.5).cancelled)


class Threads(unittest.TestCase):
    def test_of_python_run_while_a_picture_is_made(self):
        points, hexahedra, _ = cube(12)
        scene = plume.Scene(plume.Mesh(points, hexahedra), waves(points))
        started, stop, count = threading.Event(), threading.Event(), [0]

        def run():
            started.set()
            while not stop.is_set():
                count[0] += 1

        thread = threading.Thread(target=run)
        thread.start()
        started.wait()
        before = count[0]
        scene.render((400, 400), order=3, mode="integral")
        during = count[0] - before
        stop.set()
        thread.join()
        # Were Python locked, the thread would have had no turn in between.
        self.assertGreater(during, 1000)

    def test_control_c_interrupts(self):
        points, hexahedra, _ = cube(4)
        scene = plume.Scene(plume.Mesh(points, hexahedra), waves(points))
        calls = []

        def press(share):
            calls.append(share)
            if len(calls) == 1:
                signal.raise_signal(signal.SIGINT)

        signal.signal(signal.SIGINT, signal.default_int_handler)
        with self.assertRaises(KeyboardInterrupt):
            scene.render((512, 512), threads=1, progress=press)
        self.assertLess(len(calls), 3)


class DataSets(unittest.TestCase):
    def test_are_told_by_their_attributes(self):
        points, hexahedra, tetrahedra = cube(2)
        counted = np.concatenate([np.full((len(tetrahedra), 1), 4), tetrahedra], axis=1).ravel()
        data = types.SimpleNamespace(
            points=points, cells=counted, celltypes=np.full(len(tetrahedra), 10, np.uint8),
            point_data={"waves": waves(points)}, cell_data={"number": np.arange(len(tetrahedra))})
        expected = plume.render(points, tetrahedra, waves(points), size=SIZE)
        np.testing.assert_array_equal(plume.render(data, field="waves", size=SIZE), expected)
        self.assertEqual(list(plume.Mesh(data).fields), ["waves", "number"])
        self.assertIn("cells", plume.Mesh(data).copied)
        data.cell_connectivity, data.offset = tetrahedra.ravel(), np.arange(0, 4 * 49, 4)
        self.assertEqual(address(plume.Mesh(data).connectivity), address(tetrahedra))
        data.cells, data.cell_connectivity = counted[:-7], None
        del data.cell_connectivity
        with self.assertRaisesRegex(plume.Error, "cells end before cell"):
            plume.Mesh(data)

    @unittest.skipUnless(vtk, "VTK's Python modules are not installed")
    def test_of_vtk_are_read_where_they_are(self):
        points, _, tetrahedra = cube(3)
        field = waves(points)
        data = vtk.vtkUnstructuredGrid()
        held = vtk.vtkPoints()
        held.SetData(numpy_to_vtk(points))
        data.SetPoints(held)
        cells = vtk.vtkCellArray()
        offsets = np.arange(0, tetrahedra.size + 1, 4)
        cells.SetData(numpy_to_vtkIdTypeArray(offsets),
                      numpy_to_vtkIdTypeArray(tetrahedra.ravel()))
        data.SetCells(vtk.VTK_TETRA, cells)
        array = numpy_to_vtk(field)
        array.SetName("waves")
        data.GetPointData().AddArray(array)
        mesh = plume.Mesh(data)
        self.assertEqual(address(mesh.points), address(points))
        self.assertEqual(address(mesh.connectivity),
                         address(vtk_to_numpy(data.GetCells().GetConnectivityArray())))
        self.assertEqual(address(mesh.fields["waves"]), address(field))
        self.assertEqual(mesh.copied, [])
        np.testing.assert_array_equal(plume.render(data, size=SIZE),
                                      plume.render(points, tetrahedra, field, size=SIZE))
        self.assertEqual(plume.Scene(data, "waves").field["name"], "waves")

    @unittest.skipUnless(vtk, "VTK's Python modules are not installed")
    def test_of_vtk_may_be_grids(self):
        def with_waves(data):
            places = np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])
            array = numpy_to_vtk(waves(places), deep=True)
            array.SetName("waves")
            data.GetPointData().AddArray(array)
            return data

        image = vtk.vtkImageData()
        image.SetExtent(1, 4, 0, 3, 0, 2)
        image.SetSpacing(0.5, 0.25, 0.25)
        image.SetOrigin(1, 2, 3)
        with_waves(image)
        scene = plume.Scene(image)
        np.testing.assert_array_equal(scene.bounds, [(1.5, 2, 3), (3, 2.75, 3.5)])
        self.assertIn("rectilinear grid", repr(scene))
        rectilinear = vtk.vtkRectilinearGrid()
        rectilinear.SetDimensions(4, 4, 3)
        for name, along in zip("XYZ", ([1.5, 2, 2.5, 3], [2, 2.25, 2.5, 2.75], [3, 3.25, 3.5])):
            getattr(rectilinear, f"Set{name}Coordinates")(numpy_to_vtk(np.array(along), deep=True))
        expected = scene.render(SIZE).rgba
        np.testing.assert_array_equal(plume.Scene(with_waves(rectilinear)).render(SIZE).rgba,
                                      expected)
        points = vtk.vtkPoints()
        for i in range(image.GetNumberOfPoints()):
            points.InsertNextPoint(image.GetPoint(i))
        structured = vtk.vtkStructuredGrid()
        structured.SetDimensions(4, 4, 3)
        structured.SetPoints(points)
        with_waves(structured)
        np.testing.assert_allclose(plume.Scene(structured).render(SIZE).rgba, expected, atol=1e-5)
        structured.BlankCell(0)
        hidden = plume.Scene(structured)
        self.assertEqual(len(hidden.findings), 1)
        self.assertIn("hidden cells", hidden.findings[0])
        with self.assertRaisesRegex(plume.Error, "vtkPolyData: give an unstructured grid"):
            plume.Mesh(vtk.vtkPolyData())


class Words(unittest.TestCase):
    def test_are_there_for_all_that_is_public(self):
        self.assertTrue(plume.__doc__)
        self.assertRegex(plume.__version__, r"^\d+\.\d+\.\d+$")
        for name in plume.__all__:
            thing = getattr(plume, name)
            if isinstance(thing, tuple):
                self.assertIn({"COLOR_MAPS": "viridis", "VIEWS": "iso"}[name], thing)
                continue
            self.assertTrue(thing.__doc__, name)
            if isinstance(thing, type):
                for member, value in vars(thing).items():
                    if not member.startswith("_"):
                        self.assertTrue(getattr(value, "__doc__", None), f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
