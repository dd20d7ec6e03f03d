"""The figures as a Markdown page, and the pictures side by side."""

from statistics_of_noise import AGREE, ratios

COLUMNS = ["renderer", "Msamples/s", "relative MSE", "without 0.1 %", "mean", "first process", "later", "peak MiB"]
RATIOS = ["Onde over", "time a sample", "noise a sample", "**time to equal error**", "all pixels", "first process", "later", "memory", "mean"]


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def figures_row(name, result):
    if "failed" in result:
        return [name, "can't: " + result["failed"].replace("|", "/")] + [""] * (len(COLUMNS) - 2)
    return [name, f"{result['samples_per_second'] / 1e6:.2f}", f"{result['error']:.2e}", f"{result['trimmed']:.2e}",
            f"{result['mean']:.4f} ± {result['mean_deviation']:.4f}", f"{result['first_seconds']:.2f} s",
            f"{result['later_seconds']:.2f} s", f"{result['peak_mib']:.0f}"]


def ratios_row(name, ratio):
    mark = "" if ratio["agrees"] else " (?)"
    return [name, f"{ratio['time']:.2f}", f"{ratio['noise']:.2f}{mark}", f"**{ratio['equal_error']:.2f}**{mark}",
            f"{ratio['time'] * ratio['noise_all']:.2f}{mark}", f"{ratio['first_seconds']:.2f}", f"{ratio['later_seconds']:.2f}",
            f"{ratio['peak_mib']:.2f}", f"{ratio['mean']:.3f}"]


def scene_text(name, results):
    parts = [f"## {name}", table(COLUMNS, [figures_row(*entry) for entry in results.items()])]
    ours = results["onde"]
    peers = {peer: ratios(ours, theirs) for peer, theirs in results.items()
             if peer != "onde" and "failed" not in theirs and "failed" not in ours}
    if peers:
        parts.append(table(RATIOS, [ratios_row(*entry) for entry in peers.items()]))
    doubtful = [peer for peer, ratio in peers.items() if not ratio["agrees"]]
    if doubtful:
        parts.append(f"The means of Onde and of {', '.join(doubtful)} differ by more than {100 * AGREE:.0f} %: they don't show the "
                     "same light, and ratios of noise marked (?) compare different pictures.")
    return "\n\n".join(parts)


def markdown(run):
    versions = ", ".join(f"{name} {version}" for name, version in run["versions"].items())
    settings = run["settings"]
    head = (f"# Onde beside other renderers\n\n{run['date']}, {run['machine']}, {settings['threads']} threads. {versions}. "
            f"{settings['size']}x{settings['size']}, {settings['spp']} samples, medians of {settings['repeats']} interleaved runs. "
            "Ratios below 1: Onde needs less.")
    return "\n\n".join([head, *(scene_text(name, results) for name, results in run["scenes"].items())]) + "\n"
