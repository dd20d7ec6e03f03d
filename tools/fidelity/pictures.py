"""Renders a model as its reference pictures see it, and asks pictures for what can be counted."""

import json
import os
import subprocess
from dataclasses import dataclass, field

from PIL import Image, ImageChops, ImageStat


@dataclass
class Rendered:
    picture: Image.Image | None = None  # RGBA
    albedo: Image.Image | None = None
    error: str = ""
    notes: list[str] = field(default_factory=list)


def scene_text(model, folder):
    include = json.dumps(os.path.relpath(model.path, folder), ensure_ascii=False)
    lines = [f"include = [{include}]", "[camera]"]
    return "\n".join(lines + [f"{key} = {value}" for key, value in model.camera.items()]) + "\n"


def render(onde, model, folder, samples, steady):
    """`steady`: with the albedo alone in mind, for checks that must not depend on the light."""
    scene = model.path
    if model.camera:
        scene = folder / f"{model.name}.toml"
        scene.write_text(scene_text(model, folder))
    output = folder / f"{model.name}.png"
    command = [onde, "render", scene, "-o", output, "--spp", samples, "--root", "/"]
    command += ["--size", "{}x{}".format(*model.size), "--aov", "albedo"]
    if model.camera:
        command += ["--studio", "on", "--background", "transparent"]
    if steady:
        command += ["--depth", 1, "--filter", "box"]
    run = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    said = [line.removeprefix("onde: ").strip() for line in run.stderr.splitlines()]
    if run.returncode:
        return Rendered(error=said[-1] if said else f"exit code {run.returncode}")
    # Lines of progress begin with their percentage.
    notes = [line for line in said if line and not line.split("%")[0].strip().isdigit()]
    albedo = Image.open(folder / f"{model.name}.albedo.png").convert("RGB")
    return Rendered(Image.open(output).convert("RGBA"), albedo, "", notes)


def coverage(picture):
    """Where the picture shows something, as white on black."""
    return picture.getchannel("A").point(lambda alpha: 255 if alpha > 127 else 0)


def overlap(ours, theirs):
    """Of two coverages, the area of the intersection over that of the union."""
    area = lambda mask: ImageStat.Stat(mask).sum[0]
    union = area(ImageChops.lighter(ours, theirs))
    return area(ImageChops.darker(ours, theirs)) / union if union else 1.0


def patch(picture, at, half):
    """The square of `half` its side around a point, in parts of the picture's width and height."""
    x, y = at[0] * picture.width, at[1] * picture.height
    r = half * picture.width
    return picture.crop((round(x - r), round(y - r), round(x + r), round(y + r)))


def difference(a, b):
    """The mean of the absolute differences of two patches, in 8-bit steps."""
    return sum(ImageStat.Stat(ImageChops.difference(a, b.resize(a.size))).mean) / 3


def mean_color(picture):
    return ImageStat.Stat(picture).mean
