"""The results as Markdown."""

import datetime
import math
import os
import platform
import statistics

from .cases import ORGANS
from .methods import METHODS
from .scores import median

MEDIANS = ("dice", "jaccard", "asd", "hd95", "segment_s", "wall_s", "cpu_s", "memory_mb")


def spread(values):
    """Mean and standard deviation, as the paper gives them."""
    values = [value for value in values if not math.isnan(value)]
    if not values:
        return "-"
    deviation = statistics.stdev(values) if len(values) > 1 else 0
    digits = 2 if abs(statistics.mean(values)) < 100 else 0
    return f"{statistics.mean(values):.{digits}f} ± {deviation:.{digits}f}"


def cell(value, pattern):
    return "-" if isinstance(value, float) and math.isnan(value) else format(value, pattern)


def line(*cells):
    return "| " + " | ".join(cells) + " |"


def header(*names):
    return [line(*names), "|" + "---|" * len(names)]


def machine():
    """Processor, number of its threads, and memory: what times depend on."""
    name = platform.processor() or platform.machine()
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [text.split(":", maxsplit=1)[1].strip() for text in file if text.startswith("model name")]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{models[0] if models else name}, {os.cpu_count()} threads, {memory:.0f} GiB"


def of(rows, method, organ=None):
    return [row for row in rows if row["method"] == method.key and row["scored"] and organ in (None, row["organ"])]


def organs_of(rows):
    """Those that the rows are about, in the order of ORGANS."""
    return [organ for organ in ORGANS if any(row["organ"] == organ and row["scored"] for row in rows)]


def title_of(organ):
    return organ.replace("mr-", "MR ")


def medians_of(rows):
    return {name: median([row[name] for row in rows]) for name in MEDIANS}


def paper_table(rows, methods):
    """V, D, VO, K, T and T' as in Table 1 of the paper."""
    lines = header("organ", "V, ml", "algorithm", "D, mm", "VO, %", "K", "T, s", "T', s")
    for organ in organs_of(rows):
        for number, method in enumerate(methods):
            own = of(rows, method, organ)
            if own:
                seconds = [row["segment_s"] for row in own]
                each = [row["segment_s"] / (1 if method.plane else row["slices"]) for row in own]
                lines.append(line(f"{title_of(organ)} ({len(own)})" if number == 0 else "",
                                  spread([row["volume_ml"] for row in own]) if number == 0 else "", method.title,
                                  spread([row["asd"] for row in own]), spread([100 * row["jaccard"] for row in own]),
                                  spread([row["iterations"] for row in own]), spread(seconds), spread(each)))
    return lines


def median_table(rows, methods):
    organs = organs_of(rows)
    titles = [title_of(organ) for organ in organs]
    first, others = titles[0] if titles else "", titles[1:]
    lines = header("algorithm", f"Dice, {first}", *others, "all", "minimum", f"ASD, mm, {first}", *others,
                   "all", "HD95, mm", "self-intersecting surfaces", "segmentation, s", "process, s", "CPU, s",
                   "memory, MB", "times FlipFree's segmentation", "process", "CPU")
    for method in methods:
        own = of(rows, method)
        if own:
            found = medians_of(own)
            meeting = "-" if method.plane else f"{sum(row['self_intersections'] > 0 for row in own)} of {len(own)}"
            # Of a case with its own, so that large and small organs count alike.
            ratios = [median([row[name] / other[name] for row in own for other in of(rows, METHODS[0])
                              if other["case"] == row["case"]]) for name in ("segment_s", "wall_s", "cpu_s")]
            lines.append(line(method.title, *(cell(medians_of(of(rows, method, organ))["dice"], ".3f")
                                              for organ in organs), f"{found['dice']:.3f}",
                              f"{min(row['dice'] for row in own):.3f}",
                              *(cell(medians_of(of(rows, method, organ))["asd"], ".2f") for organ in organs),
                              cell(found["asd"], ".2f"),
                              cell(found["hd95"], ".1f"), meeting, cell(found["segment_s"], ".2f"),
                              f"{found['wall_s']:.2f}", f"{found['cpu_s']:.2f}", cell(found["memory_mb"], ".0f"),
                              *(cell(ratio, ".1f") for ratio in ratios)))
    return lines


def case_cell(row):
    if row is None:
        return "-"  # not run
    return "nothing" if row["failed"] else f"{row['dice']:.3f} / {row['asd']:.1f}"


def case_table(rows, methods):
    """Dice / ASD of every row."""
    lines = header("case", *(method.title for method in methods))
    for name in dict.fromkeys(row["case"] for row in rows):
        own = {row["method"]: row for row in rows if row["case"] == name}
        lines.append(line(name, *(case_cell(own.get(method.key)) for method in methods)))
    return lines


def write(results, rows, methods):
    text = ["# Table 1", "", f"{datetime.date.today():%d %B %Y}; {machine()}.", "",
            "V: reference volume; D: average symmetric surface distance, weighted by area (the paper does not say how it "
            "averages); VO: volume overlap (Jaccard); K: iterations; T: seconds of the segmentation, reading aside; T': the same per slice of the organ. Means and "
            "standard deviations over the livers, spleens and kidneys of the lists; the GVF snake has one slice, and is "
            "scored there. Where a method found nothing, its VO is 0, and D, K and T are of the other rows.", "",
            *paper_table(rows, methods), "", "## Medians", "",
            "Over the same rows. Times and memory are those of the whole process, reading included, as "
            "medians of all rounds; memory is the peak before the results are written; ratios are medians over the rows.", "",
            *median_table(rows, methods), "", "## Every row", "", "Dice / ASD in mm; -: not run.", "", *case_table(rows, methods),
            ""]
    with open(os.path.join(results, "table1.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(text))
