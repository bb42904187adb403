"""Blender's lights in the units of Meninas.

As Cycles 3.4 has them, measured by tests/blender/units_test.py: a point or spot lamp of P watts has P / (4 pi) W/sr, a
sun of strength S gives S W/m^2, and an area lamp of P watts and A square metres has the radiance P / (4 A) W/m^2/sr
(so that it sends out pi / 4 of its P watts).
"""

import math

import bpy

DISC_CORNERS = 64
# The reflectance of a lamp's face. Cycles' lamps are not there for other light; a face that reflects most of it is
# closer to that than a black one. Blender's default material has the same.
FACE_REFLECTANCE = 0.8


def _shader_factor(light, warnings, name):
    """What the light's own nodes multiply its colour by."""
    if not light.use_nodes or light.node_tree is None:
        return [1.0, 1.0, 1.0]
    for node in light.node_tree.nodes:
        if node.type == "EMISSION":
            colour, strength = node.inputs["Color"], node.inputs["Strength"]
            if colour.is_linked or strength.is_linked:
                warnings.append(f"light '{name}': what is linked to its Emission node is left out")
            factor = 1.0 if strength.is_linked else strength.default_value
            return [factor] * 3 if colour.is_linked else [factor * c for c in colour.default_value[:3]]
    return [1.0, 1.0, 1.0]


def _watts(light, name, warnings):
    colour = [c * f for c, f in zip(light.color, _shader_factor(light, warnings, name))]
    energy = light.energy * 2.0 ** getattr(light, "exposure", 0.0)  # since Blender 4.3
    if getattr(light, "use_temperature", False):  # since Blender 4.5
        colour = [c * t for c, t in zip(colour, light.temperature_color)]
    return [energy * c for c in colour]


def _face(light, scale):
    """The width and height of an area lamp, and whether it is round."""
    width = light.size
    height = light.size_y if light.shape in {"RECTANGLE", "ELLIPSE"} else light.size
    return width * abs(scale.x), height * abs(scale.y), light.shape in {"DISK", "ELLIPSE"}


def light_of(thing, warnings):
    light = thing.data
    power = _watts(light, thing.name, warnings)
    if max(power) <= 0.0:
        if min(power) < 0.0:
            warnings.append(f"light '{thing.name}': negative light is left out")
        return None
    if light.type == "AREA":
        width, height, is_round = _face(light, thing.matrix_world.to_scale())
        area = width * height * (math.pi / 4.0 if is_round else 1.0)
        if area <= 0.0:
            warnings.append(f"area lamp '{thing.name}' has no area and is left out")
            return None
        if getattr(light, "spread", math.pi) < math.pi - 1e-3:
            warnings.append(f"area lamp '{thing.name}': its spread is left out, it shines evenly")
        return {"type": "AREA", "radiance": [p / (4.0 * area) for p in power], "round": is_round,
                "size": (light.size, light.size_y if light.shape in {"RECTANGLE", "ELLIPSE"} else light.size)}
    values = {"type": light.type}
    if light.type == "SPOT":
        values.update(spot_size=light.spot_size, spot_blend=light.spot_blend)
    values["intensity"] = power if light.type == "SUN" else [p / (4.0 * math.pi) for p in power]
    return values


def _outline(light):
    width, height = light["size"]
    if not light["round"]:
        return [(x * width / 2.0, y * height / 2.0, 0.0) for x, y in ((-1, -1), (-1, 1), (1, 1), (1, -1))]
    # A polygon of the ellipse's area. Clockwise about +Z, so that the face shines along -Z as lamps do.
    n = DISC_CORNERS
    grow = math.sqrt(math.pi / (n / 2.0 * math.sin(2.0 * math.pi / n)))
    turns = [-2.0 * math.pi * k / n for k in range(n)]
    return [(grow * width / 2.0 * math.cos(t), grow * height / 2.0 * math.sin(t), 0.0) for t in turns]


def data_of(light, label):
    """A light for the exporter, or the face of an area lamp with a material that `finish` fills in."""
    if light["type"] == "AREA":
        mesh = bpy.data.meshes.new(label)
        corners = _outline(light)
        mesh.from_pydata(corners, [], [tuple(range(len(corners)))])
        mesh.materials.append(bpy.data.materials.new(label))
        return mesh
    data = bpy.data.lights.new(label, light["type"])
    if light["type"] == "SPOT":
        data.spot_size, data.spot_blend = light["spot_size"], light["spot_blend"]
    return data


def _split(values):
    top = max(values)
    return [max(0.0, v) / top for v in values], top


def _use(gltf, extension):
    used = gltf.setdefault("extensionsUsed", [])
    if extension not in used:
        used.append(extension)


def _light_index(gltf, node):
    """The light of a node, or of a child that some exporters turn it by."""
    for candidate in [node] + [gltf["nodes"][k] for k in node.get("children", [])]:
        light = candidate.get("extensions", {}).get("KHR_lights_punctual")
        if light:
            return light["light"]
    return None


def finish(gltf, index, item):
    node, light = gltf["nodes"][index], item["light"]
    if light["type"] == "AREA":
        colour, strength = _split(light["radiance"])
        for primitive in gltf["meshes"][node["mesh"]]["primitives"]:
            gltf["materials"][primitive["material"]] = {
                "name": item["name"],
                "pbrMetallicRoughness": {"baseColorFactor": [FACE_REFLECTANCE] * 3 + [1.0], "metallicFactor": 0.0,
                                         "roughnessFactor": 1.0},
                "emissiveFactor": colour,
                "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}},
            }
        _use(gltf, "KHR_materials_emissive_strength")
        return
    number = _light_index(gltf, node)
    if number is None:
        raise RuntimeError(f"Blender's exporter has left out the light '{item['name']}'")
    punctual = gltf["extensions"]["KHR_lights_punctual"]["lights"][number]
    punctual["color"], punctual["intensity"] = _split(light["intensity"])
    punctual["name"] = item["name"]
    punctual.pop("range", None)
