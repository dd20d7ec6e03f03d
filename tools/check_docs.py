#!/usr/bin/env python3
"""Holds README.md and docs/*.md to the tree: they name only files that exist, and every word of an
enum that users can write stands in some of them.

Prints each fault and ends with a count; exits 1 when there is any.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("src/", "kernels/", "tests/", "tools/", "docs/", "bench/", "scenes/", "cmake/", "include/")

LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
CODE = re.compile(r"`([^`\n]+)`")
TEST = re.compile(r"[a-z]+/[a-z0-9_]+_test")
SCENE = re.compile(r"[a-z0-9-]+(?:/[a-z0-9-]+)*\.toml")
ENUM_WORD = re.compile(r'EnumWord\{\s*[\w:]+::\w+,\s*"([^"]+)"')
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)


def pages():
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def named_file(word):
    """The path from ROOT that a word between backticks names, or None; NAME stands for any."""
    if "NAME" in word:
        return None
    if TEST.fullmatch(word):
        return f"tests/{word}.cpp"
    if word.startswith(FOLDERS) and re.fullmatch(r"[\w./-]+", word):
        return word
    if SCENE.fullmatch(word) and word.startswith("chapter/"):
        return f"scenes/{word}"
    return None


def missing_files(page):
    """Every file that a page names and that does not exist, as a line to print."""
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        targets = {page.parent / t: t for t in LINK.findall(line) if ":" not in t}
        for code in CODE.findall(line):
            for word in code.split():
                path = named_file(word.rstrip(":,"))
                if path:
                    targets[ROOT / path] = word
        for target, name in targets.items():
            if not target.exists():
                yield f"{page.relative_to(ROOT)}:{number}: {name}: no such file"


def documented_words():
    """What stands between backticks or in code blocks of the pages."""
    words = set()
    for page in pages():
        text = page.read_text(encoding="utf-8")
        blocks = FENCE.findall(text)
        for code in [*blocks, *CODE.findall(FENCE.sub("", text))]:
            words.update(re.findall(r"[a-z0-9]+(?:-[a-z0-9]+)*", code))
    return words


def missing_words():
    """Every enum word that no page documents, as a line to print."""
    documented = documented_words()
    for file in sorted((ROOT / "src").rglob("*")):
        if file.suffix not in {".h", ".cpp"} or file.name == "enum_words.h":
            continue
        for word in ENUM_WORD.findall(file.read_text(encoding="utf-8")):
            if word not in documented:
                yield f"{file.relative_to(ROOT)}: \"{word}\" stands in no page of the documentation"


def main():
    faults = [line for page in pages() for line in missing_files(page)]
    faults += missing_words()
    for line in faults:
        print(line)
    print(f"documentation: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
