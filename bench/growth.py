#!/usr/bin/env python3
"""How the time of `plan` grows with what a file holds, and whether a plan ever takes longer than a draft.

    bench/growth.py build/release/cli/meninas [--before OTHER/meninas] [--kinds nodes,bolts] [--to 1e5] [--render]

Rooms of one kind of content each, made here, with n of it for n = 1e3, 1e3.5, 1e4 ... in triangles:

    terrain     a height field: every triangle a plane of its own
    ball        one finely tessellated sphere: shared corners, planes in all directions
    scan        a bumpy body as scanners make them, small in the room: triangles that hardly know their planes
    soup        triangles that touch nothing, turned at random
    parts       closed boxes in one mesh
    nodes       boxes, each a node with a mesh of its own
    children    boxes, each the child of the one before (at most 512 deep)
    instances   one box with EXT_mesh_gpu_instancing
    materials   boxes, each of a material of its own
    bolts       small spheres of polished metal, i.e. curved mirrors of 80 facets
    mirrors     small flat mirrors that face all ways
    panes       small sheets of glass
    walls       squares that stand on the floor

A row gives the processor seconds (user and system) of plan, with --render those of a draft of 48x48, and their quotient;
the last line of a kind is the slope of log(seconds) over log(n) between the largest two n, 1 where time is proportional to n.
With --before a second program does the same. The program exits with 1 when a plan takes longer than the draft (and a second
at least), or a run fails. Nothing but Python's standard library is needed.
"""
import argparse
import json
import math
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

HANG = 600  # processor seconds after which a run is ended


class File:
    """A glTF document in the making; accessors share one buffer."""

    def __init__(self):
        self.data = bytearray()
        self.views, self.accessors, self.meshes, self.nodes, self.materials = [], [], [], [], []
        self.roots = []
        self.extensions = set()

    def accessor(self, values, width):
        packed = struct.pack(f"<{len(values)}f", *values)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        item = {"bufferView": len(self.views) - 1, "componentType": 5126, "count": len(values) // width, "type": f"VEC{width}"}
        if width == 3:
            item["min"] = [min(values[k::3]) for k in range(3)]
            item["max"] = [max(values[k::3]) for k in range(3)]
        self.accessors.append(item)
        return len(self.accessors) - 1

    def indices(self, values):
        packed = struct.pack(f"<{len(values)}I", *values)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": 5125, "count": len(values), "type": "SCALAR"})
        return len(self.accessors) - 1

    def material(self, colour=(0.6, 0.6, 0.6), metal=0.0, roughness=1.0, **more):
        self.materials.append({"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1], "metallicFactor": metal,
                                                        "roughnessFactor": roughness}, **more})
        return len(self.materials) - 1

    def mesh(self, points, faces, material):
        positions = self.accessor([x for p in points for x in p], 3)
        self.meshes.append({"primitives": [{"attributes": {"POSITION": positions}, "material": material,
                                            "indices": self.indices([i for f in faces for i in f])}]})
        return len(self.meshes) - 1

    def node(self, root=True, **content):
        self.nodes.append(content)
        if root:
            self.roots.append(len(self.nodes) - 1)
        return len(self.nodes) - 1

    def write(self, path):
        document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": self.roots}], "nodes": self.nodes,
                    "meshes": self.meshes, "materials": self.materials, "accessors": self.accessors, "bufferViews": self.views,
                    "buffers": [{"byteLength": len(self.data)}]}
        if self.extensions:
            document["extensionsUsed"] = sorted(self.extensions)
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        self.data += b"\0" * (-len(self.data) % 4)
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.data)) + struct.pack("<I4s", len(text), b"JSON") +
                         text + struct.pack("<I4s", len(self.data), b"BIN\0") + bytes(self.data))


