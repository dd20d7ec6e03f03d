"""Figures from pictures and seconds: pure functions."""

import numpy as np

DARK = 0.01  # added to squares of the reference, so that black pixels don't count for all
AGREE = 0.02  # of the means


def blurred(picture, reach=2):
    """The mean around each pixel: of so many pixels to each side."""
    height, width = picture.shape[:2]
    padded = np.pad(picture, ((reach, reach), (reach, reach), (0, 0)), mode="edge")
    sides = range(2 * reach + 1)
    return sum(padded[y : y + height, x : x + width] for y in sides for x in sides) / len(sides) ** 2


def relative_error(picture, reference):
    """The square of each pixel's error over that of the brightness around it, where noise of the
    reference itself hardly counts."""
    return ((picture - reference) ** 2 / (blurred(reference) ** 2 + DARK)).mean(-1)


def noise(pictures, references):
    """Relative MSE of pictures against the mean of others that have as many samples each, whose own
    noise is taken out; all, and without the worst 0.1 % of pixels."""
    reference = np.mean(references, axis=0)
    own = 1 + 1 / len(references)
    errors = np.mean([relative_error(picture, reference) for picture in pictures], axis=0).reshape(-1) / own
    kept = np.sort(errors)[: len(errors) - len(errors) // 1000]
    return float(errors.mean()), float(kept.mean())


def mean_with_error(pictures):
    """The mean of all pictures and its standard error, by their differences."""
    means = np.array([picture.mean() for picture in pictures])
    return float(means.mean()), float(means.std(ddof=1) / len(means) ** 0.5) if len(means) > 1 else float("nan")


def ratios(ours, theirs):
    """Of ours over theirs, less is better: `time` a sample, `noise` a sample (of the trimmed error),
    `equal_error` (their product), whole processes, memory; and of the means, which should be 1."""
    result = {name: ours[name] / theirs[name] for name in ("first_seconds", "later_seconds", "peak_mib")}
    result["mean"] = ours["mean"] / theirs["mean"]
    result["agrees"] = abs(result["mean"] - 1) <= AGREE
    result["time"] = theirs["samples_per_second"] / ours["samples_per_second"]
    result["noise"] = ours["trimmed"] * ours["samples"] / (theirs["trimmed"] * theirs["samples"])
    result["noise_all"] = ours["error"] * ours["samples"] / (theirs["error"] * theirs["samples"])
    result["equal_error"] = result["time"] * result["noise"]
    return result
