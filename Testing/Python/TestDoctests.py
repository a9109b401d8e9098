"""The examples in the package's documentation, and those of the generator of its type stubs."""

import doctest
import importlib
import os
import pkgutil
import sys
import unittest

import flipfree

MODULES = ["flipfree"] + [
    "flipfree." + module.name for module in pkgutil.iter_modules(flipfree.__path__)
    if module.name.startswith("_")]
if not hasattr(flipfree, "vtkMedicalImageReader"):
    MODULES.remove("flipfree._files")


def load_tests(_loader, tests, _pattern):
    sys.path.insert(0, os.environ["FLIPFREE_PYTHON_SOURCE"])
    for name in MODULES + ["GenerateStubs"]:
        tests.addTests(doctest.DocTestSuite(importlib.import_module(name),
                                            optionflags=doctest.ELLIPSIS))
    return tests


class Coverage(unittest.TestCase):
    def test_what_is_public_has_an_example(self):
        for function in (flipfree.segment, flipfree.evaluate, flipfree.read_image,
                         flipfree.write_image, flipfree.image_from_array,
                         flipfree.array_from_image, flipfree.default_parameters,
                         flipfree.update):
            with self.subTest(function.__name__):
                self.assertIn(">>> import flipfree", function.__doc__)


if __name__ == "__main__":
    unittest.main()