def box(low, high):
    points = [(high[0] if k & 1 else low[0], high[1] if k & 2 else low[1], high[2] if k & 4 else low[2]) for k in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def ball(centre, radius, rows):
    points = [(centre[0], centre[1] + radius, centre[2])]
    for i in range(1, rows):
        theta = math.pi * i / rows
        for j in range(2 * rows):
            phi = math.pi * (j + 0.5 * (i & 1)) / rows
            points.append((centre[0] + radius * math.sin(theta) * math.cos(phi), centre[1] + radius * math.cos(theta),
                           centre[2] - radius * math.sin(theta) * math.sin(phi)))
    points.append((centre[0], centre[1] - radius, centre[2]))
    ring = lambda i, j: 1 + (i - 1) * 2 * rows + j % (2 * rows)
    faces = []
    for j in range(2 * rows):
        faces.append((0, ring(1, j), ring(1, j + 1)))
        faces.append((len(points) - 1, ring(rows - 1, j + 1), ring(rows - 1, j)))
        for i in range(1, rows - 1):
            faces.append((ring(i, j), ring(i + 1, j), ring(i + 1, j + 1)))
            faces.append((ring(i, j), ring(i + 1, j + 1), ring(i, j + 1)))
    return points, faces


def joined(bodies):
    points, faces = [], []
    for some, triangles in bodies:
        faces += [tuple(i + len(points) for i in t) for t in triangles]
        points += some
    return points, faces


def places(count):
    """Middles of cells of a cubic grid within the room, and the cells' width."""
    side = max(1, math.ceil(count ** (1 / 3)))
    width = 4.0 / side
    return [(-2 + width * (k % side + 0.5), 0.2 + width * 0.6 * (k // side % side + 0.5), -2 + width * (k // side // side + 0.5))
            for k in range(count)], 0.5 * width


def boxes(count, chance):
    middles, width = places(count)
    for x, y, z in middles:
        half = [0.5 * width * chance.uniform(0.2, 0.55) for _ in range(3)]
        yield box([c - h for c, h in zip((x, y, z), half)], [c + h for c, h in zip((x, y, z), half)])


def squares(count, chance):
    middles, width = places(count)
    for middle in middles:
        while True:
            a, b = ([chance.gauss(0, 1) for _ in range(3)] for _ in range(2))
            n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            if math.hypot(*n) > 0.3:
                break
        u = [x / math.hypot(*a) * 0.2 * width for x in a]
        v = [n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]]
        v = [x / math.hypot(*v) * 0.2 * width for x in v]
        corner = lambda s, t: tuple(m + s * x + t * y for m, x, y in zip(middle, u, v))
        yield [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)], [(0, 1, 2), (0, 2, 3)]


def room(file):
    """4 x 2.8 x 4 m around the content, and a lamp of half a metre."""
    grey = file.material()
    points, faces = box((-2.1, 0.0, -2.1), (2.1, 2.8, 2.1))
    file.node(mesh=file.mesh(points, [(a, c, b) for a, b, c in faces], grey), name="room")
    lamp = file.material(emissiveFactor=[1, 1, 1])
    file.node(mesh=file.mesh([(-0.25, 2.79, -0.25), (0.25, 2.79, -0.25), (0.25, 2.79, 0.25), (-0.25, 2.79, 0.25)],
                             [(0, 1, 2), (0, 2, 3)], lamp), name="lamp")
    return grey


def terrain(file, n, grey, chance):
    side = max(2, round(math.sqrt(n / 2)))
    points = [(-2 + 4 * i / side, 0.1 + 0.3 * chance.random() / side + 0.1 * math.sin(5 * i / side) * math.cos(7 * j / side), -2 + 4 * j / side)
              for j in range(side + 1) for i in range(side + 1)]
    at = lambda i, j: j * (side + 1) + i
    faces = [t for j in range(side) for i in range(side)
             for t in ((at(i, j), at(i, j + 1), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i + 1, j)))]
    file.node(mesh=file.mesh(points, faces, grey))


def one_ball(file, n, grey, chance):
    file.node(mesh=file.mesh(*ball((0, 1.2, 0), 0.8, max(3, round(math.sqrt(n / 4)))), grey))


def scan(file, n, grey, chance):
    """Bumps of all sizes down to the triangles', each as steep."""
    points, faces = ball((0, 0, 0), 1.0, max(3, round(math.sqrt(n / 4))))
    waves = [([chance.gauss(0, 1) * 2 ** k for _ in range(3)], chance.uniform(0, math.tau), 0.3 / 2 ** k) for k in range(9)]
    grown = []
    for p in points:
        bump = 1.0 + sum(a * math.sin(p[0] * w[0] + p[1] * w[1] + p[2] * w[2] + phase) for w, phase, a in waves) * 0.5
        grown.append(tuple(0.2 * bump * x + (0.6 if k == 1 else 0.0) for k, x in enumerate(p)))
    file.node(mesh=file.mesh(grown, faces, grey))


def soup(file, n, grey, chance):
    file.node(mesh=file.mesh(*joined((points[:3], faces[:1]) for points, faces in squares(n, chance)), grey))


