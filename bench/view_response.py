#!/usr/bin/env python3
"""How soon `meninas view` answers while a large scene is prepared and solved.

  bench/view_response.py build/release/cli/meninas --triangles 1e6 [--kind parts] [--seconds 300] [SCENE]

The scene is a file, or one that bench/growth.py makes: closed boxes by default. Twenty times a second something small is asked
for (the line that makes a picture again, which is refused with a sentence before the room is solved), and events are
listened to. Prints when the address, the first picture and the solution were there, and the median, 99 in a hundred and longest answer, by stage.
"""
import argparse
import json
import pathlib
import random
import resource
import signal
import statistics
import subprocess
import tempfile
import threading
import time
import urllib.error
import urllib.request

import growth


def listen(address, begin, told, over):
    for line in urllib.request.urlopen(address + "events", timeout=600):
        if over.is_set():
            return
        if not line.startswith(b"data: "):
            continue
        status, now = json.loads(line[6:]), time.monotonic() - begin
        told["stage"] = status["stage"]
        if status["state"] and "first picture" not in told:
            told["first picture"] = now
            told["first picture, by the program's clock"] = status["seconds"]
        if status["solved"]:
            told["solved"] = now
            return


def ask(address, path):
    before = time.monotonic()
    try:
        urllib.request.urlopen(address + path, timeout=600).read()
    except urllib.error.HTTPError:
        pass  # a sentence
    return time.monotonic() - before


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("scene", nargs="?", type=pathlib.Path)
    options.add_argument("--triangles", type=float, default=1e6)
    options.add_argument("--kind", default="parts", choices=sorted(growth.KINDS))
    options.add_argument("--seconds", type=float, default=300.0, help="at most")
    options.add_argument("--quality", default="draft")
    chosen = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = chosen.scene
        if scene is None:
            scene, file, count = pathlib.Path(folder) / "large.glb", growth.File(), int(chosen.triangles)
            growth.KINDS[chosen.kind](file, count, growth.room(file), random.Random(count))
            file.write(scene)
        begin = time.monotonic()
        view = subprocess.Popen([chosen.program, "view", scene, "--quality", chosen.quality, "--no-open", "--quiet"], stdout=subprocess.PIPE, text=True)
        address = view.stdout.readline().strip()
        print(f"address after {time.monotonic() - begin:.2f} s, of which the file takes most", flush=True)
        told, over, answers = {"stage": ""}, threading.Event(), {}
        read = time.monotonic()
        threading.Thread(target=listen, args=(address, read, told, over), daemon=True).start()
        while "solved" not in told and time.monotonic() - read < chosen.seconds and view.poll() is None:
            stage = told["stage"]
            answers.setdefault(stage, []).append(ask(address, "command?viewer=a&number=1&exposure=0&size=8x8&camera=x"))
            time.sleep(0.05)
        over.set()
        view.send_signal(signal.SIGINT)
        view.wait(30)
    for what in ("first picture", "first picture, by the program's clock", "solved"):
        print(f"{what}: {told[what]:.2f} s after the address" if what in told else f"{what}: not in {chosen.seconds:.0f} s")
    for stage, times in answers.items():
        times.sort()
        print(f"{stage or 'before any'}: {len(times)} answers, median {1e3 * statistics.median(times):.1f} ms, 99 % {1e3 * times[int(0.99 * (len(times) - 1))]:.1f} ms, longest {1e3 * times[-1]:.1f} ms")
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"processor {used.ru_utime + used.ru_stime:.1f} s, memory {used.ru_maxrss / 1024:.0f} MiB")


if __name__ == "__main__":
    main()
