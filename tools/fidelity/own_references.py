"""References of our own, for Mitsuba's tests whose environment may not be had: the same scenes under
a map of ours, made by make_references.py. It knows where they are and how such a scene is read.
"""

import os
import shutil
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "tests/data/references"
SKY = FOLDER / "sky.exr"
MISSING_MAP = "textures/museum.exr"


def lacks_map(path):
    """Whether a test of Mitsuba's shows the missing map, itself or by what it includes."""
    files = [path, *(path.parent / "fragments").glob("*.xml")]
    included = [file for file in files if file == path or file.name in path.read_text()]
    return any(MISSING_MAP in file.read_text() for file in included) and not (
        path.parents[3] / "common" / MISSING_MAP
    ).exists()


def under_our_sky(path, folder):
    """Writes, in a folder, a scene that is the test under our map, for Onde and for Mitsuba."""
    sky = folder / "sky" / MISSING_MAP
    sky.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(SKY, sky)
    searched = folder / "sky", path.parents[3] / "common", path.parent
    lines = [f'    <path value="{os.path.relpath(place, folder)}"/>' for place in searched]
    scene = folder / f"{path.stem}.under_our_sky.xml"
    scene.write_text("\n".join(['<scene version="3.0.0">', *lines, f'    <include filename="{path.name}"/>', "</scene>"]))
    return scene


def reference(name):
    """A test's mean, and the variance of one sample."""
    return FOLDER / f"{name}.exr", FOLDER / f"{name}.variance.exr"
