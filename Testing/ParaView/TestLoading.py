"""The plugin loads into ParaView's programs, brings no second VTK, and warns of another version of ParaView."""

import glob
import os
import re
import shutil
import subprocess
import tempfile
import unittest

BUILD = os.environ["FLIPFREE_BUILD"]
PROGRAMS = os.path.join(BUILD + "-prefix", "usr", "bin")
[PLUGIN] = glob.glob(os.path.join(BUILD, "lib", "paraview-*", "plugins", "FlipFree", "FlipFree.so"))
VERSION = re.findall("/paraview-([0-9.]+)/", PLUGIN)[-1]

LOAD = """
from paraview.simple import *
LoadPlugin({plugin!r}, remote=False, ns=globals())
sphere = QuadSphere(Resolution=4)
sphere.UpdatePipeline()
print("points", sphere.GetDataInformation().GetNumberOfPoints())
print("libraries", *sorted({{line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}}))
"""

# A stand-in for a ParaView of another patch version: what it says when it is asked.
OTHER_PATCH = "int _ZN17vtkSMProxyManager15GetVersionPatchEv(void) { return 7; }\n"


class Loading(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="flipfree-test-")
        self.addCleanup(shutil.rmtree, self.folder)

    def load(self, program="pvpython", **environment):
        """Runs a program that loads the plugin."""
        script = os.path.join(self.folder, "load.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(LOAD.format(plugin=PLUGIN))
        inherited = {name: value for name, value in os.environ.items() if name != "PV_PLUGIN_PATH"}
        return subprocess.run([os.path.join(PROGRAMS, program), script], env={**inherited, **environment}, timeout=120,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def test_loads_and_brings_no_second_vtk(self):
        for program in ("pvpython", "pvbatch"):
            with self.subTest(program=program):
                result = self.load(program=program)
                self.assertEqual(result.returncode, 0, result.stdout)
                self.assertIn("points 96\n", result.stdout)
                self.assertNotRegex(result.stdout, "ERR|WARN|Warn")
                names = [os.path.basename(path) for path in result.stdout.split("libraries ")[1].split()]
                self.assertIn("libFlipFreeImaging.so", names)
                self.assertTrue(any(name.startswith("libITKIOImageBase") for name in names))
                of_vtk = [name for name in names if re.match("libvtk[A-Z]", name)]
                self.assertGreater(len(of_vtk), 20)
                self.assertEqual([name for name in of_vtk if "-pv" + VERSION not in name], [])

    def test_warns_of_another_patch_version(self):
        source, library = (os.path.join(self.folder, "other" + ending) for ending in (".c", ".so"))
        with open(source, "w", encoding="utf-8") as file:
            file.write(OTHER_PATCH)
        subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source], check=True)
        result = self.load(LD_PRELOAD=library)
        self.assertRegex(result.stdout, rf"FlipFree was built with ParaView {VERSION}\.\d, and this is ParaView {VERSION}\.7")
        self.assertIn("build-plugin.sh", result.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
