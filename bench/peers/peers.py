#!/usr/bin/env python3
"""The same scenes in Onde and in other renderers of this machine: whether they show the same light, how
fast each is, how noisy, and how long each takes to the same error.
"""

import argparse
import json
import os
import platform
import subprocess
import sys
from datetime import date
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import peer_python

OWN_PACKAGES = ["numpy", "pillow", "OpenEXR"]
PEER_PACKAGES = ["bpy", "mitsuba", "pyluxcore"]


def positive(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text}: must be at least 1")
    return number


def arguments():
    parser = argparse.ArgumentParser(prog="./run bench peers", description=__doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="names of built-in scenes, .gltf or .glb files (six scenes)")
    parser.add_argument("--size", type=positive, default=256, help="width and height in pixels (256)")
    parser.add_argument("--spp", type=positive, default=64, help="samples a pixel (64)")
    parser.add_argument("--repeats", type=positive, default=2, help="timed runs of each, interleaved (2)")
    parser.add_argument("--threads", type=positive, default=len(os.sched_getaffinity(0)), help="of each renderer (all)")
    parser.add_argument("--peers", default="", help="which, with commas between (all that can be installed)")
    parser.add_argument("--environment", type=Path, help="an equirectangular .exr or .hdr in place of the built-in sky")
    parser.add_argument("--reference-seconds", type=float, default=5, help="for the reference of each, of 2 to 16 runs (5)")
    parser.add_argument("--quick", action="store_true", help="64x64, 4 samples: whether everything works")
    parser.add_argument("--onde", type=Path, default=ROOT / "build/onde/onde")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build/peers/results", help="folder of peers.json, peers.md, pictures")
    return parser.parse_args()


def settings_of(options):
    settings = {"size": options.size, "spp": options.spp, "repeats": options.repeats, "threads": options.threads, "references": 16,
                "reference_seconds": options.reference_seconds, "onde": str(options.onde.resolve()),
                "mitsuba_variant": "llvm_ad_rgb" if peer_python.llvm_library() else "scalar_rgb"}
    if options.quick:
        settings |= {"size": 64, "spp": 4, "repeats": 1, "references": 2}
    return settings


def machine():
    """The processor's name, where the system tells it."""
    told = Path("/proc/cpuinfo")
    names = [line.split(":", 1)[1].strip() for line in told.read_text().splitlines() if line.startswith("model name")] if told.exists() else []
    return names[0] if names else platform.machine()


def show(picture, path):
    import numpy as np
    from PIL import Image

    Image.fromarray((255 * np.clip(picture, 0, 1) ** (1 / 2.2)).astype(np.uint8)).save(path)


def chosen_peers(options, installed):
    from runner import PEERS

    wanted = [name for name in options.peers.split(",") if name] or list(PEERS)
    unknown = [name for name in wanted if name not in PEERS]
    if unknown:
        sys.exit(f"there is no peer {', '.join(unknown)}; there are {', '.join(PEERS)}")
    return [name for name in wanted if PEERS[name][1] in installed]


def main():
    options = arguments()
    peer_python.enter(OWN_PACKAGES, PEER_PACKAGES)
    import race
    import report
    import scenes

    installed = {name: version for name, version in peer_python.versions().items() if name in PEER_PACKAGES}
    if strange := scenes.unknown(options.scenes):
        sys.exit(f"{strange[0]}: no scene of that name, and no .gltf or .glb file; the scenes are {', '.join(scenes.BUILT_IN)}")
    settings, names = settings_of(options), ["onde", *chosen_peers(options, installed)]
    if settings["mitsuba_variant"] == "scalar_rgb" and "mitsuba" in names:
        print(f"Mitsuba renders without LLVM, ten times slower: install libllvm19 (any from {peer_python.OLDEST_LLVM} on)", file=sys.stderr)
    version = subprocess.run([settings["onde"], "--version"], capture_output=True, text=True).stdout.split()[-1]
    run = {"date": str(date.today()), "machine": machine(), "versions": {"onde": version, **installed},
           "settings": settings, "scenes": {}}
    options.output.mkdir(parents=True, exist_ok=True)
    for name in options.scenes or scenes.USUAL:
        folder = peer_python.FOLDER / "scenes" / Path(name).stem
        race.say(f"{name}:")
        scene = scenes.make(name, folder, options.environment)
        results = race.race(scene, folder, names, settings)
        for peer, result in results.items():
            if "picture" in result:
                show(result.pop("picture"), options.output / f"{scene.name}.{peer}.png")
        run["scenes"][scene.name] = results
        print(report.scene_text(scene.name, results) + "\n", flush=True)
        (options.output / "peers.json").write_text(json.dumps(run, indent=1))
        (options.output / "peers.md").write_text(report.markdown(run))
    race.say(f"wrote {options.output}/peers.json and peers.md")


if __name__ == "__main__":
    main()
