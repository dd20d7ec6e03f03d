"""One scene, all renderers: what is run, in which order, and the figures of each."""

import statistics
import sys
import time

import statistics_of_noise as figures
from runner import Failed, runner


def say(text):
    print(text, file=sys.stderr, flush=True)


def references(racer, settings):
    """Pictures of seeds of their own for the reference: as many as the time allows, at least 2."""
    pictures, start = [], time.monotonic()
    while len(pictures) < 2 or (len(pictures) < settings["references"] and time.monotonic() - start < settings["reference_seconds"]):
        pictures.append(racer.render(settings["spp"], 1000 + len(pictures))[1])
    return pictures


def lap(racers, results, act):
    """Lets each act in turn; who fails is told of and goes on no more."""
    for name in list(racers):
        try:
            act(racers[name], results[name])
        except Failed as reason:
            say(f"  {name} can't render this scene: {reason}")
            results[name] = {"failed": str(reason)}
            racers.pop(name).close()


def race(scene, folder, names, settings):
    """Figures by renderer; those that can't render it have "failed"."""
    spp = settings["spp"]
    racers = {name: runner(name, folder, settings) for name in names}
    results = {name: {"pictures": [], "seconds": [], "samples_each": []} for name in names}

    def first(racer, result):
        racer.prepare(scene)
        result["first_seconds"] = racer.whole(spp, 1)["seconds"]

    def later(racer, result):
        measured = racer.whole(spp, 2)
        result["later_seconds"], result["peak_mib"] = measured["seconds"], measured["peak_mib"]

    def reference(racer, result):
        result["references"] = references(racer, settings)

    def timed(racer, result):
        seconds, picture, samples = racer.render(spp, 1 + len(result["pictures"]))
        result["seconds"].append(seconds)
        result["samples_each"].append(samples)
        result["pictures"].append(picture)

    for act in [first, later, reference] + [timed] * settings["repeats"]:
        lap(racers, results, act)
    for racer in racers.values():
        racer.close()
    return {name: result if "failed" in result else summary(result, settings) for name, result in results.items()}


def summary(result, settings):
    error, trimmed = figures.noise(result["pictures"], result["references"])
    mean, deviation = figures.mean_with_error(result["references"] + result["pictures"])
    seconds, samples = statistics.median(result["seconds"]), statistics.median(result["samples_each"])
    kept = {name: result[name] for name in ("first_seconds", "later_seconds", "peak_mib")}
    return kept | {
        "mean": mean, "mean_deviation": deviation, "error": error, "trimmed": trimmed, "samples": samples, "render_seconds": seconds,
        "spread": (max(result["seconds"]) - min(result["seconds"])) / seconds, "references": len(result["references"]),
        "samples_per_second": samples * settings["size"] ** 2 / seconds,
        "picture": sum(result["references"]) / len(result["references"]),
    }
