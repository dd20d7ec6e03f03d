"""What models of the glTF sample collection show to be judged by, looked up by machine: places that
must look the same, or have a colour. Places are parts of the picture's width and height, as the
reference cameras see them.
"""

from dataclasses import dataclass
from typing import Callable

from pictures import Rendered, difference, mean_color, patch
from PIL import ImageStat


@dataclass
class Tick:
    words: str
    holds: Callable[[Rendered], bool]


SHIFTS = [step / 512 for step in range(-4, 5)]  # no two signs hang quite straight


def same(words, half, first, second, most=12.0, channel="albedo"):
    def holds(rendered):
        picture = getattr(rendered, channel).convert("RGB")
        wanted = patch(picture, first, half)
        shifted = ((second[0] + dx, second[1] + dy) for dx in SHIFTS for dy in SHIFTS)
        return min(difference(wanted, patch(picture, at, half)) for at in shifted) <= most

    return Tick(words, holds)


def colored(words, at, color, half=0.006, most=40.0):
    def holds(rendered):
        found = mean_color(patch(rendered.albedo, at, half))
        return max(abs(a - b) for a, b in zip(found, color)) <= most

    return Tick(words, holds)


def greenish(words, at, is_so, half=0.012):
    def holds(rendered):
        red, green, _ = mean_color(patch(rendered.albedo, at, half))
        return (green > red + 20) == is_so

    return Tick(words, holds)


def texture_settings():
    rows = ["single-sided", "double-sided", "clamp s", "clamp t", "repeat s", "repeat t", "mirror s", "mirror t"]
    heights = [0.297, 0.377, 0.462, 0.542, 0.626, 0.711, 0.795, 0.879]
    return [same(row, 0.03, (0.535, y), (0.707, y)) for row, y in zip(rows, heights)]


def negative_scale():
    ticks = []
    for scale, y in ("1", 0.249), ("-1", 0.359):
        ticks.append(same(f"front, scale {scale}", 0.033, (0.498, y), (0.853, y)))
        ticks.append(same(f"back, scale {scale}", 0.033, (0.676, y), (0.853, y)))
    for material, y in ("white", 0.593), ("dark blue", 0.711), ("metal", 0.824):
        ticks.append(same(f"{material} spheres", 0.02, (0.592, y), (0.776, y)))
    return ticks


def vertex_color():
    columns = ("red", 0.330), ("green", 0.498), ("blue", 0.676)
    return [same(name, 0.055, (x, 0.399), (x, 0.659)) for name, x in columns]


def texture_transform():
    places = (0.143, 0.82), (0.505, 0.674), (0.81, 0.74)
    ticks = [
        colored("offset along u", (0.04, 0.216), (0, 190, 0)),
        colored("offset along v", (0.374, 0.216), (0, 0, 190)),
        colored("offset along both", (0.707, 0.216), (0, 190, 190)),
    ]
    names = "rotation", "scale", "all three"
    return ticks + [greenish(name, at, True) for name, at in zip(names, places)]


def texture_encoding():
    columns = 0.322, 0.516, 0.712, 0.905
    ticks = []
    for row, y, channel in ("base colour", 0.342, "albedo"), ("emission", 0.62, "picture"):
        for name, x in zip(("plain texture", "texture with gamma", "texture with profile"), columns[1:]):
            ticks.append(same(f"{row}: {name}", 0.025, (columns[0], y), (x, y), channel=channel))
    return ticks


def alpha_modes():
    ticks = []
    for name, x, top in ("cutoff 0.25", 0.498, 0.425), ("default cutoff", 0.66, 0.505), ("cutoff 0.75", 0.82, 0.579):
        ticks.append(greenish(f"{name}: gone above it", (x, top - 0.04), False))
        ticks.append(greenish(f"{name}: there below", (x, top + 0.04), True))
    return ticks


def texture_coordinates():
    return [
        colored("top left", (0.29, 0.29), (231, 231, 0)),
        colored("top right", (0.707, 0.36), (231, 80, 0)),
        colored("bottom left", (0.29, 0.64), (0, 115, 231)),
        colored("bottom right", (0.707, 0.64), (0, 231, 0)),
    ]


def unlit():
    def flat(rendered):
        sides = [patch(rendered.picture.convert("RGB"), (x, 0.5), 0.12) for x in (0.27, 0.73)]
        return all(max(ImageStat.Stat(side).stddev) < 2 for side in sides)

    return [
        colored("left", (0.27, 0.5), (255, 128, 0)),
        colored("right", (0.73, 0.5), (0, 128, 255)),
        Tick("no light on either", flat),
    ]


def several_uv_sets():
    def logo(rendered):
        return max(ImageStat.Stat(patch(rendered.picture.convert("RGB"), (0.5, 0.5), 0.25)).stddev) > 12

    return [Tick("the second set's logo shows", logo)]


def normal_tangents():
    ticks = []
    columns = ("plain", 0.22, 0.322), ("blue", 0.447, 0.546)
    for name, left, right in columns:
        for row, y in enumerate((0.275, 0.388, 0.501, 0.614, 0.727)):
            ticks.append(same(f"{name}, row {row + 1}", 0.03, (left, y), (right, y), 16.0, "picture"))
    return ticks


TICKS = {
    "AlphaBlendModeTest": alpha_modes(),
    "MultiUVTest": several_uv_sets(),
    "NegativeScaleTest": negative_scale(),
    "NormalTangentTest": normal_tangents(),
    "TextureCoordinateTest": texture_coordinates(),
    "TextureEncodingTest": texture_encoding(),
    "TextureSettingsTest": texture_settings(),
    "TextureTransformTest": texture_transform(),
    "UnlitTest": unlit(),
    "VertexColorTest": vertex_color(),
}


def broken(name, rendered):
    """The words of those that don't hold."""
    return [tick.words for tick in TICKS.get(name, []) if not tick.holds(rendered)]
