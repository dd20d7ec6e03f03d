"""A Python of its own under build/ with PyPI's packages of other renderers, which tools and benches
compare Onde with. Nothing that is built or installed uses it.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[1] / "build/peers"
PYTHON = FOLDER / "venv/bin/python"
OLDEST_LLVM = 17  # that compiles what Mitsuba's LLVM variants ask for


def _run(*words):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True)


def versions():
    """Of the installed packages, by name."""
    ask = "import importlib.metadata as m, json; print(json.dumps({d.name: d.version for d in m.distributions()}))"
    listed = _run(PYTHON, "-c", ask)
    if listed.returncode:
        sys.exit(f"{PYTHON} is broken; delete {FOLDER}, so that it is made anew")
    return json.loads(listed.stdout)


def install(packages):
    """Those of the packages that are there afterwards, with their versions. Says what can't be had."""
    if not PYTHON.exists():
        made = _run(sys.executable, "-m", "venv", FOLDER / "venv")
        if made.returncode:
            sys.exit(f"no virtual environment could be made in {FOLDER}: install python3-venv")
    present = versions()
    missing = [package for package in packages if package not in present]
    if missing:
        print(f"installing {', '.join(missing)} into {FOLDER} (once)...", file=sys.stderr, flush=True)
    for package in missing:
        done = _run(PYTHON, "-m", "pip", "install", "-q", "--disable-pip-version-check", package)
        if done.returncode:
            reason = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
            print(f"{package} can't be installed and is left out: {reason}", file=sys.stderr)
    present = versions()
    return {package: present[package] for package in packages if package in present}


def llvm_library():
    """The newest LLVM of the system that Mitsuba's LLVM variants can use, or nothing."""
    named = os.environ.get("DRJIT_LIBLLVM_PATH")
    if named:
        return named
    found = {}
    for path in Path("/usr/lib").glob("**/libLLVM*.so*"):
        version = re.search(r"libLLVM(?:-|\.so\.)(\d+)", path.name)
        if version and int(version[1]) >= OLDEST_LLVM:
            found[int(version[1])] = str(path)
    return found[max(found)] if found else ""


def enter(needed, wanted=()):
    """Goes on as the same script in that Python, which has what is needed and what can be had of what
    is wanted; to be called first."""
    if Path(sys.prefix).resolve() == (FOLDER / "venv").resolve():
        return
    present = install([*needed, *wanted])
    absent = set(needed) - set(present)
    if absent:
        sys.exit(f"this needs {', '.join(sorted(absent))}")
    os.execve(PYTHON, [str(PYTHON), *sys.argv], {**os.environ, "DRJIT_LIBLLVM_PATH": llvm_library()})
