"""The figures of the paper: each is drawn, and shows what it should by the numbers printed with it.

  TestPaperFigures.py EXAMPLES FOLDER
"""

import os
import re
import shutil
import subprocess
import sys
import unittest

EXAMPLES, FOLDER = sys.argv[1:3]


def draw(*arguments):
    return subprocess.run([sys.executable, os.path.join(EXAMPLES, "Python", "paper_figures.py"),
                           FOLDER, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=1200)


class TestPaperFigures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        cls.drawn = draw("--scale", "0.72")  # once, since the level set takes its time

    def test_all_figures(self):
        process = self.drawn
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        for number in range(1, 7):
            # An empty view compresses to next to nothing.
            self.assertGreater(os.path.getsize(os.path.join(FOLDER, f"figure-{number}.png")), 12000)
        for pattern in (r"naive, 4 iterations: [1-9]\d\d+ self-intersections",
                        r"naive, steps of 1 mm, 100 iterations: [1-9]\d\d+ self-intersections",
                        r"d  FlipFree: 0 self-intersections",
                        r"liver \(phantom\), defaults: Dice 0\.9[3-9]\d, .* 0 self-intersections",
                        r"liver \(phantom\), published: Dice 0\.\d+, .* [1-9]\d+ self-intersections",
                        r"spleen \(phantom\): Dice 0\.9\d+, .* 0 self-intersections",
                        r"vessel \(phantom\): Dice 0\.[89]\d+, .* 0 self-intersections"):
            self.assertRegex(process.stdout, pattern)

    def test_the_gallery_quotes_the_numbers(self):
        """Those of the figures that change first."""
        with open(os.path.join(EXAMPLES, "Gallery", "README.md"), encoding="utf-8") as file:
            gallery = file.read()
        for count in re.findall(r"naive.*: (\d+) self", self.drawn.stdout):
            self.assertIn(f"{int(count):,}", gallery)
        [dice] = re.findall(r"defaults: Dice (0\.\d+)", self.drawn.stdout)
        self.assertIn(f"Dice {dice}", gallery)
        for method in ("level set", "graph cut", "GVF snake"):
            [dice] = re.findall(rf"\(phantom\), {method}: Dice (0\.\d+)", self.drawn.stdout)
            self.assertRegex(gallery, rf"{method}[^.]*Dice {dice}")

    def test_a_folder_without_table_is_refused(self):
        process = draw("--data", FOLDER)
        self.assertEqual(process.returncode, 2)
        self.assertIn("there is no cases.csv in", process.stderr)

    def test_pictures_of_the_gallery_are_small(self):
        folder = os.path.join(EXAMPLES, "Gallery")
        self.assertLess(sum(os.path.getsize(os.path.join(folder, name))
                            for name in os.listdir(folder)), 1.5e6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