def parts(file, n, grey, chance):
    file.node(mesh=file.mesh(*joined(boxes(n // 12, chance)), grey))


def nodes(file, n, grey, chance):
    for points, faces in boxes(n // 12, chance):
        file.node(mesh=file.mesh(points, faces, grey))


def children(file, n, grey, chance):
    for k, (points, faces) in enumerate(boxes(n // 12, chance)):
        node = file.node(root=k % 512 == 0, mesh=file.mesh(points, faces, grey))
        if k % 512:
            file.nodes[node - 1]["children"] = [node]


def instances(file, n, grey, chance):
    middles, width = places(n // 12)
    mesh = file.mesh(*box([-0.2 * width] * 3, [0.2 * width] * 3), grey)
    where = file.accessor([x for p in middles for x in p], 3)
    file.extensions.add("EXT_mesh_gpu_instancing")
    file.node(mesh=mesh, extensions={"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": where}}})


def materials(file, n, grey, chance):
    for points, faces in boxes(n // 12, chance):
        file.node(mesh=file.mesh(points, faces, file.material([chance.random() for _ in range(3)])))


def bolts(file, n, grey, chance):
    metal = file.material((0.9, 0.9, 0.9), 1.0, 0.0)
    middles, width = places(max(1, n // 80))
    for middle in middles:
        file.node(mesh=file.mesh(*ball(middle, 0.25 * width, 5), metal))


def mirrors(file, n, grey, chance):
    metal = file.material((0.9, 0.9, 0.9), 1.0, 0.0)
    for points, faces in squares(n // 2, chance):
        file.node(mesh=file.mesh(points, faces, metal))


def panes(file, n, grey, chance):
    glass = file.material((1, 1, 1), 0.0, 0.0, doubleSided=True, extensions={"KHR_materials_transmission": {"transmissionFactor": 1}})
    file.extensions.add("KHR_materials_transmission")
    for points, faces in squares(n // 2, chance):
        file.node(mesh=file.mesh(points, faces, glass))


def walls(file, n, grey, chance):
    side = math.ceil(math.sqrt(n / 2))
    width, sheets = 4.0 / side, []
    for k in range(n // 2):
        x, z, turn = -2 + width * (k % side + 0.5), -2 + width * (k // side + 0.5), chance.uniform(0, math.tau)
        dx, dz = 0.4 * width * math.cos(turn), 0.4 * width * math.sin(turn)
        sheets.append(([(x - dx, 0, z - dz), (x + dx, 0, z + dz), (x + dx, 0.2, z + dz), (x - dx, 0.2, z - dz)], [(0, 1, 2), (0, 2, 3)]))
    file.node(mesh=file.mesh(*joined(sheets), grey))


KINDS = {"terrain": terrain, "ball": one_ball, "scan": scan, "soup": soup, "parts": parts, "nodes": nodes, "children": children, "instances": instances,
         "materials": materials, "bolts": bolts, "mirrors": mirrors, "panes": panes, "walls": walls}


def processor_seconds(command):
    before = os.times()
    limit = f"ulimit -t {HANG}; exec \"$@\""
    done = subprocess.run(["sh", "-c", limit, "sh", *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    after = os.times()
    seconds = after.children_user + after.children_system - before.children_user - before.children_system
    problem = "" if done.returncode == 0 else f"ends with {done.returncode}: {done.stderr.decode(errors='replace')[-200:].strip()}"
    return seconds, problem


def measure(programs, kind, n, arguments, folder):
    file = File()
    KINDS[kind](file, n, room(file), random.Random(n))
    path = folder / f"{kind}.glb"
    file.write(path)
    row = []
    for program in programs:
        plan, problem = processor_seconds([program, "plan", str(path), "--quality", "draft", "--json"])
        draft = math.nan
        if arguments.render and not problem:
            draft, problem = processor_seconds([program, "render", str(path), "--quality", "draft", "--size", "48x48", "--quiet", "-o",
                                                str(folder / "picture.png")])
        row.append((plan, draft, problem))
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meninas")
    parser.add_argument("--before", metavar="MENINAS", help="another program to compare with")
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--from", dest="first", type=float, default=1e3)
    parser.add_argument("--to", type=float, default=1e5, help="triangles, up to 1e6")
    parser.add_argument("--render", action="store_true", help="drafts as well")
    arguments = parser.parse_args()
    programs = [arguments.meninas] + ([arguments.before] if arguments.before else [])
    bad = False
    with tempfile.TemporaryDirectory() as folder:
        for kind in arguments.kinds.split(","):
            steps = round(2 * math.log10(arguments.to / arguments.first))
            counts = [round(arguments.first * 10 ** (k / 2)) for k in range(steps + 1)]
            seen = []
            for n in counts:
                row = measure(programs, kind, n, arguments, pathlib.Path(folder))
                seen.append(row)
                text = ""
                for (plan, draft, problem), name in zip(row, ("", "   before: ")):
                    text += f"{name}plan {plan:8.2f} s" + (f"  draft {draft:8.2f} s  {plan / draft:5.2f}" if arguments.render else "")
                    text += f"  {problem}" if problem else ""
                plan, draft, problem = row[0]
                bad = bad or bool(problem) or (arguments.render and plan > max(1.0, draft))
                print(f"{kind:10} {n:8} triangles  {text}", flush=True)
            if len(counts) > 1:
                span = math.log(counts[-1] / counts[-2])
                print(f"{kind:10} slope " + ", before ".join(f"{math.log(b[0] / a[0]) / span:.2f}" for a, b in zip(seen[-2], seen[-1])), flush=True)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
