#!/usr/bin/env python3
"""Holds the #include lines of src/ and kernels/ to the arrows of the house: down only. And the
vectors of 16 to the header that owns them, and every kernel file to a place where it is used.

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
    "denoise": {"core", "image", "gpu", "shared"},
    "upload": {"core", "image", "scene", "accel", "gpu", "shared"},
    "render": {"core", "image", "scene", "accel", "gpu", "upload", "shared"},
    "film": {"core", "image", "scene", "accel", "gpu", "upload", "render", "shared"},
    "farm": {"core", "image", "scene", "accel", "gpu", "upload", "render", "film", "shared"},
    "mpi": {"core", "farm"},
    "chapter": {"core", "image", "scene", "accel", "gpu", "upload", "render", "shared"},
    "session": {"core", "image", "scene", "accel", "gpu", "denoise", "upload", "render", "film", "chapter", "shared"},
    "doctor": {"core", "image", "scene", "accel", "gpu", "denoise", "upload", "render", "film", "chapter", "session", "shared",
               "probe"},
    "app": {"core", "image", "scene", "accel", "gpu", "denoise", "upload", "render", "film", "farm", "mpi", "chapter", "session", "doctor",
            "shared"},
}
SHADE = {"shared", "math", "trace", "shade"}
ESTIMATORS = {"path", "light_tracing", "chapter"}
KERNEL_ARROWS = {
    "shared": set(),
    "math": {"shared"},
    "trace": {"shared", "math"},
    "shade": {"shared", "math", "trace"},
    "film": {"shared", "math"},
    "denoise": {"shared", "math"},
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
    (re.compile(r"CL/"), re.compile(r"src/(gpu|upload|render|film|chapter)/"), "OpenCL is for gpu, upload, render, film, chapter"),
    (re.compile(r"png\.h|jpeglib|webp/|tiffio|Imf|openexr\.h|stb/|stored_image"), re.compile(r"src/image/"), "pictures are for image_io.h"),
    (re.compile(r"CLI/"), re.compile(r"src/core/command_line\.cpp"), "only command_line.cpp opens it"),
    (re.compile(r"mpi\.h"), re.compile(r"src/mpi/present/"), "MPI is for src/mpi"),
    (re.compile(r"pugixml"), re.compile(r"src/scene/mitsuba/"), "XML is for the reader of Mitsuba's scenes"),
    (re.compile(r"embree"), re.compile(r"^$"), "Embree is an oracle for tests, not for the renderer"),
]

# Readers of file formats, folders of src/scene, which know nothing of each other.
READERS = {"gltf", "obj", "ply", "stl", "toml", "pbrt", "mitsuba"}

# Everywhere else in the kernels, code is written for any width, real, or for sixteen, real16.
VECTOR_OF_16 = re.compile(r"\b(as_)?(float|u?int)16\b")
OWNS_THE_WIDTH = "kernels/math/lanes.h"

# Folders whose files are lines of a list of kernels/shared/scene.h: LINE(NAME, name, ...).
LISTS = {"kernels/shade/lobes": "LOBE", "kernels/shade/lights": "LIGHT"}

KERNEL_NAME = re.compile(r'"([\w./]+\.(?:cl|h))"')
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


def broken_reader(file, name):
    """Why a reader's `file` may not include "name", or None."""
    own, other = (re.match(r"(?:src/)?scene/(\w+)/", text) for text in (file, name))
    if own and other and own[1] != other[1] and {own[1], other[1]} <= READERS:
        return f"the reader of {own[1]} may not know that of {other[1]}"
    return None


def broken_door(file, name):
    """Why `file` may not include <name>, or None."""
    for header, allowed, why in DOORS:
        if header.match(name) and not allowed.match(file):
            return why
    return None


def check_vectors():
    """Every float16 outside the header that owns the width, as a line to print."""
    for path in sorted((ROOT / "kernels").rglob("*")):
        file = path.relative_to(ROOT).as_posix()
        if path.suffix not in SOURCES or file == OWNS_THE_WIDTH:
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if match := VECTOR_OF_16.search(line.split("//")[0]):
                yield f"{file}:{number}: {match[0]}: only {OWNS_THE_WIDTH} names it; write real"


def names_of_kernels(folders):
    """Every text in quotes that may name a kernel file: of an #include, or of a program."""
    for folder in folders:
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in SOURCES:
                yield from KERNEL_NAME.findall(path.read_text(encoding="utf-8"))


def check_used():
    """Every kernel file that nothing includes and no program names, as a line to print."""
    named = set(names_of_kernels(["kernels", "src", "tests", "bench"]))
    for path in sorted((ROOT / "kernels").rglob("*")):
        parts = path.relative_to(ROOT / "kernels").parts
        if path.suffix not in SOURCES or named & {"/".join(parts[k:]) for k in range(len(parts))}:
            continue
        yield f"{path.relative_to(ROOT).as_posix()}: nothing includes it and no program names it"


def check_lists():
    """Every file of a folder of LISTS that its list forgets, as a line to print."""
    scene = (ROOT / "kernels/shared/scene.h").read_text(encoding="utf-8")
    for folder, line in LISTS.items():
        listed = set(re.findall(rf"\b{line}\([A-Z_]+, (\w+),", scene))
        shared = {Path(name).stem for name in names_of_kernels([folder])}
        for path in sorted((ROOT / folder).glob("*.h")):
            if path.stem not in listed | shared:
                yield f"{folder}/{path.name}: no line {line}(...) of kernels/shared/scene.h has it"


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
                why = why or broken_arrow(folder, name, arrows) or broken_reader(file, name)
            if why:
                yield f"{file}:{number}: {name}: {why}"


def main():
    broken = [*check_tree("src", SRC_ARROWS), *check_tree("kernels", KERNEL_ARROWS), *check_vectors(),
              *check_used(), *check_lists()]
    for line in broken:
        print(line)
    print(f"include arrows: {len(broken)} broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
