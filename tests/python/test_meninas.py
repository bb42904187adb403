"""The Python module: what it returns is what the program makes, and what goes wrong is one line.

Run by python_test.sh with the folder of gallery scenes and the program in MENINAS_GALLERY and MENINAS_PROGRAM.
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy
import scipy.sparse

import meninas

GALLERY = pathlib.Path(os.environ["MENINAS_GALLERY"])
PROGRAM = os.environ["MENINAS_PROGRAM"]


def gallery(name, **settings):
    return meninas.load(GALLERY / f"{name}.gltf", quality="draft", **settings)


class Pictures(unittest.TestCase):
    def test_a_picture_is_that_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            by_program = pathlib.Path(folder) / "room.exr"
            subprocess.run([PROGRAM, "render", GALLERY / "cornell-mirror.gltf", "--quality", "draft", "--size", "40x30",
                            "--layers", "light", "-o", by_program, "--quiet"], check=True)
            picture = gallery("cornell-mirror").render(size=(40, 30), layers="light")
            self.assertEqual(picture.shape, (30, 40, 3))
            self.assertEqual(picture.dtype, numpy.float32)
            read = meninas.read_picture(by_program)
            numpy.testing.assert_array_equal(picture, read)
            self.assertEqual(sorted(picture.layers), sorted(read.layers))
            # Sums of nine floats in another order: a few roundings of the brightest.
            numpy.testing.assert_allclose(sum(picture.layers.values()), picture, atol=1e-5 * picture.max())
            picture.write(pathlib.Path(folder) / "again.exr")
            self.assertEqual((pathlib.Path(folder) / "again.exr").read_bytes(), by_program.read_bytes())

    def test_a_png_is_that_of_the_program_where_it_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            by_program = pathlib.Path(folder) / "room.png"
            subprocess.run([PROGRAM, "render", GALLERY / "cornell-mirror.gltf", "--quality", "draft", "--size", "48x48",
                            "-o", by_program, "--quiet"], check=True)
            gallery("cornell-mirror").render(size="48x48", png=True).write(pathlib.Path(folder) / "again.png")
            self.assertEqual((pathlib.Path(folder) / "again.png").read_bytes(), by_program.read_bytes())

    def test_what_is_computed_from_a_picture_is_an_array_and_outlives_it(self):
        half = gallery("furnace").render(size="8x8")[:4] * 0.5
        self.assertEqual(half.shape, (4, 8, 3))
        self.assertTrue(numpy.isfinite(half).all())
        whole = gallery("furnace").render(size="8x8")
        for computed in (whole + 1, whole.copy(), whole.mean(axis=0), -whole):
            self.assertIs(type(computed), numpy.ndarray)
        with self.assertRaises(meninas.UsageError):
            whole[:4].write("half.png")

    def test_arrays_cannot_be_written(self):
        with self.assertRaises(ValueError):
            gallery("furnace").render(size="8x8")[0, 0, 0] = 1

    def test_distances_are_those_of_diff(self):
        room = gallery("cornell-mirror")
        picture, other = room.render(size="32x32"), room.render(size="32x32", seed=1)
        self.assertEqual(meninas.diff(picture, picture)["rmse"], 0.0)
        apart = meninas.diff(picture, other)
        expected = numpy.sqrt(numpy.mean((numpy.asarray(picture, dtype=float) - other) ** 2))
        self.assertAlmostEqual(apart["rmse"], expected, delta=1e-6 * expected)


class Solutions(unittest.TestCase):
    def test_a_solution_is_linear_in_its_lamps(self):
        room = gallery("cornell-mirror")
        solution = room.solve(by_lamp=True)
        dimmed = solution.relight({"lamp": 0.5})
        numpy.testing.assert_array_equal(dimmed.irradiance, numpy.float32(0.5) * solution.irradiance)
        numpy.testing.assert_array_equal(room.solve(lamps={"lamp": 0.5}).irradiance, dimmed.irradiance)
        self.assertEqual(solution.vertices.shape, solution.irradiance.shape)
        self.assertEqual(solution.elements.shape, (solution.area.size, 4))
        self.assertLess(solution.elements.max(), len(solution.vertices))
        self.assertEqual(solution.nodes.size, solution.area.size)

    def test_a_solution_that_was_written_is_read_again(self):
        room = gallery("cornell-mirror")
        solution = room.solve()
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a solution.glb"
            solution.write(file)
            again = room.read_solution(file)
        numpy.testing.assert_array_equal(again.irradiance, solution.irradiance)
        numpy.testing.assert_array_equal(again.render(size="16x16"), solution.render(size="16x16"))

    def test_nodes_emit_what_they_are_told(self):
        # Radiosity is linear in its one lamp: 17, 12 and 4 W/m^2/sr are pi times as much radiosity.
        room = gallery("cornell")
        told = room.solve(emission={"lamp": 2.0 * numpy.pi * numpy.array([17.0, 12.0, 4.0])})
        numpy.testing.assert_allclose(told.irradiance, 2.0 * room.solve().irradiance, rtol=1e-4, atol=1e-5)
        self.assertEqual(float(abs(room.solve(emission={"lamp": 0.0}).irradiance).max()), 0.0)
        with self.assertRaisesRegex(meninas.UsageError, "no node 'lmap', did you mean 'lamp'"):
            room.solve(emission={"lmap": 1.0})
        with self.assertRaisesRegex(meninas.UsageError, "of node 'lamp' is no light"):
            room.emitting({"lamp": -1.0})

    def test_light_at_a_point_of_a_furnace_is_that_of_its_walls(self):
        # In a closed room of one radiosity B everything receives B, on any side of any point.
        solution = gallery("furnace").solve()
        walls = numpy.average(solution.irradiance, axis=0)
        found = solution.irradiance_at([[0.1, 0.5, 0.2]] * 2, [[0, 1, 0], [1, 2, 3]])
        numpy.testing.assert_allclose(found["total"], [walls, walls], rtol=1e-2)  # the scatter of walls
        self.assertFalse(found["inside"].any())


class Factors(unittest.TestCase):
    def test_rows_of_a_closed_room_add_up_to_one_and_solve_as_written_down(self):
        factors = gallery("furnace").form_factors(elements=200)
        rows = scipy.sparse.csr_matrix(factors.arrays(), shape=factors.shape)
        numpy.testing.assert_allclose(rows.sum(1), 1.0, atol=1e-5)  # a row of floats
        emission = numpy.zeros((len(factors), 3))
        emission[3] = [1.0, 2.0, 0.0]
        solved = factors.solve(emission, solver="direct")
        residual = emission + factors.reflectance * (rows @ solved["radiosity"]) - solved["radiosity"]
        self.assertLess(abs(residual).max(), 1e-5)
        self.assertTrue(solved["converged"])

    def test_between_nodes_is_a_block_of_the_whole(self):
        factors = gallery("cornell-mirror").form_factors(elements=150)
        rows = scipy.sparse.csr_matrix(factors.arrays(), shape=factors.shape).toarray()
        floor, back = factors.elements_of("floor"), factors.elements_of("back")
        numpy.testing.assert_array_equal(factors.between("floor", "back"), rows[numpy.ix_(floor, back)])
        scipy_rows = scipy.sparse.csr_matrix(factors.arrays(), shape=factors.shape)
        scipy_rows.sort_indices()  # writes into what it was given
        self.assertEqual(scipy_rows.max(axis=1).shape, (len(factors), 1))

    def test_arrays_keep_their_object_alive(self):
        data, indices, indptr = gallery("furnace").form_factors(elements=50).arrays()
        self.assertEqual(int(indptr[-1]), data.size)
        self.assertGreater(data.sum(), 0.0)


class Failures(unittest.TestCase):
    def test_what_goes_wrong_is_one_line_with_its_kind(self):
        room = gallery("furnace")
        picture = room.render(size="8x8")
        for kind, part, call in (
            (meninas.UsageError, "did you mean 'quality'", lambda: room.render(qualty="draft")),
            (meninas.UsageError, "where the room is loaded", lambda: room.render(background=1)),
            (meninas.UsageError, "no camera 'nobody'", lambda: room.solve().render("nobody")),
            (meninas.UsageError, "(n, 3)", lambda: room.solve().irradiance_at([[0, 1]], [[0, 1, 0]])),
            (meninas.UsageError, "by-lamp", lambda: room.solve().relight({"all": 2})),
            (meninas.UsageError, "lamps: 'all'", lambda: room.solve(by_lamp=True).relight({"all": [1, 2]})),
            (meninas.UsageError, "there is no 'nobody'", lambda: room.form_factors(elements=20).between("nobody", 0)),
            (meninas.UsageError, "of one size", lambda: meninas.diff(picture, room.render(size="9x8"))),
            (meninas.UsageError, "size", lambda: room.render(size=5)),
            (meninas.UsageError, "no dict", lambda: room.solve(by_lamp=True).relight("all")),
            (meninas.UsageError, "there is no -1", lambda: room.form_factors(elements=20).elements_of(-1)),
            (meninas.UsageError, "pictures are wanted", lambda: meninas.diff(numpy.ones((8, 8, 3)), picture)),
            (meninas.UsageError, "no path", lambda: meninas.load(None)),
            (meninas.UsageError, "within 1e+06 m", lambda: room.solve().irradiance_at([[1e18, 0, 0]], [[0, 1, 0]])),
            (meninas.InputError, "caf", lambda: meninas.load(b"/nowhere/caf\xe9.gltf")),
            (meninas.InputError, "nowhere.gltf", lambda: meninas.load("nowhere.gltf")),
            (meninas.OutputError, "no such folder", lambda: picture.write("/nowhere at all/room.png")),
            (meninas.Cancelled, "cancelled", lambda: room.render(progress=lambda stage, done: False)),
        ):
            with self.subTest(part), self.assertRaises(kind) as raised:
                call()
            self.assertIn(part, str(raised.exception))
            self.assertNotIn("\n", str(raised.exception))

    def test_warnings_and_progress_are_told(self):
        warnings, stages = [], []
        room = meninas.load(self.without_camera(), quality="draft", warning=warnings.append)
        room.render(size="64x64", warning=warnings.append, progress=lambda stage, done: stages.append((stage, done)))
        self.assertEqual([text for text in warnings if "no camera" in text], ["no camera: a default view of the whole scene is used"])
        self.assertTrue(stages)
        self.assertTrue(all(0.0 <= done <= 1.0 for _, done in stages))

    def without_camera(self):
        scene = json.loads((GALLERY / "furnace.gltf").read_text())
        del scene["cameras"]
        for node in scene["nodes"]:
            node.pop("camera", None)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for file in GALLERY.glob("furnace*"):
            (pathlib.Path(folder.name) / file.name).write_bytes(file.read_bytes())
        (pathlib.Path(folder.name) / "furnace.gltf").write_text(json.dumps(scene))
        return pathlib.Path(folder.name) / "furnace.gltf"

    def test_python_ends_while_a_call_goes_on(self):
        code = ("import meninas, sys, threading, time; room = meninas.load(sys.argv[1]);"
                "threading.Thread(target=lambda: room.render(size='2000x2000', quality='fine'), daemon=True).start(); time.sleep(0.3)")
        ended = subprocess.run([sys.executable, "-c", code, GALLERY / "meninas.gltf"], capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_an_error_of_a_listener_ends_the_call(self):
        def fail(stage, done):
            raise KeyError(stage)

        with self.assertRaises(KeyError):
            gallery("cornell-mirror").render(size="64x64", progress=fail)

    def test_control_c_ends_points_and_rows_too(self):
        solution = gallery("meninas").solve()
        factors = gallery("furnace").form_factors(elements=500)
        points = numpy.full((200000, 3), 1.0)
        # A solve is over in milliseconds: the signal comes while it tells of an iterate.
        interrupt = lambda *_: os.kill(os.getpid(), signal.SIGINT)
        threading.Timer(0.3, interrupt).start()
        with self.assertRaises(KeyboardInterrupt):
            solution.irradiance_at(points, [[0.0, 1.0, 0.0]])
        with self.assertRaises(KeyboardInterrupt):
            factors.solve(progress=interrupt)
        told = []
        factors.solve(progress=lambda stage, done: told.append((stage, done)))
        with self.assertRaises(meninas.Cancelled):
            solution.irradiance_at(points, [[0.0, 1.0, 0.0]], progress=lambda stage, done: False)

    def test_plan_is_of_the_room_that_was_read(self):
        path = self.without_camera()
        room = meninas.load(path, quality="draft", warning=None)
        path.unlink()
        self.assertGreaterEqual(room.plan()["emitters"], 1)

    def test_a_plan_has_the_warnings_of_the_file_that_were_told(self):
        document = json.loads((GALLERY / "furnace.gltf").read_text())
        document.setdefault("extensionsUsed", []).append("EXT_lights_area")
        document.setdefault("extensions", {})["EXT_lights_area"] = {"lights": [{"type": "rect", "size": 0.0}]}
        document["scenes"][0]["nodes"].append(len(document["nodes"]))
        document["nodes"].append({"name": "panel", "extensions": {"EXT_lights_area": {"light": 0}}})
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "room.gltf"
            path.write_text(json.dumps(document))
            told = []
            room = meninas.load(path, quality="draft", warning=told.append)
        expected = [text for text in told if "without area" in text]
        self.assertEqual(len(expected), 1)
        self.assertEqual([text for text in room.plan()["warnings"] if "without area" in text], expected)

    def test_control_c_ends_a_long_call(self):
        room = gallery("meninas")
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            room.render(size="4000x4000", quality="fine")
        self.assertEqual(room.render(size="4x4").shape, (4, 4, 3))  # and nothing is lost


if __name__ == "__main__":
    unittest.main()
