#!/usr/bin/env python3
"""Pages of `meninas walk` in Firefox and in WebKit, the engine of Safari, beside the program's own picture.

usage: bench/walk_browsers.py PROGRAM [--browser firefox|webkit] SCENE:CAMERA:EXPOSURE ...

Each scene is solved at draft. Its page draws the camera's view of 128 x 128 pixels; `meninas render --solution
--diffuse interpolated` renders the same view. Prints the mean FLIP of both, and the seconds from the address to the
picture. `ctest -R WalkTruth` does the same in Chromium.

Firefox is driven by its Marionette protocol, WebKit by WebKitWebDriver (Debian: firefox-esr; webkit2gtk-driver; both
with xvfb and libgl1-mesa-dri, which draw WebGL 2 without a graphics card).
"""
import argparse
import base64
import contextlib
import json
import os
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

PREFERENCES = """user_pref("webgl.force-enabled", true);
user_pref("webgl.out-of-process", false);
user_pref("gfx.webrender.software", true);
"""
MINI_BROWSER = "/usr/lib/x86_64-linux-gnu/webkit2gtk-4.1/MiniBrowser"
STATE = """const { shot = '', problem = '' } = document.body ? document.body.dataset : {};
return [shot, problem];"""


def started(command, **variables):
    """The command on a screen that nobody sees, in software."""
    environment = dict(os.environ, LIBGL_ALWAYS_SOFTWARE="1", **variables)
    return subprocess.Popen(["xvfb-run", "-a", "-s", "-screen 0 1200x900x24", *command], env=environment,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)


def until(attempt, seconds=60):
    """What `attempt` returns once it neither fails nor returns nothing."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        with contextlib.suppress(OSError):
            result = attempt()
            if result:
                return result
        time.sleep(0.05)
    raise SystemExit("no answer from the browser")


class Firefox:
    """Marionette: messages [0, id, command, parameters] behind their length."""

    def __init__(self, folder):
        with open(os.path.join(folder, "user.js"), "w", encoding="utf-8") as file:
            file.write(PREFERENCES)
        self.process = started(["firefox-esr", "--profile", folder, "--marionette", "about:blank"], HOME=folder)
        self.stream = until(lambda: socket.create_connection(("127.0.0.1", 2828))).makefile("rwb")
        self.read()
        self.count = 0
        self.send("WebDriver:NewSession", capabilities={})

    def read(self):
        length = b""
        while not length.endswith(b":"):
            length += self.stream.read(1)
        return json.loads(self.stream.read(int(length[:-1])))

    def send(self, command, **parameters):
        self.count += 1
        message = json.dumps([0, self.count, command, parameters]).encode()
        self.stream.write(b"%d:%s" % (len(message), message))
        self.stream.flush()
        return self.read()[3]

    def open(self, address):
        self.send("WebDriver:Navigate", url=address)

    def run(self, script):
        return (self.send("WebDriver:ExecuteScript", script=script, args=[]) or {}).get("value")

    def close(self):
        self.send("Marionette:Quit", flags=["eForceQuit"])
        self.process.wait(20)


class WebKit:
    """W3C WebDriver over HTTP."""

    def __init__(self, _):
        self.process = started(["WebKitWebDriver", "--port=4455"])
        until(lambda: self.call("GET", "/status"))
        options = {"binary": MINI_BROWSER, "args": ["--automation"]}
        session = self.call("POST", "/session",
                            {"capabilities": {"alwaysMatch": {"webkitgtk:browserOptions": options}}})
        self.path = "/session/" + session["sessionId"]

    @staticmethod
    def call(method, path, value=None):
        body = None if value is None else json.dumps(value).encode()
        request = urllib.request.Request("http://127.0.0.1:4455" + path, method=method, data=body,
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=120) as answer:
            return json.load(answer)["value"]

    def open(self, address):
        self.call("POST", self.path + "/url", {"url": address})

    def run(self, script):
        return self.call("POST", self.path + "/execute/sync", {"script": script, "args": []})

    def close(self):
        self.call("DELETE", self.path)
        os.killpg(self.process.pid, 15)
        self.process.wait(20)


def browse(kind, page, fragment):
    """The picture that the page draws, PNG, and the seconds until it is there."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = kind(profile)
        try:
            begin = time.monotonic()
            browser.open(f"file://{page}#{fragment}")
            shot, problem = until(lambda: (lambda said: any(said or []) and said)(browser.run(STATE)))
            seconds = time.monotonic() - begin
        finally:
            browser.close()
    if problem:
        raise SystemExit(problem)
    return base64.b64decode(shot.split(",")[1]), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("views", nargs="+", metavar="SCENE:CAMERA:EXPOSURE")
    parser.add_argument("--browser", choices=["firefox", "webkit"], default="firefox")
    asked = parser.parse_args()
    kind = {"firefox": Firefox, "webkit": WebKit}[asked.browser]
    print("| view | FLIP | seconds |\n|---|---|---|")
    for view in asked.views:
        scene, camera, exposure = view.rsplit(":", 2)
        with tempfile.TemporaryDirectory() as folder:
            path = lambda name: os.path.join(folder, name)
            run = lambda *words: subprocess.run([asked.program, *words], check=True, capture_output=True, text=True).stdout
            run("solve", scene, "-o", path("s.glb"), "--quality", "draft")
            run("walk", scene, "--solution", path("s.glb"), "-o", path("s.html"))
            run("render", scene, "--solution", path("s.glb"), "-o", path("s.png"), "--diffuse", "interpolated", "--samples", "64",
                "--size", "128x128", "--camera", camera, "--exposure", exposure)
            picture, seconds = browse(kind, path("s.html"), f"camera={camera}&size=128x128&shot&exposure={exposure}")
            with open(path("w.png"), "wb") as file:
                file.write(picture)
            difference = json.loads(run("diff", path("w.png"), path("s.png"), "--json"))
        print(f"| `{os.path.basename(scene)}`, {camera} | {difference['flip']:.4f} | {seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main()
