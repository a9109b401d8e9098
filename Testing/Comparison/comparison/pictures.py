"""The results as pictures: a chart of all methods, FlipFree's convergence, and what the methods found."""

import csv
import os

import flipfree
import matplotlib
import numpy as np
import paper_figures
import scene
from vtkmodules.vtkFiltersCore import vtkAppendPolyData

from . import runs, tables
from .cases import ORGANS
from .scores import read_surface, voxels

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  pylint: disable=wrong-import-position

OURS, THEIRS = "#d1663a", "#3f6fa5"


def draw(results, cases, methods, rows):
    chart(os.path.join(results, "table1.png"), rows, methods)
    if methods[0].key == "flipfree":
        convergence(os.path.join(results, "convergence.png"), results, cases, methods[0])
        worst(os.path.join(results, "worst.png"), results, cases, methods[0], rows)
    for case in cases:
        if case.organ in ORGANS:
            organs(os.path.join(results, case.name, "methods.png"), results, case, methods, rows)


def chart(path, rows, methods):
    """Each row's Dice and mean distance, and the processor time of its process, method by method."""
    figure, panels = pyplot.subplots(1, 3, figsize=(12, 4.2), sharey=True, layout="constrained")
    shown = [method for method in methods if tables.of(rows, method)][::-1]
    for panel, (name, title) in zip(panels, (("dice", "Dice"), ("asd", "mean distance, mm"),
                                             ("cpu_s", "processor time of the process, s"))):
        for height, method in enumerate(shown):
            values = [row[name] for row in tables.of(rows, method)]
            color = OURS if method.ours else THEIRS
            panel.plot(values, [height] * len(values), "o", color=color, alpha=0.35, markersize=5, linewidth=0)
            panel.plot(tables.median(values), height, "|", color=color, markersize=20, markeredgewidth=3)
        panel.set_xlabel(title)
        panel.grid(axis="x", color="#dddddd")
        panel.set_axisbelow(True)
        if name != "dice":
            panel.set_xscale("log")
    panels[0].set_yticks(range(len(shown)), [method.title for method in shown])
    panels[0].set_xlim(0, 1)
    figure.suptitle("Livers, spleens and kidneys: every row, and the median")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def convergence(path, results, cases, method):
    """As Fig. 4 of the paper, for the first liver and the first spleen."""
    if not any(case.organ in ("liver", "spleen") for case in cases):
        return
    figure, panel = pyplot.subplots(figsize=(6.5, 4), layout="constrained")
    for organ, color in (("liver", OURS), ("spleen", THEIRS)):
        table = next((path for path in (runs.output(results, case, method, ".csv")
                                        for case in cases if case.organ == organ) if os.path.exists(path)), None)
        if table:
            with open(table, encoding="utf-8") as file:
                steps = list(csv.DictReader(file))
            distances = np.array([float(step["MeanDistance"]) for step in steps])
            levels = np.array([int(step["Level"]) for step in steps])
            panel.plot(range(1, len(steps) + 1), distances, color=color,
                       label=os.path.basename(os.path.dirname(table)))
            begins = np.flatnonzero(np.diff(levels)) + 1
            panel.plot(begins + 1, distances[begins], "o", color=color, markersize=5)
    panel.set_xlabel("iteration")
    panel.set_ylabel("mean distance to the targets, mm")
    panel.set_ylim(bottom=0)
    panel.set_xlim(left=1)
    panel.grid(color="#dddddd")
    panel.legend(title="dots: the mesh is refined")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def with_volumes(case):
    return paper_figures.Case(case.name, flipfree.read_image(case.image), list(case.seed), case.radius,
                              flipfree.read_image(case.labels), case.label)


def move_to_error(shown, labels):
    """Puts the slice where most voxels are wrong, through their center."""
    wrong = (voxels(labels) != 0) != (voxels(shown.truth) == shown.label)
    k = int(np.argmax(wrong.sum(axis=(1, 2))))
    j, i = np.argwhere(wrong[k]).mean(axis=0)
    shown.truth.TransformContinuousIndexToPhysicalPoint([i, j, k], shown.seed)


def worst(path, results, cases, method, rows, number=10):
    """The lowest Dice scores of a method, each in the axial slice with the largest error."""
    named = {case.name: case for case in cases}
    found = [row for row in tables.of(rows, method) if not row["failed"] and row["case"] in named]
    views = []
    for row in sorted(found, key=lambda row: row["dice"])[:number]:
        case = named[row["case"]]
        shown = with_volumes(case)
        move_to_error(shown, flipfree.read_image(runs.output(results, case, method, ".mha")))
        truth = paper_figures.truth_of(shown)
        surface = read_surface(runs.output(results, case, method, ".vtp"))
        both = vtkAppendPolyData()
        both.AddInputData(truth)
        both.AddInputData(surface)
        both.Update()
        views.append(paper_figures.slice_of(shown, scene.AXIAL, [(truth, scene.BLUE, 3.5), (surface, scene.YELLOW, 1.8)],
                                            [("the reference", scene.BLUE),
                                             (f"{case.name}: Dice {row['dice']:.2f}", scene.YELLOW)],
                                            both.GetOutput(), 1.15))
    if views:
        scene.write_picture(path, [views[i:i + 5] for i in range(0, len(views), 5)], size=330)


def organs(path, results, case, methods, rows):
    """A view per method: its outline, and the reference's."""
    shown = with_volumes(case)
    truth = paper_figures.truth_of(shown)
    views = []
    for method in methods:
        row = next((row for row in rows if (row["case"], row["method"]) == (case.name, method.key)), None)
        if row and not row["failed"]:
            surface = read_surface(runs.output(results, case, method, ".vtp"))
            views.append(paper_figures.method_view(shown, scene.AXIAL, truth, surface,
                                                   f"{method.title}: Dice {row['dice']:.2f}"))
    columns = min(4, max(1, len(views)))
    scene.write_picture(path, [views[i:i + columns] for i in range(0, len(views), columns)], size=330)
