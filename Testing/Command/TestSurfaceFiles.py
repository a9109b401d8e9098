"""The promise about files: what other software reads from them is the surface that was certified."""

import os
import unittest

import command
import numpy
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkTriangleFilter
from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

READERS = {".vtp": vtkXMLPolyDataReader, ".stl": vtkSTLReader, ".ply": vtkPLYReader, ".obj": vtkOBJReader}


def write_volume(name, organ, noise, offset=0):
    """A MetaImage of short integers."""
    values = (100 * organ + noise * numpy.random.default_rng(1).normal(size=organ.shape)).astype("<i2")
    with open(name, "wb") as file:
        file.write(("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                    f"Offset = {offset} 0 0\nElementSpacing = 1 1 1\n"
                    f"DimSize = {' '.join(map(str, organ.shape[::-1]))}\n"
                    "ElementType = MET_SHORT\nElementDataFile = LOCAL\n").encode())
        file.write(values.tobytes())


def field(size=48):
    """Distances from the center, and the angles there."""
    z, y, x = numpy.indices((size, size, size)) - (size - 1) / 2
    return numpy.sqrt(x * x + y * y + z * z), numpy.arctan2(y, x), numpy.arctan2(z, numpy.hypot(x, y))


class TestSurfaceFiles(command.CommandTest):
    def segment(self, output, *arguments, center=23.5, radius=7):
        return command.run("segment", self.result("organ.mha"), "--seed", center, 23.5, 23.5, "--radius", radius,
                           "-o", self.result(output), *arguments)

    def open_edges(self, name):
        """As a program sees them that cuts quads in its own way."""
        reader = READERS[name[-4:]]()
        reader.SetFileName(self.result(name))
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(reader.GetOutputPort())
        edges = vtkFeatureEdges()
        edges.SetInputConnection(triangles.GetOutputPort())
        edges.FeatureEdgesOff()
        edges.Update()
        self.assertGreater(triangles.GetOutput().GetNumberOfPolys(), 1000)
        return edges.GetOutput().GetNumberOfCells()

    def test_sharp_folds_are_valid_in_every_format(self):
        """Arms with narrow clefts between them: quads are bent, and their two cuts differ."""
        distance, around, up = field()
        arms = numpy.abs(numpy.sin(3 * around) * numpy.cos(2 * up)) > 0.45
        write_volume(self.result("organ.mha"), (distance < 8) | ((distance < 20) & arms), 10)
        for ending in READERS:
            with self.subTest(ending=ending):
                name = "arms" + ending
                process = self.segment(name, "--labels", self.result("labels.mha"))
                self.assertEqual(process.returncode, 0, process.stderr)
                # An arm may be none of the organ's.
                self.assertRegex(process.stderr, r"\A(flipfree: warning: Is the part of .* (adds|removes) it\.\n)?\Z")
                self.assertEqual(self.open_edges(name), 0)
                process = command.run("evaluate", self.result(name), self.result("labels.mha"))
                self.assertRegex(process.stdout, r"surface +valid: closed, Euler number 2, self-intersections 0")

    def test_trees_are_valid_in_every_format(self):
        """Where branches meet, the start's faces have five corners or six, and VTK would cut bent ones with holes."""
        z, y, x = numpy.indices((64, 64, 64)) - 31.5
        branches = (numpy.hypot(y, z) < 5), (numpy.hypot(y - 0.9 * x, z) < 4) & (x > 0), (numpy.hypot(y + 0.6 * x, z - x) < 3) & (x > 0)
        write_volume(self.result("organ.mha"), numpy.where(x < -28, -10.4, 1.1 * numpy.any(branches, axis=0) + 0.4), 10)
        points = [word for x, y, z in ((6, 31.5, 31.5), (58, 31.5, 31.5), (58, 55, 31.5), (58, 15, 58)) for word in ("--point", x, y, z)]
        for ending in READERS:
            with self.subTest(ending=ending):
                name = "tree" + ending
                process = command.run("trace", self.result("organ.mha"), *points, "-o", self.result(name))
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertEqual(self.open_edges(name), 0)

    def test_what_a_format_cannot_hold_is_not_written(self):
        """Single precision is too coarse so far from the origin."""
        write_volume(self.result("organ.mha"), field()[0] < 16, 5, offset=10 ** 8)
        for ending in (".stl", ".ply"):
            process = self.segment("far" + ending, center=10 ** 8 + 23.5)
            self.assertEqual(process.returncode, 1)
            self.assertRegex(process.stderr, r"cannot hold this surface: .* Write a \.vtp")
        self.assert_succeeds(self.segment("far.vtp", center=10 ** 8 + 23.5))
        self.assertEqual(self.open_edges("far.vtp"), 0)
        self.assertEqual({name for name in os.listdir(self.results)}, {"organ.mha", "far.vtp"})

    def test_what_is_not_certified_says_so(self):
        write_volume(self.result("organ.mha"), field()[0] < 16, 5)
        for options, certified in (((), 1), (("--preset", "published"), 0)):
            process = self.segment("sphere.vtp", *options)
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertEqual("not certified" in process.stderr, certified == 0)
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(self.result("sphere.vtp"))
            reader.Update()
            self.assertEqual(reader.GetOutput().GetFieldData().GetArray("Certified").GetTuple1(0), certified)


if __name__ == "__main__":
    unittest.main()
