"""The type stubs: they hold every public name, and a type checker understands them."""

import ast
import importlib.util
import inspect
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree

PACKAGE = Path(flipfree.__file__).parent

GOOD = """
import flipfree
import numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

liver = flipfree.segment("ct.nii.gz", seed=(1, 2, 3.5), radius=26, levels=2, guard=True)
array = flipfree.segment(numpy.zeros((3, 4, 5)), [1, 2, 3], 26, spacing=(1, 1, 1), progress=print)
again = flipfree.segment(vtkImageData(), (1, 2, 3), 26, start=liver, preset="naive", progress=True)
vessel: flipfree.Vessel = flipfree.trace("ct.nii.gz", [(1, 2, 3), (4, 5, 6.5)], radius=4, levels=1)
way = flipfree.trace(vtkImageData(), numpy.zeros((2, 3)), progress=print).branches[0].points
vertices: int = liver.points.shape[0]
score: float = flipfree.evaluate(liver, "truth.nii.gz", reference_label=6).dice
volume = flipfree.phantom("cube", dimensions=(20, 20, 20), noise_standard_deviation=0).image
sphere = flipfree.vtkQuadSphereSource()
sphere.SetCenter(1, 2, 3)
sphere.SetCenter((1, 2, 3))
sphere.SetSpacing(sphere.RADIAL)
seed = [0.0, 0.0, 0.0, 0.0]
found: bool = flipfree.vtkPhantomSource().GetSeed(6, seed)
sphere.Update()
try:
    pass
except flipfree.SegmentationError as error:
    print(error)
"""

BAD = {
    'flipfree.segment("ct.nii", (1, 2, 3), 26, level=2)': 'Unexpected keyword argument "level"',
    'flipfree.segment("ct.nii", (1, 2, 3), 26, levels="2")': 'type "str"; expected "int"',
    'flipfree.segment("ct.nii", (1, 2, 3), "9")': 'incompatible type "str"',
    'flipfree.segment("ct.nii", (1, 2, 3), 26, preset="fast")': "expected \"Literal['default'",
    'flipfree.segment("ct.nii", (1, 2, 3), 26).dice': 'has no attribute "dice"',
    'flipfree.trace("ct.nii")': 'Missing positional argument "points"',
    'flipfree.trace("ct.nii", [(1, 2, 3)], radios=4)': 'Unexpected keyword argument "radios"',
    'flipfree.evaluate("a.nii", "b.nii", label=6)': 'Unexpected keyword argument "label"',
    'flipfree.phantom("star")': "expected \"Literal['sphere'",
    'flipfree.vtkQuadSphereSource().SetRadius("large")': 'type "str"; expected "float"',
    'flipfree.vtkQuadSphereSource().SetCenter(1, 2)': "No overload variant",
    "flipfree.vtkNoSuchThing()": 'has no attribute "vtkNoSuchThing"',
}


def defined_in(body):
    """What a stub's module or class defines, by name."""
    names = {node.name: node for node in body
             if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    names.update((node.target.id, node) for node in body if isinstance(node, ast.AnnAssign))
    return names


def public(thing):
    return {name for name in vars(thing) if not name.startswith("_")}


class Names(unittest.TestCase):
    def test_every_class_and_member_is_in_the_stub_of_its_module(self):
        libraries = [value for value in vars(flipfree).values() if inspect.ismodule(value)
                     and getattr(value, "__file__", "").endswith(".so")]
        self.assertGreaterEqual(len(libraries), 3)
        for library in libraries:
            stub = PACKAGE / (library.__name__.rpartition(".")[2] + ".pyi")
            classes = defined_in(ast.parse(stub.read_text(encoding="utf-8")).body)
            self.assertEqual(set(classes), public(library))
            for name, node in classes.items():
                with self.subTest(name):
                    members = defined_in(node.body)
                    self.assertEqual(set(members), public(getattr(library, name)))
                    self.assertEqual(node.bases[0].id, getattr(library, name).__base__.__name__)
                    self.assertGreater(len(ast.get_docstring(node)), 200)

    def test_functions_have_their_parameters_spelled_out(self):
        for function, last in ((flipfree.segment, "fairing"),
                               (flipfree.trace, "label_value"),
                               (flipfree.evaluate, "score_voxelization"),
                               (flipfree.phantom, "partial_volume")):
            stub = PACKAGE / (function.__module__.rpartition(".")[2] + ".pyi")
            node = defined_in(ast.parse(stub.read_text(encoding="utf-8")).body)[function.__name__]
            spelled = [argument.arg for argument in node.args.args + node.args.kwonlyargs]
            self.assertEqual(spelled, list(inspect.signature(function).parameters))
            self.assertEqual(spelled[-1], last)

    def test_package_says_that_it_has_types(self):
        self.assertTrue((PACKAGE / "py.typed").exists())


@unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
class Mypy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # One for all runs, which read numpy's types for the most part.
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.cache = folder.name

    def mypy(self, *arguments):
        """VTK 9.1 itself has no types, so what comes from it is of any type."""
        return subprocess.run(
            [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports",
             "--allow-subclassing-any", "--cache-dir", self.cache, *arguments],
            env=dict(os.environ, MYPYPATH=str(PACKAGE.parent)), text=True, timeout=250,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False).stdout

    def check(self, program):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "program.py"
            path.write_text(program, encoding="utf-8")
            return self.mypy(str(path))

    def test_layer_is_sound_in_itself(self):
        self.assertRegex(self.mypy("-p", "flipfree"), "^Success")

    def test_accepts_what_is_right(self):
        self.assertRegex(self.check(GOOD), "^Success")

    def test_refuses_what_is_wrong(self):
        found = self.check("import flipfree\n" + "\n".join(BAD)).splitlines()
        for line, message in enumerate(BAD.values(), start=2):
            with self.subTest(message):
                self.assertTrue(any(f"program.py:{line}: error: " in text and message in text
                                    for text in found), "\n".join(found))


if __name__ == "__main__":
    unittest.main()
