# %% [markdown]
# # Radiosity in an hour
#
# The classic lecture, with numbers: form factors and what they must satisfy, three ways to solve the system, how a hemicube
# errs, and a mirror as a world of its own. Run it cell by cell, or whole: `python3 lecture.py`.

# %%
import base64
import json
import pathlib
import struct
import tempfile

import numpy as np
import scipy.sparse as sparse

import meninas

folder = pathlib.Path(tempfile.mkdtemp())


def room_file(name, quads, materials):
    """A glTF of rectangles: (node, material, corner, edge, edge), the front where edge x edge points."""
    data, accessors, views, meshes, nodes = b"", [], [], [], []
    for node, material, corner, along, up in quads:
        corner, along, up = (np.array(v, dtype=float) for v in (corner, along, up))
        points = np.array([corner, corner + along, corner + along + up, corner + up], dtype="<f4")
        for chunk, kind in ((points.tobytes(), "VEC3"), (struct.pack("<6H", 0, 1, 2, 0, 2, 3), "SCALAR")):
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(chunk)})
            accessors.append({"bufferView": len(views) - 1, "count": 4 if kind == "VEC3" else 6, "type": kind,
                              "componentType": 5126 if kind == "VEC3" else 5123})
            data += chunk + b"\0" * (-len(chunk) % 4)
        accessors[-2].update(min=points.min(0).tolist(), max=points.max(0).tolist())
        meshes.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 2}, "indices": len(accessors) - 1,
                                       "material": material}]})
        nodes.append({"name": node, "mesh": len(meshes) - 1})
    nodes.append({"name": "eye", "camera": 0, "translation": [1, 0.5, 0.9]})
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    file = folder / name
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
        "meshes": meshes, "materials": materials, "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": uri}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.01}}]}))
    return file


def diffuse(grey, emission=0.0):
    return {"pbrMetallicRoughness": {"baseColorFactor": [grey] * 3 + [1], "metallicFactor": 0},
            "emissiveFactor": [emission] * 3}


def box(name, origin, size, material):
    """The inside of a box, a node for each of its six walls."""
    x, y, z = size
    o = np.array(origin, dtype=float)
    return [(name + "floor", material, o, (0, 0, z), (x, 0, 0)), (name + "ceiling", material, o + (0, y, 0), (x, 0, 0), (0, 0, z)),
            (name + "back", material, o, (x, 0, 0), (0, y, 0)), (name + "front", material, o + (0, 0, z), (0, y, 0), (x, 0, 0)),
            (name + "left", material, o, (0, y, 0), (0, 0, z)), (name + "right", material, o + (x, 0, 0), (0, 0, z), (0, y, 0))]


# %% [markdown]
# ## Form factors
#
# $F_{ij}$ is the share of what element $i$ sends that arrives at $j$. In a closed room every row adds up to 1. Reciprocity says
# $A_i F_{ij} = A_j F_{ji}$; rays know it up to their noise.

# %%
walls = box("", (0, 0, 0), (2, 1, 1), 0)
walls[1] = (*walls[1][:1], 1, *walls[1][2:])  # the ceiling shines
room = meninas.load(room_file("room.gltf", walls, [diffuse(0.6), diffuse(0.6, 1.0)]))
factors = room.form_factors(elements=300, rays=4096)
F = sparse.csr_matrix(factors.arrays(), shape=factors.shape).toarray()
A = factors.area
print(len(factors), "elements; rows add up to", F.sum(1).min(), "...", F.sum(1).max())
exchange = A[:, None] * F
print("reciprocity holds to", abs(exchange - exchange.T).max() / exchange.max())
assert abs(F.sum(1) - 1).max() < 1e-5
assert abs(exchange - exchange.T).max() < 0.1 * exchange.max()

# %% [markdown]
# Between two whole walls the closed form is known: two equal parallel rectangles $a \times b$ at a distance $c$ (here the floor and
# the ceiling), with $X = a/c$ and $Y = b/c$.

# %%
X, Y = 2.0, 1.0
closed_form = 2 / (np.pi * X * Y) * (
    np.log(np.sqrt((1 + X**2) * (1 + Y**2) / (1 + X**2 + Y**2)))
    + X * np.sqrt(1 + Y**2) * np.arctan(X / np.sqrt(1 + Y**2)) + Y * np.sqrt(1 + X**2) * np.arctan(Y / np.sqrt(1 + X**2))
    - X * np.arctan(X) - Y * np.arctan(Y))


