#!/usr/bin/env python3
"""When pages of `meninas walk` are there, and what their frames take, where Chromium draws by software.

  bench/walk_frames.py [--openings 9] [--seconds 6] [--size 1000,640] PAGE.html[#camera=NAME] ...

Each page is opened so many times, each time in a new browser; then the camera's view is drawn as while someone moves, as
often as it can be, for so many seconds, and then at rest. Prints medians: the time from the start of the navigation to the end of the first frame, and from there, of frames
while someone moves and at rest, the milliseconds elapsed, the processor's (all of the browser's processes, the page's scripts
and the drawing), and the draws. While someone moves a slow frame has a third of the screen's pixels along each side.
"""
import argparse
import os
import pathlib
import statistics
import time

from view_film import Browser

FIRST = """new MutationObserver((_, observer) => {
  if (!document.body || !document.body.classList.contains('shown')) return;
  window.firstPicture = performance.now();
  observer.disconnect();
}).observe(document, { subtree: true, childList: true, attributes: true, attributeFilter: ['class'] });"""
FRAMES = """const ask = requestAnimationFrame.bind(window), all = window.framesDrawn = [];
window.requestAnimationFrame = draw => ask(now => {
  const before = performance.now();
  draw(now);
  if (window.keys) press(keys.reverse()[0]);
  all.push([performance.now() - before, Number(document.getElementById('figures').textContent.match(/(\\d+) draws/)[1])]);
});"""


def processor_seconds(root):
    """Of a process and all that it has started."""
    parents, seconds = {}, {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        parents[int(folder.name)] = int(fields[1])
        seconds[int(folder.name)] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def is_of_root(process):
        while process and process != root:
            process = parents.get(process, 0)
        return process == root

    return sum(spent for process, spent in seconds.items() if is_of_root(process))


def opened(browser, page):
    """Opens the page in the browser's first tab. Returns the tab, the milliseconds until the first picture, and the processor seconds."""
    target = next(t for t in browser.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
    tab = browser.call("Target.attachToTarget", {"targetId": target["targetId"], "flatten": True})["sessionId"]
    browser.call("Page.enable", page=tab)
    browser.call("Page.addScriptToEvaluateOnNewDocument", {"source": FIRST}, tab)
    time.sleep(2)  # what a browser does when it has been started
    begin = processor_seconds(browser.process.pid)
    browser.call("Page.navigate", {"url": page}, tab)
    time.sleep(0.9)  # asking would take time from it
    first = browser.run(tab, "await until(() => window.firstPicture); return window.firstPicture;")
    return tab, first, processor_seconds(browser.process.pid) - begin


def of_frames(browser, tab, seconds):
    """Medians while someone moves and at rest: (elapsed ms, processor ms, draws)."""
    spent = lambda: processor_seconds(browser.process.pid)
    browser.run(tab, FRAMES + "await new Promise(r => setTimeout(r, 5000)); window.keys = ['+', '-']; press('-');")
    time.sleep(1)  # the first of them compile
    begin, count = spent(), browser.run(tab, "return framesDrawn.length;")
    time.sleep(seconds)
    frames = browser.run(tab, f"return framesDrawn.slice({count});")
    moving = [statistics.median(f[0] for f in frames), 1000 * (spent() - begin) / max(1, len(frames)), statistics.median(f[1] for f in frames)]
    rests = []
    browser.run(tab, "window.keys = null; await new Promise(r => setTimeout(r, 4000));")
    for _ in range(5):
        begin = spent()
        # A coarse frame, and then one at rest.
        frame = browser.run(tab, "const n = framesDrawn.length; press('+'); await until(() => framesDrawn.length > n + 1); return framesDrawn[n + 1];")
        rests.append([frame[0], 1000 * (spent() - begin) - moving[1], frame[1]])
    return moving, [statistics.median(column) for column in zip(*rests)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="+", metavar="PAGE.html[#camera=NAME]")
    parser.add_argument("--openings", type=int, default=9)
    parser.add_argument("--seconds", type=float, default=6)
    parser.add_argument("--size", default="1000,640")
    asked = parser.parse_args()
    print("| page | first picture, ms (least, most) | processor, s | moving: ms, processor ms, draws | at rest |\n|---|---|---|---|---|")
    for page in asked.pages:
        file, _, fragment = page.partition("#")
        address, firsts, spent = f"file://{os.path.abspath(file)}#{fragment}", [], []
        for k in range(max(1, asked.openings)):
            browser = Browser(asked.size)
            try:
                tab, first, seconds = opened(browser, address)
                firsts.append(first)
                spent.append(seconds)
                if k + 1 >= asked.openings:
                    moving, rest = of_frames(browser, tab, asked.seconds)
            finally:
                browser.end()
        middle = lambda row: ", ".join(f"{x:.0f}" for x in row)
        print(f"| `{os.path.basename(file)}` | {statistics.median(firsts):.0f} ({min(firsts):.0f}, {max(firsts):.0f}) | {statistics.median(spent):.1f} "
              f"| {middle(moving)} | {middle(rest)} |", flush=True)


if __name__ == "__main__":
    main()
