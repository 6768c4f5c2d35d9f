#!/usr/bin/env python3
"""Runs the commands of a document as they are written, from the top folder of a copy of the project.

    run_commands.py DOCUMENT --source DIR --build DIR

A command is a line of a block that is marked as sh. A block runs in one shell, line by line, as a reader would type it:
  - `export NAME=VALUE` holds for the rest of the document;
  - a line that ends in & runs beside the ones after it, and is interrupted (Ctrl-C) at the end of the document;
  - any other line must end with status 0; servers, windows and bridges run on until somebody stops them, so they are
    interrupted after a few seconds and must end with status 0 then;
  - where something runs in the background, a line that fails is tried again for some seconds: a server needs a moment.
A block after the comment <!-- long --> takes longer than a test may: its lines are stopped after a few seconds, and
what they make of that does not count.
Scripts of deploy/ and .ci/ are not run, since they build and test all of the project: tests/integration runs the demo, and the
suite of accuracy has a test of its own.

Beside the blocks, each command that the text shows in single backquotes is held against the program's own --help: the
options that the text gives must be there.
"""

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BLOCK = re.compile(r"(<!-- long -->\s*\n)?^```sh\n(.*?)^```", re.M | re.S)
INLINE = re.compile(r"(?<!`)`([^`\n]+(?:\n[^`\n]+)?)`(?!`)")
PROGRAM = re.compile(r"(?:build/release/bin/)?(pelagos-[a-z-]+|deploy/[a-z-]+)$")
TAKES_NO_INPUT = subprocess.DEVNULL
RUNS_ON = re.compile(r"pelagos-(server|viewer|example-bridge)\b")
PATIENCE = 8  # s, with what runs on
LONGEST = 120  # s, for what ends by itself
LONG_ENOUGH = 4  # s, for a line that takes minutes: wrong options and missing files show at once
RETRIES = 15  # s, beside a background process
ENDING = 20  # s, after an interrupt
NOT_COPIED = {"build", "out", ".git", ".cache"}


class Fault(Exception):
    pass


def commands_of(block):
    """The lines of a block, with continued lines and loops joined."""
    command = ""
    for line in block.splitlines():
        text = line if line.lstrip().startswith("#") else re.sub(r"\s+#.*$", "", line)
        if not text.strip() or text.lstrip().startswith("#"):
            continue
        command += text + "\n"
        if text.rstrip().endswith("\\"):
            continue
        opened = len(re.findall(r"^\s*for\b", command, re.M))
        if opened > len(re.findall(r"^\s*done\b", command, re.M)):
            continue
        yield command.strip()
        command = ""


def copy_of(source, build):
    """A folder that looks like a built clone: links to the sources, and the build at build/release."""
    folder = Path(tempfile.mkdtemp(prefix="pelagos-docs-"))
    for entry in source.iterdir():
        if entry.name not in NOT_COPIED:
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    (folder / "build/release").symlink_to(build)
    return folder


