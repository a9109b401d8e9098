"""The package over the kernels gives the bits that the one over VTK's filters gives.

  TestSameBits.py                  compares; FLIPFREE_EXPECTED names a file of results, instead of those of VTK's filters
  TestSameBits.py RESULTS.pickle   only writes what the package at hand gives
"""

import dataclasses
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import flipfree
import numpy

VESSELS = {
    "default": ("vessel", {}),
    "others": ("vessel", {"radius": 4, "levels": 1, "wall_thickness": 0.7, "maximum_iterations": 4, "label_value": 5}),
    "tree": ("fork", {}),
    "corrected": ("vessel", {"inside": [(48, 60, 50)], "outside": [(20, 47, 44)], "levels": 1}),
}
SEED, RADIUS = (99.75, 83.75, 167), 28
GRID = {"dimensions": (110, 86, 46), "spacing": (3, 3, 6)}  # as in Testing/Python/example.py
RUNS = {
    "default": {},
    "carving": {"carving": True},
    "published": {"preset": "published", "maximum_iterations": 9, "resolution": 16},
    "naive": {"preset": "naive", "maximum_iterations": 9, "resolution": 16},
    "others": {"levels": 2, "resolution": 16, "leak_control": False, "edge_window": 0, "reach": 90,
               "diffusion_iterations": 12, "keep_history": True, "start_center_offset": (2, 0, -3)},
    "start labels": {"start_label": 6, "outside": [(60, 83, 167)]},
    "stroke": {"outside": numpy.linspace((60, 83, 160), (60, 84, 173), 60), "levels": 3},
}


def fork():
    """Two tubes that meet in a third: voxels of 1 mm, and a point at each end."""
    z, y, x = numpy.mgrid[0:64, 0:32, 0:64].astype(float)
    distance = numpy.full(x.shape, 1e3)
    for end in ((8, 56), (56, 56), (32, 6)):
        part = numpy.clip(((x - 32) * (end[0] - 32) + (z - 32) * (end[1] - 32))
                          / ((end[0] - 32) ** 2 + (end[1] - 32) ** 2), 0, 1)
        off = (x - 32 - part * (end[0] - 32)) ** 2 + (y - 16) ** 2 + (z - 32 - part * (end[1] - 32)) ** 2
        distance = numpy.minimum(distance, numpy.sqrt(off))
    voxels = numpy.round(80 + 120 * numpy.clip(5 - distance, 0, 1)).astype(numpy.int16)
    return voxels, [(10, 16, 54), (54, 16, 54), (32, 16, 8)]


def vessels():
    """What trace() has to say, and how it complains."""
    tube = flipfree.phantom("vessel").image
    voxels, ends = fork()
    images = {"vessel": (tube, [(13.3, 44.6, 44.5), (82, 50.4, 37.6)]),
              "fork": (flipfree.image_from_array(voxels, (1, 1, 1)), ends)}
    found = {
        # Python 3.13 takes the indentation away.
        "help of trace": "\n".join(line.strip() for line in flipfree.trace.__doc__.splitlines()),
        "signature of trace": str(flipfree.trace.__signature__).partition("progress")[2],
    }
    for name, (image, parameters) in VESSELS.items():
        image, points = images[image]
        vessel = flipfree.trace(image, points, **parameters)
        found[f"vessel {name}, points"] = numpy.array(vessel.points)
        found[f"vessel {name}, faces"] = vessel.faces
        found[f"vessel {name}, labels"] = numpy.array(vessel.labels)
        found[f"vessel {name}, end"] = vessel.stop_reason, vessel.self_intersections, repr(vessel)
        found[f"vessel {name}, parents"] = [branch.parent for branch in vessel.branches], "tree"
        for number, branch in enumerate(vessel.branches):
            for column in ("points", "radius", "length"):
                found[f"vessel {name}, branch {number}, {column}"] = numpy.array(getattr(branch, column))
        for column, values in vessel.iterations.items():
            if not column.endswith("Seconds"):
                found[f"vessel {name}, {column}"] = numpy.array(values)
    for number, (points, parameters) in enumerate((
            (ends[:1], {}), ([ends[0], ends[0]], {}), ([*ends, (500, 0, 0)], {}), ([*ends, (float("nan"), 0, 0)], {}),
            ((1, 2, 3), {}), (7, {}), ([(1, 2)], {}), (["here"], {}), (ends, {"radius": float("nan")}), (ends, {"levels": 9}),
            (ends, {"label_value": 0}), (ends, {"radios": 3}), (ends, {"levels": 1.5}), (ends, {"wall_thickness": "thick"}))):
        try:
            flipfree.trace(images["fork"][0], points, **parameters)
            found[f"complaint {number}"] = "none"
        except (flipfree.FlipFreeError, TypeError, ValueError) as error:
            found[f"complaint {number}"] = type(error).__name__, str(error)
    return found


