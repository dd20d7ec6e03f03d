#!/usr/bin/env python3
"""Holds the #include lines of src/ and kernels/ to the arrows of the house: down only. And the
vectors of 16 to the floors that own them.

Prints each line that breaks a rule and ends with a count; exits 1 when there is any.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# What a folder may include beside itself. "shared" is kernels/shared, compiled by host and device.
SRC_ARROWS = {
    "core": set(),
    "image": {"core"},
    "scene": {"core", "image"},
    "accel": {"core", "shared"},
    "gpu": {"core", "shared"},
    "upload": {"core", "image", "scene", "accel", "gpu", "shared"},
    "render": {"core", "image", "scene", "accel", "gpu", "upload", "shared"},
    "chapter": {"core", "image", "scene", "accel", "gpu", "upload", "render", "shared"},
    "session": {"core", "image", "scene", "accel", "gpu", "upload", "render", "chapter", "shared"},
    "app": {"core", "image", "scene", "accel", "gpu", "upload", "render", "chapter", "session", "shared"},
}
SHADE = {"shared", "math", "trace", "shade"}
ESTIMATORS = {"path", "light_tracing", "chapter"}
KERNEL_ARROWS = {
    "shared": set(),
    "math": {"shared"},
    "trace": {"shared", "math"},
    "shade": {"shared", "math", "trace"},
    "film": {"shared", "math"},
    "path": SHADE | {"film"},
    "light_tracing": SHADE | {"film"},
    "chapter": SHADE | {"film"},
    "wavefront": SHADE | ESTIMATORS | {"film", "megakernel"},
    "megakernel": SHADE | ESTIMATORS | {"film"},
    "inspect": SHADE | ESTIMATORS | {"film", "wavefront", "megakernel"},
    "bench": SHADE,
    "probe": SHADE | ESTIMATORS | {"film"},
}

# System headers that only some places may see: pattern, who may, why.
DOORS = [
    (re.compile(r"CL/"), re.compile(r"src/(gpu|upload|render|chapter)/"), "OpenCL is for gpu, upload, render, chapter"),
    (re.compile(r"png\.h|jpeglib|webp/|tiffio|Imf|stb/|stored_image"), re.compile(r"src/image/"), "pictures are for image_io.h"),
    (re.compile(r"CLI/"), re.compile(r"src/core/command_line\.cpp"), "only command_line.cpp opens it"),
    (re.compile(r"embree"), re.compile(r"^$"), "Embree is an oracle for tests, not for the renderer"),
]

# Elsewhere in the kernels, code is written for any width: real, not float16.
VECTOR_OF_16 = re.compile(r"\bfloat16\b")
MAY_NAME_FLOAT16 = re.compile(r"kernels/(math|trace)/|kernels/chapter/solvers\.cl")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = {".h", ".cpp", ".cl", ".inl"}


def includes(path):
    """(line number, is a system header, name) of each #include in a file."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) == "<", match.group(2)


def broken_arrow(folder, name, arrows):
    """Why `folder` may not include "name", or None."""
    if folder not in arrows:
        return f"the folder {folder} has no place in tools/check_includes.py"
    if "/" not in name:
        return "name the folder too"
    target = name.split("/")[0]
    if target != folder and target not in arrows[folder]:
        return f"{folder} may not include {target}"
    return None


def broken_door(file, name):
    """Why `file` may not include <name>, or None."""
    for header, allowed, why in DOORS:
        if header.match(name) and not allowed.match(file):
            return why
    return None


def check_vectors():
    """Every float16 above kernels/math and kernels/trace, as a line to print."""
    for path in sorted((ROOT / "kernels").rglob("*")):
        file = path.relative_to(ROOT).as_posix()
        if path.suffix not in SOURCES or MAY_NAME_FLOAT16.match(file):
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if VECTOR_OF_16.search(line.split("//")[0]):
                yield f"{file}:{number}: float16: only math and trace name it; write real"


def check_tree(tree, arrows):
    """Every broken rule under ROOT/tree, as a line to print."""
    for path in sorted((ROOT / tree).rglob("*")):
        if path.suffix not in SOURCES:
            continue
        file = path.relative_to(ROOT).as_posix()
        folder = path.relative_to(ROOT / tree).parts[0]
        for number, is_system, name in includes(path):
            why = broken_door(file, name)
            if not is_system:
                why = why or broken_arrow(folder, name, arrows)
            if why:
                yield f"{file}:{number}: {name}: {why}"


def main():
    broken = [*check_tree("src", SRC_ARROWS), *check_tree("kernels", KERNEL_ARROWS), *check_vectors()]
    for line in broken:
        print(line)
    print(f"include arrows: {len(broken)} broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
