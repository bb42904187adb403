"""The mirror preset, the bake and the animation."""

import json
import os
import shutil
import tempfile

import bpy
import numpy as np

from . import exr, passes, program, room, settings, solution


class MENINAS_OT_make_mirror(bpy.types.Operator):
    """Make the active material an ideal mirror: metallic 1, roughness 0"""

    bl_idname = "meninas.make_mirror"
    bl_label = "Make a Mirror"
    bl_options = {"REGISTER", "UNDO"}

    reflectance: bpy.props.FloatProperty(name="Reflectance", default=0.95, min=0.0, max=1.0)

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def execute(self, context):
        thing = context.object
        material = thing.active_material
        if material is None:
            material = bpy.data.materials.new("Mirror")
            thing.active_material = material
        material.use_nodes = True
        tree = material.node_tree
        output = next((n for n in tree.nodes if n.type == "OUTPUT_MATERIAL" and n.is_active_output), None)
        output = output or tree.nodes.new("ShaderNodeOutputMaterial")
        node = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
        node = node or tree.nodes.new("ShaderNodeBsdfPrincipled")
        for name in ("Base Color", "Metallic", "Roughness"):
            for link in list(node.inputs[name].links):
                tree.links.remove(link)
        node.inputs["Base Color"].default_value = (self.reflectance,) * 3 + (1.0,)
        node.inputs["Metallic"].default_value = 1.0
        node.inputs["Roughness"].default_value = 0.0
        tree.links.new(node.outputs["BSDF"], output.inputs["Surface"])
        return {"FINISHED"}


