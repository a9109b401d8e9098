"""The wheel's type stubs: a type checker understands what users write, and refuses what is wrong."""

import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree

if not importlib.util.find_spec("mypy"):
    print("Skipped: mypy is not installed.")
    sys.exit(77)

PACKAGE = Path(flipfree.__file__).parent

GOOD = """
import flipfree
import numpy

liver = flipfree.segment("ct.nii.gz", seed=(1, 2, 3.5), radius=26, levels=2, guard=True)
array = flipfree.segment(numpy.zeros((3, 4, 5)), [1, 2, 3], 26, spacing=(1, 1, 1), progress=print)
volume = flipfree.phantom("cube", dimensions=(20, 20, 20), noise_standard_deviation=0).image
again = flipfree.segment(volume, (1, 2, 3), 26, start=liver, preset="naive", progress=True)
flipfree.write_surface(again, "again.stl")
vessel: flipfree.Vessel = flipfree.trace(volume, [(1, 2, 3), (4, 5, 6.5)], radius=4, levels=1)
way = flipfree.trace("ct.nii.gz", numpy.zeros((2, 3)), progress=True).branches[0].points
flipfree.write_centerline(vessel, "line.vtp")
vertices: int = liver.points.shape[0]
score: float = flipfree.evaluate(liver, "truth.nii.gz", reference_label=6).dice
spacing: tuple[float, ...] = volume.spacing
flipfree.set_threads(2)
"""

BAD = {
    'flipfree.segment("ct.nii", (1, 2, 3), 26, level=2)': 'Unexpected keyword argument "level"',
    'flipfree.segment("ct.nii", (1, 2, 3), 26, levels="2")': 'type "str"; expected "int"',
    'flipfree.segment("ct.nii", (1, 2, 3), "9")': 'incompatible type "str"',
    'flipfree.segment(7, (1, 2, 3), 26)': 'incompatible type "int"',
    'flipfree.trace("ct.nii")': 'Missing positional argument "points"',
    'flipfree.trace("ct.nii", [(1, 2, 3)], radios=4)': 'Unexpected keyword argument "radios"',
    'flipfree.trace("ct.nii", [(1, 2, 3)], levels="2")': 'type "str"; expected "int"',
    'flipfree.write_centerline(liver, "line.vtp")': 'expected "Vessel"',
    'flipfree.evaluate("a.nii", "b.nii", label=6)': 'Unexpected keyword argument "label"',
    'flipfree.phantom("star")': "expected \"Literal['sphere'",
    'flipfree.set_threads("all")': 'type "str"; expected "int"',
    'flipfree.update()': 'has no attribute "update"',
}


# Each version of these packages says something else of its types, and to read them takes longer than all the rest.
CONFIGURATION = """
[mypy]
[mypy-dask.*,matplotlib.*,PIL.*,pyvista.*,slicer.*,vtkmodules.*]
follow_imports = skip
follow_imports_for_stubs = True
"""


class Mypy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "mypy.ini").write_text(CONFIGURATION, encoding="utf-8")

    def mypy(self, *arguments):
        """With one cache for all runs, which read numpy's types for the most part."""
        return subprocess.run(
            [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--config-file", self.folder / "mypy.ini",
             "--cache-dir", self.folder / "cache", *arguments],
            env=dict(os.environ, MYPYPATH=""), text=True, timeout=250, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, check=False).stdout

    def test_user_code(self):
        program = self.folder / "program.py"
        program.write_text(GOOD + "\n".join(BAD), encoding="utf-8")
        found = self.mypy(program).splitlines()
        first = GOOD.count("\n") + 1
        for line, message in enumerate(BAD.values(), start=first):
            with self.subTest(message):
                self.assertTrue(any(f"program.py:{line}: error: " in text and message in text for text in found),
                                "\n".join(found))
        others = [text for text in found if ": error: " in text and int(text.split(":")[1]) < first]
        self.assertEqual(others, [])

    def test_layer_is_sound_in_itself(self):
        """Apart from the extension, which has no types."""
        found = [text for text in self.mypy("-p", "flipfree").splitlines() if ": error: " in text and "_kernels" not in text]
        self.assertEqual(found, [])

    def test_stubs_are_there(self):
        for name in ("_segment.pyi", "_segment_organs.pyi", "_trace.pyi", "_evaluate.pyi", "_phantom.pyi", "py.typed"):
            self.assertTrue((PACKAGE / name).exists(), name)


if __name__ == "__main__":
    unittest.main()
