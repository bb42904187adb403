#!/usr/bin/env python3
"""What lamps apart cost: processor seconds of `solve --by-lamp` over those of `solve`, by the number of lamps k.

    bench/lamps.py build/release/cli/meninas [--lamps 1,4,16,64] [--quality draft]

A room of 8 x 6 x 3 m with a mirror on a wall, three boxes and k square lamps under its ceiling. A row gives k, the
processor seconds (user and system) of a solve, of the same by lamp, their quotient beside the limit 1 + 0.15 k, those of
a render of the solution as it is and with half of the lamps off (relit), their quotient, and the bytes that a vertex
and lamp take in the file. Each is the least of three. Ends with 1 where a limit is passed; 5 % of a render is noise.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from growth import File  # noqa: E402


def quad(file, name, corners, material):
    file.node(name=name, mesh=file.mesh(corners, [(0, 1, 2), (0, 2, 3)], material))


def box(file, name, low, high, material, inward=False):
    (a, b, c), (d, e, f) = low, high
    faces = [[(a, b, c), (a, b, f), (a, e, f), (a, e, c)], [(d, b, c), (d, e, c), (d, e, f), (d, b, f)],
             [(a, b, c), (d, b, c), (d, b, f), (a, b, f)], [(a, e, c), (a, e, f), (d, e, f), (d, e, c)],
             [(a, b, c), (a, e, c), (d, e, c), (d, b, c)], [(a, b, f), (d, b, f), (d, e, f), (a, e, f)]]
    for k, corners in enumerate(faces):
        quad(file, f"{name} {k}", corners[::-1] if inward else corners, material)


def room(path, lamps):
    file = File()
    grey, mirror = file.material((0.6, 0.6, 0.6)), file.material((0.9, 0.9, 0.9), metal=1.0, roughness=0.0)
    box(file, "room", (0, 0, 0), (8, 3, 6), grey, inward=True)
    for k in range(3):
        box(file, f"box {k}", (1.5 + 2 * k, 0, 2), (2.3 + 2 * k, 0.8, 3), grey)
    quad(file, "mirror", [(1, 0.5, 0.01), (7, 0.5, 0.01), (7, 2.5, 0.01), (1, 2.5, 0.01)], mirror)
    across = 1
    while across * across < lamps:
        across += 1
    for k in range(lamps):
        x, z = 8 * (k % across + 0.5) / across, 6 * (k // across + 0.5) / across
        glow = file.material((0, 0, 0), emissiveFactor=[1, 0.8 - 0.6 * (k % 3) / 2, 0.4])
        quad(file, f"lamp {k}", [(x - .1, 2.99, z - .1), (x + .1, 2.99, z - .1), (x + .1, 2.99, z + .1),
                                 (x - .1, 2.99, z + .1)], glow)
    file.write(path)


def seconds(command):
    best = float("inf")
    for _ in range(3):
        before = os.times()
        run = subprocess.run(command, capture_output=True, text=True)
        after = os.times()
        if run.returncode != 0:
            sys.exit(run.stderr)
        best = min(best, after.children_user - before.children_user + after.children_system - before.children_system)
    return best


def vertices_and_bytes(path):
    data = path.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    extras = json.loads(data[20:20 + length])["asset"]["extras"]["meninas"]
    views = json.loads(data[20:20 + length])["bufferViews"]
    return extras["vertices"], sum(views[lamp["view"]]["byteLength"] for lamp in extras["lamps"]["list"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--lamps", default="1,4,16,64")
    parser.add_argument("--quality", default="draft")
    options = parser.parse_args()
    failed = False
    print(f"{'k':>3} {'solve':>7} {'by lamp':>8} {'ratio':>6} {'limit':>6} {'render':>7} {'relit':>7} {'ratio':>6} {'bytes':>6}")
    with tempfile.TemporaryDirectory() as folder:
        for k in map(int, options.lamps.split(",")):
            scene, solution = pathlib.Path(folder, "room.glb"), pathlib.Path(folder, "solved.glb")
            room(scene, k)
            solve = [options.program, "solve", scene, "-o", solution, "--quality", options.quality, "--quiet"]
            render = [options.program, "render", scene, "-o", pathlib.Path(folder, "a.png"), "--solution", solution,
                      "--size", "480x320", "--quality", "normal", "--quiet"]
            whole, apart = seconds(solve), seconds(solve + ["--by-lamp"])
            off = [word for lamp in range(0, max(k // 2, 1)) for word in ("--lamp", f"lamp {lamp}=0.5")]
            plain, relit = seconds(render), seconds(render + off)
            vertices, size = vertices_and_bytes(solution)
            limit = 1 + 0.15 * k
            failed |= apart > limit * whole or relit > 1.05 * plain
            print(f"{k:3} {whole:7.2f} {apart:8.2f} {apart / whole:6.2f} {limit:6.2f} {plain:7.2f} {relit:7.2f} "
                  f"{relit / plain:6.2f} {size / vertices / k:6.1f}", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
