"""Reads a solution that `meninas solve` has written: glTF binary, one mesh a node, light at its vertices."""

import json
import struct

import numpy as np

COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}


def _chunks(path):
    with open(path, "rb") as file:
        data = file.read()
    (length,) = struct.unpack_from("<I", data, 12)
    gltf = json.loads(data[20 : 20 + length])
    return gltf, data[20 + length + 8 :]


def _values(gltf, binary, index):
    accessor = gltf["accessors"][index]
    view = gltf["bufferViews"][accessor["bufferView"]]
    kind, count = np.dtype(TYPES[accessor["componentType"]]), COMPONENTS[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", kind.itemsize * count)
    return np.ndarray((accessor["count"], count), kind, binary, start, (stride, kind.itemsize))


def _matrix(node):
    """Solutions have translations and matrices alone."""
    matrix = np.array(node["matrix"], float).reshape(4, 4).T if "matrix" in node else np.eye(4)
    matrix[:3, 3] += node.get("translation", (0.0, 0.0, 0.0))
    return matrix


def _radiosity(shown, white, irradiance, emitted):
    """Colours stop at a display's white. Beyond it the radiosity is emission and reflectance times irradiance, the
    reflectance being that of the node's other vertices (its median, where a texture has several)."""
    radiosity = shown.copy()
    dim = (shown.max(axis=1) < 0.999 * white) & (irradiance.min(axis=1) > 0.0)
    bright = shown.max(axis=1) >= 0.999 * white
    reflectance = np.median(shown[dim] / irradiance[dim], axis=0) if dim.any() else np.zeros(3)
    radiosity[bright] = np.maximum(shown[bright], np.asarray(emitted) + reflectance * irradiance[bright])
    return radiosity


def read_nodes(path, emitted):
    """For each node and material: name, positions (n, 3) and triangles (m, 3) in Blender's axes, irradiance (n, 3) and
    radiosity (n, 3) in W/m^2. `emitted` is the radiant exitance of nodes by name, which the file has no room for."""
    gltf, binary = _chunks(path)
    scale = gltf["asset"]["extras"]["meninas"]["display_scale"]
    found = []

    def visit(index, above):
        node = gltf["nodes"][index]
        place = above @ _matrix(node)
        for primitive in gltf["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            attributes = primitive["attributes"]
            if "_IRRADIANCE" not in attributes:
                continue
            name = node.get("name", f"node{index}")
            irradiance = np.array(_values(gltf, binary, attributes["_IRRADIANCE"]))
            shown = np.array(_values(gltf, binary, attributes["COLOR_0"])[:, :3]) / scale
            at = _values(gltf, binary, attributes["POSITION"]) @ place[:3, :3].T + place[:3, 3]
            found.append({
                "name": name,
                "positions": np.stack([at[:, 0], -at[:, 2], at[:, 1]], axis=-1),
                "triangles": _values(gltf, binary, primitive["indices"]).reshape(-1, 3),
                "irradiance": irradiance,
                "radiosity": _radiosity(shown, 1.0 / scale, irradiance, emitted.get(name, (0.0, 0.0, 0.0))),
            })
        for child in node.get("children", []):
            visit(child, place)

    for root in gltf["scenes"][gltf.get("scene", 0)]["nodes"]:
        visit(root, np.eye(4))
    return found
