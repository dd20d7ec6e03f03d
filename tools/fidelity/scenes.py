"""Scenes of other renderers beside the pictures that those made of them: pbrt scenes by their means,
Mitsuba's reference tests by a Z-test with the variance that stands beside each reference.
"""

import html
import json
import os
import struct
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import own_references
from page import STYLE

MOST_OFF = 0.02  # of the mean
LEAST_WITHIN = 0.9975  # of all samples, as Mitsuba's own tests ask for
DEPTH = 65  # of the references of pbrt scenes

# What Onde lacks of a scene, or the reference has otherwise. Other scenes must agree.
LACKS = {
    "dining-room": "the reference's sun has a size, and its sky stands upright",
    "veach-bidir": "nothing that is known: 2.2 % brighter than the reference",
    "veach-mis": "the reference has Beckmann's distribution, which pbrt's files can't name",
    "test_arealight": "rough plastic, of which Mitsuba's returns 2.6 % less than its smooth one",
    "test_bumpmap": "bump maps, whose lack shows in more than 64 samples",
    "test_roughplastic_linear": "rough plastic as dark as Mitsuba's, most at roughness 1",
    "test_roughplastic_nonlinear": "rough plastic as dark as Mitsuba's",
    "test_textured_roughconductor": "amorphous carbon (a-C), and textures of metals' roughness",
    "test_texturedprincipled1": "principled materials' own lobes, and textures of their numbers",
    "test_texturedprincipled2": "principled materials' own lobes, and textures of their numbers",
    "test_texturedprincipledthin": "principled materials' own lobes, and textures of their numbers",
}


@dataclass
class Scene:
    name: str
    path: Path
    reference: Path
    variance: Path | None  # of one sample of the reference
    root: Path
    arguments: list = field(default_factory=list)


@dataclass
class Verdict:
    scene: Scene
    words: str
    agrees: bool = False
    lacks: str = ""


def pbrt_scenes(assets):
    for path in sorted(assets.glob("pbrt/*/scene-v4.pbrt")):
        reference = path.parent / "TungstenRender.exr"
        if reference.exists():
            yield Scene(path.parent.name, path, reference, None, path.parent, ["--depth", DEPTH])


def mitsuba_scenes(assets, folder):
    """Beside Mitsuba's references; beside our own, under our own sky, where their map may not be had."""
    root = assets / "mitsuba-data"
    for path in sorted(root.glob("tests/scenes/*/*.xml")):
        name = path.stem.rsplit("_", 1)[0]
        reference = path.parent / "refs" / f"{name}_ref_rgb.exr"
        if own_references.lacks_map(path):
            scene = own_references.under_our_sky(path, folder)
            yield Scene(name, scene, *own_references.reference(name), Path("/"))
        elif reference.exists():
            yield Scene(name, path, reference, reference.with_name(f"{name}_ref_rgb_var.exr"), root)


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    lines = [line.removeprefix("onde: ") for line in done.stderr.splitlines()]
    return done.returncode, done.stdout, lines


def size_of(picture):
    """Width and height of an .exr, from its header."""
    name = b"dataWindow\0box2i\0"
    header = picture.read_bytes()[:4096]
    left, top, right, bottom = struct.unpack_from("<4i", header, header.index(name) + len(name) + 4)
    return right - left + 1, bottom - top + 1


def show(onde, picture, output):
    """Writes an .exr as .png, as Onde shows light: a rectangle that glows by it, seen by parallel rays."""
    width, height = size_of(picture)
    texture = json.dumps(os.path.relpath(picture, output.parent))
    scene = output.with_suffix(".toml")
    scene.write_text(
        f"""film.size = [{width}, {height}]
render = {{ samples = 1, filter = "box", tone_map = "none" }}
camera = {{ position = [0, 0, 1], look_at = [0, 0, 0], orthographic_height = 2 }}
material = [{{ name = "picture", kind = "unlit", base_color = 1, base_color_texture = {texture}, wrap = "clamp" }}]
shape = [{{ type = "rectangle", size = [{2 * width / height}, 2], material = "picture" }}]
"""
    )
    run([onde, "render", scene, "-o", output, "--root", "/"])
    scene.unlink()


def mean(onde, picture):
    return json.loads(run([onde, "compare", picture, picture, "--json"])[1])["mean_a"]


def judge(onde, scene, folder, samples):
    picture = folder / f"{scene.name}.exr"
    code, _, notes = run([onde, "render", scene.path, "-o", picture, "--root", scene.root, "--spp", samples, *scene.arguments])
    if code:
        return Verdict(scene, notes[-1] if notes else f"exit code {code}")
    ratio = mean(onde, picture) / mean(onde, scene.reference)
    verdict = Verdict(scene, f"mean {100 * (ratio - 1):+.2f} %", lacks=LACKS.get(scene.name, ""))
    verdict.agrees = abs(ratio - 1) <= MOST_OFF
    if scene.variance:
        test = [onde, "compare", picture, scene.reference, "--variance", scene.variance, "--samples", samples, "--json"]
        within = json.loads(run(test)[1])["within_noise"]
        verdict.words += f", {100 * within:.2f} % within noise"
        verdict.agrees = within >= LEAST_WITHIN
    return verdict


def row(verdict, folder, onde):
    name = verdict.scene.name
    cells = [f"<b>{html.escape(name)}</b>"]
    for kind, picture in ("onde", folder / f"{name}.exr"), ("reference", verdict.scene.reference):
        shown = folder / f"{name}.{kind}.png"
        if picture.exists():
            show(onde, picture, shown)
        cells.append(f'<img src="{html.escape(shown.name)}" alt="{kind}">' if shown.exists() else "no picture")
    word = "agrees" if verdict.agrees else "lacks" if verdict.lacks else "differs"
    cells.append(f'<b class="{"pass" if verdict.agrees else "fails"}">{word}</b><br>{html.escape(verdict.words)}'
                 f'<br>{html.escape(verdict.lacks)}')
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def compare(options):
    """Exit code: 1 when a scene differs of which Onde lacks nothing, 77 when there are none."""
    options.output.mkdir(parents=True, exist_ok=True)
    found = [*pbrt_scenes(options.assets), *mitsuba_scenes(options.assets, options.output)]
    wanted = [scene for scene in found if not options.models or scene.name in options.models]
    if not wanted:
        print(f"there are no such scenes in {options.assets}/pbrt and mitsuba-data; name their folder with --assets")
        return 77
    verdicts = []
    for scene in wanted:
        verdicts.append(judge(options.onde, scene, options.output, options.spp))
        verdict = verdicts[-1]
        word = "agrees" if verdict.agrees else f"lacks {verdict.lacks}" if verdict.lacks else "DIFFERS"
        print(f"{scene.name}: {verdict.words}: {word}", flush=True)
    rows = "\n".join(row(verdict, options.output, options.onde) for verdict in verdicts)
    (options.output / "scenes.html").write_text(
        f"""<!doctype html><html lang="en"><meta charset="utf-8"><title>Onde: scenes</title><style>{STYLE}</style>
<h1>Scenes of other renderers</h1><p>{sum(v.agrees for v in verdicts)} of {len(verdicts)} agree with the pictures that those made of them.</p>
<table><tr><th>scene<th>Onde<th>reference<th>verdict</tr>
{rows}
</table></html>
"""
    )
    print(f"the page: {options.output / 'scenes.html'}")
    return 1 if any(not verdict.agrees and not verdict.lacks for verdict in verdicts) else 0
