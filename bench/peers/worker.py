"""A process of one renderer: loads a scene, then renders what each line of its input asks for.

worker.py RENDERER FOLDER SETTINGS; lines {"samples": N, "seed": N, "output": FILE}, answered by
{"seconds": S, "samples": N}.
"""

import importlib
import json
import os
import sys

import numpy as np

SESSIONS = {
    "mitsuba": ("mitsuba_scene", {}),
    "mitsuba-multijitter": ("mitsuba_scene", {"sampler": "multijitter"}),
    "cycles": ("cycles_scene", {}),
    "luxcore": ("luxcore_scene", {}),
}


def main():
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)  # renderers talk
    name, folder, settings = sys.argv[1], sys.argv[2], json.loads(sys.argv[3])
    module, more = SESSIONS[name]
    session = importlib.import_module(module).Session(folder, settings, **more)
    for line in sys.stdin:
        wanted = json.loads(line)
        seconds, picture, samples = session.render(wanted["samples"], wanted["seed"])
        np.save(wanted["output"], np.ascontiguousarray(picture, np.float32))
        print(json.dumps({"seconds": seconds, "samples": samples}), file=answers)


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # without what renderers do when they are torn down
