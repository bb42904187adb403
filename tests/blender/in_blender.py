"""What the tests of the add-on share: it is installed from its zip, into a folder with spaces; pictures by it and by Cycles."""

import os
import sys

import bpy
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import rooms  # noqa: E402

ZIP, PROGRAM, WORK = sys.argv[sys.argv.index("--") + 1 :][:3]
bpy.ops.preferences.addon_install(filepath=ZIP)
bpy.ops.preferences.addon_enable(module="meninas_render")
import meninas_render  # noqa: E402
from meninas_render import engine, exr, program, room  # noqa: E402

PREFERENCES = bpy.context.preferences.addons["meninas_render"].preferences
SAID = []  # what the engine has told, besides telling it
_tell = engine.MeninasRenderEngine.tell_warnings


def _tell_and_keep(self, warnings):
    SAID.extend(warnings)
    _tell(self, warnings)


engine.MeninasRenderEngine.tell_warnings = _tell_and_keep


def rendered(scene, name):
    """The passes of a rendering, {"Combined": (height, width, 4), ...}, the first row at the bottom."""
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "ZIP"
    scene.render.filepath = os.path.join(WORK, name + ".exr")
    bpy.ops.render.render(write_still=True)
    layers = exr.read_layers(scene.render.filepath)
    return {layer.split(".", 1)[1]: picture for layer, picture in layers.items() if "." in layer}


def by_meninas(scene, name, **settings):
    scene.render.engine = "MENINAS"
    usual = {"accuracy": "QUALITY", "quality": "normal", "use_lamps": False, "use_mirrors": True, "use_passes": True}
    for key, value in {**usual, **settings}.items():
        setattr(scene.meninas, key, value)
    del SAID[:]
    return rendered(scene, name + "-meninas")


def by_cycles(scene, name, samples, seed=0):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.seed = samples, seed
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.pixel_filter_type = "BOX"
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 64
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0.0
    cycles.caustics_reflective = True
    return rendered(scene, f"{name}-cycles{seed}")["Combined"][..., :3]


def patches(picture, size=8):
    height, width = picture.shape[:2]
    return picture[..., :3].reshape(height // size, size, width // size, size, 3).mean(axis=(1, 3, 4))


def png(path, picture):
    """For people to look at; both of a pair at one exposure."""
    image = bpy.data.images.new("look", picture.shape[1], picture.shape[0])
    shown = np.ones((*picture.shape[:2], 4), np.float32)
    x = np.clip(picture, 0.0, 1.0)
    shown[..., :3] = np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-9) ** (1 / 2.4) - 0.055)
    image.pixels.foreach_set(shown.ravel())
    image.filepath_raw, image.file_format = path, "PNG"
    image.save()
    bpy.data.images.remove(image)


def floor_under(kind, energy, height=2.0, **values):
    """A grey floor, seen where a lamp stands above it."""
    scene = rooms.empty(16, 16)
    rooms.rectangle("floor", (0, 0, 0), (10, 0, 0), (0, 10, 0), rooms.diffuse("grey", 0.5))
    rooms.light("Lamp", kind, energy, (0.0, 0.0, height), **values)
    rooms.camera((0.6, 0.0, 1.0), (0.0, 0.0, 0.0), 4.0)
    return scene
