"""Reads the EXR files that Meninas writes: one part, scan lines, none or ZIP compression (OpenEXR, "File Layout").

Blender's own reader gives the layers of a file to the compositor alone, not to Python.
"""

import struct
import zlib

import numpy as np

MAGIC = 20000630
LINES_OF = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP
TYPE_OF = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}


class ExrError(Exception):
    pass


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _header(data):
    magic, version = struct.unpack_from("<ii", data, 0)
    if magic != MAGIC or version & ~0x4FF:  # beyond the version number and long names: tiles, deep data, parts
        raise ExrError("not an EXR of scan lines")
    attributes, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channels(blob):
    channels, at = [], 0
    while blob[at]:
        name, at = _text(blob, at)
        (kind,) = struct.unpack_from("<i", blob, at)
        channels.append((name, TYPE_OF[kind]))
        at += 16
    return channels


def _unzipped(block, size):
    if len(block) == size:
        return block  # stored as it is where ZIP would not have made it smaller
    raw = np.frombuffer(zlib.decompress(block), np.uint8)
    # The bytes are differences, and the even ones stand before the odd ones.
    steps = raw.astype(np.int64)
    steps[1:] -= 128
    values = np.cumsum(steps).astype(np.uint8)
    woven = np.empty_like(values)
    half = (len(values) + 1) // 2
    woven[0::2], woven[1::2] = values[:half], values[half:]
    return woven.tobytes()


def read_channels(path):
    """{"R": (height, width) float32, "depth.Z": ...}, the first row on top."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = _header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    compression = attributes["compression"][0]
    if compression not in LINES_OF:
        raise ExrError(f"compression {compression} is not read")
    channels = _channels(attributes["channels"])
    lines = LINES_OF[compression]
    bytes_of_line = sum(kind.itemsize * width for _, kind in channels)
    pictures = {name: np.empty((height, width), np.float32) for name, _ in channels}
    blocks = (height + lines - 1) // lines
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        y -= y0
        count = min(lines, height - y)
        block = data[offset + 8 : offset + 8 + size]
        if compression:
            block = _unzipped(block, count * bytes_of_line)
        start = 0
        for line in range(y, y + count):
            for name, kind in channels:
                pictures[name][line] = np.frombuffer(block, kind, width, start)
                start += kind.itemsize * width
    return pictures


def read_layers(path):
    """{"": (height, width, 3), "depth": (height, width, 1), ...}, the first row at the bottom, as Blender has it."""
    order = {"R": 0, "G": 1, "B": 2, "A": 3, "X": 0, "Y": 1, "Z": 2}
    layers = {}
    for name, picture in read_channels(path).items():
        layer, _, channel = name.rpartition(".")
        layers.setdefault(layer, []).append((order.get(channel, 9), picture))
    return {
        layer: np.stack([p for _, p in sorted(parts, key=lambda part: part[0])], axis=-1)[::-1]
        for layer, parts in layers.items()
    }
