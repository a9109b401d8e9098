"""Packs the build tree as a Debian package, reads its control fields and contents by dpkg-deb,
unpacks it elsewhere, and works from there in the shell and in Python.

  TestDebianPackage.py BUILD_TREE SOURCE_TREE WORK_FOLDER PYTHON_DESTINATION VERSION
"""

import os
import re
import shutil
import subprocess
import sys
import unittest

BUILD, SOURCE, WORK, PYTHON, VERSION = sys.argv[1:6]
LIBRARIES = ("Evaluation", "Imaging", "Phantoms", "Segmentation")


def run(*arguments, **options):
    process = subprocess.run(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True, timeout=600, **options)
    if process.returncode != 0:
        raise AssertionError(f"{arguments} failed ({process.returncode}):\n{process.stdout}")
    return process.stdout


def field(name):
    return run("dpkg-deb", "--field", TestDebianPackage.package, name).strip()


class TestDebianPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        os.makedirs(WORK)
        cls.log = run("cpack", "-G", "DEB", "--config", os.path.join(BUILD, "CPackConfig.cmake"),
                      "-B", WORK)
        [name] = [name for name in os.listdir(WORK) if name.endswith(".deb")]
        cls.package = os.path.join(WORK, name)
        cls.tree = os.path.join(WORK, "unpacked here")
        run("dpkg-deb", "--extract", cls.package, cls.tree)
        cls.files = {os.path.relpath(os.path.join(folder, file), cls.tree)
                     for folder, _, files in os.walk(cls.tree) for file in files}

    def test_nothing_is_complained_of(self):
        for word in ("warning", "Warning", "error:"):
            self.assertNotIn(word, self.log)

    def test_name(self):
        architecture = run("dpkg", "--print-architecture").strip()
        self.assertEqual(os.path.basename(self.package), f"flipfree_{VERSION}_{architecture}.deb")
        self.assertEqual((field("Package"), field("Version"), field("Architecture")),
                         ("flipfree", VERSION, architecture))

    def test_control_fields(self):
        self.assertEqual((field("Section"), field("Priority")), ("science", "optional"))
        self.assertEqual(field("Maintainer"),
                         "The FlipFree developers <developers@flipfree.invalid>")
        description = field("Description").splitlines()
        self.assertLess(len(description[0]), 80)
        self.assertGreater(len(description), 3)
        self.assertIn("libvtk9-dev", field("Suggests"))

    def test_dependencies_are_those_of_the_libraries(self):
        depends = field("Depends")
        packages = [package.split(" ")[0] for package in depends.split(", ")]
        for package in ("libc6", r"libstdc\+\+6", r"libvtk9\.\d+", r"libinsighttoolkit5\.\d+", "python3-vtk9",
                        "python3-numpy"):
            self.assertTrue(any(re.fullmatch(package, name) for name in packages), (package, packages))
        self.assertRegex(depends, r"\bpython3 \(>= 3\.\d+\), python3 \(<< 3\.\d+\)")
        self.assertNotIn("-dev", depends)
        self.assertNotRegex(depends, r"(^|, )flipfree\b")

    def test_contents(self):
        for file in ("usr/bin/flipfree",
                     "usr/include/flipfree/vtkFlipFreeSegmentation.h",
                     "usr/lib/cmake/FlipFree/FlipFreeConfig.cmake",
                     "usr/lib/cmake/FlipFree/FlipFreeConfigVersion.cmake",
                     f"usr/{PYTHON}/flipfree/__init__.py",
                     "usr/share/bash-completion/completions/flipfree",
                     "usr/share/doc/flipfree/CHANGELOG.md",
                     "usr/share/doc/flipfree/README.md",
                     "usr/share/doc/flipfree/copyright",
                     "usr/share/doc/flipfree/Examples/Cxx/CMakeLists.txt",
                     "usr/share/doc/flipfree/Examples/Python/segment_ct.py",
                     "usr/share/man/man1/flipfree.1.gz",
                     "usr/share/zsh/vendor-completions/_flipfree",
                     *(f"usr/lib/libFlipFree{name}.so.{VERSION}" for name in LIBRARIES)):
            self.assertIn(file, self.files)
        for file in self.files:
            self.assertRegex(file, "^usr/(bin|include|lib|share)/")
            self.assertNotRegex(file, "__pycache__|/Command/|Kernels")

    def test_owner_and_modes(self):
        for line in run("dpkg-deb", "--contents", self.package).splitlines():
            self.assertRegex(line, r"^(-rw-r--r--|-rwxr-xr-x|drwxr-xr-x|lrwxrwxrwx) root/root ")

    def control_file(self, name):
        control = os.path.join(WORK, f"control for {self.id()}")
        run("dpkg-deb", "--control", self.package, control)
        return os.path.join(control, name)

    def test_it_tells_the_linker(self):
        with open(self.control_file("triggers"), encoding="utf-8") as file:
            self.assertIn("ldconfig", file.read())

    def test_what_python_compiled_goes_with_it(self):
        tree = os.path.join(WORK, "installed here")
        run("dpkg-deb", "--extract", self.package, tree)
        modules, examples = (os.path.join(tree, folder) for folder in
                             (f"usr/{PYTHON}/flipfree", "usr/share/doc/flipfree/Examples/Python"))
        others = os.path.join(tree, f"usr/{PYTHON}/__pycache__")
        os.mkdir(others)
        run(sys.executable, "-m", "compileall", "-q", modules, examples)
        self.assertTrue(os.path.isdir(os.path.join(modules, "__pycache__")))

        # In place of dpkg, one that has the package in this tree.
        programs = os.path.join(WORK, "programs")
        os.mkdir(programs)
        dpkg = os.path.join(programs, "dpkg")
        with open(dpkg, "w", encoding="utf-8") as file:
            file.write('#!/bin/sh\n[ "$1 $2" = "-L flipfree" ] || exit 2\ncat "$0.list"\n')
        os.chmod(dpkg, 0o755)
        with open(dpkg + ".list", "w", encoding="utf-8") as file:
            file.writelines(os.path.join(tree, name) + "\n" for name in sorted(self.files))
        run(self.control_file("prerm"), "remove",
            env={**os.environ, "PATH": programs + ":" + os.environ["PATH"]})
        left = [folder for folder, _, _ in os.walk(tree) if folder.endswith("__pycache__")]
        self.assertEqual(left, [others])  # of another package

    def test_programs_are_stripped_and_name_no_place(self):
        for file in self.files:
            path = os.path.join(self.tree, file)
            with open(path, "rb") as stream:
                content = stream.read()
            for place in (BUILD, SOURCE):
                self.assertNotIn(place.encode(), content, file)
            if content.startswith(b"\x7fELF"):
                self.assertNotIn(".debug_info", run("readelf", "--section-headers", path), file)

    def test_it_works_where_it_was_unpacked(self):
        """In the shell and in Python; Package.InstalledTree follows the whole readme."""
        prefix = os.path.join(self.tree, "usr")
        environment = {**os.environ, "PYTHONPATH": os.path.join(prefix, PYTHON)}
        command = os.path.join(prefix, "bin", "flipfree")
        run(command, "phantom", "sphere", "-o", WORK, "--size", "20", "20", "20")
        scores = run(command, "evaluate", *2 * [os.path.join(WORK, "sphere-truth.nii.gz")])
        self.assertRegex(scores, r"(?m)^Dice +1\b")
        run(sys.executable, "-c", "import flipfree; flipfree.vtkQuadSphereSource().Update()", env=environment)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