class LongRun:
    """An operator that works in steps while Blender goes on, and in one go without windows. `work(context)` is a generator that
    yields a fraction now and then; Escape ends it, and with it the process that it waits for."""

    def execute(self, context):
        return self.finish(context, self.begin(context))

    def invoke(self, context, event):
        self.steps = self.begin(context)
        self.timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.steps.close()
            return self.leave(context, {"CANCELLED"})
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            fraction, text = next(self.steps)
            context.window_manager.progress_update(int(100 * fraction))
            context.workspace.status_text_set(f"Meninas: {text} (Escape ends it)")
        except StopIteration:
            return self.leave(context, {"FINISHED"})
        except (program.ProgramError, exr.ExrError, OSError, RuntimeError) as error:
            self.report({"ERROR"}, f"Meninas: {error}")
            return self.leave(context, {"CANCELLED"})
        return {"RUNNING_MODAL"}

    def leave(self, context, outcome):
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        return outcome

    def finish(self, context, steps):
        try:
            for _ in steps:
                pass
        except (program.ProgramError, exr.ExrError, OSError, RuntimeError) as error:
            self.report({"ERROR"}, f"Meninas: {error}")
            return {"CANCELLED"}
        return {"FINISHED"}

    def begin(self, context):
        folder = tempfile.mkdtemp(prefix="meninas-")
        try:
            yield from self.work(context, folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def warn(self, warnings):
        for line in dict.fromkeys(warnings):
            self.report({"WARNING"}, f"Meninas: {line}")

    def exported(self, context, frames, folder):
        scene = context.scene
        blend, unseen = room.write_blend(scene, folder)
        made = yield from room.export_steps(blend, scene.name, context.view_layer.name, frames, folder)
        self.warn(unseen + made["warnings"])
        return made["frames"]


class MENINAS_OT_bake(LongRun, bpy.types.Operator):
    """Solve the room and show its light as vertex colours on copies of its objects"""

    bl_idname = "meninas.bake"
    bl_label = "Bake to Vertex Colours"
    bl_options = {"REGISTER", "UNDO"}

    def work(self, context, folder):
        path = program.find_program(settings.program_path(context))
        scene, chosen = context.scene, context.scene.meninas
        frames = yield from self.exported(context, [(scene.frame_current, scene.frame_subframe)], folder)
        out, nodes = os.path.join(folder, "solution.glb"), os.path.join(folder, "nodes.json")
        command = [path, "solve", frames[0]["scene"], "-o", out, "--per-node", nodes, "--quality", chosen.quality]
        output = yield from program.steps(command + frames[0]["sky"], "solve")
        self.warn(output.warnings)
        with open(nodes, encoding="utf-8") as file:
            emitted = {node["name"]: node["emitted"] for node in json.load(file)["nodes"]}
        collection = bpy.data.collections.new("Meninas Bake")
        scene.collection.children.link(collection)
        for node in solution.read_nodes(out, emitted):
            collection.objects.link(baked_object(node, chosen.bake_of))


def baked_material(attribute):
    """Shows the attribute B or H in W/m^2 as the radiance B / pi of a glowing surface."""
    name = f"Meninas {attribute}"
    if name in bpy.data.materials:
        return bpy.data.materials[name]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    colour, glow = nodes.new("ShaderNodeAttribute"), nodes.new("ShaderNodeEmission")
    colour.attribute_name = attribute
    glow.inputs["Strength"].default_value = 1.0 / np.pi
    output = nodes.new("ShaderNodeOutputMaterial")
    links.new(colour.outputs["Color"], glow.inputs["Color"])
    links.new(glow.outputs["Emission"], output.inputs["Surface"])
    return material


def baked_object(node, shown):
    mesh = bpy.data.meshes.new(f"{node['name']} baked")
    mesh.from_pydata(node["positions"].tolist(), [], node["triangles"].tolist())
    for name in ("Radiosity", "Irradiance"):
        attribute = mesh.color_attributes.new(name, "FLOAT_COLOR", "POINT")
        values = node[name.lower()]
        attribute.data.foreach_set("color", np.concatenate(
            [values, np.ones((len(values), 1))], axis=1).astype(np.float32).ravel())
    active = {"RADIOSITY": "Radiosity", "IRRADIANCE": "Irradiance"}[shown]
    mesh.color_attributes.active_color = mesh.color_attributes[active]
    mesh.materials.append(baked_material(active))
    return bpy.data.objects.new(f"{node['name']} baked", mesh)


class MENINAS_OT_render_animation(LongRun, bpy.types.Operator):
    """Render all frames of the scene as one batch: what stands still is solved once"""

    bl_idname = "meninas.render_animation"
    bl_label = "Render Animation in One Batch"

    def work(self, context, folder):
        path = program.find_program(settings.program_path(context))
        scene, chosen = context.scene, context.scene.meninas
        numbers = list(range(scene.frame_start, scene.frame_end + 1, scene.frame_step))
        frames = yield from self.exported(context, [(number, 0.0) for number in numbers], folder)
        jobs = os.path.join(folder, "jobs.json")
        with open(jobs, "w", encoding="utf-8") as file:
            json.dump(batch_of(frames, chosen), file)
        out = os.path.join(folder, "pictures")
        output = yield from program.steps([path, "batch", jobs, "-o", out], "batch")
        self.warn(output.warnings)
        for number, frame in zip(numbers, frames):
            save_picture(scene, number, os.path.join(out, stem(frame) + ".exr"))
            yield 1.0, f"frame {number}"
        self.report({"INFO"}, f"Meninas: {len(numbers)} frames in {os.path.dirname(scene.render.frame_path())}")


def stem(frame):
    return os.path.splitext(os.path.basename(frame["scene"]))[0]


def batch_of(frames, chosen):
    """A job for each frame, because each may have a sky of its own."""
    common = {**settings.accuracy_settings(chosen), "float": True}
    jobs = []
    for frame in frames:
        sky = dict(zip((word.removeprefix("--") for word in frame["sky"][0::2]), frame["sky"][1::2]))
        jobs.append({"scenes": os.path.basename(frame["scene"]), "modes": settings.mode_of(chosen),
                     "settings": {**common, "size": "{}x{}".format(*frame["size"]), **sky},
                     "outputs": stem(frame) + ".exr"})
    return {"jobs": jobs}


def save_picture(scene, number, path):
    """Writes a frame where and as Blender would, with the scene's view transform."""
    picture = passes.pictures(exr.read_layers(path))["Combined"]
    height, width = picture.shape[:2]
    image = bpy.data.images.new("Meninas frame", width, height, float_buffer=True)
    try:
        image.colorspace_settings.name = "Linear" if bpy.app.version < (4, 0, 0) else "Linear Rec.709"
        image.pixels.foreach_set(picture.ravel())
        target = bpy.path.abspath(scene.render.frame_path(frame=number))
        os.makedirs(os.path.dirname(target) or ".", exist_ok=True)
        image.save_render(target, scene=scene)
    finally:
        bpy.data.images.remove(image)


CLASSES = (MENINAS_OT_make_mirror, MENINAS_OT_bake, MENINAS_OT_render_animation)
