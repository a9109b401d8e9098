"""The pictures of the guide: each is drawn, with good settings agreeing better than bad ones.

  TestGuidePictures.py EXAMPLES FOLDER
"""

import os
import shutil
import subprocess
import sys
import unittest

EXAMPLES, FOLDER = sys.argv[1:3]


class TestGuidePictures(unittest.TestCase):
    def test_all_pictures(self):
        shutil.rmtree(FOLDER, ignore_errors=True)
        process = subprocess.run(
            [sys.executable, os.path.join(EXAMPLES, "Python", "guide_pictures.py"), FOLDER],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        for name in ("seed", "leak", "mass", "search", "resolution", "shape", "question"):
            # An empty view compresses to next to nothing.
            self.assertGreater(os.path.getsize(os.path.join(FOLDER, f"{name}.png")), 12000)
        for pattern in (r"seed: deep in the organ: Dice 0\.9",
                        r"leak: smoothed: Dice 0\.9",
                        r"search: search_distance=5: Dice 0\.[0-4]",
                        r"search: [^\n]*the default: Dice 0\.9",
                        r"resolution: [^\n]*levels=5: Dice 0\.9",
                        r"shape: 1, the default: Dice 0\.9",
                        r"question: are these [0-9]+ ml liver\?: Dice 0\.9"):
            self.assertRegex(process.stdout, pattern)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
