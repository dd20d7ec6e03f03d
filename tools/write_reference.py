#!/usr/bin/env python3
"""Writes the tables that `onde reference` prints into docs/scene-format.md, between their markers.

usage: tools/write_reference.py [PROGRAM], by default build/onde/onde. A test of tests/scene holds
the page to the tables.
"""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/scene-format.md"
BLOCK = re.compile(r"<!-- table (.*?) -->\n.*?<!-- end -->\n", re.DOTALL)


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/onde/onde"
    printed = subprocess.run([program, "reference"], capture_output=True, text=True, check=True)
    blocks = {match[1]: match[0] for match in BLOCK.finditer(printed.stdout)}
    text = PAGE.read_text(encoding="utf-8")
    missing = blocks.keys() - {match[1] for match in BLOCK.finditer(text)}
    written = BLOCK.sub(lambda match: blocks.get(match[1], match[0]), text)
    PAGE.write_text(written, encoding="utf-8")
    for name in sorted(missing):
        print(f"{PAGE.relative_to(ROOT)}: add the lines <!-- table {name} --> and <!-- end -->")
    print(f"{len(blocks)} tables, {'changed' if written != text else 'unchanged'}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
