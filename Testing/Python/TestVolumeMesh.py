"""A volume mesher takes the surfaces as they are: TetGen fills each with tetrahedra at the first try."""

import os
import shutil
import subprocess
import tempfile
import unittest

import flipfree
from vtkmodules.util.numpy_support import vtk_to_numpy


def triangles_of(surface):
    """The certified triangulation: every face is cut from its first vertex."""
    triangles = []
    for cell in range(surface.GetNumberOfCells()):
        points = surface.GetCell(cell).GetPointIds()
        ids = [points.GetId(i) for i in range(points.GetNumberOfIds())]
        triangles += [(ids[0], ids[i], ids[i + 1]) for i in range(1, len(ids) - 1)]
    return triangles


def write_off(surface, path):
    points = vtk_to_numpy(surface.GetPoints().GetData())
    triangles = triangles_of(surface)
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines("%.17g %.17g %.17g\n" % tuple(point) for point in points)
        file.writelines("3 %d %d %d\n" % triangle for triangle in triangles)


def tetrahedra(surface, folder):
    """How many TetGen makes of it; fails where it does not."""
    path = os.path.join(folder, "surface.off")
    write_off(surface, path)
    subprocess.run(["tetgen", "-pQ", path], check=True, timeout=300, capture_output=True)
    with open(os.path.join(folder, "surface.1.ele"), encoding="ascii") as file:
        return int(file.readline().split()[0])


def segmentation_of(shape, label):
    phantom = flipfree.vtkPhantomSource()
    getattr(phantom, "SetShapeTo" + shape)()
    seed = [0.0] * 4
    phantom.GetSeed(label, seed)
    segmentation = flipfree.vtkFlipFreeSegmentation()
    segmentation.SetInputConnection(phantom.GetOutputPort())
    segmentation.SetSeedCenter(*seed[:3])
    segmentation.SetSeedRadius(seed[3])
    return segmentation


@unittest.skipUnless(shutil.which("tetgen"), "TetGen is not installed")
class VolumeMesh(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def check(self, shape, label):
        segmentation = segmentation_of(shape, label)
        segmentation.Update()
        surface = segmentation.GetSurface()
        self.assertGreater(tetrahedra(surface, self.folder), surface.GetNumberOfPoints())

    def test_sphere(self):
        self.check("Sphere", 1)

    def test_vessel_grown_along(self):
        self.check("Vessel", 1)

    def test_liver(self):
        self.check("Abdomen", flipfree.vtkPhantomSource.LIVER)

    def test_a_surface_that_intersects_itself_is_not_taken(self):
        segmentation = segmentation_of("Vessel", 1)
        segmentation.UseNaiveParameters()
        segmentation.Update()
        self.assertGreater(segmentation.GetNumberOfSelfIntersections(), 0)
        with self.assertRaises(subprocess.CalledProcessError):
            tetrahedra(segmentation.GetSurface(), self.folder)


if __name__ == "__main__":
    unittest.main()
