"""Rooms that the tests build by script: all surfaces are Lambert's, so that Cycles and Meninas mean the same by them."""

import math

import bpy
import numpy as np


def empty(width=64, height=64):
    for scene in bpy.data.scenes[1:]:
        bpy.data.scenes.remove(scene)
    for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.lights, bpy.data.cameras,
                       bpy.data.worlds, bpy.data.collections):
        for thing in list(collection):
            collection.remove(thing)
    scene = bpy.context.scene
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.use_border = False
    scene.view_settings.view_transform = "Standard"
    return scene


def shader(name, kind, **inputs):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node, output = tree.nodes.new(kind), tree.nodes.new("ShaderNodeOutputMaterial")
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material


def diffuse(name, grey):
    colour = grey if isinstance(grey, tuple) else (grey,) * 3
    return shader(name, "ShaderNodeBsdfDiffuse", Color=(*colour, 1.0), Roughness=0.0)


def mirror(name, reflectance):
    return shader(name, "ShaderNodeBsdfPrincipled", Base_Color=(reflectance,) * 3 + (1.0,), Metallic=1.0, Roughness=0.0)


def emission(name, strength, colour=(1.0, 1.0, 1.0)):
    return shader(name, "ShaderNodeEmission", Color=(*colour, 1.0), Strength=strength)


def mesh(name, corners, faces, materials):
    """Faces are (corner, corner, ..., material number)."""
    data = bpy.data.meshes.new(name)
    data.from_pydata(corners, [], [face[:-1] for face in faces])
    for material in materials:
        data.materials.append(material)
    for polygon, face in zip(data.polygons, faces):
        polygon.material_index = face[-1]
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def rectangle(name, centre, across, up, material):
    """A rectangle of the two edge vectors, which faces along across x up."""
    c, a, u = (np.array(v, float) for v in (centre, across, up))
    corners = [c - a / 2 - u / 2, c + a / 2 - u / 2, c + a / 2 + u / 2, c - a / 2 + u / 2]
    return mesh(name, [tuple(p) for p in corners], [(0, 1, 2, 3, 0)], [material])


def box(name, low, high, materials, inward=True, leave_out=()):
    """Materials of -x, +x, -y, +y, -z, +z, by these letters; faces look inwards, or outwards."""
    x0, y0, z0 = low
    x1, y1, z1 = high
    corners = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    sides = {"-x": (0, 2, 6, 4), "+x": (1, 5, 7, 3), "-y": (0, 4, 5, 1), "+y": (2, 3, 7, 6), "-z": (0, 1, 3, 2),
             "+z": (4, 6, 7, 5)}
    wanted = [name for name in sides if name not in leave_out]
    faces = [(*(sides[side] if inward else sides[side][::-1]), k) for k, side in enumerate(wanted)]
    return mesh(name, corners, faces, [materials[side] if isinstance(materials, dict) else materials for side in wanted])


