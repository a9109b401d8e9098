"""The method, composed from its stages, one iteration at a time.

This is what vtkFlipFreeSegmentation does inside, from coarse to fine, with everything in sight.
"""

from dataclasses import dataclass

import flipfree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

RESOLUTIONS = (4, 8, 16, 32)  # vertices along the side of the cube, level by level
MOST_ITERATIONS = 40  # at each level
LEVELS = len(RESOLUTIONS)  # of the first run; the second, after carving, has as many


@dataclass
class Iteration:
    """What one iteration did."""

    level: int
    mean_distance: float  # to the targets, mm
    matched: int  # vertices that have one
    flipping: int  # whose targets would have flipped an edge
    guarded: int  # held back, because the surface would have met itself


class Growth:
    """A surface that grows from a seed sphere, by step() after step(), until it has converged."""

    def __init__(self, image, seed, radius):
        self.voxel = max(image.GetSpacing())
        self.level = -1
        self.distances = []

        # The image, smoothed where the surface can get to.
        self.smooth = flipfree.vtkSeedRegionDiffusion()
        self.smooth.SetInputData(image)
        self.smooth.SetSeedCenter(seed)
        self.smooth.SetSeedRadius(radius)

        # How well each voxel fits the organ, from 0 to 1: first by the seed sphere's intensities.
        self.feature = flipfree.vtkGMMFeatureFilter()
        self.feature.SetInputConnection(self.smooth.GetOutputPort())
        self.feature.SetSeedCenter(seed)
        self.feature.SetSeedRadius(radius)
        self.feature.CarvingOff()  # until there is a surface to carve

        # From each vertex along its normal to the boundary of the foreground.
        self.search = flipfree.vtkCorrespondenceSearch()
        self.search.SetFeatureConnection(self.feature.GetOutputPort())

        # Towards these targets, but never so that a face flips or the surface meets itself.
        self.deform = flipfree.vtkFlipFreeDeform()
        self.deform.SetInputConnection(self.search.GetOutputPort())

        sphere = flipfree.vtkQuadSphereSource()
        sphere.SetCenter(seed)
        sphere.SetRadius(radius)
        sphere.SetResolution(RESOLUTIONS[0])
        sphere.Update()
        self.surface = self.start = sphere.GetOutput()

    def has_converged(self):
        """Has the last level ended?"""
        return self.level == 2 * LEVELS - 1 and self._is_level_done()

    def step(self):
        """One iteration; the first one of a level is preceded by what that level needs."""
        if self._is_level_done():
            self._next_level()
        self.search.SetInputData(self.surface)
        flipfree.update(self.search)
        flipfree.update(self.deform)
        self.surface = _detached(self.deform.GetOutput())
        self.distances.append(_number(self.search, "MeanDistance"))
        matched = self.search.GetOutput().GetPointData().GetArray("Correspondence")
        return Iteration(self.level, self.distances[-1], int((vtk_to_numpy(matched) == 1).sum()),
                         int(_number(self.deform, "FlippingVertices")),
                         int(_number(self.deform, "GuardedVertices")))

    def _is_level_done(self):
        recent = self.distances[-6:]
        return (self.level < 0 or len(self.distances) == MOST_ITERATIONS
                or len(recent) == 6 and recent[0] - recent[-1] < 0.02 * self.voxel)

    def _next_level(self):
        self.level += 1
        self.distances = []
        if self.level == 0:
            flipfree.update(self.smooth)
        elif self.level == LEVELS:
            # What has leaked is carved off, and the surface grows again within what remains.
            self.feature.CarvingOn()
            self.feature.SetSurfaceData(self.surface)
            self.surface = self.start
        else:
            refine = flipfree.vtkFlipFreeRefinement()
            refine.SetInputData(self.surface)
            flipfree.update(refine)
            self.surface = refine.GetOutput()
            if self.level < LEVELS:
                # By now the surface knows the organ better than the seed did.
                self.feature.SetSurfaceData(self.surface)
        # The last millimeter: to the strongest edge. What is carved ends there of itself.
        snaps = self.level == LEVELS - 1
        self.search.SetEdgeConnection(self.smooth.GetOutputPort() if snaps else None)
        flipfree.update(self.feature)


def _detached(surface):
    """A filter's output changes with its next update; this one stays."""
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    return copy


def _number(algorithm, name):
    return algorithm.GetOutput().GetFieldData().GetArray(name).GetValue(0)
