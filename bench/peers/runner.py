"""Who renders: Onde by its command line, the peers as processes that stay. It knows nothing of what is
measured with them.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import cycles_scene
import luxcore_scene
import mitsuba_scene
import numpy as np
import onde
import OpenEXR

HERE = Path(__file__).resolve().parent
PEERS = {  # by name: what prepares a scene for it, and the package that it comes in
    "cycles": (cycles_scene, "bpy"),
    "mitsuba": (mitsuba_scene, "mitsuba"),
    "mitsuba-multijitter": (mitsuba_scene, "mitsuba"),
    "luxcore": (luxcore_scene, "pyluxcore"),
}


class Failed(Exception):
    pass


def last_line(path):
    lines = [line for line in path.read_text(errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else "it said nothing"


class Runner:
    """One renderer and one scene, in that scene's folder. Who inherits has a command for a whole
    process and what to write to its input."""

    def __init__(self, name, folder, settings):
        self.name, self.folder, self.settings = name, folder, settings
        self.log = folder / f"{name}.log"
        self.home = folder / f"home-{name}"
        self.process = None

    def prepare(self, scene):
        shutil.rmtree(self.home, ignore_errors=True)
        self.home.mkdir()
        self.module.prepare(scene, self.folder)

    def environment(self):
        """With caches of its own, in the scene's folder, and as many threads as are asked for."""
        threads = str(self.settings["threads"])
        return {**os.environ, "HOME": str(self.home), "XDG_CACHE_HOME": str(self.home), "ONDE_CACHE_DIR": str(self.home / "onde"),
                "POCL_CACHE_DIR": str(self.home / "pocl"), "POCL_MAX_PTHREAD_COUNT": threads, "OMP_NUM_THREADS": threads,
                "TMPDIR": str(self.home)}

    def pin(self):
        os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[: self.settings["threads"]])

    def whole(self, samples, seed):
        """A process from start to end: its seconds and peak memory. Throws Failed."""
        result = self.home / "measured.json"
        result.unlink(missing_ok=True)
        words = [sys.executable, "-S", "-E", HERE / "measure.py", result, *self.command(samples, seed)]
        with open(self.log, "w") as log:
            subprocess.run([str(word) for word in words], env=self.environment(), preexec_fn=self.pin, input=self.request(samples, seed),
                           text=True, stdout=log, stderr=log)
        measured = json.loads(result.read_text()) if result.exists() else {"code": 1}
        if measured["code"]:
            raise Failed(last_line(self.log))
        return measured


class Onde(Runner):
    module = onde

    def command(self, samples, seed):
        return onde.command(self.settings["onde"], self.folder, self.settings, samples, seed, self.folder / "onde.exr")

    def request(self, samples, seed):
        return ""

    def render(self, samples, seed):
        """Seconds of the render alone, the picture, and the samples a pixel that it has. Throws Failed."""
        self.whole(samples, seed)
        said = json.loads((self.folder / "onde.exr.json").read_text())
        picture = OpenEXR.File(str(self.folder / "onde.exr"), separate_channels=False).channels()["RGB"].pixels
        return said["render_seconds"], np.asarray(picture, float), said["samples"]

    def close(self):
        pass


class Peer(Runner):
    @property
    def module(self):
        return PEERS[self.name][0]

    def command(self, samples, seed):
        return [sys.executable, HERE / "worker.py", self.name, self.folder, json.dumps(self.settings)]

    def request(self, samples, seed):
        return json.dumps({"samples": samples, "seed": seed, "output": str(self.folder / f"{self.name}.npy")}) + "\n"

    def start(self):
        words = [str(word) for word in self.command(0, 0)]
        self.process = subprocess.Popen(words, env=self.environment(), preexec_fn=self.pin, text=True, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, stderr=open(self.log, "w"))
        self.ask(1, 0)  # what is done once

    def ask(self, samples, seed):
        try:
            self.process.stdin.write(self.request(samples, seed))
            self.process.stdin.flush()
        except BrokenPipeError:
            pass
        answer = self.process.stdout.readline()
        if not answer:
            raise Failed(last_line(self.log))
        return json.loads(answer)

    def render(self, samples, seed):
        if not self.process:
            self.start()
        said = self.ask(samples, seed)
        return said["seconds"], np.load(self.folder / f"{self.name}.npy").astype(float), said["samples"]

    def close(self):
        if self.process:
            self.process.stdin.close()
            self.process.wait()
            self.process = None


def runner(name, folder, settings):
    return (Onde if name == "onde" else Peer)(name, folder, settings)
