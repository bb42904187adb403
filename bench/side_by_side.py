#!/usr/bin/env python3
"""Other people's models beside the project's own path tracer.

    bench/side_by_side.py build/release/cli/meninas FILE... [-o FOLDER] [--size 192x144] [--quality normal] [--seconds 20]

Every file is rendered twice at one exposure: by the two passes, and by `--mode reference`, which shares the reader, the
materials and the rays, and none of the light transport. Files without a light of their own stand under a clear sky with its sun. A line of the table is

    file | patches | processor seconds of the two passes, and of the path tracer | mean | blocks

mean: what the two passes show over what the path tracer shows, both clipped at white. blocks: the mean absolute difference of blocks of
8 x 8 pixels over the mean, in which the path tracer's noise is an eighth of that of a pixel. The folder keeps NAME.png, NAME.reference.png and NAME.both.png, the first
beside the second: look at them, since a fault of the reader is in both. Python's standard library and oiiotool are needed.
"""
import argparse
import json
import pathlib
import re
import resource
import struct
import subprocess
import zlib

BLOCK = 8
SUN = "150,40"  # degrees: from north, and above the horizon


def read_png(path):
    """Rows of bytes of an 8-bit RGB PNG: width, height, rows."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "big")
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    width, height = struct.unpack(">II", data[16:24])
    if data[24] != 8 or data[25] != 2:
        raise ValueError(f"{path}: only 8-bit RGB is read")
    raw, stride, rows = zlib.decompress(packed), 3 * width, []
    above = bytearray(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for k in range(stride):
            left = row[k - 3] if k >= 3 else 0
            corner = above[k - 3] if k >= 3 else 0
            if kind == 1:
                row[k] = (row[k] + left) & 255
            elif kind == 2:
                row[k] = (row[k] + above[k]) & 255
            elif kind == 3:
                row[k] = (row[k] + (left + above[k]) // 2) & 255
            elif kind == 4:
                near = min((abs(above[k] - corner), 0, left), (abs(left - corner), 1, above[k]),
                           (abs(left + above[k] - 2 * corner), 2, corner))
                row[k] = (row[k] + near[2]) & 255
        rows.append(bytes(row))
        above = row
    return width, height, rows


def write_png(path, width, rows):
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows))) + chunk(b"IEND", b""))


def decode(code):
    value = code / 255.0
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


LINEAR = [decode(code) for code in range(256)]


def blocks(width, height, rows):
    """Mean linear value of every channel of every whole block."""
    means = []
    for y in range(0, height - BLOCK + 1, BLOCK):
        for x in range(0, width - BLOCK + 1, BLOCK):
            for c in range(3):
                means.append(sum(LINEAR[rows[y + j][3 * (x + i) + c]] for j in range(BLOCK) for i in range(BLOCK)) / BLOCK ** 2)
    return means


def shown(picture, exposure, png):
    """The EXR's means at this exposure, clipped at white: both sides by one display."""
    scale = 2.0 ** exposure
    subprocess.run(["oiiotool", str(picture), "--ch", "R,G,B", "--mulc", f"{scale}", "--clamp:min=0:max=1",
                    "--colorconvert", "linear", "sRGB", "-d", "uint8", "-o", str(png)], check=True, capture_output=True)
    picture.unlink()


def call(*arguments, limit=900):
    """What a run says, and its processor seconds; None where it does not end."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run([*map(str, arguments)], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        done = None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def name_of(file):
    return f"{file.parent.name}-{file.stem}" if file.stem.lower() in ("scene", "model", "room") else file.stem


def line_of(program, file, given):
    plan, _ = call(program, "plan", file, "--json")
    if plan is None or plan.returncode != 0:
        return f"| | | | | {plan.stderr.strip().splitlines()[-1] if plan else 'no plan'} |"
    patches = json.loads(plan.stdout).get("patches", "")
    common = [file, "--size", given.size, "--view-transform", "srgb"]
    dark = "nothing emits light" in plan.stdout
    common += ["--sky", "clear", "--sun", SUN] if dark else []
    ours, traced = given.folder / f"{name_of(file)}.png", given.folder / f"{name_of(file)}.reference.png"
    done, seconds = call(program, "render", *common, "--quality", given.quality, "-o", ours, "-o", ours.with_suffix(".exr"))
    if done is None or done.returncode != 0:
        return f"| {patches} | {seconds:.1f} | | | {'longer than 900 s' if done is None else done.stderr.strip().splitlines()[-1]} |"
    exposure = re.search(r"exposure ([+-][\d.]+) EV", done.stdout + done.stderr).group(1)
    done, reference_seconds = call(program, "render", *common, "--mode", "reference", "--max-seconds", given.seconds,
                                   "--max-error", "1e-9", "-o", traced.with_suffix(".exr"))
    if done is None or done.returncode != 0:
        return f"| {patches} | {seconds:.1f} | | | the path tracer: {'no end' if done is None else done.stderr.strip().splitlines()[-1]} |"
    for png in (ours, traced):
        shown(png.with_suffix(".exr"), float(exposure), png)
    width, height, left = read_png(ours)
    _, _, right = read_png(traced)
    write_png(given.folder / f"{name_of(file)}.both.png", 2 * width, [a + b for a, b in zip(left, right)])
    a, b = blocks(width, height, left), blocks(width, height, right)
    mean = sum(b) or 1e-9
    off = sum(abs(x - y) for x, y in zip(a, b)) / mean
    return f"| {patches} | {seconds:.1f} | {reference_seconds:.0f} | {sum(a) / mean:.3f} | {off:.3f} |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("-o", dest="folder", type=pathlib.Path, default=pathlib.Path("side_by_side"))
    parser.add_argument("--size", default="192x144")
    parser.add_argument("--quality", default="normal", help="of the two passes")
    parser.add_argument("--seconds", type=float, default=20.0)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    print("| file | patches | two passes, s | path tracer, s | mean | blocks |\n|---|---|---|---|---|---|", flush=True)
    for file in given.files:
        print(f"| {name_of(file)} {line_of(given.program, file, given)}", flush=True)


if __name__ == "__main__":
    main()
