"""Brings a scene out of the user's Blender: written to a .blend file, and exported by a Blender of its own."""

import json
import os

import bpy

from . import program

EXPORTER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "inside", "room_export.py")


def _unsaved_images():
    return [image.name for image in bpy.data.images
            if image.is_dirty and image.users and not image.packed_file and image.type == "IMAGE"]


def write_blend(scene, folder):
    """The scene with all that it needs, as it is at this moment; the user's own file is not touched."""
    path = os.path.join(folder, "scene.blend")
    bpy.data.libraries.write(path, {scene}, path_remap="ABSOLUTE")
    return path, [f"image '{name}' has changes that are not saved: they are not seen" for name in _unsaved_images()]


def export_steps(blend, scene_name, view_layer_name, frames, folder):
    """{"frames": [{"scene", "size", "sky"}, ...], "warnings": [...]} of frames = [(frame, subframe), ...], after
    steps as `program.steps` has them."""
    job = {"blend": blend, "scene": scene_name, "view_layer": view_layer_name, "frames": frames, "folder": folder}
    path = os.path.join(folder, "JOB.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(job, file)
    # Scripts in the file (drivers) run where the user's own Blender runs them.
    scripts = "-y" if bpy.context.preferences.filepaths.use_scripts_auto_execute else "-Y"
    command = [bpy.app.binary_path, "-b", "-noaudio", "--factory-startup", scripts, "--python-exit-code", "3",
               "-P", EXPORTER, "--", path]
    try:
        yield from program.steps(command, "export")
        with open(os.path.join(folder, "RESULT.json"), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError as error:
        raise program.ProgramError("the scene was not exported; Blender's console may say why") from error
