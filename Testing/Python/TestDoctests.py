"""The examples in the package's documentation, and those of the generators of its type stubs and documentation."""

import doctest
import functools
import importlib
import os
import pkgutil
import sys
import unittest

import flipfree
from example import HAS_VTK

MODULES = ["flipfree"] + [
    "flipfree." + module.name for module in pkgutil.iter_modules(flipfree.__path__)
    if module.name.startswith("_")]
if HAS_VTK and not hasattr(flipfree, "vtkMedicalImageReader"):
    MODULES.remove("flipfree._files")


def load_tests(_loader, tests, _pattern):
    # Several make the same one, which takes longer than what they do with it. None changes it.
    flipfree.phantom = functools.lru_cache(maxsize=None)(flipfree.phantom)
    source = os.environ["FLIPFREE_PYTHON_SOURCE"]
    sys.path[:0] = [source, os.path.join(source, "Wheel")]
    for name in MODULES + ["GenerateStubs", "GenerateDocumentation"]:
        tests.addTests(doctest.DocTestSuite(importlib.import_module(name),
                                            optionflags=doctest.ELLIPSIS))
    return tests


class Coverage(unittest.TestCase):
    def test_what_is_public_has_an_example(self):
        own = (flipfree.update,) if HAS_VTK else (flipfree.threads, flipfree.set_threads)
        for function in (flipfree.segment, flipfree.trace, flipfree.evaluate, flipfree.phantom, flipfree.read_image,
                         flipfree.write_image, flipfree.image_from_array,
                         flipfree.array_from_image, flipfree.default_parameters, *own):
            with self.subTest(function.__name__):
                self.assertIn(">>> import flipfree", function.__doc__)


if __name__ == "__main__":
    unittest.main()
