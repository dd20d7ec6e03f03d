#!/usr/bin/env python3
"""Kills renders with checkpoints, workers and merges at random times, by SIGKILL, and has them go on:
each must end in the bytes of one undisturbed render, and no half film may ever be seen.

tools/kill_films.py [--kills 200] [--onde build/onde/onde] [--seed 1]
Prints a line for each round, ends with a count, and exits 1 when anything went wrong.
"""

import argparse
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PICTURE = [str(ROOT / "scenes/cornell.toml"), "--size", "96x72", "--spp", "700", "--quiet"]
NOISE = ["--noise", "0.04"]


class Trial:
    """Kills of one kind, until the work is done in spite of them."""

    def __init__(self, onde, folder, chance):
        self.onde, self.folder, self.chance = str(onde), folder, chance
        self.kills, self.faults = 0, []

    def run(self, arguments):
        result = subprocess.run([self.onde, *arguments], cwd=self.folder, capture_output=True, text=True)
        if result.returncode != 0:
            self.faults.append(f"{' '.join(arguments[:2])}: exit code {result.returncode}: {result.stderr.strip()}")

    def kill_once(self, arguments, longest):
        """True when it was killed before its end."""
        process = subprocess.Popen([self.onde, *arguments], cwd=self.folder, stderr=subprocess.DEVNULL)
        time.sleep(self.chance.uniform(0.02, longest))
        process.kill()
        killed = process.wait() < 0
        self.kills += killed
        self.check_films()
        return killed

    def check_films(self):
        for film in self.folder.rglob("*.exr"):
            if not film.name.startswith("."):
                self.run(["film", str(film)])

    def compare(self, name, expected):
        if (self.folder / name).read_bytes() != expected:
            self.faults.append(f"{name} has other bytes")


def kill_renders(trial, whole, kills, more=()):
    job = ["render", *PICTURE, *more, "--film", "a.exr", "--resume", "a.exr", "--checkpoint", "0.05", "--wave-size", "4096"]
    for _ in range(kills):
        if not trial.kill_once(job, 2.5):  # it had come to its end
            trial.compare("a.exr", whole)
            (trial.folder / "a.exr").unlink()
    trial.run(job)
    trial.compare("a.exr", whole)


def kill_noisy_renders(trial, _, kills):
    if not (trial.folder / "noisy.exr").exists():
        trial.run(["render", *PICTURE, *NOISE, "--film", "noisy.exr"])
    kill_renders(trial, (trial.folder / "noisy.exr").read_bytes(), kills, NOISE)


def kill_workers(trial, whole, kills):
    job = ["work", "store", *PICTURE, "--tiles", "2x1", "--lease", "5"]
    for _ in range(kills):
        if not trial.kill_once(job, 1.5):
            trial.compare("store/film.exr", whole)
            shutil.rmtree(trial.folder / "store")
    trial.run(job)
    trial.compare("store/film.exr", whole)


def kill_merges(trial, whole, kills):
    for first in range(0, 700, 64) if not list(trial.folder.glob("part*.exr")) else ():
        trial.run(["render", *PICTURE, "--samples", f"{first}:{min(first + 64, 700)}", "--film", f"part{first}.exr"])
    parts = sorted(path.name for path in trial.folder.glob("part*.exr"))
    for _ in range(kills):
        trial.chance.shuffle(parts)
        trial.kill_once(["merge", *parts, "-o", "joined.exr"], 0.08)
    trial.run(["merge", *parts, "-o", "joined.exr"])
    trial.compare("joined.exr", whole)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--onde", type=Path, default=ROOT / "build/onde/onde")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    faults = []
    kills = 0
    for what, share in ((kill_renders, 0.3), (kill_noisy_renders, 0.2), (kill_workers, 0.25), (kill_merges, 0.25)):
        with tempfile.TemporaryDirectory(prefix="onde-kills-") as name:
            trial = Trial(options.onde, Path(name), random.Random(options.seed))
            trial.run(["render", *PICTURE, "--film", "whole.exr"])
            whole = (Path(name) / "whole.exr").read_bytes()
            wanted = round(options.kills * share)
            while trial.kills < wanted and not trial.faults:
                what(trial, whole, wanted - trial.kills)
            print(f"{what.__name__}: {trial.kills} killed, {len(trial.faults)} faults", flush=True)
            faults += trial.faults
            kills += trial.kills
    for fault in faults:
        print(fault)
    print(f"{kills} kills, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
