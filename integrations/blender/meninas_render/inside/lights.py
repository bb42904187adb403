"""Blender's lights in the units of Meninas.

As Cycles 3.4 has them, measured by tests/blender/units_test.py: a point or spot lamp of P watts has P / (4 pi) W/sr, a
sun of strength S gives S W/m^2, and an area lamp of P watts and A square metres has the radiance P / (4 A) W/m^2/sr
(so that it sends out pi / 4 of its P watts).
"""

import math

import bpy
from mathutils import Matrix


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


def _warn_of_area(thing, light, warnings):
    """Of what Cycles' area lamps can be told and ours cannot."""
    if getattr(light, "spread", math.pi) < math.pi - 1e-3:
        warnings.append(f"area lamp '{thing.name}': its spread is left out, it shines evenly")
    if getattr(thing, "visible_camera", False):
        warnings.append(f"area lamp '{thing.name}': mirrors alone show it, the camera does not")


def _is_portal(light):
    return bool(getattr(getattr(light, "cycles", None), "is_portal", False))


def light_of(thing, matrix, warnings):
    light = thing.data
    if light.type == "AREA" and _is_portal(light):
        return None  # it guides Cycles' rays and shines no light; Meninas finds windows itself
    power = _watts(light, thing.name, warnings)
    if max(power) <= 0.0:
        if min(power) < 0.0:
            warnings.append(f"light '{thing.name}': negative light is left out")
        return None
    if light.type == "AREA":
        width, height, is_round = _face(light, matrix.to_scale())
        area = width * height * (math.pi / 4.0 if is_round else 1.0)
        if area <= 0.0:
            warnings.append(f"area lamp '{thing.name}' has no area and is left out")
            return None
        _warn_of_area(thing, light, warnings)
        return {"type": "AREA", "radiance": [p / (4.0 * area) for p in power], "round": is_round,
                "size": (width, height)}
    values = {"type": light.type}
    if light.type == "SPOT":
        values.update(spot_size=light.spot_size, spot_blend=light.spot_blend)
    values["intensity"] = power if light.type == "SUN" else [p / (4.0 * math.pi) for p in power]
    return values


def placed(light, matrix):
    """The node's matrix, and the object's data for the exporter: none of area lamps, which are EXT_lights_area, of world size."""
    if light["type"] != "AREA":
        data = bpy.data.lights.new("light", light["type"])
        if light["type"] == "SPOT":
            data.spot_size, data.spot_blend = light["spot_size"], light["spot_blend"]
        return matrix, data
    # Its own Z and X in the world: decompose() would turn those of mirrored objects the other way.
    z = matrix.to_3x3().col[2].normalized()
    x = matrix.to_3x3().col[0]
    x = (x - x.dot(z) * z).normalized()
    turned = Matrix((x, z.cross(x), z)).transposed()
    # Z upwards in Blender is Y in glTF, also of what a node itself has: its -Z, the way the light shines, is +Y here.
    turn = Matrix.Rotation(-math.pi / 2.0, 4, "X")
    return Matrix.Translation(matrix.to_translation()) @ turned.to_4x4() @ turn, None


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


def _finish_area(gltf, node, name, light):
    width, height = light["size"]
    colour, intensity = _split(light["radiance"])
    area = {"name": name, "type": "disk" if light["round"] else "rect", "size": height, "color": colour,
            "intensity": intensity}
    area["extras" if light["round"] else "rect"] = {"aspect": width / height}
    lights = gltf.setdefault("extensions", {}).setdefault("EXT_lights_area", {}).setdefault("lights", [])
    node.setdefault("extensions", {})["EXT_lights_area"] = {"light": len(lights)}
    lights.append(area)
    _use(gltf, "EXT_lights_area")


def finish(gltf, index, item):
    node, light = gltf["nodes"][index], item["light"]
    if light["type"] == "AREA":
        _finish_area(gltf, node, item["name"], light)
        return
    number = _light_index(gltf, node)
    if number is None:
        raise RuntimeError(f"Blender's exporter has left out the light '{item['name']}'")
    punctual = gltf["extensions"]["KHR_lights_punctual"]["lights"][number]
    punctual["color"], punctual["intensity"] = _split(light["intensity"])
    punctual["name"] = item["name"]
    punctual.pop("range", None)
