"""The package over the kernels gives the bits that the one over VTK's filters gives."""

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

SEED, RADIUS = (99.75, 83.75, 167), 28
RUNS = {
    "default": {},
    "carving": {"carving": True},
    "published": {"preset": "published", "maximum_iterations": 9, "resolution": 16},
    "naive": {"preset": "naive", "maximum_iterations": 9, "resolution": 16},
    "others": {"levels": 2, "resolution": 16, "leak_control": False, "edge_window": 0, "reach": 90,
               "diffusion_iterations": 12, "keep_history": True, "start_center_offset": (2, 0, -3)},
}


def results():
    """What either package has to say, by name."""
    warnings.simplefilter("ignore")
    phantom = flipfree.phantom("abdomen")
    found = {
        "image": numpy.array(flipfree.array_from_image(phantom.image)),
        "truth": numpy.array(flipfree.array_from_image(phantom.label_map)),
        "seeds": phantom.seeds,
        "lesions": flipfree.array_from_image(
            flipfree.phantom("abdomen", number_of_lesions=3, random_seed=5).image).sum(),
        "help": flipfree.segment.__doc__.partition("The other parameters:")[2],
        "help of evaluate": flipfree.evaluate.__doc__.partition("The other parameters:")[2],
        "signature": str(flipfree.segment.__signature__).partition("progress")[2],
    }
    for preset in ("default", "published", "naive"):
        found[f"parameters, {preset}"] = flipfree.default_parameters(preset)
    for name, parameters in RUNS.items():
        organ = flipfree.segment(phantom.image, SEED, RADIUS, **parameters)
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
    return found


class SameBits(unittest.TestCase):
    def test_everything(self):
        self.assertFalse(hasattr(flipfree, "vtkFlipFreeSegmentation"))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "results.pickle"
            subprocess.run([os.environ["FLIPFREE_VTK_PYTHON"], __file__, str(path)], check=True, timeout=500,
                           env={**os.environ, "PYTHONPATH": os.environ["FLIPFREE_VTK_PACKAGE"]})
            with open(path, "rb") as file:
                expected = pickle.load(file)
        found = results()
        self.assertEqual(list(found), list(expected))
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
