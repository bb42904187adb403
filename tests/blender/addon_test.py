"""Runs inside Blender: blender -b --factory-startup -P addon_test.py -- ADDON.zip MENINAS WORK_FOLDER

Pictures are compared with those of Cycles, whose noise is measured by two of them with different seeds.
"""

import glob
import math
import os
import signal
import sys
import tempfile
import threading
import time
import traceback
import unittest

import bpy
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rooms  # noqa: E402
from in_blender import (  # noqa: E402
    PREFERENCES, PROGRAM, SAID, WORK, by_cycles, by_meninas, engine, exr, patches, png, program,
    rendered, room)
from units import Units  # noqa: E402, F401: its tests are these, too


class Rooms(unittest.TestCase):
    """The mean of all patches is within 1 % of Cycles', and each patch within 1 % and four standard errors of Cycles' own
    noise, which two seeds tell."""

    def compare(self, name, samples, size=8):
        scene = rooms.ROOMS[name]()
        ours = by_meninas(scene, name)
        seeds = [by_cycles(scene, name, samples, seed) for seed in (1, 2)]
        theirs = (seeds[0] + seeds[1]) / 2.0
        combined = ours["Combined"][..., :3]
        scale = 0.4 / theirs.mean()
        png(os.path.join(WORK, f"{name}.png"), np.concatenate([combined, theirs], axis=1) * scale)
        mine, cycles = (patches(picture, size) for picture in (combined, theirs))
        lit = cycles > 0.05 * theirs.mean()
        noise = (patches(seeds[0], size) - patches(seeds[1], size)) / (2.0 * cycles.clip(1e-9))
        sigma = math.sqrt((noise[lit] ** 2).mean())
        ratio = mine[lit] / cycles[lit]
        mean = mine[lit].mean() / cycles[lit].mean()
        print(f"{name}: mean {mean:.4f} of Cycles; {lit.sum()} patches {ratio.min():.3f} to {ratio.max():.3f}, "
              f"rms {math.sqrt(((ratio - 1) ** 2).mean()):.4f}, of which noise of Cycles {sigma:.4f}")
        self.assertGreater(lit.sum(), 0.6 * lit.size)
        self.assertAlmostEqual(mean, 1.0, delta=0.01)
        self.assertLess(abs(ratio - 1.0).max(), 0.01 + 4.0 * sigma)
        return ours

    def test_cornell_box(self):
        ours = self.compare("cornell", 1024)
        light = [name for name in ours if name.startswith(("Emission", "Direct", "Mirrored"))]
        self.assertEqual(len(light), 9)
        total = sum(ours[name] for name in light)
        np.testing.assert_allclose(total, ours["Combined"][..., :3], rtol=1e-5, atol=1e-6)

    def test_mirror_that_lights_a_wall(self):
        ours = self.compare("mirror_room", 2048, 16)  # caustics are noisy in Cycles
        self.assertGreater(ours["Mirrored"].sum(), 0.3 * ours["Combined"][..., :3].sum())
        self.assertGreater(ours["Direct by Mirror"].sum() + ours["Mirrored by Mirror"].sum(), 0.0)

    def test_lamps_that_hang_in_a_room(self):
        ours = self.compare("hanging_lamps", 1024)
        self.assertEqual(float(abs(ours["Emission"]).max()), 0.0)
        self.assertGreater(float(ours["Emission by Mirror"].max()), 0.0)

    def test_room_lit_by_the_world(self):
        self.compare("world_room", 512)


