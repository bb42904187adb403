"""Blender's world as the options of Meninas that say the same."""

import math
import os

import bpy

PANORAMA_WIDTH = 2048
PANORAMA_SAMPLES = 16


def _background_node(world):
    for node in world.node_tree.nodes:
        if node.type == "OUTPUT_WORLD" and node.is_active_output:
            if not node.inputs["Surface"].is_linked:
                return "black"
            source = node.inputs["Surface"].links[0].from_node
            return source if source.type == "BACKGROUND" else None
    return "black"


def world_of(world):
    """{"radiance": RGB} of a world of one colour, {"name": of the world} of one with nodes that say more, or None."""
    if world is None:
        return None
    if not world.use_nodes:
        return {"radiance": list(world.color)}
    node = _background_node(world)
    if node == "black":
        return None
    if node is not None and not node.inputs["Color"].is_linked and not node.inputs["Strength"].is_linked:
        strength = node.inputs["Strength"].default_value
        return {"radiance": [strength * c for c in node.inputs["Color"].default_value[:3]]}
    return {"name": world.original.name}


def _paint(world, path):
    """Lets Cycles paint the world as a panorama, +X in the middle, as Blender's Environment Texture has it."""
    scene = bpy.data.scenes.new("sky")
    scene.world = world
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = PANORAMA_WIDTH, PANORAMA_WIDTH // 2, 100
    scene.cycles.samples = PANORAMA_SAMPLES
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    data = bpy.data.cameras.new("sky")
    data.type = "PANO"
    owner = data if hasattr(data, "panorama_type") else data.cycles  # since Blender 4.0 the camera's own
    owner.panorama_type = "EQUIRECTANGULAR"
    camera = bpy.data.objects.new("sky", data)
    camera.rotation_euler = (math.pi / 2.0, 0.0, -math.pi / 2.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.filepath, render.use_file_extension = path, False
    bpy.ops.render.render(scene=scene.name, write_still=True)
    bpy.data.scenes.remove(scene)


def options(world, path, warnings):
    if world is None:
        return []
    if "radiance" in world:
        radiance = [max(0.0, c) for c in world["radiance"]]
        return ["--background", ",".join(f"{c:.9g}" for c in radiance)] if max(radiance) > 0.0 else []
    bpy.ops.preferences.addon_enable(module="cycles")
    _paint(bpy.data.worlds[world["name"]], path)
    if not os.path.exists(path):
        warnings.append(f"world '{world['name']}': Cycles has not painted it, it is left out")
        return []
    return ["--environment", path]
