"""Runs inside a Blender of its own: blender -b --factory-startup -P room_export.py -- JOB.json

Exports a scene, which the user's Blender has written to a .blend file, as Blender renders it: what the render's own
dependency graph has at a frame (modifiers at render levels, instances, visibility, animated values), one glTF file a
frame. So nothing is ever changed in the user's session, and nothing there has to wait for the main thread.

JOB.json: {"blend", "scene", "view_layer", "frames": [[frame, subframe], ...], "folder"}; RESULT.json in that folder:
{"frames": [{"scene", "size", "sky": [options of meninas]}, ...], "warnings": [...]}
"""

import json
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import lights  # noqa: E402
import materials  # noqa: E402
import sky  # noqa: E402

SHOWN_AS_MESHES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
LEFT_OUT = {"CURVES", "VOLUME", "POINTCLOUD", "GPENCIL", "GREASEPENCIL"}


class Snapshot(bpy.types.RenderEngine):
    """A render engine that keeps what it is to render, because Blender gives the render's state to engines alone."""

    bl_idname = "MENINAS_SNAPSHOT"
    bl_label = "Meninas snapshot"
    taken = None
    error = None

    def render(self, depsgraph):
        try:
            Snapshot.taken = take(depsgraph)
        except Exception as error:  # noqa: BLE001: Blender would print it and go on
            Snapshot.error = error


def custom_properties(owner):
    plain = {}
    for key in owner.keys():
        value = owner[key]
        if isinstance(value, (int, float, str)):
            plain[key] = value
    return plain


def mesh_of(instance, depsgraph, kept):
    """A mesh of the file with what modifiers made of it, one for all instances."""
    thing = instance.object
    slots = tuple(slot.material.name if slot.material else "" for slot in thing.material_slots)
    key = (thing.data.as_pointer(), thing.type, slots)
    if key in kept:
        return kept[key]
    mesh = bpy.data.meshes.new_from_object(thing, preserve_all_data_layers=True, depsgraph=depsgraph)
    if mesh is not None and not mesh.polygons:
        bpy.data.meshes.remove(mesh)
        mesh = None
    if mesh is not None:
        originals = [slot.material.original if slot.material else None for slot in thing.material_slots]
        for k, material in enumerate(originals):
            if k < len(mesh.materials):
                mesh.materials[k] = material
            else:
                mesh.materials.append(material)
        if not materials.use_vertex_colours(originals):
            while mesh.color_attributes:
                mesh.color_attributes.remove(mesh.color_attributes[0])
    kept[key] = mesh
    return mesh


def camera_of(thing, render, warnings):
    """The camera's values, and its lens as custom properties that Meninas reads."""
    camera = thing.data
    values = {
        name: getattr(camera, name)
        for name in ("type", "lens", "sensor_width", "sensor_height", "sensor_fit", "ortho_scale", "clip_start",
                     "clip_end")
    }
    extras = {}
    if camera.dof.use_dof and camera.type == "PERSP":
        focus = camera.dof.focus_distance
        if camera.dof.focus_object:
            at = camera.dof.focus_object.matrix_world.translation
            focus = abs((thing.matrix_world.inverted() @ at).z)
        extras = {"fstop": camera.dof.aperture_fstop, "focus_distance": focus, "focal_length": camera.lens}
    if camera.shift_x or camera.shift_y:
        warnings.append(f"camera '{thing.name}': its shift is left out")
    if camera.type == "PANO":
        warnings.append(f"camera '{thing.name}': panoramic, rendered as a perspective one")
        values["type"] = "PERSP"
    if render.use_border:
        warnings.append("the render region is left out: all of the picture is rendered")
    return {"values": values, "extras": extras}


def take(depsgraph):
    """Everything that the render has, in copies that are the file's own."""
    scene, items, kept, warnings = depsgraph.scene_eval, [], {}, []
    for instance in depsgraph.object_instances:
        thing = instance.object
        item = {"name": thing.name, "matrix": instance.matrix_world.copy(), "extras": custom_properties(thing)}
        if thing.type in SHOWN_AS_MESHES and instance.show_self:
            item["mesh"] = mesh_of(instance, depsgraph, kept)
            if item["mesh"] is None:
                continue
        elif thing.type == "LIGHT" and instance.show_self:
            item["light"] = lights.light_of(thing, instance.matrix_world, warnings)
            if item["light"] is None:
                continue
        else:
            if thing.type in LEFT_OUT:
                warnings.append(f"'{thing.name}' ({thing.type.lower()}) is left out")
            continue
        items.append(item)
    camera = scene.camera
    if camera is None:
        raise RuntimeError("the scene has no camera")
    items.append({"name": camera.name, "matrix": camera.matrix_world.normalized(),
                  "extras": custom_properties(camera), "camera": camera_of(camera, scene.render, warnings)})
    return {"items": items, "world": sky.world_of(scene.world), "warnings": warnings}