class Passes(unittest.TestCase):
    def test_depth_normal_albedo_and_lamps(self):
        scene = rooms.cornell()
        rooms.light("Zweite Lampe ö", "POINT", 30.0, (1.0, 1.0, 2.5), shadow_soft_size=0.0)
        ours = by_meninas(scene, "passes", use_lamps=True, quality="draft")
        # The back wall, 8.6 m before the camera.
        self.assertAlmostEqual(float(ours["Depth"][40, 34, 0]), 8.6, delta=1e-3)
        np.testing.assert_allclose(ours["Normal"][40, 34], (0.0, -1.0, 0.0), atol=1e-4)
        np.testing.assert_allclose(ours["Albedo"][40, 34], 0.7, atol=1e-3)
        self.assertGreater(float(ours["Depth"][0, 0, 0]), 1e9)
        # The run that tells lamps apart shows all of the field, and differs from the other one within the accuracy of a draft.
        lamps = ours["Lamp Area"] + ours["Lamp Zweite Lampe ö"]
        self.assertAlmostEqual(float(lamps.mean() / ours["Combined"][..., :3].mean()), 1.0, delta=0.02)

    def test_without_mirrors(self):
        scene = rooms.mirror_room()
        ours = by_meninas(scene, "black", use_mirrors=False, quality="draft")
        self.assertEqual(float(ours["Combined"][31, 57, :3].sum()), 0.0)
        ours = by_meninas(scene, "black", quality="draft")
        self.assertGreater(float(ours["Combined"][31, 57, :3].sum()), 0.0)

    def test_accuracy_by_error(self):
        for mirrors in (True, False):
            ours = by_meninas(rooms.cornell(), "error", accuracy="ERROR", error=0.05, use_lamps=True, use_mirrors=mirrors)
            np.testing.assert_allclose(ours["Lamp Area"].mean(), ours["Combined"][..., :3].mean(), rtol=0.05)


