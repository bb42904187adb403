#!/usr/bin/env python3
"""What becomes of a folder of other people's models: which are drawn, which are refused, and why.

    bench/wild_models.py build/release/cli/meninas FOLDER... [--csv FILE] [--size 48x48] [--seconds 60] [--memory 4] [--also]

Every .gltf and .glb below the folders is planned and rendered (draft, under --background 1, so that nothing is dark for want
of a lamp), each run in a process of its own with a limit on processor time and address space. A model is

    renders   a picture, and no more warnings than that there is no camera
    warns     a picture, and what was left out or read in another way is named
    refused   exit code 3 or 4 and one line `meninas: FILE: WHERE: WHAT`
    long      over the time, and larger than --triangles
    BLACK     a picture without light, and no warning that says so
    HANG      over the time
    CRASH     anything else: a signal, a sanitizer's report, an error that is not one line

A table counts them by collection, the folder right below the one that is named, with the processor seconds of its models;
SLOW PLAN counts those whose plan takes a second and more, and longer than the draft. The program exits with 1 when one of the
last three is there. `--also` takes each model that is drawn through `solve --by-lamp` and `walk` as well, and `--pictures FOLDER`
keeps the pictures, to be looked at. `--table CSV...` prints the tables of runs that are over. Nothing but Python's standard library is needed.
"""
import argparse
import collections
import contextlib
import csv
import json
import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import zlib

UNIMPORTANT = ("no camera: a default view",)
DARK = ("nothing emits light", "the picture is black")
BAD = ("BLACK", "HANG", "CRASH")


def brightest(png):
    """The largest byte of an 8-bit PNG's filtered rows: 0 exactly where every pixel is 0."""
    data, at, packed = png.read_bytes(), 8, b""
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "big")
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    width = int.from_bytes(data[16:20], "big")
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[data[25]]
    if data[24] != 8 or channels not in (1, 3):
        raise ValueError("only 8-bit PNGs without alpha are looked at")
    rows = zlib.decompress(packed)
    stride = 1 + width * channels
    return max(max(rows[k + 1:k + stride]) for k in range(0, len(rows), stride))


def run(command, arguments):
    """Exit code or "time", what it says, what it prints, and its processor seconds, user and system."""

    def limit():
        os.nice(arguments.nice)
        seconds = int(arguments.seconds)
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        if arguments.memory:
            resource.setrlimit(resource.RLIMIT_AS, (arguments.memory << 30,) * 2)

    before = os.times()
    try:
        # A process that waits for ever uses no processor time.
        done = subprocess.run(command, capture_output=True, timeout=30 * arguments.seconds, preexec_fn=limit)
        code, text, output = done.returncode, done.stderr.decode("utf-8", "replace"), done.stdout
    except subprocess.TimeoutExpired:
        code, text, output = "time", "", b""
    after = os.times()
    seconds = after.children_user + after.children_system - before.children_user - before.children_system
    # The second signal comes where the first one finds the process in the kernel.
    if code == -signal.SIGXCPU or (code == -signal.SIGKILL and seconds >= arguments.seconds - 1):
        code = "time"
    return code, text, output, seconds


def reason_of(line, model):
    """A warning or error without the names in it, so that like ones are counted together."""
    line = line.replace(str(model), "FILE")
    line = re.sub(r"^meninas: (warning: )?(FILE: )?", "", line)
    line = re.sub(r"^[^:]*?\[[0-9]+\][^:]*: ", "", line)
    line = re.sub(r": '.*", "", line)
    line = re.sub(r"'[^']*'", "'...'", line)
    return re.sub(r"[0-9][0-9.,e+-]*", "N", line)[:110]


class Model:
    """What became of one file."""

    def __init__(self, path, collection):
        self.path, self.collection = path, collection
        self.verdict, self.lines, self.plan, self.draft = "", [], 0.0, 0.0

    def slow_plan(self):
        return self.draft > 0 and self.plan > max(1.0, self.draft)

    def row(self):
        return (self.path, self.collection, self.verdict, f"{self.plan:.2f}", f"{self.draft:.2f}", " | ".join(self.lines))