def data_of(item, label):
    """What an object of the exported scene shows: a mesh, a light or the camera; nothing of an area lamp."""
    if "mesh" in item:
        mesh = item["mesh"]
        location, rotation, scale = item["matrix"].decompose()
        composed = type(item["matrix"]).LocRotScale(location, rotation, scale)
        error = max(abs(a - b) for row, other in zip(composed, item["matrix"]) for a, b in zip(row, other))
        if error > 1e-5 * max(map(abs, scale)):  # a shear, which a node of glTF cannot have
            mesh = mesh.copy()
            mesh.transform(item["matrix"])
            item["matrix"].identity()
        return mesh
    if "light" in item:
        item["matrix"], light = lights.placed(item["light"], item["matrix"])
        return light
    camera = bpy.data.cameras.new(label)
    for name, value in item["camera"]["values"].items():
        setattr(camera, name, value)
    return camera


def room_scene(taken, source):
    """A scene of what was taken, and the names that its nodes are to have."""
    scene = bpy.data.scenes.new("room")
    for name in ("resolution_x", "resolution_y", "resolution_percentage", "pixel_aspect_x", "pixel_aspect_y"):
        setattr(scene.render, name, getattr(source.render, name))
    names = {}
    for k, item in enumerate(taken["items"]):
        label = f"meninas {k}"
        thing = bpy.data.objects.new(label, data_of(item, label))
        thing.matrix_world = item["matrix"]
        extras = {**item["extras"], **item.get("camera", {}).get("extras", {})}
        for key, value in extras.items():
            thing[key] = value
        scene.collection.objects.link(thing)
        if "camera" in item:
            scene.camera = thing
        names[thing.name] = item
    return scene, names


def write_gltf(path):
    wanted = {
        "export_format": "GLTF_SEPARATE", "use_active_scene": True, "export_cameras": True, "export_lights": True,
        "export_extras": True, "export_yup": True, "export_apply": False, "export_animations": False,
        "export_current_frame": True, "export_skins": False, "export_morph": False, "export_materials": "EXPORT",
    }
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    bpy.ops.export_scene.gltf(filepath=path, **{k: v for k, v in wanted.items() if k in known})


def finish(path, names):
    """Names, lights and lamps of the file are those of Blender, whatever this version's exporter writes of them."""
    with open(path, encoding="utf-8") as file:
        gltf = json.load(file)
    used = {}
    for index, node in enumerate(gltf.get("nodes", [])):
        item = names.get(node.get("name"))
        if item is None:
            continue
        again = used.get(item["name"], 0)
        used[item["name"]] = again + 1
        node["name"] = f"{item['name']}.{again:03d}" if again else item["name"]
        if "light" in item:
            lights.finish(gltf, index, item)
    gltf.setdefault("asset", {}).setdefault("extras", {})["light_units"] = "radiometric"
    with open(path, "w", encoding="utf-8") as file:
        json.dump(gltf, file)


def export_frame(job, scene, frame, subframe, number):
    Snapshot.taken = Snapshot.error = None
    scene.frame_set(int(frame), subframe=subframe)
    bpy.ops.render.render(scene=scene.name, layer=job["view_layer"])
    if Snapshot.error:
        raise Snapshot.error
    if Snapshot.taken is None:
        raise RuntimeError("the view layer is not rendered: 'Use for Rendering' is off")
    taken = Snapshot.taken
    warnings = taken["warnings"]
    room, names = room_scene(taken, scene)
    restore = materials.prepare(names.values(), warnings)
    path = os.path.join(job["folder"], f"room-{number:04d}.gltf")
    bpy.context.window.scene = room
    write_gltf(path)
    restore()
    bpy.context.window.scene = scene
    finish(path, names)
    options = sky.options(taken["world"], os.path.join(job["folder"], f"sky-{number:04d}.exr"), warnings)
    for thing in list(room.objects):
        data = thing.data
        bpy.data.objects.remove(thing)
        if isinstance(data, bpy.types.Mesh) and data.users == 0:
            bpy.data.meshes.remove(data)
    bpy.data.scenes.remove(room)
    percentage = scene.render.resolution_percentage / 100.0
    size = [max(1, int(scene.render.resolution_x * percentage)), max(1, int(scene.render.resolution_y * percentage))]
    return {"scene": path, "size": size, "sky": options}, warnings


def opened(job):
    """The scene of the .blend file, which has no windows and is therefore appended."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="io_scene_gltf2")
    bpy.utils.register_class(Snapshot)
    with bpy.data.libraries.load(job["blend"], link=False) as (inside, wanted):
        wanted.scenes = [name for name in inside.scenes if name == job["scene"]]
    scene = wanted.scenes[0]
    bpy.context.window.scene = scene
    scene.render.engine = Snapshot.bl_idname
    scene.render.use_compositing = scene.render.use_sequencer = scene.render.use_multiview = False
    scene.use_nodes = False
    return scene


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        job = json.load(file)
    scene = opened(job)
    result = {"frames": [], "warnings": []}
    for number, (frame, subframe) in enumerate(job["frames"]):
        made, warnings = export_frame(job, scene, frame, subframe, number)
        result["frames"].append(made)
        result["warnings"] += [line for line in warnings if line not in result["warnings"]]
        print(f"meninas: {100 * (number + 1) // len(job['frames'])} %: export", file=sys.stderr, flush=True)
    with open(os.path.join(job["folder"], "RESULT.json"), "w", encoding="utf-8") as file:
        json.dump(result, file)


if __name__ == "__main__":
    try:
        main()
    except Exception as error:  # noqa: BLE001: one line for the user; the trace is for us
        import traceback

        traceback.print_exc()
        print(f"meninas: {error}", file=sys.stderr, flush=True)
        sys.exit(3)
