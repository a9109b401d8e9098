"""What the tests of the Python layer share: a phantom, and Python in a process of its own."""

import functools
import os
import subprocess
import sys
import unittest

import flipfree

needs_files = unittest.skipUnless(hasattr(flipfree, "vtkMedicalImageReader"), "built without ITK")

SEED = (99.75, 83.75, 167)
RADIUS = 28


@functools.lru_cache(maxsize=None)
def abdomen():
    phantom = flipfree.vtkPhantomSource()
    phantom.SetShapeToAbdomen()
    phantom.Update()
    return phantom


def image():
    return abdomen().GetOutput()


def truth():
    return abdomen().GetLabelMap()


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
