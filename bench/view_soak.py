#!/usr/bin/env python3
"""Browsers of `meninas view` that read, that never read and that leave in the middle, for as long as one wants.

  bench/view_soak.py build/release/cli/meninas scenes/gallery/cornell-mirror.gltf --minutes 10

The scene is copied and saved again every few seconds, so that it is solved over and over. Prints memory, threads and
open files of the program as time goes on, and how late events reach a reader; fails where memory or open files grow
after the first quarter, where a reader is not told of a solution, or where the program has ended.
"""
import argparse
import json
import os
import pathlib
import shutil
import signal
import socket
import statistics
import subprocess
import tempfile
import threading
import time
import urllib.parse
import urllib.request


def request(address, path):
    place = urllib.parse.urlparse(address)
    one = socket.create_connection((place.hostname, place.port))
    one.sendall(f"GET {place.path}{path} HTTP/1.1\r\nHost: {place.netloc}\r\n\r\n".encode())
    return one


def read_all(address, solved, over):
    """A browser: reads events, and fetches what is newest."""
    state = 0
    while not over.is_set():
        try:
            for line in urllib.request.urlopen(address + "events", timeout=30):
                if over.is_set():
                    return
                if not line.startswith(b"data: "):
                    continue
                status = json.loads(line[6:])
                if status["state"] > state:
                    state = status["state"]
                    urllib.request.urlopen(address + f"light?base={state - 1}").read()
                if status["solved"]:
                    solved.append((time.monotonic(), status["room"]))
        except OSError:
            time.sleep(0.1)


def leave_again_and_again(address, over):
    while not over.is_set():
        one = request(address, "events")
        one.recv(100)
        one.close()
        other = request(address, "room")
        other.recv(10)
        other.close()
        time.sleep(0.05)


def figures(process):
    status = dict(line.split(":", 1) for line in open(f"/proc/{process}/status"))
    return {
        "resident MB": int(status["VmRSS"].split()[0]) / 1024,
        "threads": int(status["Threads"]),
        "files": len(os.listdir(f"/proc/{process}/fd")),
    }


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("scene", type=pathlib.Path)
    options.add_argument("--minutes", type=float, default=10.0)
    options.add_argument("--every", type=float, default=5.0, help="seconds from save to save")
    chosen = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / chosen.scene.name
        for file in chosen.scene.parent.iterdir():
            if file.stem == chosen.scene.stem:
                shutil.copy(file, folder)
        view = subprocess.Popen([chosen.program, "view", copy, "--quality", "draft", "--no-open", "--quiet"], stdout=subprocess.PIPE, text=True)
        address = view.stdout.readline().strip()
        over, solved = threading.Event(), []
        silent = [request(address, path) for path in ("events", "room", "events")]
        work = [threading.Thread(target=read_all, args=(address, solved, over)) for _ in range(3)]
        work.append(threading.Thread(target=leave_again_and_again, args=(address, over)))
        for one in work:
            one.start()
        begin, rows, saves = time.monotonic(), [], 0
        while time.monotonic() - begin < 60 * chosen.minutes and view.poll() is None:
            time.sleep(chosen.every)
            os.utime(copy)
            saves += 1
            rows.append(figures(view.pid))
            print(f"{time.monotonic() - begin:7.1f} s", *(f"{name} {value:.0f}" for name, value in rows[-1].items()), f"solved rooms {len({room for _, room in solved})}", flush=True)
        over.set()
        alive = view.poll() is None
        view.send_signal(signal.SIGINT)
        end = view.wait(10)
        for one in work + []:
            one.join(40)
        for one in silent:
            one.close()
    quarter = len(rows) // 4 + 1
    growth = {name: statistics.mean(r[name] for r in rows[-quarter:]) - statistics.mean(r[name] for r in rows[quarter:2 * quarter]) for name in rows[0]}
    print("growth from the second quarter to the last:", growth)
    problems = [text for text, wrong in (("it ended by itself", not alive), (f"exit code {end}", end != 0), ("nobody was told of a solution", not solved),
                                         ("memory grows", growth["resident MB"] > 30), ("open files grow", growth["files"] > 8)) if wrong]
    print("; ".join(problems) or f"well, after {saves} saves")
    return 1 if problems else 0


if __name__ == "__main__":
    raise SystemExit(main())
