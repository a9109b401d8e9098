"""What builds a release's wheels plans them as pyproject.toml says, and says what is missing; nothing is built.

  TestReleaseScripts.py SOURCE_TREE
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
SCRIPTS = [*(SOURCE / "Wrapping" / "Python" / "Wheel").glob("*.sh"), SOURCE / "Testing" / "Wheel" / "test-wheel.sh"]
BUILD = SOURCE / "Wrapping" / "Python" / "Wheel" / "build-wheels.sh"
PROJECT = tomllib.loads((SOURCE / "pyproject.toml").read_text(encoding="utf-8"))
VERSIONS = [int(line.rpartition(".")[2]) for line in PROJECT["project"]["classifiers"]
            if re.search(r":: Python :: 3\.\d+$", line)]
OLDEST = int(PROJECT["project"]["requires-python"].removeprefix(">=3."))
STABLE = int(PROJECT["tool"]["scikit-build"]["wheel"]["py-api"].removeprefix("cp3"))
# All that a plan takes of the system, which may have Pythons of its own.
PROGRAMS = "bash", "dirname", "grep", "sed", "sh", "sort", "tail"


class Scripts(unittest.TestCase):
    def test_are_understood_and_say_what_they_do(self):
        self.assertEqual(len(SCRIPTS), 5)
        for path in SCRIPTS:
            with self.subTest(path.name):
                subprocess.run(["bash", "-n", path], check=True)
                if os.access(path, os.X_OK):
                    for option, status in (("--help", 0), ("--nonsense", 2)):
                        shown = subprocess.run([path, option], capture_output=True, text=True, check=False)
                        self.assertEqual(shown.returncode, status)
                        self.assertIn(f"\n  {path.name} ", shown.stdout)
                        self.assertNotIn("set -euo", shown.stdout)


class Project(unittest.TestCase):
    def test_versions_have_no_gap(self):
        self.assertEqual(VERSIONS, list(range(OLDEST, VERSIONS[-1] + 1)))
        self.assertIn(STABLE, VERSIONS)

    def test_build_agrees(self):
        text = (BUILD.parent / "CMakeLists.txt").read_text(encoding="utf-8")
        self.assertIn(f"find_package(Python 3.{OLDEST} REQUIRED", text)
        self.assertRegex(text, r"nanobind_add_module\(_kernels STABLE_ABI\b")


class Plan(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name in PROGRAMS:
            (self.folder / name).symlink_to(shutil.which(name))

    def python(self, name, answer):
        """A stand-in that gives an answer."""
        path = self.folder / name
        path.write_text(f"#!/bin/sh\n{answer}\n", encoding="utf-8")
        path.chmod(0o755)
        return path

    def stand_in(self, minor):
        return self.python(f"python3.{minor}", f"echo {minor} /of/{minor}")

    def plan(self, *pythons):
        return subprocess.run([BUILD, "--plan", *pythons], capture_output=True, text=True, check=False,
                              env={"PATH": str(self.folder), "HOME": str(self.folder)})

    def test_has_every_version(self):
        for minor in VERSIONS:
            self.stand_in(minor)
        own = [f"cp3{minor}-cp3{minor}, tested with 3.{minor}, built with /of/{minor}" for minor in range(OLDEST, STABLE)]
        tested = " ".join(f"3.{minor}" for minor in range(STABLE, VERSIONS[-1] + 1))
        shared = f"cp3{STABLE}-abi3, tested with {tested}, built with /of/{STABLE}"
        self.assertEqual(self.plan().stdout.splitlines(), [*own, shared])

    def test_says_which_version_is_missing(self):
        for minor in VERSIONS[1:]:
            self.stand_in(minor)
        planned = self.plan()
        self.assertEqual(planned.returncode, 1)
        self.assertRegex(planned.stderr, rf"^No CPython 3\.{OLDEST} with its headers is on PATH or in pyenv\.")
        self.stand_in(OLDEST)
        for minor in range(STABLE, VERSIONS[-1] + 1):
            (self.folder / f"python3.{minor}").unlink()
        self.assertRegex(self.plan().stderr, rf"^No CPython 3\.{STABLE} with its headers")

    def test_takes_the_pythons_that_are_named(self):
        lines = self.plan(self.stand_in(VERSIONS[-1])).stdout.splitlines()
        self.assertEqual(lines[0], f"cp3{STABLE}-abi3, tested with 3.{VERSIONS[-1]}, built with /of/{VERSIONS[-1]}")
        self.assertEqual(lines[1:], [f"Not tested: Python 3.{minor}, which is not here." for minor in VERSIONS[:-1]])

    def test_looks_at_a_real_one(self):
        planned = self.plan(sys.executable)
        self.assertRegex(planned.stdout + planned.stderr, r", built with /|cannot be used: it lacks ")

    def test_refuses_free_threaded_pythons(self):
        program = "import sys, sysconfig; sysconfig.get_config_var = lambda name: 1; exec(sys.stdin.read())"
        python = self.python("python3.13t", f"shift\nexec '{sys.executable}' -c '{program}' \"$@\"")
        planned = self.plan(python)
        self.assertEqual(planned.returncode, 1)
        self.assertRegex(planned.stderr, "cannot be used: it is free-threaded, and there are no wheels for that.$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
