"""Finds and runs the program: its progress, its warnings, its end, and ending it."""

import os
import queue
import re
import shutil
import subprocess
import threading
import time

PROGRESS = re.compile(r"^meninas: (\d+) %(?:, (.+) left)?: (.+)$")
WARNING = re.compile(r"^meninas: warning: (.+)$")


class ProgramError(Exception):
    """What went wrong, in one line for the user."""


class Cancelled(Exception):
    pass


def find_program(path):
    """The program's full path. `path` is a name to be looked for in PATH, or a file."""
    path = os.path.expanduser(path.strip()) or "meninas"
    found = shutil.which(path)
    if not found:
        raise ProgramError(
            f"the program '{path}' is not there or cannot be run: "
            "set its path in Edit > Preferences > Add-ons > Meninas"
        )
    return os.path.abspath(found)


class Output:
    """What a process has said on standard error so far."""

    def __init__(self, label):
        self.label = label
        self.fraction = 0.0
        self.stage = ""
        self.left = ""
        self.warnings = []
        self.lines = []

    def take(self, line):
        progress = PROGRESS.match(line)
        if progress:
            self.fraction = int(progress.group(1)) / 100.0
            self.left, self.stage = progress.group(2) or "", progress.group(3)
            return
        warning = WARNING.match(line)
        if warning:
            self.warnings.append(warning.group(1))
        elif line:
            self.lines.append(line)

    def text(self):
        """What is going on, for the status line."""
        parts = [self.label]
        if self.stage:
            parts.append(f"{self.stage}, {100.0 * self.fraction:.0f} %")
        if self.left:
            parts.append(f"{self.left} left")
        last = self.last()
        if last.startswith("step "):
            parts.append(last)
        return ", ".join(parts)

    def last(self):
        lines = [line for line in self.lines if line.startswith("meninas: ")] or self.lines
        return lines[-1].removeprefix("meninas: ") if lines else ""


def _lines_of(stream, lines):
    for line in stream:
        lines.put(line.rstrip("\n"))
    stream.close()


def end(process):
    """Asks it to end, then ends it."""
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(2)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def steps(command, label=""):
    """Runs a command and yields (fraction, text) several times a second; its value is the Output. The process is gone when the
    generator is closed or ends. Raises ProgramError where the command fails."""
    try:
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            text=True, encoding="utf-8", errors="replace",
        )
    except OSError as error:
        raise ProgramError(f"'{command[0]}' cannot be run: {error.strerror}") from error
    lines, output = queue.Queue(), Output(label)
    reader = threading.Thread(target=_lines_of, args=(process.stderr, lines), daemon=True)
    reader.start()
    try:
        while process.poll() is None:
            while not lines.empty():
                output.take(lines.get())
            yield output.fraction, output.text()
    finally:
        end(process)
        reader.join(5)
    while not lines.empty():
        output.take(lines.get())
    if process.returncode != 0:
        raise ProgramError(output.last() or f"'{command[0]}' ended with code {process.returncode}")
    return output


def run(stepped, is_cancelled=lambda: False, tell=lambda fraction, text: None):
    """Takes `steps` to their end; raises Cancelled, after the process is gone, where `is_cancelled()` says so."""
    try:
        while True:
            tell(*next(stepped))
            if is_cancelled():
                stepped.close()
                raise Cancelled()
            time.sleep(0.05)
    except StopIteration as ended:
        return ended.value
