"""Layers of Meninas as render passes of Blender."""

import numpy as np

# Layer of the EXR: pass of Blender. The first nine add up to the combined picture.
LIGHT_PASSES = {
    "emission": "Emission",
    "emission.mirror": "Emission by Mirror",
    "emission.mirrors": "Emission by Mirrors",
    "diffuse.direct": "Direct",
    "diffuse.direct.mirror": "Direct by Mirror",
    "diffuse.direct.mirrors": "Direct by Mirrors",
    "diffuse.mirrored": "Mirrored",
    "diffuse.mirrored.mirror": "Mirrored by Mirror",
    "diffuse.mirrored.mirrors": "Mirrored by Mirrors",
    "albedo": "Albedo",
}
FAR = 1e10  # what Blender's depth is where there is nothing


def lamp_pass(layer):
    """A pass's name has at most 63 bytes."""
    return ("Lamp " + layer.removeprefix("lamp.")).encode()[:63].decode(errors="ignore")


def added_passes(layers):
    """(name, channels, their names, kind) of the passes beyond the combined picture, by the names of layers."""
    named = [LIGHT_PASSES[layer] for layer in LIGHT_PASSES if layer in layers]
    named += [lamp_pass(layer) for layer in layers if layer.startswith("lamp.")]
    return [("Depth", 1, "Z", "VALUE"), ("Normal", 3, "XYZ", "VECTOR"), *((name, 3, "RGB", "COLOR") for name in named)]


def blender_axes(vectors):
    """(x, y, z) of glTF, +Y up, is (x, -z, y) of Blender."""
    return np.stack([vectors[..., 0], -vectors[..., 2], vectors[..., 1]], axis=-1)


def pictures(layers):
    """{pass: (height, width, channels) float32} of what the program has written."""
    colour = layers[""][..., :3]
    made = {"Combined": np.concatenate([colour, np.ones_like(colour[..., :1])], axis=-1)}
    for layer, picture in layers.items():
        if layer in LIGHT_PASSES:
            made[LIGHT_PASSES[layer]] = picture
        elif layer.startswith("lamp."):
            made[lamp_pass(layer)] = picture
    if "depth" in layers:
        made["Depth"] = np.where(layers["depth"] > 0.0, layers["depth"], np.float32(FAR))
    if "normal" in layers:
        made["Normal"] = blender_axes(layers["normal"])
    return {name: np.ascontiguousarray(picture, np.float32) for name, picture in made.items()}
