#!/usr/bin/env python3
"""A short film of `meninas view`: from the dark by shots to the solution, as an animated PNG; or one picture of its page.

  bench/view_film.py build/release/cli/meninas scenes/gallery/meninas.gltf docs/view-film.png
  bench/view_film.py build/release/cli/meninas scenes/gallery/cornell-mirror.gltf docs/view-factors.png --factors 690,250

A headless Chromium shows the page and is told what to do by the DevTools protocol over two pipes (messages are JSON, each ended by a
zero byte). Its pictures get one palette of 256 colours (median cut), and of each frame only what differs from the one before is kept.
Nothing but Python's standard library is needed.
"""
import argparse
import base64
import fcntl
import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib


class Browser:
    """A headless Chromium whose pages draw WebGL 2 by software."""

    def __init__(self, size, program="chromium"):
        commands, answers = os.pipe(), os.pipe()
        self.folder = tempfile.mkdtemp()

        def hand_over():
            for end, place in ((fcntl.fcntl(commands[0], fcntl.F_DUPFD, 10), 3), (fcntl.fcntl(answers[1], fcntl.F_DUPFD, 10), 4)):
                os.dup2(end, place)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--hide-scrollbars", f"--window-size={size}", "--no-first-run", "--remote-debugging-pipe", f"--user-data-dir={self.folder}", "about:blank"],
            preexec_fn=hand_over, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(commands[0])
        os.close(answers[1])
        self.to, self.source, self.calls, self.received, self.blank = commands[1], answers[0], 0, b"", None

    def call(self, method, parameters=None, page=None):
        self.calls += 1
        message = {"id": self.calls, "method": method, "params": parameters or {}}
        if page:
            message["sessionId"] = page
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.received:
                part = os.read(self.source, 1 << 20)
                if not part:
                    raise RuntimeError("the browser has ended")
                self.received += part
            text, self.received = self.received.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("id") == self.calls:
                if "error" in answer:
                    raise RuntimeError(answer["error"]["message"])
                return answer["result"]

    def open(self, address):
        target = self.call("Target.createTarget", {"url": address})["targetId"]
        page = self.call("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        while True:
            there = self.call("Runtime.evaluate", {"expression": "location.href !== 'about:blank' && document.readyState === 'complete'", "returnByValue": True}, page)
            if there["result"].get("value"):
                return page
            time.sleep(0.05)

    def run(self, page, script):
        """What the body of an async function returns there; it may use until(), press() and status()."""
        answer = self.call("Runtime.evaluate", {"expression": "(async () => {" + HELPERS + script + "})()", "awaitPromise": True, "returnByValue": True}, page)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["exception"].get("description", str(answer)))
        return answer["result"].get("value")

    def picture(self, page):
        return base64.b64decode(self.call("Page.captureScreenshot", {"format": "png"}, page)["data"])

    def pixels(self, picture, width):
        """(width, height, RGB bytes) of a PNG, as the browser scales it, on a page that may fetch it."""
        if self.blank is None:
            target = self.call("Target.createTarget", {"url": "about:blank"})["targetId"]
            self.blank = self.call("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        told = self.run(self.blank, f"""
            const image = await createImageBitmap(await (await fetch('data:image/png;base64,{base64.b64encode(picture).decode()}')).blob());
            const width = {width}, height = Math.round(width * image.height / image.width), canvas = new OffscreenCanvas(width, height), to = canvas.getContext('2d');
            to.imageSmoothingQuality = 'high';
            to.drawImage(image, 0, 0, width, height);
            const bytes = to.getImageData(0, 0, width, height).data;
            let text = '';
            for (let k = 0; k < bytes.length; k += 4) text += String.fromCharCode(bytes[k], bytes[k + 1], bytes[k + 2]);
            return [width, height, btoa(text)];""")
        return told[0], told[1], base64.b64decode(told[2])

    def end(self):
        self.call("Browser.close")
        self.process.wait(20)
        os.close(self.to)
        os.close(self.source)
        shutil.rmtree(self.folder, ignore_errors=True)


HELPERS = """
const until = async (holds, patience = 60000) => { const end = performance.now() + patience; while (!holds() && performance.now() < end) await new Promise(r => setTimeout(r, 20)); return Boolean(holds()); };
const press = (key, more = {}) => dispatchEvent(new KeyboardEvent('keydown', { key, ...more }));
const data = document.body.dataset, status = () => JSON.parse(data.status || '{}');
const drawn = () => new Promise(r => setTimeout(r, 600));
"""


def palette_of(frames, colours):
    """By median cut (Heckbert 1982) of a sample of all pixels, in 5 bits a channel."""
    counts = {}
    for _, _, rgb in frames:
        for k in range(0, len(rgb) - 2, 21):
            key = (rgb[k] >> 3, rgb[k + 1] >> 3, rgb[k + 2] >> 3)
            counts[key] = counts.get(key, 0) + 1
    boxes = [list(counts)]

    def spread(box):
        return max((max(c[k] for c in box) - min(c[k] for c in box), k) for k in range(3))

    while len(boxes) < colours:
        candidates = [(spread(box)[0] * sum(counts[c] for c in box) ** 0.5, number) for number, box in enumerate(boxes) if len(box) > 1]
        if not candidates:
            break
        box = boxes.pop(max(candidates)[1])
        axis = spread(box)[1]
        box.sort(key=lambda c: c[axis])
        half, seen = sum(counts[c] for c in box) / 2, 0
        for cut, colour in enumerate(box[:-1]):
            seen += counts[colour]
            if seen >= half:
                break
        boxes += [box[:cut + 1], box[cut + 1:]]
    return [tuple(round(sum(counts[c] * (8 * c[k] + 4) for c in box) / sum(counts[c] for c in box)) for k in range(3)) for box in boxes]


def in_palette(rgb, palette, known):
    indices = bytearray(len(rgb) // 3)
    for k in range(len(indices)):
        key = (rgb[3 * k] >> 2, rgb[3 * k + 1] >> 2, rgb[3 * k + 2] >> 2)
        number = known.get(key)
        if number is None:
            r, g, b = (4 * c + 2 for c in key)
            number = known[key] = min(range(len(palette)), key=lambda p: (palette[p][0] - r) ** 2 + (palette[p][1] - g) ** 2 + (palette[p][2] - b) ** 2)
        indices[k] = number
    return indices


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_animation(file, frames, milliseconds):
    """APNG (PNG, third edition, 11.3.6): the last entry of the palette is clear, and leaves what the frame before has."""
    palette = palette_of(frames, 255)
    clear, known = len(palette), {}
    width, height, _ = frames[0]
    out = [b"\x89PNG\r\n\x1a\n", chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)),
           chunk(b"acTL", struct.pack(">II", len(frames), 0)), chunk(b"PLTE", b"".join(bytes(c) for c in palette) + bytes(3)),
           chunk(b"tRNS", b"\xff" * clear + b"\0")]
    before, number = None, 0
    for (_, _, rgb), wait in zip(frames, milliseconds):
        indices = in_palette(rgb, palette, known)
        shown = bytearray(indices)
        if before:
            for k in range(len(shown)):
                if before[k] == indices[k]:
                    shown[k] = clear
        rows = b"".join(b"\0" + shown[width * y:width * (y + 1)] for y in range(height))
        data = zlib.compress(rows, 9)
        out.append(chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, width, height, 0, 0, wait, 1000, 0, 1 if before else 0)))
        number += 1
        if before:
            out.append(chunk(b"fdAT", struct.pack(">I", number) + data))
            number += 1
        else:
            out.append(chunk(b"IDAT", data))
        before = indices
    out.append(chunk(b"IEND", b""))
    pathlib.Path(file).write_bytes(b"".join(out))


def take_film(browser, page, width):
    """Frames with the milliseconds that each is shown."""
    film = []

    def keep(milliseconds):
        film.append((browser.pixels(browser.picture(page), width), milliseconds))

    browser.run(page, "await until(() => data.state === '1' && status().stage === 'dark'); await drawn();")
    keep(1200)
    shots = 0
    for wanted in (0, 1, 2, 4, 8, 16, 32, 64, 128):
        steps = wanted - shots if wanted else 1
        shots = wanted
        browser.run(page, f"for (let k = 0; k < {steps}; ++k) press('n'); await until(() => status().shots >= {wanted} && status().state === Number(data.state) && status().stage === 'shots'); await drawn();")
        keep(700)
    browser.run(page, "press('p'); await until(() => status().solved && status().state === Number(data.state), 600000); await drawn();")
    keep(1000)
    browser.run(page, "await until(() => data.resting === 'whole', 600000); await drawn();")
    keep(2500)
    return film


def show_factors(browser, page, place):
    """The page when the room is solved, with the form factors of what is at a place of it, as PNG."""
    x, y = place.split(",")
    browser.run(page, f"""await until(() => data.state === '1' && status().stage === 'dark'); press('p');
        await until(() => status().solved && status().state === Number(data.state), 600000);
        document.getElementById('view').dispatchEvent(new PointerEvent('pointermove', {{ clientX: {x}, clientY: {y}, pointerId: 1 }}));
        press('g'); await until(() => data.factors); await new Promise(r => setTimeout(r, 4000));""")
    return browser.picture(page)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("scene", type=pathlib.Path)
    options.add_argument("picture", type=pathlib.Path)
    options.add_argument("--window", default="960,640", help="pixels of the browser's window")
    options.add_argument("--width", type=int, default=480, help="pixels of the film")
    options.add_argument("--factors", metavar="X,Y", help="in place of a film, the form factors of what is seen there in the window")
    chosen = options.parse_args()
    view = subprocess.Popen([chosen.program, "view", chosen.scene, "--no-open", "--quiet", "--paused"], stdout=subprocess.PIPE, text=True)
    try:
        address = view.stdout.readline().strip()
        browser = Browser(chosen.window)
        try:
            page = browser.open(address)
            if chosen.factors:
                chosen.picture.write_bytes(show_factors(browser, page, chosen.factors))
                return
            film = take_film(browser, page, chosen.width)
        finally:
            browser.end()
    finally:
        view.send_signal(signal.SIGINT)
        view.wait(10)
    write_animation(chosen.picture, [frame for frame, _ in film], [wait for _, wait in film])
    print(f"{chosen.picture}: {len(film)} frames, {chosen.picture.stat().st_size} bytes")


if __name__ == "__main__":
    main()
