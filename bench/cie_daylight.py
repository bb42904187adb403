#!/usr/bin/env python3
"""Daylight through openings beside its closed form, by the program: cases 5.9 and 5.11 after CIE 171:2006.

    bench/cie_daylight.py build/release/cli/meninas [draft|normal|fine ...]

Makes black rooms of 4 x 4 x 3 m with an opening, runs `solve --sky overcast|clear --by-lamp --points` on each, and prints the largest
difference of the column `sky` from E = integral of L cos cos' / d^2 over the opening, in percent, as docs/known_answers.md has it.
"""
import csv
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
from base64 import b64encode

UP, DOWN, EAST = (0, 1, 0), (0, -1, 0), (1, 0, 0)
SUN = (math.cos(math.pi / 3), math.sin(math.pi / 3), 0.0)  # 60 degrees up in the east
dot = lambda a, b: sum(x * y for x, y in zip(a, b))
along = lambda p, s, u, t, v: tuple(p[k] + s * u[k] + t * v[k] for k in range(3))


def overcast(d):
    return (1 + 2 * d[1]) / 3


def clear(d):
    s = math.acos(min(1.0, dot(d, SUN)))
    return (0.91 + 10 * math.exp(-3 * s) + 0.45 * math.cos(s) ** 2) * (1 - math.exp(-0.32 / max(d[1], 1e-6)))


def outside(luminance, n=600):
    total = 0.0
    for i in range(n):
        up2 = (i + 0.5) / n
        side = math.sqrt(1 - up2)
        for j in range(n):
            a = 2 * math.pi * (j + 0.5) / n
            total += luminance((side * math.cos(a), math.sqrt(up2), side * math.sin(a)))
    return math.pi * total / n**2


def through(opening, point, normal, luminance, n=400):
    """By the middles of n x n parts, whose error falls with n squared."""
    corner, u, v = opening
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    total = 0.0
    for i in range(n):
        for j in range(n):
            d = tuple(x - p for x, p in zip(along(corner, (i + 0.5) / n, u, (j + 0.5) / n, v), point))
            r2 = dot(d, d)
            r = math.sqrt(r2)
            cosine = dot(d, normal) / r
            if cosine > 0:
                total += luminance(tuple(x / r for x in d)) * cosine * abs(dot(d, cross)) / (r2 * r)
    return total / n**2


# The walls of the room, each a corner and two edges whose cross product points inwards.
WALLS = {"x0": ((0, 0, 0), (0, 3, 0), (0, 0, 4)), "x1": ((4, 0, 0), (0, 0, 4), (0, 3, 0)),
         "y0": ((0, 0, 0), (0, 0, 4), (4, 0, 0)), "y1": ((0, 3, 0), (4, 0, 0), (0, 0, 4)),
         "z0": ((0, 0, 0), (4, 0, 0), (0, 3, 0)), "z1": ((0, 0, 4), (0, 3, 0), (4, 0, 0))}


def write_room(file, open_wall, hole):
    """`hole`: shares a0, a1, b0, b1 of the open wall's edges; None for all of it."""
    quads = [[along(p, s, u, t, v) for s, t in ((0, 0), (1, 0), (1, 1), (0, 1))]
             for name, (p, u, v) in WALLS.items() if name != open_wall]
    if hole:
        p, u, v = WALLS[open_wall]
        a0, a1, b0, b1 = hole
        outer = [along(p, s, u, t, v) for s, t in ((0, 0), (1, 0), (1, 1), (0, 1))]
        inner = [along(p, s, u, t, v) for s, t in ((a0, b0), (a1, b0), (a1, b1), (a0, b1))]
        quads += [[outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]] for k in range(4)]
    data = b"".join(struct.pack("<3f", *q[k]) for q in quads for k in (0, 1, 2, 0, 2, 3))
    points = [x for q in quads for x in q]
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "room"}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6 * len(quads), "type": "VEC3",
                       "min": [min(p[k] for p in points) for k in range(3)], "max": [max(p[k] for p in points) for k in range(3)]}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + b64encode(data).decode()}]}))


FLOOR_AND_WALL = [((0.25, 0, 2), UP), ((1.25, 0, 2), UP), ((2, 0, 2), UP), ((3.5, 0, 0.5), UP),
                  ((0, 0.5, 2), EAST), ((0, 1.5, 2), EAST), ((0, 2.5, 2), EAST)]
FACADE = [((3.5, 0, 2), UP), ((2, 0, 2), UP), ((0.5, 0, 2), UP), ((2, 3, 2), DOWN),
          ((0, 0.5, 2), EAST), ((0, 1.5, 2), EAST), ((0, 2.5, 2), EAST)]
CASES = [("5.9, an opening of 1 x 1 m in the roof", "y1", (0.375, 0.625, 0.375, 0.625), ((1.5, 3, 1.5), (1, 0, 0), (0, 0, 1)), FLOOR_AND_WALL),
         ("the whole roof", "y1", None, ((0, 3, 0), (4, 0, 0), (0, 0, 4)), FLOOR_AND_WALL[:3] + FLOOR_AND_WALL[5:6]),
         ("5.11, an opening of 2 x 1 m in a wall", "x1", (0.25, 0.75, 1 / 3, 2 / 3), ((4, 1, 1), (0, 0, 2), (0, 1, 0)), FACADE)]


def main(program, qualities):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for kind, above in (("overcast", overcast), ("clear", clear)):
            everything = outside(above)
            # Of the clear sky the ground shows the sun's light as well, a fifth of it: the program says how much.
            for what, wall, hole, opening, points in CASES:
                write_room(folder / "room.gltf", wall, hole)
                (folder / "points.csv").write_text("x,y,z,nx,ny,nz\n" + "".join(
                    ",".join(map(str, p + n)) + "\n" for p, n in points + [((0, -1, 0), DOWN), ((0, 10, 0), UP)]))
                for quality in qualities:
                    sky = ["--sky", kind, "--sky-illuminance", "683"] + (["--sun", "90,60"] if kind == "clear" else [])
                    subprocess.run([program, "solve", folder / "room.gltf", "-o", folder / "s.glb", "--quality", quality, "--by-lamp",
                                    "--points", folder / "points.csv", "--points-out", folder / "out.csv", "--quiet", *sky], check=True)
                    rows = list(csv.DictReader(open(folder / "out.csv")))
                    column = next(c for c in rows[0] if "sky" in c and "lx" in c)
                    ground = float(rows[-2][column]) / 683 / math.pi
                    light = lambda d: above(d) / everything if d[1] > 0 else ground
                    worst = max(abs(float(row[column]) / 683 / through(opening, p, n, light) - 1) for row, (p, n) in zip(rows, points))
                    print(f"{kind:9} {what:42} {quality:7} {100 * worst:.4f} %", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:] or ["normal"])