def results():
    """What either package has to say, by name."""
    warnings.simplefilter("ignore")
    phantom = flipfree.phantom("abdomen", **GRID)
    found = {
        "image": numpy.array(flipfree.array_from_image(phantom.image)),
        "truth": numpy.array(flipfree.array_from_image(phantom.label_map)),
        "seeds": phantom.seeds,
        "lesions": flipfree.array_from_image(
            flipfree.phantom("abdomen", number_of_lesions=3, random_seed=5, **GRID).image).sum(),
        "help": flipfree.segment.__doc__.partition("The other parameters:")[2],
        "help of evaluate": flipfree.evaluate.__doc__.partition("The other parameters:")[2],
        "signature": str(flipfree.segment.__signature__).partition("progress")[2],
    }
    for preset in ("default", "published", "naive"):
        found[f"parameters, {preset}"] = flipfree.default_parameters(preset)
    for name, parameters in RUNS.items():
        start = {"start_labels": phantom.label_map} if "start_label" in parameters else {"seed": SEED, "radius": RADIUS}
        organ = flipfree.segment(phantom.image, **start, **parameters)
        found[f"{name}, points"] = organ.points
        found[f"{name}, faces"] = organ.faces
        found[f"{name}, labels"] = organ.labels
        found[f"{name}, end"] = organ.stop_reason, organ.self_intersections, len(organ.history)
        for column, values in organ.iterations.items():
            if not column.endswith("Seconds"):
                found[f"{name}, {column}"] = values
        for options in ({}, {"score_voxelization": True}, {"score_voxelization": True, "label_smoothing": 20}):
            scores = flipfree.evaluate(organ, phantom.label_map, reference_label=6, **options)
            found[f"{name}, scores, {options}"] = dataclasses.asdict(scores)
        scores = flipfree.evaluate(organ.label_map, phantom.label_map, reference_label=6)
        found[f"{name}, scores of labels"] = dataclasses.asdict(scores)
    return {**found, **vessels()}


class SameBits(unittest.TestCase):
    def test_everything(self):
        self.assertFalse(hasattr(flipfree, "vtkFlipFreeSegmentation"))
        with tempfile.TemporaryDirectory() as folder:
            path = os.environ.get("FLIPFREE_EXPECTED")
            if not path:
                path = str(Path(folder) / "results.pickle")
                subprocess.run([os.environ["FLIPFREE_VTK_PYTHON"], __file__, path], check=True, timeout=500,
                               env={**os.environ, "PYTHONPATH": os.environ["FLIPFREE_VTK_PACKAGE"]})
            with open(path, "rb") as file:
                expected = pickle.load(file)
        found = results()
        self.assertEqual(list(found), list(expected))
        self.assertGreater(len(found["vessel tree, parents"][0]), 1)
        for name, value in expected.items():
            with self.subTest(name):
                if isinstance(value, list):
                    dtype, shape, data = value
                    self.assertEqual(found[name].shape, shape)
                    if "faces" not in name:  # VTK's indices are longer
                        self.assertEqual(found[name].dtype.str, dtype)
                    same = numpy.frombuffer(data, dtype).reshape(shape)
                    numpy.testing.assert_array_equal(found[name], same)
                else:
                    self.assertEqual(found[name], value)


def write(path):
    """Arrays as bytes: the other interpreter may have another numpy."""
    plain = {name: [value.dtype.str, value.shape, value.tobytes()] if isinstance(value, numpy.ndarray) else value
             for name, value in results().items()}
    plain["lesions"] = int(plain["lesions"])
    with open(path, "wb") as file:
        pickle.dump(plain, file)


if __name__ == "__main__":
    if len(sys.argv) == 2 and sys.argv[1].endswith(".pickle"):
        write(sys.argv[1])
    else:
        unittest.main()