class Scenes(unittest.TestCase):
    """What is exported is what Blender renders, and the session stays as it is."""

    def nodes_of(self, scene, frames=((1, 0.0),)):
        import json

        with tempfile.TemporaryDirectory() as folder:
            blend, _ = room.write_blend(scene, folder)
            made = program.run(room.export_steps(blend, scene.name, scene.view_layers[0].name, frames, folder))
            files = []
            for frame in made["frames"]:
                with open(frame["scene"], encoding="utf-8") as file:
                    files.append(json.load(file))
            return files, made

    def corners(self, gltf, name):
        node = next(node for node in gltf["nodes"] if node["name"] == name)
        primitives = gltf["meshes"][node["mesh"]]["primitives"]
        return sum(gltf["accessors"][p["indices"]]["count"] for p in primitives)

    def test_modifiers_visibility_instances_and_frames(self):
        scene = rooms.cornell()
        grey = rooms.diffuse("grey", 0.5)
        smooth = rooms.box("smooth", (1, 1, 1), (1.2, 1.2, 1.2), grey, inward=False)
        modifier = smooth.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels, modifier.render_levels = 1, 2
        rooms.box("not rendered", (1, 1, 1), (2, 2, 2), grey).hide_render = True
        rooms.box("not in the viewport", (3, 3, 1), (3.1, 3.1, 1.1), grey).hide_viewport = True
        inside = bpy.data.collections.new("inside")
        chair = rooms.box("chair", (0, 0, 0), (0.1, 0.1, 0.1), grey, inward=False)
        scene.collection.objects.unlink(chair)
        inside.objects.link(chair)
        for k in range(2):
            copy = bpy.data.objects.new(f"copy {k}", None)
            copy.instance_type, copy.instance_collection, copy.location = "COLLECTION", inside, (0.5 + k, 0.5, 0.0)
            scene.collection.objects.link(copy)
        smooth.keyframe_insert("location", frame=1)
        smooth.location.x = 1.0
        smooth.keyframe_insert("location", frame=11)
        glow = rooms.emission("glow", 2.0)
        rooms.box("glowing", (3, 3, 2), (3.1, 3.1, 2.1), glow, inward=False)
        strength = glow.node_tree.nodes["Emission"].inputs["Strength"]
        strength.keyframe_insert("default_value", frame=1)
        strength.default_value = 7.0
        strength.keyframe_insert("default_value", frame=11)
        scene.frame_set(3)
        before = sorted(thing.name for thing in bpy.data.objects), scene.frame_current
        files, made = self.nodes_of(scene, [(1, 0.0), (11, 0.0)])
        self.assertEqual(before, (sorted(thing.name for thing in bpy.data.objects), scene.frame_current))
        names = [node["name"] for node in files[0]["nodes"]]
        self.assertIn("not in the viewport", names)
        self.assertNotIn("not rendered", names)
        self.assertEqual(sum(name.startswith("chair") for name in names), 2)
        self.assertEqual(self.corners(files[0], "smooth"), 6 * 16 * 2 * 3)
        places = [next(n for n in gltf["nodes"] if n["name"] == "smooth").get("translation", [0, 0, 0])[0] for gltf in files]
        self.assertEqual(places, [0.0, 1.0])
        glows = [next(m for m in gltf["materials"] if m["name"] == "glow") for gltf in files]
        strengths = [m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] for m in glows]
        np.testing.assert_allclose(strengths, [2.0, 7.0], rtol=1e-6)
        np.testing.assert_allclose([m["pbrMetallicRoughness"]["baseColorFactor"][:3] for m in glows], 0.0)

    def test_area_lamps_are_no_faces(self):
        scene = rooms.cornell()
        parent = bpy.data.objects.new("turned", None)
        scene.collection.objects.link(parent)
        parent.rotation_euler, parent.scale = (0.3, 0.2, 0.1), (2.0, 2.0, 2.0)
        lamp = scene.objects["Area"]
        lamp.parent, lamp.data.shape, lamp.data.size, lamp.data.size_y = parent, "ELLIPSE", 0.8, 0.4
        rooms.light("Portal", "AREA", 10.0, (1.0, 1.0, 1.0)).data.cycles.is_portal = True
        (gltf,), _ = self.nodes_of(scene)
        (light,) = gltf["extensions"]["EXT_lights_area"]["lights"]
        node = next(node for node in gltf["nodes"] if node["name"] == "Area")
        self.assertEqual(node["extensions"]["EXT_lights_area"], {"light": 0})
        self.assertNotIn("mesh", node)
        self.assertNotIn("Portal", [node["name"] for node in gltf["nodes"]])
        self.assertEqual((light["type"], light["name"]), ("disk", "Area"))
        self.assertAlmostEqual(light["size"], 0.8, places=5)
        self.assertAlmostEqual(light["extras"]["aspect"], 2.0, places=5)
        np.testing.assert_allclose(node.get("scale", (1.0, 1.0, 1.0)), 1.0, rtol=1e-5)
        # 200 W from pi 0.8 m by 0.4 m times 4: P / (4 A).
        self.assertAlmostEqual(light["intensity"], 200.0 / (4.0 * math.pi * 0.8 * 0.4), places=3)

    def test_lens(self):
        scene = rooms.cornell()
        camera = scene.camera.data
        camera.dof.use_dof, camera.dof.focus_distance, camera.dof.aperture_fstop = True, 3.0, 1.4
        (gltf,), _ = self.nodes_of(scene)
        extras = next(node for node in gltf["nodes"] if "camera" in node)["extras"]
        self.assertAlmostEqual(extras["fstop"], 1.4, places=5)
        self.assertAlmostEqual(extras["focus_distance"], 3.0, places=5)
        self.assertAlmostEqual(extras["focal_length"], camera.lens, places=3)

    def test_warnings_name_objects(self):
        scene = rooms.cornell()
        scene.objects["Area"].name = "Desk lamp"
        scene.objects["Desk lamp"].data.spread = math.radians(60.0)
        rooms.mesh("bare thing", [(1, 1, 1), (2, 1, 1), (2, 2, 1)], [(0, 1, 2, 0)], [])
        by_meninas(scene, "warnings", quality="draft")
        self.assertTrue(any("Desk lamp" in line and "spread" in line for line in SAID), SAID)
        self.assertTrue(any("bare thing" in line for line in SAID), SAID)

    def test_a_scene_without_lamps_is_black_and_said(self):
        scene = rooms.cornell()
        bpy.data.objects.remove(scene.objects["Area"])
        ours = by_meninas(scene, "dark", quality="draft")
        self.assertEqual(float(ours["Combined"][..., :3].sum()), 0.0)
        self.assertTrue(SAID)

    def test_a_scene_without_a_camera_is_said(self):
        scene = rooms.cornell()
        bpy.data.objects.remove(scene.camera)
        scene.render.engine = "MENINAS"
        with self.assertRaisesRegex(RuntimeError, "camera"):
            bpy.ops.render.render()


