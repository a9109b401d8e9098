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
HELPERS = {"KernelTypes", "MessageText", "Stopwatch", "TableColumn"}


def text_of(*path):
    with open(os.path.join(SOURCE, *path), encoding="utf-8") as file:
        return file.read()


class TestGuide(unittest.TestCase):
    def test_parameters_exist(self):
        headers = glob.glob(os.path.join(SOURCE, "Filters", "Segmentation", "vtk*.h"))
        setters = re.findall(r"(?:vtkSet\w*Macro\(|void Set)(\w+)", "".join(map(text_of, headers)))
        properties = {re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower() for name in setters}
        guide = "".join(text_of("Examples", "Guide", page + ".md")
                        for page in ("README", "parameters", "several-organs", "start-label-map", "label-surfaces", "vessels"))
        named = set(re.findall(r"`([a-z]+(?:_[a-z]+)+)[`=]", guide))
        named |= set(re.findall(r"\b([a-z]+(?:_[a-z]+)*)=-?[\dTF]", guide))
        self.assertGreater(len(named), 15)
        self.assertEqual(named - properties, set())

    def test_the_map_leads_to_every_page(self):
        pages = {os.path.basename(path) for path in glob.glob(os.path.join(SOURCE, "Examples", "Guide", "*.md"))}
        page_map = text_of("Examples", "Guide", "README.md").partition("\n## ")[0]
        self.assertEqual(set(re.findall(r"\]\(([\w-]+\.md)", page_map)) | {"README.md"}, pages)

    def test_readme_is_short(self):
        self.assertLessEqual(text_of("README.md").count("\n"), 200)

    def test_readme_has_the_numbers_of_the_guide(self):
        rows = [re.findall(r"^\| (?:[CM][TR] \w+|all) \|.*", text_of(*path), re.MULTILINE)[:7]
                for path in (("README.md",), ("Examples", "Guide", "measures.md"))]
        self.assertEqual([len(table) for table in rows], [7, 7])
        for short, whole in zip(*rows):
            cells = whole.split(" | ")
            self.assertEqual(short.split(" | ")[:5], [*cells[:3], cells[4], cells[6]])

    def test_all_kernels_have_their_stage(self):
        names = {os.path.splitext(os.path.basename(path))[0]
                 for path in glob.glob(os.path.join(SOURCE, "Filters", "Kernels", "**", "*.h"),
                                   recursive=True)}
        page = text_of("Examples", "Guide", "architecture.md")
        table = page[page.index("## Kernels by stage"):page.index("## The guarantee")]
        named = set(re.findall(r"`([A-Z]\w+)`", table))
        self.assertEqual(named, names - HELPERS)

    def test_rooms_include_only_what_their_row_names(self):
        page = text_of("Examples", "Guide", "architecture.md")
        table = page[page.index("## Rooms"):page.index("## Kernels by stage")]
        rows = re.findall(r"^\| `(\w+)/` \|.*\|(.*)\|$", table, re.MULTILINE)
        rooms = [room for room, _ in rows]
        self.assertEqual(sorted(rooms), sorted(
            entry.name for entry in os.scandir(os.path.join(SOURCE, "Filters", "Kernels")) if entry.is_dir()))
        for index, (room, uses) in enumerate(rows):
            allowed = {room, *(rooms[:index] if "all rows above" in uses else re.findall(r"\w+", uses))}
            folder = os.path.join(SOURCE, "Filters", "Kernels", room)
            for name in sorted(os.listdir(folder)):
                used = set(re.findall(r'^#include "(\w+)/', text_of(folder, name), re.MULTILINE))
                self.assertLessEqual(used, allowed, f"{room}/{name}")

    def test_kernels_know_no_filter(self):
        """Their messages neither; and they throw Error, FileProblem, or std::logic_error for what should be impossible."""
        for path in glob.glob(os.path.join(SOURCE, "Filters", "Kernels", "**", "*.[hc]*"), recursive=True):
            code = re.sub(r"/\*.*?\*/|//[^\n]*", "", text_of(path), flags=re.DOTALL)
            self.assertEqual(re.findall(r"\b(?:vtk|itk)\w+", code), [], path)
            thrown = set(re.findall(r"\bthrow\s+([\w:]+)", code))
            self.assertLessEqual(thrown, {"Error", "FileProblem", "std::logic_error"}, path)

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
