"""Rewrites materials that Blender's exporter does not read as the Principled BSDF that says the same."""

import bpy


def _output(material):
    if not material.use_nodes or material.node_tree is None:
        return None
    for node in material.node_tree.nodes:
        if node.type == "OUTPUT_MATERIAL" and node.is_active_output:
            return node
    return None


def use_vertex_colours(materials):
    """Whether one of them shows colours of vertices: glTF multiplies by them, Blender does where a node asks for it."""
    for material in materials:
        if material and material.use_nodes and material.node_tree:
            if any(node.type in {"VERTEX_COLOR", "ATTRIBUTE"} for node in material.node_tree.nodes):
                return True
    return False


def _set(node, names, value):
    for name in names:  # inputs have other names since Blender 4.0
        if name in node.inputs:
            node.inputs[name].default_value = value
            return node.inputs[name]
    return None


def _move(tree, source, target):
    """Gives an input's value or link to another one."""
    if target is None:
        return
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value


def _principled(tree):
    node = tree.nodes.new("ShaderNodeBsdfPrincipled")
    _set(node, ("Specular", "Specular IOR Level"), 0.0)
    _set(node, ("Roughness",), 1.0)
    _set(node, ("Metallic",), 0.0)
    return node


def _rewrite(tree, shader):
    """The Principled BSDF of a plain shader, None of others."""
    if shader.type == "BSDF_DIFFUSE":
        node = _principled(tree)
        _move(tree, shader.inputs["Color"], node.inputs["Base Color"])
    elif shader.type in {"BSDF_GLOSSY", "BSDF_ANISOTROPIC"}:
        node = _principled(tree)
        node.inputs["Metallic"].default_value = 1.0
        _move(tree, shader.inputs["Color"], node.inputs["Base Color"])
        if getattr(shader, "distribution", "") == "SHARP":
            node.inputs["Roughness"].default_value = 0.0
        else:
            _move(tree, shader.inputs["Roughness"], node.inputs["Roughness"])
    elif shader.type == "EMISSION":
        node = _principled(tree)
        node.inputs["Base Color"].default_value = (0.0, 0.0, 0.0, 1.0)
        _move(tree, shader.inputs["Color"], _set(node, ("Emission", "Emission Color"), (1.0, 1.0, 1.0, 1.0)))
        _move(tree, shader.inputs["Strength"], node.inputs["Emission Strength"])
    elif shader.type in {"BSDF_GLASS", "BSDF_REFRACTION"}:
        node = _principled(tree)
        _set(node, ("Transmission", "Transmission Weight"), 1.0)
        _set(node, ("Specular", "Specular IOR Level"), 0.5)
        _move(tree, shader.inputs["Color"], node.inputs["Base Color"])
        _move(tree, shader.inputs["Roughness"], node.inputs["Roughness"])
        _move(tree, shader.inputs["IOR"], node.inputs["IOR"])
    else:
        return None
    if "Normal" in shader.inputs and shader.inputs["Normal"].is_linked:
        tree.links.new(shader.inputs["Normal"].links[0].from_socket, node.inputs["Normal"])
    return node


def _prepare(material, warnings):
    """What undoes it, or None: the shader's own values may be animated, and the next frame looks at them again."""
    output = _output(material)
    if output is None or not output.inputs["Surface"].is_linked:
        return None
    if output.inputs["Volume"].is_linked and output.inputs["Volume"].links[0].from_node.type != "VOLUME_ABSORPTION":
        warnings.append(f"material '{material.name}': its volume is left out")
    socket = output.inputs["Surface"].links[0].from_socket
    shader = socket.node
    if shader.type == "BSDF_PRINCIPLED":
        return None
    tree = material.node_tree
    node = _rewrite(tree, shader)
    if node is None:
        warnings.append(f"material '{material.name}': {shader.bl_label or shader.name} is not understood, "
                        "only what Blender's glTF exporter makes of it; a Principled BSDF is")
        return None
    tree.links.new(node.outputs["BSDF"], output.inputs["Surface"])

    def undo():
        tree.links.new(socket, output.inputs["Surface"])
        tree.nodes.remove(node)

    return undo


def prepare(items, warnings):
    """Rewrites the materials of meshes; returns what undoes it."""
    done, undone = set(), []
    for item in items:
        mesh = item.get("mesh")
        for material in mesh.materials if mesh else []:
            if material and material.name not in done:
                done.add(material.name)
                undone.append(_prepare(material, warnings))

    def undo():
        for step in undone:
            if step:
                step()

    return undo
