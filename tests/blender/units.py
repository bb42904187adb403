"""Watts of lamps and worlds, beside Cycles."""

import math
import unittest

import rooms
from in_blender import by_cycles, by_meninas, floor_under


class Units(unittest.TestCase):
    """W of lamps are Cycles' W. The floor under a lamp has no other light, so that Cycles' noise is below 0.1 %, and ours
    is nought but for area lamps' shadow rays (0.1 %): 1 % is the promise, and nothing is near it."""

    def compare(self, name, scene, samples=256, tolerance=0.01):
        ours = by_meninas(scene, name)["Combined"][..., :3].mean(axis=(0, 1))
        theirs = by_cycles(scene, name, samples).mean(axis=(0, 1))
        for mine, cycles in zip(ours, theirs):
            self.assertAlmostEqual(mine / cycles, 1.0, delta=tolerance)
        print(f"units, {name}: {ours.mean() / theirs.mean():.4f} of Cycles")

    def test_point(self):
        self.compare("point", floor_under("POINT", 100.0, shadow_soft_size=0.0, color=(1.0, 0.5, 0.25)))

    def test_spot(self):
        self.compare("spot", floor_under("SPOT", 100.0, shadow_soft_size=0.0, spot_size=1.2, spot_blend=0.0))

    def test_sun(self):
        self.compare("sun", floor_under("SUN", 3.0, angle=0.0))

    def test_area_rectangle(self):
        self.compare("rectangle", floor_under("AREA", 100.0, shape="RECTANGLE", size=0.8, size_y=0.3, color=(1.0, 0.5, 0.25)))

    def test_area_disk(self):
        self.compare("disk", floor_under("AREA", 100.0, shape="DISK", size=0.7))

    def test_area_ellipse_that_is_scaled(self):
        scene = floor_under("AREA", 100.0, shape="ELLIPSE", size=0.7, size_y=0.4)
        scene.objects["Lamp"].scale = (2.0, 1.0, 1.0)
        self.compare("ellipse", scene)

    def test_area_lamp_that_is_mirrored(self):
        for turned, scale in ((0.0, (-1.0, 1.0, 1.0)), (math.pi, (1.0, 1.0, -1.0))):
            scene = floor_under("AREA", 100.0, shape="RECTANGLE", size=0.8, size_y=0.3)
            scene.objects["Lamp"].rotation_euler[0] += turned
            scene.objects["Lamp"].scale = scale
            self.compare(f"mirrored {scale}", scene)

    def test_light_with_nodes(self):
        scene = floor_under("POINT", 100.0, shadow_soft_size=0.0)
        data = scene.objects["Lamp"].data
        data.use_nodes = True
        node = data.node_tree.nodes["Emission"]
        node.inputs["Strength"].default_value, node.inputs["Color"].default_value = 2.5, (0.2, 0.9, 0.4, 1.0)
        self.compare("nodes", scene)

    def test_world_with_nodes(self):
        """A world that differs by direction: its colour is that of the direction, so that a turned sky shows."""
        scene = floor_under("POINT", 0.0)
        made = rooms.world((1.0, 1.0, 1.0), 3.0)
        tree = made.node_tree
        coordinates = tree.nodes.new("ShaderNodeTexCoord")
        colour = tree.nodes.new("ShaderNodeVectorMath")
        colour.operation = "MULTIPLY_ADD"
        colour.inputs[1].default_value = colour.inputs[2].default_value = (0.5, 0.5, 0.5)
        tree.links.new(coordinates.outputs["Generated"], colour.inputs[0])
        tree.links.new(colour.outputs["Vector"], tree.nodes["Background"].inputs["Color"])
        rooms.box("post", (-1.2, -0.2, 0.0), (-0.8, 0.2, 1.0), rooms.diffuse("white", 0.8), inward=False)
        scene.camera.location = (2.0, -3.0, 1.5)
        scene.camera.data.angle = math.radians(50.0)
        scene.camera.rotation_euler = (math.radians(85.0), 0.0, math.radians(30.0))
        # Both sample a sky that is 2048 wide and smooth; Cycles' noise is 0.3 % of the mean here.
        self.compare("world", scene, 512)
