#!/usr/bin/env python3
"""Renders every glTF model of a folder of assets as public reference pictures show it, compares what
can be compared by machine, and writes a page with a row a model.

Prints a line a model; exits 1 when one does not load or a sign of a test model is wrong, 77 when
there are no assets.
"""

import argparse
import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

import models
import page
import pictures
import scenes
import ticks
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]

# Notes that say that a picture lacks something; others tell of choices.
LOSSES = re.compile(r"KHR_materials_\w+ (is|are) ignored|left out|rendered opaque")
LEAST_OVERLAP = 0.97  # of union and intersection; the references differ by as much between themselves
PREFERRED = "blender-cycles", "vray", "three-gpu-pathtracer"


@dataclass
class Result:
    model: models.Model
    tests: str
    rendered: bool = False
    reference: str = ""  # the renderer whose picture stands beside
    broken: bool = False  # does not load, or its own signs are wrong
    reasons: list[str] = field(default_factory=list)  # why it does not pass
    remarks: list[str] = field(default_factory=list)


def described(assets):
    """What each model is there for, by its folder's name, as the index of the assets says."""
    index = assets / "INDEX.md"
    rows = index.read_text().splitlines() if index.exists() else []
    cells = [[cell.strip() for cell in row.strip("|").split(" | ")] for row in rows if row.startswith("| gltf/")]
    return {row[0]: row[-1].strip(" |") for row in cells if len(row) > 3}


def overlaps(model, rendered):
    """Of our coverage with that of each reference, by renderer."""
    found = {}
    for renderer, path in model.references.items():
        reference = Image.open(path).convert("RGBA").resize(model.size)
        if reference.getextrema()[3][0] < 255:  # else it has no alpha
            found[renderer] = pictures.overlap(pictures.coverage(rendered.picture), pictures.coverage(reference))
    return found


def departs(rendered, plain):
    """How a variant's picture differs from that of the model that it is a variant of, or nothing."""
    if pictures.overlap(pictures.coverage(rendered.picture), pictures.coverage(plain.picture)) < 0.99:
        return "has another shape than"
    if pictures.difference(rendered.albedo, plain.albedo) > 1.5:
        return "has other colours than"
    return ""


def judge(model, rendered, plain, tests):
    """`plain`: the picture of the model that this is a variant of, if it is."""
    result = Result(model, tests)
    if rendered.error:
        result.broken = True
        result.reasons.append(rendered.error)
        return result
    result.rendered = True
    result.reference = next((name for name in PREFERRED if name in model.references), "")
    result.reasons += [note for note in rendered.notes if LOSSES.search(note)]
    shares = overlaps(model, rendered)
    if shares:
        agreeing = sum(share >= LEAST_OVERLAP for share in shares.values())
        words = f"covers what {agreeing} of {len(shares)} references cover, at best to {100 * max(shares.values()):.1f} %"
        (result.remarks if agreeing else result.reasons).append(words)
    wrong = ticks.broken(model.name, rendered)
    departure = departs(rendered, plain) if plain else ""
    result.broken = bool(wrong or departure)
    if departure:
        result.reasons.append(f"{departure} {model.variant_of}")
    elif plain:
        result.remarks.append(f"the same picture as {model.variant_of}")
    if wrong:
        result.reasons.append("wrong signs: " + ", ".join(wrong))
    elif model.name in ticks.TICKS:
        result.remarks.append(f"all {len(ticks.TICKS[model.name])} signs are right")
    return result


def arguments():
    parser = argparse.ArgumentParser(prog="./run fidelity", description=__doc__.split("\n\n")[0])
    parser.add_argument("models", nargs="*", help="names of models, or of scenes (all)")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build/fidelity", help="folder of the page")
    parser.add_argument("--assets", type=Path, default=ROOT.parent / "shared/assets")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--onde", type=Path, default=ROOT / "build/onde/onde")
    parser.add_argument("--signs", action="store_true", help="only models with signs and compressed variants, hardly lit")
    parser.add_argument("--scenes", action="store_true", help="scenes of pbrt and Mitsuba beside their references")
    return parser.parse_args()


def main():
    options = arguments()
    if options.scenes:
        return scenes.compare(options)
    found = models.models(options.assets)
    if not found:
        print(f"there are no models in {options.assets}/gltf; name a folder that has some with --assets")
        return 77
    names = {model.name for model in found}
    signed = set(ticks.TICKS) | {name for model in found if model.variant_of for name in (model.name, model.variant_of)}
    wanted = set(options.models) or (signed & names if options.signs else names)
    unknown = wanted - names
    if unknown:
        print(f"there is no model {', '.join(sorted(unknown))} in {options.assets}/gltf", file=sys.stderr)
        return 2
    options.output.mkdir(parents=True, exist_ok=True)
    words = described(options.assets)
    results, seen = [], {}
    for model in (model for model in found if model.name in wanted):
        rendered = pictures.render(options.onde, model, options.output, options.spp, options.signs)
        seen[model.name] = rendered
        tests = words.get(str(model.path.relative_to(options.assets)), "")
        results.append(judge(model, rendered, seen.get(model.variant_of), tests))
        print(f"{model.name}: {'; '.join(results[-1].reasons) or 'pass'}", flush=True)
    page.write(results, options.output)
    print(f"the page: {options.output / 'index.html'}")
    return 1 if any(result.broken for result in results) else 0


if __name__ == "__main__":
    sys.exit(main())
