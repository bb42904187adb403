#!/usr/bin/env python3
"""What becomes of a folder of other people's models: which render, which warn, which are refused, and why.

    bench/wild_models.py build/release/cli/meninas FOLDER... [--csv FILE] [--size 48x48] [--seconds 60] [--memory 4]

Every .gltf and .glb below the folders is planned and rendered (draft, under --background 1, so that nothing is dark for want
of a lamp), each run in a process of its own with a limit on time and address space. A model is

    renders   a picture, and no more warnings than that there is no camera
    warns     a picture, and what was left out or read in another way is named
    refused   exit code 3 or 4 and one line `meninas: FILE: WHERE: WHAT`
    BLACK     a picture without light, and no warning that says so
    HANG      over the time
    CRASH     anything else: a signal, a sanitizer's report, an error that is not one line

The program exits with 1 when one of the last three is there. Nothing but Python's standard library is needed.
"""
import argparse
import collections
import contextlib
import csv
import json
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import tempfile
import time
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
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (arguments.memory << 30,) * 2)

    start = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, timeout=arguments.seconds, preexec_fn=limit if arguments.memory else None)
        code, text, output = done.returncode, done.stderr.decode("utf-8", "replace"), done.stdout
    except subprocess.TimeoutExpired:
        code, text, output = "time", "", b""
    return code, text, output, time.monotonic() - start


def reason_of(line, model):
    """A warning or error without the names in it, so that like ones are counted together."""
    line = line.replace(str(model), "FILE")
    line = re.sub(r"^meninas: (warning: )?(FILE: )?", "", line)
    line = re.sub(r"^[^:]*?\[[0-9]+\][^:]*: ", "", line)
    line = re.sub(r": '.*", "", line)
    line = re.sub(r"'[^']*'", "'...'", line)
    return re.sub(r"[0-9][0-9.,e+-]*", "N", line)[:110]


def judge(model, arguments, folder):
    picture = folder / "picture.png"
    picture.unlink(missing_ok=True)
    lines, seconds = [], 0.0
    plan = ["plan", str(model), "--json"]
    render = ["render", str(model), "--quality", "draft", "--size", arguments.size, "--background", "1", "--quiet", "-o", str(picture)]
    for command in [plan] if arguments.plan else [plan, render + arguments.render]:
        code, text, output, took = run([arguments.meninas] + command, arguments)
        lines, seconds = text.splitlines(), seconds + took
        if code == "time":
            return "HANG", [f"{command[0]} takes over N s"], seconds
        one_line = len(lines) >= 1 and lines[-1].startswith("meninas: ") and \
            all(line.startswith("meninas: ") for line in lines)
        if code in (3, 4) and one_line:
            return "refused", lines[-1:], seconds
        if code != 0 or any("Sanitizer" in line or "runtime error:" in line for line in lines):
            return "CRASH", [f"{command[0]} ends with {code}"] + lines[-3:], seconds
    if arguments.plan:
        lines = json.loads(output)["warnings"]
    warnings = [line for line in lines if not any(small in line for small in UNIMPORTANT)]
    if not arguments.plan and brightest(picture) == 0 and not any(dark in line for dark in DARK for line in lines):
        return "BLACK", ["a black picture"] + warnings, seconds
    return ("warns" if warnings else "renders"), warnings, seconds


def table_of(path):
    return path.open("w", newline="") if path else contextlib.nullcontext()


def write_row(table, row):
    """At once, so that a run that is stopped leaves what it knows."""
    if table:
        csv.writer(table).writerow(row)
        table.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meninas")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--csv", type=pathlib.Path, help="a row for each model")
    parser.add_argument("--size", default="48x48")
    parser.add_argument("--seconds", type=float, default=60.0, help="of each run")
    parser.add_argument("--memory", type=int, default=4, help="GiB of address space of each run, 0: no limit (sanitizers)")
    parser.add_argument("--plan", action="store_true", help="only plan, which is faster")
    parser.add_argument("--render", type=shlex.split, default=[], metavar="OPTIONS", help="more options for render, such as '--rays 16'")
    arguments = parser.parse_args()

    models = sorted(path for folder in arguments.folders for path in folder.rglob("*")
                    if path.suffix.lower() in (".gltf", ".glb") and path.is_file())
    rows = []
    with tempfile.TemporaryDirectory() as folder, table_of(arguments.csv) as table:
        write_row(table, ("model", "verdict", "seconds", "lines"))
        for model in models:
            verdict, lines, seconds = judge(model, arguments, pathlib.Path(folder))
            rows.append((model, verdict, seconds, lines))
            write_row(table, (model, verdict, f"{seconds:.2f}", " | ".join(lines)))
            if verdict in BAD:
                print(f"{verdict:8} {seconds:5.1f} s  {model}: {' | '.join(lines)}", flush=True)

    verdicts = collections.Counter(verdict for _, verdict, _, _ in rows)
    print(f"\n{len(rows)} models")
    for verdict, count in verdicts.most_common():
        print(f"{verdict:8} {count:5}  {100 * count / len(rows):5.1f} %")
    for verdict in verdicts:
        reasons = collections.Counter(reason for model, v, _, lines in rows if v == verdict
                                      for reason in {reason_of(line, model) for line in lines})
        if reasons:
            print(f"\n{verdict}:")
            for reason, count in reasons.most_common():
                print(f"{count:5}  {reason}")
    return 1 if any(verdicts[verdict] for verdict in BAD) else 0


if __name__ == "__main__":
    sys.exit(main())
