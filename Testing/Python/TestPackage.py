"""The package as a researcher meets it: every filter is there, and works with VTK's and numpy's objects."""

import glob
import os
import subprocess
import sys
import unittest

import flipfree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter


def public_classes():
    """The class of each public header of the modules that were built."""
    folders = os.environ["FLIPFREE_MODULE_FOLDERS"].split(os.pathsep)
    headers = [path for folder in folders for path in glob.glob(os.path.join(folder, "vtk*.h"))]
    return sorted(os.path.splitext(os.path.basename(path))[0] for path in headers if not is_abstract(path))


def is_abstract(header):
    """Whether a class is only there to be derived from: it has no New()."""
    with open(header, encoding="utf-8") as file:
        return "* New();" not in file.read()


class Package(unittest.TestCase):
    def test_every_public_class_is_there_with_its_help_and_can_be_made_and_printed(self):
        names = public_classes()
        self.assertIn("vtkQuadSphereSource", names)
        for name in names:
            with self.subTest(name):
                instance = getattr(flipfree, name)()
                self.assertEqual(instance.GetClassName(), name)
                self.assertIn(name, str(instance))
                self.assertGreater(len(getattr(flipfree, name).__doc__), 200)

    def test_says_where_cohorts_are(self):
        with self.assertRaisesRegex(AttributeError, r"no attribute 'cohort' here: .* pip install '\.\[cohort\]' in the source"):
            getattr(flipfree, "cohort")
        with self.assertRaisesRegex(AttributeError, r"^module 'flipfree' has no attribute 'cohorts'$"):
            getattr(flipfree, "cohorts")
        self.assertNotIn("cohort", dir(flipfree))

    def test_filters_need_no_numpy(self):
        program = ("import sys; sys.modules['numpy'] = None; import flipfree; "
                   "sphere = flipfree.vtkQuadSphereSource(); flipfree.update(sphere)")
        subprocess.run([sys.executable, "-c", program], check=True)

    def test_version(self):
        self.assertRegex(flipfree.__version__, r"^\d+\.\d+\.\d+$")


class QuadSphere(unittest.TestCase):
    def test_filters_work_with_numpy_and_vtks_own(self):
        sphere = flipfree.vtkQuadSphereSource()
        sphere.SetRadius(5)
        with self.assertRaises(TypeError):
            sphere.SetRadius("large")
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(sphere.GetOutputPort())
        properties = vtkMassProperties()
        properties.SetInputConnection(triangles.GetOutputPort())
        properties.Update()
        self.assertAlmostEqual(properties.GetVolume() / 5 ** 3, 4.18879, delta=0.02)
        points = vtk_to_numpy(sphere.GetOutput().GetPoints().GetData())
        self.assertEqual(points.shape, (6144, 3))
        radii = (points ** 2).sum(axis=1) ** 0.5
        self.assertAlmostEqual(radii.min(), 5, places=12)
        self.assertAlmostEqual(radii.max(), 5, places=12)


if __name__ == "__main__":
    unittest.main(verbosity=2)
