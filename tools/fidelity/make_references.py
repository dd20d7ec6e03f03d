#!/usr/bin/env python3
"""Renders those of Mitsuba's tests whose environment may not be had with PyPI's Mitsuba under a sky
of our own, into tests/data/references: the mean of many samples, and the variance of one, by which
`./run fidelity --scenes` tests whether noise explains how Onde's pictures differ.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import own_references
import peer_python

DEPTH = 2  # surfaces, as all those tests ask for
WIDTH, HEIGHT = 128, 64  # of the sky


def sky():
    """A gradient, a soft sun and a ground of two colours, smooth enough that texels don't matter.
    The middle of the map is -Z of Mitsuba's, +Y is up."""
    v, u = np.meshgrid((np.arange(HEIGHT) + 0.5) / HEIGHT, (np.arange(WIDTH) + 0.5) / WIDTH, indexing="ij")
    theta, phi = np.pi * v, 2 * np.pi * u
    direction = np.stack([np.sin(phi) * np.sin(theta), np.cos(theta), -np.cos(phi) * np.sin(theta)], -1)
    up = direction[..., 1:2]
    above = 1 / (1 + np.exp(-12 * up))  # a soft horizon
    zenith, horizon = np.array([0.15, 0.3, 0.7]), np.array([0.7, 0.75, 0.8])
    heaven = horizon + (zenith - horizon) * np.clip(up, 0, 1) ** 0.5
    around = 0.5 + 0.5 * np.sin(phi)[..., None]
    ground = np.array([0.25, 0.12, 0.05]) * around + np.array([0.05, 0.2, 0.08]) * (1 - around)
    to_sun = np.array([-0.6, 0.6, 0.5]) / np.linalg.norm([-0.6, 0.6, 0.5])
    sun = np.exp(30 * (direction @ to_sun - 1))[..., None] * np.array([9.0, 8.0, 6.5])
    return heaven * above + ground * (1 - above) + sun


def write(picture, path, component, words):
    bitmap = mi.Bitmap(np.ascontiguousarray(picture, np.float32)).convert(
        mi.Bitmap.PixelFormat.RGB, getattr(mi.Struct.Type, component), False)
    for key, value in words.items():
        bitmap.metadata()[key] = str(value)
    bitmap.write(str(path))


def squares():
    """Mitsuba's path tracer that keeps the square of each sample beside it."""
    nested = mi.load_dict({"type": "path", "max_depth": DEPTH})

    class Squares(mi.SamplingIntegrator):
        def sample(self, scene, sampler, ray, medium=None, active=True):
            color, valid, _ = nested.sample(scene, sampler, ray, medium, active)
            return color, valid, [color[channel] ** 2 for channel in range(3)]

        def aov_names(self):
            return ["square.R", "square.G", "square.B"]

    return Squares(mi.Properties("squares"))


def render(scene, samples, passes):
    """The mean, and the variance of one sample, by passes of that many samples, each of its own seed."""
    integrator, sums = squares(), 0
    for seed in range(passes):
        sums = sums + np.array(mi.render(scene, integrator=integrator, spp=samples, seed=seed), np.float64)
    mean, square = sums[..., :3] / passes, sums[..., -3:] / passes
    return mean, np.maximum(square - mean**2, 0)


def arguments():
    parser = argparse.ArgumentParser(prog="tools/fidelity/make_references.py", description=__doc__)
    parser.add_argument("--assets", type=Path, default=ROOT.parent / "shared/assets")
    parser.add_argument("--samples", type=int, default=1024, help="of a pass")
    parser.add_argument("--passes", type=int, default=32)
    return parser.parse_args()


def main():
    options = arguments()
    own_references.FOLDER.mkdir(parents=True, exist_ok=True)
    made_by = {"renderer": f"Mitsuba {mi.__version__}", "sampler": "independent",
               "samples": options.samples * options.passes, "seeds": f"0 to {options.passes - 1}"}
    write(sky(), own_references.SKY, "Float16", {"made by": "tools/fidelity/make_references.py"})
    tests = [path for path in sorted((options.assets / "mitsuba-data/tests/scenes").glob("*/*.xml"))
             if own_references.lacks_map(path)]
    if not tests:
        sys.exit(f"no test of {options.assets}/mitsuba-data lacks its map; name the assets with --assets")
    with tempfile.TemporaryDirectory() as folder:
        for path in tests:
            name = path.stem.rsplit("_", 1)[0]
            scene = mi.load_file(str(own_references.under_our_sky(path, Path(folder))))
            pictures = render(scene, options.samples, options.passes)
            for picture, file, component in zip(pictures, own_references.reference(name), ("Float32", "Float16")):
                write(picture, file, component, made_by)
            print(f"{name}: mean {pictures[0].mean():.5f}", flush=True)
    (own_references.FOLDER / "references.json").write_text(json.dumps({**made_by, "depth": DEPTH}, indent=2) + "\n")


if __name__ == "__main__":
    peer_python.enter(["mitsuba", "numpy"])
    import mitsuba as mi
    import numpy as np

    mi.set_variant("llvm_ad_rgb")
    main()
