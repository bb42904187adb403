"""Models a room in Blender and exports it with Blender's own glTF exporter.

    blender -b --factory-startup --python make_room.py -- ../blender-room.glb

Everything is made as a modeller would: planes and cubes with the modifiers applied, node materials with the
Principled BSDF, default names where nobody would have given one. Blender is Z up; the exporter turns it to Y up.
"""
import math
import sys

import bpy
import numpy

# Blender 3.4's exporter was written for a numpy that still had this alias.
if not hasattr(numpy, "bool"):
    numpy.bool = bool


def material(name, color, metallic=0.0, roughness=1.0, emission=None, strength=0.0):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.use_backface_culling = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    shader.inputs["Metallic"].default_value = metallic
    shader.inputs["Roughness"].default_value = roughness
    # No clear coat over walls and wood: they are matt.
    if metallic == 0.0:
        shader.inputs["Specular"].default_value = 0.0
    if emission:
        shader.inputs["Emission"].default_value = (*emission, 1.0)
        shader.inputs["Emission Strength"].default_value = strength
    return made


def finish(name, paint):
    thing = bpy.context.object
    if name:
        thing.name = name
    thing.data.materials.append(paint)
    return thing


def plane(name, location, rotation, size, paint):
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=location, rotation=[math.radians(a) for a in rotation])
    bpy.context.object.scale = (size[0], size[1], 1.0)
    return finish(name, paint)


def cube(name, location, size, paint, turn=0.0):
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=location, rotation=(0.0, 0.0, math.radians(turn)))
    bpy.context.object.scale = size
    return finish(name, paint)


def room(paint, boards):
    """4 m wide, 5 m deep, 2.8 m high; every plane faces in."""
    plane("Floor", (0, 0, 0), (0, 0, 0), (4, 5), boards)
    plane("Ceiling", (0, 0, 2.8), (180, 0, 0), (4, 5), paint)
    plane("Wall.back", (0, 2.5, 1.4), (90, 0, 0), (4, 2.8), paint)
    plane("Wall.front", (0, -2.5, 1.4), (-90, 0, 0), (4, 2.8), paint)
    plane("Wall.left", (-2, 0, 1.4), (0, 90, 0), (2.8, 5), paint)
    plane("Wall.right", (2, 0, 1.4), (0, -90, 0), (2.8, 5), paint)


def furniture(wood, cloth, clay):
    cube("Table.top", (0.4, 1.0, 0.73), (1.4, 0.8, 0.04), wood)
    for x in (-0.2, 1.0):
        for y in (0.7, 1.3):
            cube(None, (x, y, 0.355), (0.06, 0.06, 0.7), wood)
    cube("Sideboard", (-1.7, 0.6, 0.405), (0.5, 1.6, 0.8), wood)
    cube("Seat", (1.3, -0.4, 0.225), (0.6, 0.6, 0.44), cloth, turn=25.0)

    # A vase: a cylinder whose rings were scaled, as spinning would make it.
    rings = ((0.05, 0.0), (0.1, 0.06), (0.13, 0.14), (0.1, 0.23), (0.05, 0.3), (0.07, 0.36))
    sides = 20
    corners = [(r * math.cos(2 * math.pi * k / sides), r * math.sin(2 * math.pi * k / sides), z)
               for r, z in rings for k in range(sides)]
    faces = [(i * sides + k, i * sides + (k + 1) % sides, (i + 1) * sides + (k + 1) % sides, (i + 1) * sides + k)
             for i in range(len(rings) - 1) for k in range(sides)]
    mesh = bpy.data.meshes.new("Vase")
    mesh.from_pydata(corners, [], faces)
    vase = bpy.data.objects.new("Vase", mesh)
    vase.location = (0.55, 1.0, 0.752)
    bpy.context.collection.objects.link(vase)
    mesh.materials.append(clay)
    for face in mesh.polygons:
        face.use_smooth = True

    bpy.ops.mesh.primitive_uv_sphere_add(segments=20, ring_count=10, radius=0.18, location=(-1.65, 0.3, 0.99))
    bpy.ops.object.shade_smooth()
    finish("Globe", cloth)


def mirror_and_lamp(wood):
    glass = material("Mirror", (0.92, 0.92, 0.92), metallic=1.0, roughness=0.0)
    plane("Mirror", (0.2, 2.47, 1.55), (90, 0, 0), (1.6, 1.1), glass)
    for x in (-0.64, 1.04):
        cube("Mirror.frame", (x, 2.465, 1.55), (0.08, 0.05, 1.26), wood)
    for z in (0.96, 2.14):
        cube("Mirror.frame", (0.2, 2.465, z), (1.6, 0.05, 0.08), wood)

    # Area lights are not part of glTF: the lamp is a plane that emits, as one models it for export.
    glow = material("Lamp", (0.0, 0.0, 0.0), emission=(1.0, 0.85, 0.65), strength=16.0)
    plane("Lamp", (-0.3, 0.2, 2.78), (180, 0, 0), (0.7, 0.7), glow)


def camera():
    bpy.ops.object.camera_add(location=(-1.55, -2.2, 1.6))
    seen = bpy.context.object
    aim = bpy.data.objects.new("Aim", None)
    aim.location = (0.35, 1.6, 1.05)
    bpy.context.collection.objects.link(aim)
    track = seen.constraints.new("TRACK_TO")
    track.target, track.track_axis, track.up_axis = aim, "TRACK_NEGATIVE_Z", "UP_Y"
    seen.data.lens = 24.0
    bpy.context.scene.camera = seen
    bpy.context.scene.render.resolution_x = 1024
    bpy.context.scene.render.resolution_y = 768


bpy.ops.wm.read_factory_settings(use_empty=True)
wall = material("Material", (0.75, 0.73, 0.68))
boards = material("Material.001", (0.45, 0.33, 0.22))
wood = material("Material.002", (0.3, 0.18, 0.1))
cloth = material("Material.003", (0.15, 0.3, 0.5))
clay = material("Material.004", (0.6, 0.26, 0.14))
room(wall, boards)
furniture(wood, cloth, clay)
mirror_and_lamp(wood)
camera()

target = sys.argv[sys.argv.index("--") + 1] if "--" in sys.argv else "blender-room.glb"
bpy.ops.export_scene.gltf(filepath=target, export_format="GLB", export_cameras=True, export_apply=True)
