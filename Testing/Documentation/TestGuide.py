"""The guide and the architecture page speak of what there is: parameters, kernels, modules.

  TestGuide.py SOURCE_TREE
"""

import glob
import os
import re
import sys
import unittest

SOURCE = sys.argv[1]
# What kernels share, and what has no stage of its own.
HELPERS = {"KernelTypes", "MessageText", "Stopwatch"}


def text_of(*path):
    with open(os.path.join(SOURCE, *path), encoding="utf-8") as file:
        return file.read()


class TestGuide(unittest.TestCase):
    def test_parameters_exist(self):
        headers = glob.glob(os.path.join(SOURCE, "Filters", "Segmentation", "vtk*.h"))
        setters = re.findall(r"(?:vtkSet\w*Macro\(|void Set)(\w+)", "".join(map(text_of, headers)))
        properties = {re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower() for name in setters}
        guide = text_of("Examples", "Guide", "README.md")
        named = set(re.findall(r"`([a-z]+(?:_[a-z]+)+)[`=]", guide))
        named |= set(re.findall(r"\b([a-z]+(?:_[a-z]+)*)=-?[\dTF]", guide))
        self.assertGreater(len(named), 15)
        self.assertEqual(named - properties, set())

    def test_all_kernels_have_their_stage(self):
        names = {os.path.splitext(os.path.basename(path))[0]
                 for path in glob.glob(os.path.join(SOURCE, "Filters", "Kernels", "**", "*.h"),
                                   recursive=True)}
        page = text_of("Examples", "Guide", "architecture.md")
        table = page[page.index("## Kernels by stage"):page.index("## The guarantee")]
        named = set(re.findall(r"`([A-Z]\w+)`", table))
        self.assertEqual(named, names - HELPERS)

    def test_modules_and_filters_exist(self):
        page = text_of("Examples", "Guide", "architecture.md")
        modules = {re.search(r"FlipFree::\w+", text_of("Filters", name, "vtk.module")).group()
                   for name in os.listdir(os.path.join(SOURCE, "Filters"))
                   if os.path.exists(os.path.join(SOURCE, "Filters", name, "vtk.module"))}
        self.assertEqual(set(re.findall(r"FlipFree::\w+", page)), modules)
        for name in set(re.findall(r"\bvtk[A-Z]\w+", page)):
            self.assertTrue(glob.glob(os.path.join(SOURCE, "Filters", "*", name + ".h")), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