class Shell:
    """Runs commands in the copy of the project, each in a process group of its own."""

    def __init__(self, folder):
        self.folder = folder
        self.environment = dict(os.environ)
        self.background = []

    def start(self, command):
        log = tempfile.TemporaryFile("w+")
        # set -m in the shell: an interrupt reaches the program as from a terminal. exec: no shell stays between.
        process = subprocess.Popen(["bash", "-c", command], cwd=self.folder, env=self.environment, stdin=TAKES_NO_INPUT,
                                   stdout=log, stderr=subprocess.STDOUT, start_new_session=True)
        process.log, process.command = log, command
        return process

    @staticmethod
    def output(process):
        process.log.seek(0)
        return process.log.read()[-3000:]

    def interrupt(self, process):
        """Ctrl-C; the status after it."""
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        try:
            return process.wait(ENDING)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            raise Fault(f"does not end within {ENDING} s of an interrupt:\n  {process.command}\n{self.output(process)}")

    @staticmethod
    def abandon(process):
        """Stops a line that takes minutes. A loop goes on after the interrupt of one of its commands, so it is ended."""
        os.killpg(process.pid, signal.SIGINT)
        try:
            process.wait(LONG_ENOUGH)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()

    def run(self, command, long):
        export = re.fullmatch(r"export (\w+)=(\S+)", command)
        if export:
            self.environment[export[1]] = subprocess.run(
                ["bash", "-c", f"echo -n {export[2]}"], cwd=self.folder, env=self.environment, check=True,
                capture_output=True, text=True).stdout
            return
        if command.startswith(("deploy/", ".ci/")):
            return
        if command.endswith("&"):
            self.background.append(self.start("exec " + command[:-1]))
            time.sleep(1.0)
            return
        end = time.monotonic() + RETRIES
        while (fault := self.attempt(command, long)) is not None:
            if not self.background or time.monotonic() > end:
                raise Fault(fault)
            time.sleep(1.0)

    def attempt(self, command, long):
        """None, or what is wrong."""
        process = self.start(command)
        try:
            status = process.wait(LONG_ENOUGH if long else PATIENCE if RUNS_ON.search(command) else LONGEST)
        except subprocess.TimeoutExpired:
            if long:
                return self.abandon(process)
            status = self.interrupt(process)
        return None if status == 0 else f"ended with status {status}:\n  {command}\n{self.output(process)}"

    def close(self):
        faults = []
        for process in self.background:
            try:
                status = self.interrupt(process)
                if status != 0:
                    faults.append(f"ended with status {status}:\n  {process.command}\n{self.output(process)}")
            except Fault as fault:
                faults.append(str(fault))
        return faults


def run_blocks(text, shell):
    count, faults = 0, []
    for match in BLOCK.finditer(text):
        line = text[:match.start()].count("\n") + 1
        for command in commands_of(match[2]):
            print(f"line {line}: {command}", flush=True)
            count += 1
            try:
                shell.run(command, long=match[1] is not None)
            except Fault as fault:
                faults.append(f"block at line {line}: {fault}")
    return count, faults + shell.close()


def help_of(program, words, folder, cache):
    """The help of a program, or of its subcommand where the text names one."""
    path = folder / (program if program.startswith("deploy/") else f"build/release/bin/{program}")
    if program.startswith("deploy/"):
        words = []  # a script has no subcommands: what follows it would be done
    for count in range(len(words), -1, -1):
        key = (program, *words[:count])
        if key not in cache:
            done = subprocess.run([path, *words[:count], "--help"], capture_output=True, text=True, timeout=60,
                                  stdin=TAKES_NO_INPUT, cwd=folder)
            cache[key] = done.stdout if done.returncode == 0 else None
        if cache[key] is not None:
            return cache[key]
    return None


def check_inline(text, folder):
    count, faults, cache = 0, [], {}
    blocks = [match[1] for match in INLINE.finditer(text)]
    blocks += [line for match in re.finditer(r"^```(?:sh)?\n(.*?)^```", text, re.M | re.S) for line in
               match[1].splitlines()]
    for span in blocks:
        words = re.sub(r"\s+#.*$", "", span).split()
        program = PROGRAM.fullmatch(words[0]) if words else None
        if not program or not (folder / program[1]).exists() and not (folder / "build/release/bin" / program[1]).exists():
            continue
        count += 1
        plain = []
        for word in words[1:]:
            if not re.fullmatch(r"[a-z][a-z-]*", word):
                break
            plain.append(word)
        known = help_of(program[1], plain[:2], folder, cache)
        if known is None:
            faults.append(f"`{span}`: {program[1]} has no --help")
            continue
        for option in re.findall(r"(?<![\w-])--[a-z][a-z-]*", " ".join(words[1:])):
            if option not in known and option != "--help":
                faults.append(f"`{span}`: {program[1]} {' '.join(plain[:2])} knows no {option}")
    return count, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("document")
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--build", type=Path, required=True)
    arguments = parser.parse_args()
    source, build = arguments.source.resolve(), arguments.build.resolve()
    text = (source / arguments.document).read_text()
    folder = copy_of(source, build)
    try:
        shown, faults = check_inline(text, folder)
        run, more = run_blocks(text, Shell(folder))
        faults += more
    finally:
        shutil.rmtree(folder)
    print(f"{arguments.document}: {run} commands run, {shown} held against --help")
    for fault in faults:
        print(f"{arguments.document}: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
