"""The line that build-plugin.sh prints last starts ParaView, wherever the folders are."""

import os
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "Wrapping" / "ParaView"
# In place of what gets ParaView, and of CMake: they leave the files that the script looks for.
PARAVIEW = 'mkdir -p "$1/usr/lib/cmake" && touch "$1/usr/lib/cmake/paraview-config.cmake"'
CMAKE = 'if [[ $1 == --build ]]; then touch "$2/FlipFree.so"; fi'


class BuildScript(unittest.TestCase):
    def test_the_line_can_be_copied(self):
        with tempfile.TemporaryDirectory() as place:
            wrapping = Path(place) / "my sources" / "Wrapping"
            shutil.copytree(SCRIPTS, wrapping / "ParaView", ignore=shutil.ignore_patterns("Plugin"))
            for path, content in ((wrapping / "Setup" / "install-paraview.sh", PARAVIEW), (Path(place) / "bin" / "cmake", CMAKE)):
                path.parent.mkdir()
                path.write_text(f"#!/bin/bash\n{content}\n", encoding="utf-8")
                path.chmod(0o755)
            folder = Path(place) / "build it's here"
            process = subprocess.run([wrapping / "ParaView" / "build-plugin.sh", folder], capture_output=True, text=True,
                                     env={**os.environ, "PATH": f"{place}/bin:{os.environ['PATH']}"}, check=False)
            self.assertEqual(process.returncode, 0, process.stderr)
            line = process.stdout.splitlines()[-1].partition(": ")[2]
            self.assertEqual(shlex.split(line), [f"FLIPFREE_BUILD={folder}", str(wrapping / "ParaView" / "with-paraview.sh"),
                                                 "paraview"])

    def test_with_paraview_needs_a_program(self):
        process = subprocess.run([SCRIPTS / "with-paraview.sh", "--no-plugin"], capture_output=True, text=True, check=False)
        self.assertEqual(process.returncode, 2)
        self.assertRegex(process.stderr, "^with-paraview.sh: which program is to run")


if __name__ == "__main__":
    unittest.main()
