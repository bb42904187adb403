"""Meninas as a render engine of Blender: rooms with mirrors, without noise."""

bl_info = {
    "name": "Meninas",
    "author": "The Meninas developers",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "Render Properties > Render Engine > Meninas",
    "description": "Renders rooms with mirrors without noise, by the program meninas",
    "category": "Render",
}

if "bpy" in locals():  # Blender reloads add-ons
    import importlib

    for _module in (settings, program, exr, solution, passes, room, engine, operators, panels):  # noqa: F821
        importlib.reload(_module)

import bpy

from . import settings, program, exr, solution, passes, room, engine, operators, panels

CLASSES = (
    settings.MeninasPreferences,
    settings.MeninasSettings,
    engine.MeninasRenderEngine,
    *operators.CLASSES,
    *panels.CLASSES,
)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.meninas = bpy.props.PointerProperty(type=settings.MeninasSettings)
    panels.share_panels()


def unregister():
    panels.unshare_panels()
    del bpy.types.Scene.meninas
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
