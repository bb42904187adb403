"""Renders a scene of this project with Cycles, to put beside a picture of meninas.

    blender -b --factory-startup --python render_scene.py -- SCENE.gltf OUT.exr --size 256x256 --samples 1024 --threads 2

Everything is made to mean the same: materials are replaced by what meninas takes them for (Lambert's law, ideal mirrors, emitted
radiance; Blender's importer would give walls a coat that adds a quarter to their energy), backs of single-sided surfaces are black and
are passed by camera rays, nothing is clamped, blurred or denoised, paths are followed for 64 bounces, pixels are boxes. Roughness between that of a
mirror and 1, glass and coats are not carried over. The seconds that are printed are those of rendering alone, without the start of Blender.
"""
import argparse
import sys
import time

import bpy
import numpy

# Blender 3.4's glTF add-on was written for a numpy that still had this alias.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

MIRROR_ROUGHNESS = 0.01


def arguments():
    own = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="render_scene.py")
    parser.add_argument("scene")
    parser.add_argument("output")
    parser.add_argument("--size", default="256x256")
    parser.add_argument("--samples", type=int, default=1024)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    return parser.parse_args(own)


def value_or_link(tree, source, target):
    """The same value or texture at another input."""
    target.default_value = source.default_value
    for link in source.links:
        tree.links.new(link.from_socket, target)


def replace_material(material):
    """Lambert, mirror and emission instead of the principled shader; black backs."""
    tree = material.node_tree
    principled = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None)
    if principled is None:
        return
    inputs = principled.inputs
    metal = inputs["Metallic"].default_value >= 0.5 and inputs["Roughness"].default_value <= MIRROR_ROUGHNESS
    if metal:
        surface = tree.nodes.new("ShaderNodeBsdfGlossy")
        surface.distribution = "SHARP"
    else:
        surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
    value_or_link(tree, inputs["Base Color"], surface.inputs["Color"])

    emission = tree.nodes.new("ShaderNodeEmission")
    value_or_link(tree, inputs["Emission"], emission.inputs["Color"])
    value_or_link(tree, inputs["Emission Strength"], emission.inputs["Strength"])
    front = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(surface.outputs[0], front.inputs[0])
    tree.links.new(emission.outputs[0], front.inputs[1])
    shown = front
    if material.use_backface_culling:
        black = tree.nodes.new("ShaderNodeBsdfDiffuse")
        black.inputs["Color"].default_value = (0, 0, 0, 1)
        passed = tree.nodes.new("ShaderNodeBsdfTransparent")
        path = tree.nodes.new("ShaderNodeLightPath")
        back = tree.nodes.new("ShaderNodeMixShader")
        tree.links.new(path.outputs["Is Camera Ray"], back.inputs[0])
        tree.links.new(black.outputs[0], back.inputs[1])
        tree.links.new(passed.outputs[0], back.inputs[2])
        geometry = tree.nodes.new("ShaderNodeNewGeometry")
        shown = tree.nodes.new("ShaderNodeMixShader")
        tree.links.new(geometry.outputs["Backfacing"], shown.inputs[0])
        tree.links.new(front.outputs[0], shown.inputs[1])
        tree.links.new(back.outputs[0], shown.inputs[2])
    output = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
    tree.links.new(shown.outputs[0], output.inputs["Surface"])


def prepare(options):
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.import_scene.gltf(filepath=options.scene)
    for material in bpy.data.materials:
        if material.use_nodes:
            replace_material(material)

    scene = bpy.context.scene
    cameras = sorted((o for o in scene.objects if o.type == "CAMERA"), key=lambda o: o.name)
    if not cameras:
        sys.exit("render_scene.py: the scene has no camera")
    scene.camera = cameras[0]
    world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    scene.world = world

    width, height = (int(side) for side in options.size.split("x"))
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.filepath = options.output
    if options.threads > 0:
        render.threads_mode, render.threads = "FIXED", options.threads
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", options.samples, options.seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 64
    cycles.transparent_max_bounces = 64
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.caustics_reflective, cycles.blur_glossy = True, 0.0
    cycles.pixel_filter_type = "BOX"


def main():
    options = arguments()
    prepare(options)
    begin = time.time()
    bpy.ops.render.render(write_still=True)
    print(f"rendered in {time.time() - begin:.2f} s")


main()
