"""What the tests in ParaView share: the plugin loaded, an abdomen with a seed in its liver, a folder for files."""

import os
import shutil
import sys
import tempfile
import unittest

import numpy
from paraview import servermanager
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

# Voxels twice as long as the phantom's own, as in Testing/Python/example.py: the phantom's own take four times as long,
# in each process anew.
SIZE = [110, 86, 46]
SPACING = [3, 3, 6]
# The liver, as `flipfree phantom abdomen` prints it for these voxels.
SEED = [99, 84.5, 168.5]
RADIUS = 28


def abdomen():
    return simple.SegmentationPhantom(Shape="Abdomen", Dimensions=SIZE, Spacing=SPACING)


def segmentation(image, **properties):
    return simple.FlipFreeSegmentation(Input=image, SeedCenter=SEED, SeedRadius=RADIUS, **properties)


def fetch(proxy, port=0):
    """The output of a port, brought to the client."""
    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def points(surface):
    return vtk_to_numpy(surface.GetPoints().GetData()).copy()


def point_array(surface, name):
    return vtk_to_numpy(surface.GetPointData().GetArray(name)).copy()


def voxels(image):
    return vtk_to_numpy(image.GetPointData().GetScalars()).copy()


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name)).copy()


class Progress:
    """What ParaView's progress bar is told of a filter, in percent."""

    def __init__(self, filter_class):
        self.told = []
        self.handler = servermanager.ActiveConnection.Session.GetProgressHandler()
        self.handler.SetProgressInterval(self.handler.GetProgressIntervalMinValue())
        self.filter_class = filter_class
        self.tag = self.handler.AddObserver("ProgressEvent", self.note)

    def note(self, *_):
        if self.handler.GetLastProgressText() == self.filter_class:
            self.told.append(self.handler.GetLastProgress())

    def remove(self):
        self.handler.RemoveObserver(self.tag)
        self.handler.SetProgressInterval(0.1)  # ParaView's own


class SessionTest(unittest.TestCase):
    """Each test starts with an empty pipeline and has a folder of its own."""

    def setUp(self):
        simple.ResetSession()
        self.folder = tempfile.mkdtemp(prefix="flipfree-test-")
        self.addCleanup(shutil.rmtree, self.folder)

    def file(self, name):
        return os.path.join(self.folder, name)

    def view(self, kind="RenderView"):
        """A view that is gone before Python is: one that is left makes ParaView fail at the exit."""
        view = simple.CreateView(kind)
        self.addCleanup(lambda: simple.Delete(view))
        return view

    def assert_same(self, first, second):
        self.assertEqual(first.shape, second.shape)
        self.assertEqual(numpy.count_nonzero(first != second), 0,
                         f"greatest difference {numpy.abs(first.astype(float) - second).max()}")


def main():
    unittest.main(module="__main__", argv=["test", *sys.argv[1:]], verbosity=2)
