"""Scores what the runs left: accuracy against the reference, validity of the surface, median times."""

import csv
import math
import os
import statistics

import flipfree
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkMarchingSquares
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from . import runs

MEASURES = ("dice", "jaccard", "asd", "hd95", "self_intersections", "iterations", "segment_s", "wall_s", "cpu_s",
            "memory_mb")
FIELDS = ("case", "organ", "scored", "method", "volume_ml", "slices", "failed", *MEASURES)


def median(values):
    """Of those that are numbers."""
    values = [value for value in values if not math.isnan(value)]
    return statistics.median(values) if values else math.nan


def read_surface(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def voxels(image):
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])


def seed_slice(image, case):
    index = [0.0] * 3
    image.TransformPhysicalPointToContinuousIndex(case.seed, index)
    return round(index[2])


def outline(mask, spacing):
    """Points on the boundary of a mask of one slice, in mm, half a pixel apart or less."""
    padded = np.pad(mask, 1).astype(np.float32)
    image = vtkImageData()
    image.SetDimensions(padded.shape[1], padded.shape[0], 1)
    image.SetSpacing(spacing[0], spacing[1], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(padded.ravel(), deep=True))
    squares = vtkMarchingSquares()
    squares.SetInputData(image)
    squares.SetValue(0, 0.5)
    squares.Update()
    lines = squares.GetOutput()
    ends = vtk_to_numpy(lines.GetPoints().GetData())[
        vtk_to_numpy(lines.GetLines().GetConnectivityArray()).reshape(-1, 2)]
    return ends.mean(axis=1)[:, :2]


def nearest(points, others):
    return np.array([np.sqrt(((others - point) ** 2).sum(axis=1).min()) for point in points])


def plane_scores(labels, reference, spacing):
    """Overlaps and distances within one slice, where the others are measured in space."""
    both, either = (labels & reference).sum(), (labels | reference).sum()
    a, b = outline(labels, spacing), outline(reference, spacing)
    distances = np.concatenate([nearest(a, b), nearest(b, a)])
    return {"dice": 2 * both / (both + either), "jaccard": both / either, "asd": distances.mean(),
            "hd95": np.percentile(distances, 95)}


def score(results, case, method, reference):
    labels = flipfree.read_image(runs.output(results, case, method, ".mha"))
    if method.plane:
        k = seed_slice(reference, case)
        return {**plane_scores(voxels(labels)[k] != 0, voxels(reference)[k] == case.label, reference.GetSpacing()),
                "self_intersections": math.nan}
    found = flipfree.evaluate(labels, reference, reference_label=case.label)
    validity = flipfree.vtkSurfaceValidity()
    validity.SetInputData(read_surface(runs.output(results, case, method, ".vtp")))
    flipfree.update(validity)
    meetings = validity.GetMeasures().GetValueByName(0, "SelfIntersections").ToInt()
    return {"dice": found.dice, "jaccard": found.jaccard, "asd": found.asd, "hd95": found.hd95,
            "self_intersections": meetings}


def median_times(records):
    return {name: median([float(record[name]) for record in records])
            for name in ("iterations", "segment_s", "wall_s", "cpu_s", "memory_mb")}


def score_all(results, cases, methods):
    """A row per case and method, as dictionaries with numbers; also into scores.csv."""
    records = runs.read_runs(results)
    rows = []
    for case in cases:
        reference = flipfree.read_image(case.labels)
        mask = voxels(reference) == case.label
        about = {"case": case.name, "organ": case.organ, "scored": int(case.scored),
                 "volume_ml": mask.sum() * abs(np.prod(reference.GetSpacing())) / 1000,
                 "slices": int(mask.any(axis=(1, 2)).sum())}
        for method in methods:
            own = [record for record in records if (record["case"], record["method"]) == (case.name, method.key)]
            if not own:
                continue
            failed = int(own[-1]["failed"])
            # Nothing found counts as such: no overlap, and no distance to tell.
            scored = {"dice": 0, "jaccard": 0, "asd": math.nan, "hd95": math.nan, "self_intersections": math.nan} \
                if failed else score(results, case, method, reference)
            rows.append({**about, "method": method.key, "failed": failed, **scored, **median_times(own)})
    with open(os.path.join(results, "scores.csv"), "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, FIELDS)
        table.writeheader()
        table.writerows({key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()}
                        for row in rows)
    return rows


def read_scores(results):
    """What score_all wrote, to its four digits."""
    with open(os.path.join(results, "scores.csv"), encoding="utf-8") as file:
        return [{key: value if key in ("case", "organ", "method") else float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]