def triangles_of(path):
    """As the file says; 0 where it cannot be read."""
    try:
        data = path.read_bytes()
        if data[:4] == b"glTF":
            data = data[20:20 + int.from_bytes(data[12:16], "little")]
        document = json.loads(data)
        meshes = collections.Counter()
        for node in document.get("nodes", ()):
            if "mesh" in node:
                copies = node.get("extensions", {}).get("EXT_mesh_gpu_instancing", {}).get("attributes", {})
                meshes[node["mesh"]] += max((document["accessors"][k]["count"] for k in copies.values()), default=1)
        count = 0
        for mesh, uses in meshes.items():
            for primitive in document["meshes"][mesh]["primitives"]:
                if primitive.get("mode", 4) >= 4:
                    which = primitive.get("indices", primitive["attributes"].get("POSITION"))
                    count += uses * document["accessors"][which]["count"] // (3 if primitive.get("mode", 4) == 4 else 1)
        return count
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, OSError, RecursionError):
        return 0


def over_time(model, command, arguments):
    triangles = triangles_of(model.path)
    model.lines = [f"{command} takes over {arguments.seconds:g} processor seconds: {triangles} triangles"]
    return "long" if triangles > arguments.triangles else "HANG"


def judge(model, arguments, folder):
    picture = folder / "picture.png"
    picture.unlink(missing_ok=True)
    path = str(model.path)
    plan = ["plan", path, "--quality", "draft", "--background", "1", "--json"]
    render = ["render", path, "--quality", "draft", "--size", arguments.size, "--background", "1", "--quiet", "-o", str(picture)]
    commands = [plan] if arguments.plan else [plan, render + arguments.render]
    if arguments.also and not arguments.plan:
        by_lamp = [path, "--quality", "draft", "--background", "1", "--by-lamp", "--quiet", "-o"]
        commands += [["solve"] + by_lamp + [str(folder / "solution.glb")], ["walk"] + by_lamp + [str(folder / "room.html")]]
    lines, said = [], []
    for command in commands:
        code, text, output, took = run([arguments.meninas] + command, arguments)
        lines = text.splitlines()
        if command is plan:
            model.plan = took
        elif command[0] == "render":
            model.draft = took
            said = lines
        elif code in (2, 3, 4) and lines and all(line.startswith("meninas: ") for line in lines):
            continue # too large for a page, say: it is drawn all the same
        if code == "time":
            return over_time(model, command[0], arguments)
        model.lines = lines[-1:]
        one_line = lines and all(line.startswith("meninas: ") for line in lines)
        if code in (3, 4) and one_line:
            return "refused"
        if code != 0 or any("Sanitizer" in line or "runtime error:" in line for line in lines):
            model.lines = [f"{command[0]} ends with {code}"] + lines[-3:]
            return "CRASH"
    if arguments.plan:
        said = json.loads(output)["warnings"]
    lines = said
    if arguments.pictures and not arguments.plan:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
        shutil.copy(picture, arguments.pictures / (re.sub(r"[^A-Za-z0-9.-]+", "_", path)[-120:] + ".png"))
    model.lines = [line for line in lines if not any(small in line for small in UNIMPORTANT)]
    if not arguments.plan and brightest(picture) == 0 and not any(dark in line for dark in DARK for line in lines):
        model.lines.insert(0, "a black picture")
        return "BLACK"
    return "warns" if model.lines else "renders"


def table_of(path):
    return path.open("w", newline="") if path else contextlib.nullcontext()


def write_row(table, row):
    """At once, so that a run that is stopped leaves what it knows."""
    if table:
        csv.writer(table).writerow(row)
        table.flush()


def models_below(folder):
    """By collection, in order."""
    for path in sorted(path for path in folder.rglob("*") if path.suffix.lower() in (".gltf", ".glb") and path.is_file()):
        below = path.relative_to(folder).parts
        yield Model(path, below[0] if len(below) > 1 else folder.name)


