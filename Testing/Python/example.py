"""What the tests of the Python layer share: a phantom, and Python in a process of its own.

The same tests run over VTK's filters and over the kernels alone, in the package that pip builds; what only
one of them has is marked.
"""

import functools
import os
import subprocess
import sys
import unittest

import flipfree
import numpy

HAS_VTK = hasattr(flipfree, "vtkFlipFreeSegmentation")

needs_files = unittest.skipUnless(hasattr(flipfree, "vtkMedicalImageReader"), "built without ITK")
needs_vtk = unittest.skipUnless(HAS_VTK, "about VTK's objects")
needs_wheel = unittest.skipIf(HAS_VTK, "about the objects of the package without VTK")

SEED = (99.75, 83.75, 167)
RADIUS = 28
# Voxels twice as long as the phantom's own; 86 and 46 are a row and a slice more than half, as in
# Testing/Command/command.py. What is found with the phantom's own is tested in
# Testing/Filters/TestPhantomSegmentation.cxx (AbdomenSegmentation).
SIZE = (110, 86, 46)
SPACING = (3, 3, 6)


@functools.lru_cache(maxsize=None)
def abdomen():
    """As keep_abdomen.py has kept it, where CTest had it do so."""
    path = os.environ.get("FLIPFREE_ABDOMEN")
    if not path:
        return flipfree.phantom("abdomen", dimensions=SIZE, spacing=SPACING)
    with numpy.load(path) as kept:
        geometry = [kept[name] for name in ("spacing", "origin", "direction")]
        volume, labels = (flipfree.image_from_array(kept[name], *geometry) for name in ("image", "label_map"))
        seeds = {int(label): (tuple(place), radius) for label, *place, radius in kept["seeds"].tolist()}
    return flipfree.Phantom(volume, labels, seeds)


def image():
    return abdomen().image


def truth():
    return abdomen().label_map


def surface_of(segmentation):
    """As evaluate() takes it."""
    return segmentation.surface if HAS_VTK else segmentation.mesh


def points_of(surface):
    if not HAS_VTK:
        return surface.points
    return numpy.array([surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())])


def axes_of(image):
    """The direction matrix."""
    if not HAS_VTK:
        return numpy.reshape(image.direction, (3, 3))
    matrix = image.GetDirectionMatrix()
    return numpy.array([[matrix.GetElement(row, column) for column in range(3)] for row in range(3)])


def spacing_of(image):
    return image.GetSpacing() if HAS_VTK else image.spacing


@functools.lru_cache(maxsize=None)
def liver():
    return flipfree.segment(image(), SEED, RADIUS)


@functools.lru_cache(maxsize=None)
def coarse_liver():
    return flipfree.segment(image(), SEED, RADIUS, resolution=8)


def start_python(program):
    """Runs a program with SEED, RADIUS and image() at hand."""
    preamble = "import flipfree\nfrom example import *\n"
    return subprocess.Popen([sys.executable, "-c", preamble + program], text=True,
                            cwd=os.path.dirname(__file__), stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)
