"""The render engine: F12."""

import json
import os
import shutil
import tempfile

import bpy
import numpy as np

from . import exr, passes, program, room, settings

EXPORT_SHARE = 0.1  # of the progress that Blender shows


def percent_off(error):
    """As the program says it (runs/report/percent.h): "about 1.3 %"; "about" a number alone."""
    if error > 1.0:
        return "over 100 %"
    if 0.0 < error < 1e-4:
        return "under 0.01 %"
    return f"about {100.0 * error:.2g} %" if error < 0.0995 else f"about {100.0 * error:.0f} %"


class MeninasRenderEngine(bpy.types.RenderEngine):
    bl_idname = "MENINAS"
    bl_label = "Meninas"
    bl_use_preview = False
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False
    bl_use_postprocess = True

    def update(self, data, depsgraph):
        """Writes the scene while Blender holds its drawing back, so that nobody changes it meanwhile."""
        self.folder, self.problem, self.unseen, self.told = None, None, [], []
        try:
            self.path = program.find_program(settings.program_path(bpy.context))
            self.folder = tempfile.mkdtemp(prefix="meninas-")
            self.blend, self.unseen = room.write_blend(depsgraph.scene.original, self.folder)
        except (program.ProgramError, OSError, RuntimeError) as error:
            self.problem = str(error)

    def render(self, depsgraph):
        try:
            if self.problem:
                raise program.ProgramError(self.problem)
            self.make(depsgraph)
        except program.Cancelled:
            self.update_stats("", "Meninas: cancelled")
        except (program.ProgramError, exr.ExrError, OSError) as error:
            self.update_stats("", f"Meninas: {error}")
            self.report({"ERROR"}, f"Meninas: {error}")
        finally:
            if self.folder:
                shutil.rmtree(self.folder, ignore_errors=True)

    def make(self, depsgraph):
        scene = depsgraph.scene
        chosen = scene.meninas
        self.update_stats("", "Meninas: export")
        frames = [(scene.frame_current, scene.frame_subframe)]
        exported = program.run(
            room.export_steps(self.blend, scene.name, depsgraph.view_layer.name, frames, self.folder), self.test_break
        )
        self.tell_warnings(self.unseen + exported["warnings"])
        frame = exported["frames"][0]
        self.update_progress(EXPORT_SHARE)
        count = 2 if chosen.use_lamps else 1
        accuracy = settings.options_of(settings.accuracy_settings(chosen))
        layers, figures = self.run("picture", settings.layers_of(chosen), accuracy, frame, chosen, (0, count))
        if chosen.use_lamps:
            # Lamps are told apart by runs whose settings are known; a chosen accuracy has led to some.
            accuracy = (figures.get("choice") or {}).get("options") or accuracy
            lamps, _ = self.run("lamps", "lamps", accuracy, frame, chosen, (1, count))
            layers.update({name: picture for name, picture in lamps.items() if name})
        self.show(layers, frame["size"], depsgraph.view_layer.name)
        self.tell_error(figures)

    def run(self, name, wanted, accuracy, frame, chosen, part):
        """The layers and the figures of one run of the program, which is `part` = (number, count) of all."""
        out, figures = (os.path.join(self.folder, f"{name}.{kind}") for kind in ("exr", "json"))
        command = [self.path, "render", frame["scene"], "-o", out, "--float", "--stats", figures, "--layers", wanted,
                   "--size", "{}x{}".format(*frame["size"]), *accuracy, *frame["sky"]]
        if "--mode" not in command:
            command += ["--mode", settings.mode_of(chosen)]
        output = program.run(program.steps(command, name), self.test_break, self.shower(*part))
        self.tell_warnings([line for line in output.warnings if line not in self.told])
        self.told += output.warnings
        with open(figures, encoding="utf-8") as file:
            return exr.read_layers(out), json.load(file)

    def shower(self, number, count):
        def show(fraction, text):
            self.update_progress(EXPORT_SHARE + (1.0 - EXPORT_SHARE) * (number + fraction) / count)
            self.update_stats(f"Meninas: {text}", "")

        return show

    def tell_warnings(self, warnings):
        for line in warnings:
            self.report({"WARNING"}, f"Meninas: {line}")

    def tell_error(self, figures):
        estimate = figures.get("error_estimate") or {}
        seconds = figures["seconds"]["total"]
        line = f"Meninas: {seconds:.1f} s"
        if estimate.get("total") is not None:
            line += f", {percent_off(estimate['total'])} off"
        self.update_stats("", line)
        self.report({"INFO"}, line)

    def show(self, layers, size, view_layer):
        width, height = size
        for name, channels, letters, _ in passes.added_passes(layers):
            self.add_pass(name, channels, letters, layer=view_layer)
        result = self.begin_result(0, 0, width, height, layer=view_layer)
        if result is None:
            return
        try:
            # All passes at once: `rect` of one pass takes lists of lists alone, which is slow.
            targets, made = result.layers[0].passes, passes.pictures(layers)
            nothing = {target.name: np.zeros(width * height * target.channels, np.float32) for target in targets}
            flat = [made[name].ravel() if name in made else black for name, black in nothing.items()]
            targets.foreach_set("rect", np.concatenate(flat))
        finally:
            self.end_result(result)

    def update_render_passes(self, scene, renderlayer):
        """Tells the compositor which passes there will be."""
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        chosen = scene.meninas
        layers = []
        if chosen.use_passes:
            layers += [layer for layer in passes.LIGHT_PASSES if chosen.use_mirrors or layer == "albedo"]
        if chosen.use_lamps:
            layers += ["lamp." + str(thing.get("lamp", thing.name)) for thing in scene.objects if thing.type == "LIGHT"]
            layers += ["lamp.sky"] if scene.world else []
        for registered in passes.added_passes(layers):
            self.register_pass(scene, renderlayer, *registered)