def some_of(models, most):
    """Of each collection at most so many, spread evenly over its list; one of each before the second of any,
    so that a run that is stopped has seen all of them."""
    by_collection = collections.defaultdict(list)
    for model in models:
        by_collection[model.collection].append(model)
    rounds = []
    for group in by_collection.values():
        count = min(most or len(group), len(group))
        rounds += [(k, group[k * len(group) // count]) for k in range(count)]
    return [model for _, model in sorted(rounds, key=lambda pair: pair[0])]


def models_of_table(path):
    with path.open(newline="") as table:
        for row in csv.DictReader(table):
            model = Model(pathlib.Path(row["model"]), row["collection"])
            model.verdict, model.plan, model.draft = row["verdict"], float(row["plan"]), float(row["draft"])
            model.lines = row["lines"].split(" | ") if row["lines"] else []
            yield model


def print_table(models):
    names = ["files", "drawn", "refused", "long", "CRASH", "HANG", "BLACK", "SLOW PLAN", "plan s", "draft s"]
    print("\n| collection | " + " | ".join(names) + " |\n|---" + "|---:" * len(names) + "|")
    sums = collections.defaultdict(collections.Counter)
    for model in models:
        for name in (model.collection, "all"):
            count = sums[name]
            count["files"] += 1
            count["drawn" if model.verdict in ("renders", "warns") else model.verdict] += 1
            count["SLOW PLAN"] += model.slow_plan()
            count["plan s"] += model.plan
            count["draft s"] += model.draft
    for collection in sorted(sums, key=lambda name: (name == "all", name)):
        print(f"| {collection} | " + " | ".join(f"{sums[collection][name]:.0f}" for name in names) + " |")


def print_reasons(models):
    verdicts = collections.Counter(model.verdict for model in models)
    print(f"\n{len(models)} models")
    for verdict, count in verdicts.most_common():
        print(f"{verdict:8} {count:5}  {100 * count / len(models):5.1f} %")
    for verdict in verdicts:
        reasons = collections.Counter(reason for model in models if model.verdict == verdict
                                      for reason in {reason_of(line, model.path) for line in model.lines})
        if reasons:
            print(f"\n{verdict}:")
            for reason, count in reasons.most_common():
                print(f"{count:5}  {reason}")


def run_all(models, arguments):
    with tempfile.TemporaryDirectory() as folder, table_of(arguments.csv) as table:
        write_row(table, ("model", "collection", "verdict", "plan", "draft", "lines"))
        for model in models:
            model.verdict = judge(model, arguments, pathlib.Path(folder))
            write_row(table, model.row())
            if model.verdict in BAD or model.slow_plan():
                print(f"{model.verdict:8} {model.plan:5.1f} s {model.draft:5.1f} s  {model.path}: {' | '.join(model.lines)}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meninas")
    parser.add_argument("folders", nargs="+", type=pathlib.Path, help="of collections; with --table the CSVs of earlier runs")
    parser.add_argument("--csv", type=pathlib.Path, help="a row for each model")
    parser.add_argument("--size", default="48x48")
    parser.add_argument("--seconds", type=float, default=60.0, help="processor seconds of each run")
    parser.add_argument("--triangles", type=int, default=200000, help="larger models may take longer")
    parser.add_argument("--memory", type=int, default=4, help="GiB of address space of each run, 0: no limit (sanitizers)")
    parser.add_argument("--most", type=int, default=0, help="models of one collection, 0: all")
    parser.add_argument("--nice", type=int, default=10)
    parser.add_argument("--plan", action="store_true", help="only plan, which is faster")
    parser.add_argument("--render", type=shlex.split, default=[], metavar="OPTIONS", help="more options for render, such as '--rays 16'")
    parser.add_argument("--also", action="store_true", help="solve --by-lamp and walk too")
    parser.add_argument("--pictures", type=pathlib.Path, help="folder that keeps the pictures")
    parser.add_argument("--table", action="store_true", help="run nothing, print the tables of earlier runs")
    arguments = parser.parse_args()

    if arguments.table:
        models = [model for path in arguments.folders for model in models_of_table(path)]
    else:
        models = some_of((model for folder in arguments.folders for model in models_below(folder)), arguments.most)
        run_all(models, arguments)
    print_table(models)
    print_reasons(models)
    return 1 if any(model.verdict in BAD for model in models) else 0


if __name__ == "__main__":
    sys.exit(main())