def between_nodes(of, node, other):
    """F of whole nodes: the mean over the elements of the one of the sum over those of the other."""
    rows = of.elements_of(node)
    return of.area[rows] @ of.between(node, other).sum(1) / of.area[rows].sum()


by_rays = between_nodes(factors, "floor", "ceiling")
print("floor to ceiling:", by_rays, "by rays,", closed_form, "in closed form")
assert abs(by_rays - closed_form) < 2e-3 * closed_form  # 50 elements of 4,096 low-discrepancy rays each

# %% [markdown]
# ## Solving B = E + rho F B
#
# Gauss-Seidel gathers, row by row; shooting sends the brightest unshot power, column by column; and a dense matrix is
# factorised, which in the library Eigen does.

# %%
E, rho = factors.emission[:, 0], factors.reflectance[:, 0]
exact = np.linalg.solve(np.eye(len(A)) - rho[:, None] * F, E)


def gauss_seidel(sweeps):
    B = E.copy()
    for _ in range(sweeps):
        for i in range(len(B)):
            B[i] = E[i] + rho[i] * (F[i] @ B)
    return B


def shooting(shots):
    B, unshot = E.copy(), E.copy()
    for _ in range(shots):
        j = np.argmax(unshot * A)
        # What i receives of j, by reciprocity as it has been sampled: rows, not columns.
        received = rho * F[:, j] * unshot[j]
        unshot[j] = 0.0
        B += received
        unshot += received
    return B


for count in (1, 2, 4, 8):
    print(f"{count} sweeps of gathering: {abs(gauss_seidel(count) - exact).max() / exact.max():.1e} off; "
          f"{count * len(A)} shots: {abs(shooting(count * len(A)) - exact).max() / exact.max():.1e}")
assert abs(gauss_seidel(12) - exact).max() < 1e-4 * exact.max()
assert abs(shooting(12 * len(A)) - exact).max() < 1e-4 * exact.max()
for solver in ("direct", "gauss-seidel", "jacobi", "cg", "progressive"):
    solved = factors.solve(solver=solver, tolerance=1e-5)
    off = abs(solved["radiosity"][:, 0] - exact).max() / exact.max()
    print(f"library, {solver}: {solved['iterations']} iterations, {off:.1e} off, bound {solved['error_bound']:.1e}")
    assert off < 2e-5

# %% [markdown]
# ## How a hemicube errs
#
# A hemicube asks from the centre of an element alone, by the cells of a grid. Fewer cells alias: what is small is hit or missed.

# %%
cells = (8, 16, 32, 64)
errors = []
for resolution in cells:
    hemicube = room.form_factors("hemicube", elements=300, hemicube_resolution=resolution)
    errors.append(abs(between_nodes(hemicube, "floor", "ceiling") - closed_form) / closed_form)
    print(f"{resolution} cells: {errors[-1]:.1e} off")
assert errors[-1] < 0.02  # what is left is that elements are asked at their centres alone

# %% [markdown]
# ## A mirror is a world
#
# The right wall is a mirror that reflects 0.9. What the floor receives of the left wall by way of it is what it would receive of
# the *image* of that wall, in the room doubled, times 0.9.

# %%
mirrored = [*walls[:5], ("mirror", 2, *walls[5][2:])]
mirror = {"pbrMetallicRoughness": {"baseColorFactor": [0.9] * 3 + [1], "metallicFactor": 1, "roughnessFactor": 0}}
with_mirror = meninas.load(room_file("mirror.gltf", mirrored, [diffuse(0.6), diffuse(0.6, 1.0), mirror]))
doubled = [*walls[:5], *[quad for quad in box("image-", (2, 0, 0), (2, 1, 1), 0) if quad[0] != "image-left"]]
by_hand = meninas.load(room_file("doubled.gltf", doubled, [diffuse(0.6), diffuse(0.6, 1.0)]))

T = with_mirror.form_factors(elements=300, rays=4096)
direct = with_mirror.form_factors(elements=300, rays=4096, worlds=False)
halves = by_hand.form_factors(elements=600, rays=4096)
for wall, image in (("left", "image-right"), ("back", "image-back"), ("ceiling", "image-ceiling")):
    by_mirror = between_nodes(T, "floor", wall) - between_nodes(direct, "floor", wall)
    image_room = 0.9 * between_nodes(halves, "floor", image)
    print(f"floor to {wall} by way of the mirror: {by_mirror:.5f}; 0.9 times the doubled room's: {image_room:.5f}")
    assert abs(by_mirror - image_room) < 1e-3  # of 1, the noise of both