class Program(unittest.TestCase):
    def tearDown(self):
        PREFERENCES.program = PROGRAM

    def assert_nothing_is_left(self):
        self.assertEqual(glob.glob(os.path.join(tempfile.gettempdir(), "meninas-*")), [])

    def test_missing_program(self):
        scene = rooms.cornell()
        scene.render.engine = "MENINAS"
        PREFERENCES.program = "/no such place/meninas"
        with self.assertRaisesRegex(RuntimeError, "'/no such place/meninas' is not there .* Preferences"):
            bpy.ops.render.render()
        with self.assertRaisesRegex(RuntimeError, "is not there"):
            bpy.ops.meninas.bake()
        self.assert_nothing_is_left()

    def test_a_program_that_fails_is_quoted(self):
        scene = rooms.cornell()
        scene.render.engine = "MENINAS"
        broken = os.path.join(WORK, "broken program")
        with open(broken, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\necho 'meninas: room.gltf: /meshes/0: too odd' >&2\nexit 3\n")
        os.chmod(broken, 0o755)
        PREFERENCES.program = broken
        with self.assertRaisesRegex(RuntimeError, "Meninas: room.gltf: /meshes/0: too odd"):
            bpy.ops.render.render()
        self.assert_nothing_is_left()

    def test_a_process_ends_with_its_steps(self):
        """Escape in a bake closes the generator."""
        began = []
        original = program.subprocess.Popen
        program.subprocess.Popen = lambda *a, **k: began.append(original(*a, **k)) or began[-1]
        try:
            steps = program.steps(["sleep", "600"], "sleep")
            self.assertEqual(next(steps), (0.0, "sleep"))
            steps.close()
        finally:
            program.subprocess.Popen = original
        self.assertIsNotNone(began[0].returncode)

    def test_progress_lines(self):
        output = program.Output("picture")
        output.take("meninas: 43 %, 1 min 05 s left: direct light")
        self.assertEqual((output.fraction, output.text()), (0.43, "picture, direct light, 43 %, 1 min 05 s left"))
        output.take("meninas: 98 %: error estimate")
        self.assertEqual((output.fraction, output.text()), (0.98, "picture, error estimate, 98 %"))
        output.take("meninas: warning: 'A lamp': odd")
        self.assertEqual(output.warnings, ["'A lamp': odd"])

    def test_cancel(self):
        """Blender without windows takes Ctrl-C for Escape. The program would run for minutes."""
        scene = rooms.cornell()
        scene.render.engine = "MENINAS"
        scene.meninas.accuracy, scene.meninas.quality = "QUALITY", "fine"
        scene.render.resolution_percentage = 4000
        running = []
        original = program.subprocess.Popen

        class Watched(original):
            def __init__(self, command, **others):
                super().__init__(command, **others)
                if command[0] == PROGRAM:
                    running.append(self)
                    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()

        program.subprocess.Popen = Watched
        began = time.monotonic()
        try:
            bpy.ops.render.render()
        finally:
            program.subprocess.Popen = original
        self.assertEqual(len(running), 1)
        self.assertIsNotNone(running[0].returncode)
        self.assertNotEqual(running[0].returncode, 0)
        self.assert_nothing_is_left()
        print(f"cancel: {time.monotonic() - began:.1f} s with the export")


class Operators(unittest.TestCase):
    def test_mirror_preset(self):
        scene = rooms.cornell()
        bpy.context.view_layer.objects.active = scene.objects["low"]
        scene.objects["low"].active_material = rooms.diffuse("own", 0.5)
        self.assertEqual(bpy.ops.meninas.make_mirror(reflectance=0.8), {"FINISHED"})
        (gltf,), _ = Scenes.nodes_of(self, scene)
        material = next(m for m in gltf["materials"] if m["name"] == "own")["pbrMetallicRoughness"]
        self.assertEqual(material.get("metallicFactor", 1), 1)
        self.assertEqual(material["roughnessFactor"], 0)
        np.testing.assert_allclose(material["baseColorFactor"][:3], 0.8, atol=1e-6)

    def test_bake_shows_the_light_of_the_picture(self):
        scene = rooms.cornell()
        scene.meninas.accuracy = "QUALITY"
        ours = by_meninas(scene, "baked", quality="normal")["Combined"]
        self.assertEqual(bpy.ops.meninas.bake(), {"FINISHED"})
        objects = {thing.name: thing for thing in bpy.data.collections["Meninas Bake"].objects}
        self.assertLessEqual({"room baked", "tall baked", "low baked"}, set(objects))
        # The same wall by Cycles, which shows the vertex colours as light: within the normal quality's accuracy of 2 %.
        for thing in list(scene.collection.objects):
            thing.hide_render = thing.type != "CAMERA"
        shown = by_cycles(scene, "baked", 16)
        for rows, columns in ((slice(36, 48), slice(28, 44)), (slice(20, 44), slice(2, 8)), (slice(6, 9), slice(8, 30))):
            mine, baked = ours[rows, columns, :3].mean(axis=(0, 1)), shown[rows, columns].mean(axis=(0, 1))
            np.testing.assert_allclose(baked, mine, rtol=0.02)
            print(f"bake: {baked.mean() / mine.mean():.4f} of the picture")

    def test_animation_in_one_batch(self):
        scene = rooms.cornell()
        scene.meninas.accuracy = "QUALITY"
        scene.meninas.quality = "draft"
        scene.frame_start, scene.frame_end = 1, 3
        for frame, x in ((1, 1.9), (3, 2.1)):
            scene.camera.location.x = x
            scene.camera.keyframe_insert("location", index=0, frame=frame)
        folder = os.path.join(WORK, "an animation")
        scene.render.filepath = os.path.join(folder, "frame ")
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        self.assertEqual(bpy.ops.meninas.render_animation(), {"FINISHED"})
        files = sorted(os.listdir(folder))
        self.assertEqual(files, [f"frame {k:04d}.exr" for k in (1, 2, 3)])
        frames = [exr.read_layers(os.path.join(folder, name))[""][..., :3] for name in files]
        scene.frame_set(2)
        still = by_meninas(scene, "still")["Combined"][..., :3]
        # Batches solve for all views, a single picture for its own: they differ within the accuracy of a draft.
        self.assertAlmostEqual(float(frames[1].mean() / still.mean()), 1.0, delta=0.02)
        self.assertGreater(float(abs(frames[0] - frames[2]).mean()), 0.01 * still.mean())


def main():
    PREFERENCES.program = PROGRAM
    names = sys.argv[sys.argv.index("--") + 4 :]
    loader = unittest.defaultTestLoader
    module = sys.modules[__name__]
    suite = loader.loadTestsFromNames(names, module) if names else loader.loadTestsFromModule(module)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2).run(suite)
    sys.stdout.flush()
    os._exit(0 if result.wasSuccessful() else 1)


if __name__ == "__main__":
    try:
        main()
    except Exception:  # noqa: BLE001: Blender would go on
        traceback.print_exc()
        os._exit(1)
