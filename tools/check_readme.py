#!/usr/bin/env python3
"""Runs the commands of README.md's ```sh blocks, so that none of them can rot.

Each line that starts with ./run is run in a scratch folder that looks like the root of the
repository, in the order of the page; pictures are made tiny, with one sample. `./run test` is only
checked to exist (it is what calls this), a benchmark only to be there. Prints one line a command;
exits 1 when any failed.
"""

import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TIMEOUT_SECONDS = 600
SMALL = {"render": {"--spp": "1", "--size": "64x64"}, "gallery": {"--spp": "1"}}
# One work instead of all: every scene has kernels of its own to compile, and render/lesson_test
# measures them all.
ONE_OF = {"gallery": "scenes/chapter/screen.toml"}
SHELL_SYNTAX = set("|<>&;$`")


def readme_commands(text):
    """The ./run lines of the sh blocks, with continued lines joined."""
    for block in re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        for line in block.replace("\\\n", " ").splitlines():
            if line.strip().startswith("./run"):
                yield line.strip()


def shrink(words, small):
    """The words of a command that makes pictures, with its size and samples replaced by tiny ones."""
    kept = []
    words = iter(words)
    for word in words:
        name, _, value = word.partition("=")
        if name not in small:
            kept.append(word)
        elif not value:
            next(words, None)
    return kept + [word for option in small.items() for word in option]


def check_command(command, folder):
    """None when the command works, else what is wrong with it."""
    words = shlex.split(command, comments=True)
    verb = words[1] if len(words) > 1 else "help"
    if SHELL_SYNTAX & set("".join(words)):
        return "shell syntax, which this check does not follow"
    if verb == "test":
        return None
    if verb == "bench" and len(words) > 2:
        names = subprocess.run(["./run", "bench"], cwd=folder, capture_output=True, text=True)
        return None if words[2] in names.stdout.split() else f"no benchmark {words[2]}"
    if verb == "format":
        words.append("--check")
    if verb in SMALL:
        words = shrink(words, SMALL[verb])
    if verb in ONE_OF:
        words.append(ONE_OF[verb])
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, timeout=TIMEOUT_SECONDS)
    if done.returncode != 0:
        return f"exit code {done.returncode}: {done.stderr.strip()[-600:]}"
    return None


def link_root(folder):
    """Makes `folder` look like the root of the repository; what commands write stays in it."""
    for entry in ROOT.iterdir():
        if not entry.name.startswith(".") and entry.name not in ("build", "out"):
            (Path(folder) / entry.name).symlink_to(entry)


def main():
    commands = list(dict.fromkeys(readme_commands((ROOT / "README.md").read_text("utf-8"))))
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        link_root(folder)
        for command in commands:
            problem = check_command(command, folder)
            failures += problem is not None
            print(f"{'failed' if problem else 'passed'}: {command}")
            if problem:
                print(f"    {problem}")
    print(f"README commands: {len(commands) - failures} passed, {failures} failed")
    return 1 if failures or not commands else 0


if __name__ == "__main__":
    sys.exit(main())
