"""The walls of all organs, as TetGen takes them: one mesh, with the volumes of the labels.

  TestMeshOrgans.py EXAMPLES PROGRAM FOLDER

FOLDER takes what the example in Python writes, and PROGRAM is the same example in C++.
"""

import os
import re
import shutil
import subprocess
import sys
import unittest

import flipfree
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

EXAMPLES, PROGRAM, FOLDER = sys.argv[1:4]
EXAMPLE = os.path.join(EXAMPLES, "Python", "mesh_organs.py")


def run(*command, folder=FOLDER):
    return subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)


def numbers_in(name):
    with open(os.path.join(FOLDER, name), encoding="ascii") as file:
        return [float(word) for word in file.read().split()]


def volumes_in(name):
    """Of the tetrahedra of each label, in ml."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.path.join(FOLDER, name))
    reader.Update()
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    corners = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    volumes = numpy.abs(numpy.linalg.det(points[corners[:, 1:]] - points[corners[:, :1]])) / 6000
    return numpy.bincount(vtk_to_numpy(grid.GetCellData().GetArray("Label")), volumes)


@unittest.skipUnless(shutil.which("tetgen"), "TetGen is not installed")
class TestMeshOrgans(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        os.makedirs(FOLDER)
        cls.filled = run(sys.executable, EXAMPLE, "--folder", "python", "--compare", "--picture", "organs.png")
        cls.written = run(PROGRAM)

    def test_the_mesh_has_the_volumes_of_the_labels(self):
        self.assertEqual((self.filled.returncode, self.filled.stderr), (0, ""))
        rows = re.findall(r"label +(\d+): +(\d+) tetrahedra of +([\d.]+) ml, voxels of +([\d.]+) ml", self.filled.stdout)
        self.assertEqual([int(row[0]) for row in rows], list(range(1, 12)))
        saved = volumes_in(os.path.join("python", "organs.vtu"))
        for label, count, volume, wanted in rows:
            with self.subTest(label=label):
                self.assertGreater(int(count), 500)
                self.assertLess(abs(float(volume) / float(wanted) - 1), 0.03)
                self.assertLess(abs(float(volume) - saved[int(label)]), 0.1)
        self.assertRegex(self.filled.stdout, r"one mesh: \d+ tetrahedra, shapes 0\.\d+ at least, 0\.[12]\d for 99 %")

    def test_the_usual_chain_is_refused_where_its_surfaces_meet_themselves(self):
        self.assertRegex(self.filled.stdout, r"TetGen refuses [1-9] of 11; shapes 0\.\d+ at least")

    def test_the_picture_shows_something(self):
        self.assertGreater(os.path.getsize(os.path.join(FOLDER, "organs.png")), 100000)

    def test_both_languages_write_the_same_walls(self):
        self.assertEqual((self.written.returncode, self.written.stderr), (0, ""))
        self.assertEqual(numbers_in("walls.smesh"), numbers_in(os.path.join("python", "walls.smesh")))
        self.assertEqual(self.triangles_for_gmsh(""), self.triangles_for_gmsh("python"))

    def triangles_for_gmsh(self, folder):
        """How many enclose each label."""
        with open(os.path.join(FOLDER, folder, "walls.msh"), encoding="ascii") as file:
            surfaces = re.findall(r"^\d+ 2 2 (\d+) \1 \d+ \d+ \d+$", file.read(), re.MULTILINE)
        with open(os.path.join(FOLDER, folder, "organs.geo"), encoding="ascii") as file:
            loops = re.findall(r"Surface Loop\((\d+)\) = {([\d, ]+)};\nVolume\(\1\) = {\1};\nPhysical Volume\(\1\) = {\1};",
                               file.read())
        self.assertEqual(len(loops), 11)
        return {label: sum(surfaces.count(surface) for surface in around.split(", ")) for label, around in loops}

    def test_a_turned_image_with_enclosed_background(self):
        """A box of two labels around a cavity, in an image that begins elsewhere."""
        voxels = numpy.zeros((24, 24, 24), numpy.int16)
        voxels[4:20, 4:20, 4:20] = 7
        voxels[12:20, 4:20, 4:20] = 70000 // 3
        voxels[9:14, 9:14, 9:14] = 0
        image = vtkImageData()
        image.SetExtent(5, 28, -3, 20, 0, 23)
        image.SetOrigin(-40, 10, 300)
        image.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(voxels.ravel(), deep=True))
        flipfree.write_image(image, os.path.join(FOLDER, "turned.nrrd"))
        process = run(sys.executable, EXAMPLE, "turned.nrrd", "--folder", "turned", "--edge-length", "3")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        saved = volumes_in(os.path.join("turned", "organs.vtu"))
        for label in (7, 70000 // 3):
            self.assertLess(abs(saved[label] / ((voxels == label).sum() / 1000) - 1), 0.02)

    def test_what_cannot_be_done_is_said(self):
        self.assertEqual(run(PROGRAM, "none.nii.gz").returncode, 1)
        for words in (("labels.nii.gz", "5mm"), ("a", "5", "b")):
            process = run(PROGRAM, *words)
            self.assertEqual((process.returncode, process.stderr[:18]), (2, "Usage: MeshOrgans "))
        self.assertEqual(run(PROGRAM, "--help").stdout[:18], "Usage: MeshOrgans ")
        folder = os.path.join(FOLDER, "full")
        os.makedirs(os.path.join(folder, "walls.smesh"))
        process = run(PROGRAM, folder=folder)
        self.assertEqual(process.returncode, 1)
        self.assertRegex(process.stderr, "^walls.smesh cannot be written; run this in a folder that has room for it")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
