#!/usr/bin/env python3
"""Shows that two builds make the same bits.

    bench/same_bits.py OLD NEW [--scenes DIR] [--only NAME] [--size WxH]

Both programs render every scene of the gallery in every mode and with every diffuse term, solve it
by each of the solvers below, and print form factors between its first two nodes. The files must be
equal byte for byte; figures in `--stats` are compared but for times, memory and threads. Ends with 1 when anything differs.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

MACHINE = {"seconds", "peak_memory_bytes", "threads", "versions", "program"}
RUNS = [
    ("radiosity", ["render", "--mode", "radiosity"], "exr"),
    ("hybrid", ["render", "--mode", "hybrid"], "exr"),
    ("direct", ["render", "--diffuse", "direct", "--layers"], "exr"),
    ("gather", ["render", "--diffuse", "gather"], "exr"),
    ("uniform", ["render", "--mesh", "uniform"], "exr"),
    ("hemicube", ["render", "--form-factors", "hemicube"], "exr"),
    ("progressive", ["solve", "--solver", "progressive"], "glb"),
    ("gauss-seidel", ["solve", "--solver", "gauss-seidel"], "glb"),
    ("reference", ["render", "--mode", "reference", "--samples", "4"], "exr"),
]


def without_times(value):
    if isinstance(value, dict):
        return {k: without_times(v) for k, v in value.items() if k not in MACHINE}
    return [without_times(v) for v in value] if isinstance(value, list) else value


def figures(file):
    return without_times(json.loads(file.read_text())) if file.exists() else None


def form_factors(program, scene, nodes):
    run = subprocess.run([program, "formfactors", scene, "--from", nodes[0], "--to", nodes[1],
                          "--method", "rays", "--json"], capture_output=True, timeout=600)
    return without_times(json.loads(run.stdout)) if run.returncode == 0 else run.stderr


def nodes_of(program, scene, folder):
    nodes = folder / "nodes.json"
    nodes.unlink(missing_ok=True)
    run = subprocess.run([program, "solve", scene, "--quality", "draft", "--element-size", "10",
                          "-o", folder / "nodes.glb", "--per-node", nodes, "--quiet"],
                         capture_output=True, timeout=600)
    if run.returncode != 0:
        return []
    return [node["name"] for node in json.loads(nodes.read_text())["nodes"] if node["area"] > 0][:2]


def outcome(program, scene, arguments, kind, size, folder):
    picture, stats = folder / f"out.{kind}", folder / "stats.json"
    for file in (picture, stats):
        file.unlink(missing_ok=True)
    sized = ["--size", size] if arguments[0] == "render" else []
    run = subprocess.run([program, arguments[0], scene, "--quality", "draft", *arguments[1:], *sized,
                          "-o", picture, "--stats", stats, "--quiet"],
                         capture_output=True, text=True, timeout=1800)
    return run.returncode, run.stderr, picture.read_bytes() if picture.exists() else b"", figures(stats)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--scenes", default="scenes/gallery")
    parser.add_argument("--only", default="")
    parser.add_argument("--size", default="64x64")
    given = parser.parse_args()
    programs = [str(pathlib.Path(p).resolve()) for p in (given.old, given.new)]
    different = compared = 0
    for scene in sorted(pathlib.Path(given.scenes).resolve().glob("*.gl*")):
        if given.only not in scene.name:
            continue
        with tempfile.TemporaryDirectory() as name:
            for label, arguments, kind in RUNS:
                old, new = (outcome(p, scene, arguments, kind, given.size, pathlib.Path(name))
                            for p in programs)
                compared += 1
                parts = [what for what, a, b in
                         zip(("exit code", "messages", "file", "figures"), old, new) if a != b]
                if parts:
                    different += 1
                    print(f"{scene.name}: {label}: {', '.join(parts)} differ", flush=True)
            nodes = nodes_of(programs[0], scene, pathlib.Path(name))
        if len(nodes) == 2:
            answers = [form_factors(p, scene, nodes) for p in programs]
            compared += 1
            if answers[0] != answers[1]:
                different += 1
                print(f"{scene.name}: formfactors differ", flush=True)
    print(f"{compared} compared, {different} different")
    return 1 if different or not compared else 0


if __name__ == "__main__":
    sys.exit(main())
