#!/usr/bin/env python3
"""Writes kernels/probe/layout.h: every field of every struct that host and device share.

The test of layouts compares what both compilers make of that list. With --check nothing is written;
exits 1 when the file is not what it would be.
"""

import re
import subprocess
import sys
from pathlib import Path

KERNELS = Path(__file__).resolve().parent.parent / "kernels"
TARGET = KERNELS / "probe" / "layout.h"
HEAD = """// Every field of every shared struct, once, for both compilers: SIZE(Type) and OFFSET(Type, field)
// are the includer's. Written by tools/list_fields.py from shared/*.h.
#ifndef ONDE_PROBE_LAYOUT_H
#define ONDE_PROBE_LAYOUT_H

"""
TOKEN = re.compile(r"[A-Za-z_]\w*|[{};]|\[[^\]]*\]|,|[^\s]")


def preprocessed(headers):
    text = "".join(f'#include "{name}"\n' for name in headers)
    run = ["c++", "-E", "-P", "-x", "c", "-I", str(KERNELS), "-"]
    return subprocess.run(run, input=text, capture_output=True, text=True, check=True).stdout


def members(tokens, prefix, types):
    """Consumes a block after its '{'; yields the paths of the fields in it."""
    while tokens[0] != "}":
        if tokens[0] in ("struct", "union"):
            del tokens[:2]
            inner = list(members(tokens, "", types))
            name = tokens.pop(0)
            yield from (f"{prefix}{name}.{field}" for field in inner)
        else:
            kind = tokens.pop(0)
            while tokens[0] != ";":
                name = tokens.pop(0)
                if name == "," or name.startswith("["):
                    continue
                yield f"{prefix}{name}"
                yield from (f"{prefix}{name}.{field}" for field in types.get(kind, []))
        assert tokens.pop(0) == ";"
    tokens.pop(0)


def structs(text):
    """Type names and the paths of their fields, in order."""
    tokens = TOKEN.findall(text)
    types = {}
    while tokens:
        if tokens.pop(0) == "typedef" and tokens[0] in ("struct", "union"):
            del tokens[:2]
            fields = list(members(tokens, "", types))
            types[tokens.pop(0)] = fields
    return types


def layout():
    headers = sorted(f"shared/{path.name}" for path in (KERNELS / "shared").glob("*.h"))
    lines = ["#define SHARED_LAYOUT(SIZE, OFFSET)"]
    for name, fields in structs(preprocessed(headers)).items():
        lines.append(f"    SIZE({name})")
        lines += [f"    OFFSET({name}, {field})" for field in fields]
    body = "\n".join(f"{line:<99}\\" for line in lines[:-1]) + "\n" + lines[-1] + "\n\n#endif\n"
    return HEAD + "".join(f'#include "{name}"\n' for name in headers) + "\n" + body


def main():
    text = layout()
    if "--check" not in sys.argv[1:]:
        TARGET.write_text(text, encoding="utf-8")
        return 0
    if TARGET.read_text(encoding="utf-8") == text:
        return 0
    print(f"{TARGET.name} is out of step with kernels/shared; run tools/list_fields.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