def camera(location, target, degrees, name="Camera"):
    import mathutils

    data = bpy.data.cameras.new(name)
    data.angle = math.radians(degrees)
    data.clip_start = 0.01
    thing = bpy.data.objects.new(name, data)
    thing.location = location
    thing.rotation_euler = (mathutils.Vector(target) - mathutils.Vector(location)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = thing
    return thing


def light(name, kind, energy, location, rotation=(0.0, 0.0, 0.0), **values):
    data = bpy.data.lights.new(name, kind)
    data.energy = energy
    for key, value in values.items():
        setattr(data, key, value)
    thing = bpy.data.objects.new(name, data)
    thing.location, thing.rotation_euler = location, rotation
    bpy.context.scene.collection.objects.link(thing)
    return thing


def world(colour, strength):
    made = bpy.data.worlds.new("World")
    made.use_nodes = True
    node = made.node_tree.nodes["Background"]
    node.inputs["Color"].default_value = (*colour, 1.0)
    node.inputs["Strength"].default_value = strength
    bpy.context.scene.world = made
    return made


def cornell():
    """A box with coloured walls and two blocks under an area lamp in its ceiling."""
    scene = empty()
    white, red, green = diffuse("white", 0.7), diffuse("red", (0.6, 0.06, 0.05)), diffuse("green", (0.1, 0.45, 0.1))
    box("room", (0, 0, 0), (4, 4, 3), {"-x": red, "+x": green, "+y": white, "-z": white, "+z": white}, leave_out=("-y",))
    box("tall", (0.8, 2.0, 0.0), (1.8, 3.0, 1.8), white, inward=False)
    box("low", (2.2, 1.0, 0.0), (3.1, 1.9, 0.9), white, inward=False)
    light("Area", "AREA", 200.0, (2.0, 2.0, 2.995), shape="RECTANGLE", size=1.0, size_y=0.6, color=(1.0, 0.9, 0.7))
    camera((2.0, -4.6, 1.5), (2.0, 0.0, 1.5), 42.0)
    return scene


def mirror_room():
    """An area lamp in a housing that shines on a mirror alone: the wall opposite has its light by way of the mirror.

    The mirror reflects 0.98: the Principled BSDF of a duller one brightens at grazing angles (Schlick), Meninas' mirror does not."""
    scene = empty()
    white, dark = diffuse("white", 0.6), diffuse("dark", 0.2)
    box("room", (0, 0, 0), (4, 4, 3), {"-x": white, "+x": dark, "+y": white, "-z": dark, "+z": dark}, leave_out=("-y",))
    rectangle("Mirror", (3.98, 2.0, 1.5), (0.0, 2.4, 0.0), (0.0, 0.0, 2.0), mirror("mirror", 0.98))
    box("housing", (2.3, 1.3, 0.8), (2.7, 2.5, 2.0), diffuse("housing", 0.8), leave_out=("+x",))
    light("Lamp", "AREA", 300.0, (2.302, 1.9, 1.4), (0.0, math.radians(-90.0), 0.0), shape="SQUARE", size=1.2)
    camera((2.0, -4.2, 1.5), (2.0, 0.0, 1.5), 45.0)
    return scene


def hanging_lamps():
    """A square, a disc and a scaled ellipse that hang in a room with a mirror: to other light, and to the camera, they are not there,
    so that the ceiling above them is lit from below. The mirror shows two of them, none edge-on: of a strip a tenth of
    a pixel wide sixteen samples would tell nothing."""
    scene = empty()
    white, dark = diffuse("white", 0.7), diffuse("dark", 0.3)
    box("room", (0, 0, 0), (4, 4, 3), {"-x": white, "+x": white, "+y": white, "-z": white, "+z": dark}, leave_out=("-y",))
    rectangle("Mirror", (2.0, 3.98, 1.2), (2.4, 0.0, 0.0), (0.0, 0.0, 1.6), mirror("mirror", 0.98))
    light("Square", "AREA", 150.0, (1.0, 1.2, 1.2), shape="SQUARE", size=1.0, color=(1.0, 0.8, 0.5))
    light("Disc", "AREA", 80.0, (3.0, 2.6, 1.9), (math.radians(150.0), 0.0, 0.0), shape="DISK", size=0.8)
    oval = light("Oval", "AREA", 60.0, (2.2, 2.0, 2.2), (0.0, math.radians(40.0), math.radians(30.0)), shape="ELLIPSE", size=0.5, size_y=0.3)
    oval.scale = (1.5, 1.0, 1.0)
    camera((2.0, -4.2, 1.5), (2.0, 0.0, 1.5), 45.0)
    return scene


def world_room():
    """A room without a front wall and a ceiling, lit by the world alone."""
    scene = empty()
    white, blue = diffuse("white", 0.7), diffuse("blue", (0.1, 0.2, 0.6))
    box("room", (0, 0, 0), (4, 4, 3), {"-x": white, "+x": blue, "+y": white, "-z": white}, leave_out=("-y", "+z"))
    box("block", (1.4, 1.6, 0.0), (2.4, 2.6, 1.2), white, inward=False)
    world((0.5, 0.7, 1.0), 2.0)
    camera((2.0, -4.2, 1.8), (2.0, 0.0, 1.5), 45.0)
    return scene


ROOMS = {"cornell": cornell, "mirror_room": mirror_room, "hanging_lamps": hanging_lamps, "world_room": world_room}
