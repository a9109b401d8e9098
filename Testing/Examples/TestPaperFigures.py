"""The figures of the paper: each is drawn, and shows what it should by the numbers printed with it.

  TestPaperFigures.py EXAMPLES FOLDER METHODS

METHODS is the program of the methods that FlipFree is compared with.
"""

import os
import re
import shutil
import subprocess
import sys
import unittest

EXAMPLES, FOLDER, METHODS = sys.argv[1:4]
DATA = os.environ.get("FLIPFREE_DATA_DIR", "")


def draw(folder, *arguments):
    return subprocess.run([sys.executable, os.path.join(EXAMPLES, "Python", "paper_figures.py"),
                           folder, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)


class TestPaperFigures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        cls.drawn = draw(FOLDER, "--scale", "0.72", "--methods", METHODS)

    def assert_pictures(self, folder, numbers):
        for number in numbers:
            # An empty view compresses to next to nothing.
            self.assertGreater(os.path.getsize(os.path.join(folder, f"figure-{number}.png")), 12000)

    def test_all_figures(self):
        self.assertEqual((self.drawn.returncode, self.drawn.stderr), (0, ""))
        self.assert_pictures(FOLDER, range(1, 7))
        for pattern in (r"naive, 4 iterations: [1-9]\d\d+ self-intersections",
                        r"naive, steps of 1 mm, 100 iterations: [1-9]\d\d+ self-intersections",
                        r"d  FlipFree: 0 self-intersections",
                        r"liver \(phantom\), defaults: Dice 0\.9[3-9]\d, .* 0 self-intersections",
                        r"liver \(phantom\), published: Dice 0\.\d+, .* [1-9]\d+ self-intersections",
                        r"spleen \(phantom\): Dice 0\.9\d+, .* 0 self-intersections",
                        r"vessel \(phantom\): Dice 0\.[89]\d+, .* 0 self-intersections"):
            self.assertRegex(self.drawn.stdout, pattern)

    def test_figure_5_of_the_package_alone(self):
        folder = os.path.join(FOLDER, "alone")
        process = draw(folder, "--only", "5", "--scale", "0.5")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assert_pictures(folder, (5,))
        self.assertEqual(re.findall(r"\(phantom\), ([^:]*):", process.stdout), ["defaults", "published"])

    @unittest.skipUnless(os.path.exists(os.path.join(DATA, "cases.csv")),
                         f"'{DATA}' has no cases.csv; FLIPFREE_DATA_DIR names the folder of it")
    def test_of_real_volumes(self):
        folder = os.path.join(FOLDER, "real")
        process = draw(folder, "--data", DATA, "--only", "6", "--scale", "0.5")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assert_pictures(folder, (6,))
        self.assertNotIn("phantom", process.stdout)
        self.assertRegex(process.stdout, r"spleen: Dice 0\.[89]\d+, .* 0 self-intersections")

    def test_the_gallery_quotes_the_numbers(self):
        """Those of the figures that change first."""
        with open(os.path.join(EXAMPLES, "Gallery", "README.md"), encoding="utf-8") as file:
            gallery = " ".join(file.read().split())
        counts = re.findall(r"naive.*: (\d+) self", self.drawn.stdout)
        self.assertEqual(len(counts), 2)
        for count in counts:
            self.assertIn(f"{int(count):,}", gallery)
        [dice] = re.findall(r"defaults: Dice (0\.\d+)", self.drawn.stdout)
        self.assertIn(f"Dice {dice}", gallery)
        for method in ("level set", "graph cut", "GVF snake"):
            [dice] = re.findall(rf"\(phantom\), {method}: Dice (0\.\d+)", self.drawn.stdout)
            self.assertRegex(gallery, rf"{method}[^.]*Dice (of )?{dice}")

    def test_a_folder_without_table_is_refused(self):
        process = draw(FOLDER, "--data", FOLDER)
        self.assertEqual(process.returncode, 2)
        self.assertIn("there is no cases.csv in", process.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
