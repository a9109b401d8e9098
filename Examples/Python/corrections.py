"""A segmentation and the steps that correct it, which can be taken back and brought again."""

import flipfree
from vtkmodules.vtkCommonDataModel import vtkPolyData

OUTSIDE, INSIDE, BOUNDARY = "outside the organ", "inside the organ", "on its boundary"
ADD = {
    OUTSIDE: flipfree.vtkFlipFreeSegmentation.AddOutsidePoint,
    INSIDE: flipfree.vtkFlipFreeSegmentation.AddInsidePoint,
    BOUNDARY: flipfree.vtkFlipFreeSegmentation.AddBoundaryPoint,
}
# Of points that parts of the organ follow.
PREVIEW = {
    OUTSIDE: flipfree.vtkFlipFreeSegmentation.PreviewOutsidePoint,
    INSIDE: flipfree.vtkFlipFreeSegmentation.PreviewInsidePoint,
}


class Corrections:
    """Steps are pairs of what their points say and the places: a click, a stroke, or an answer."""

    def __init__(self, image, seed, radius):
        self.done = []
        self.undone = []
        self.surface = vtkPolyData()  # one object, into which each new result is copied
        self.filter = flipfree.vtkFlipFreeSegmentation()
        self.filter.SetInputData(image)
        self.filter.SetSeedCenter(seed)
        self.filter.SetSeedRadius(radius)
        self.filter.KeepForCorrectionsOn()  # a correction then takes a third of the time
        self._segment()

    def do(self, meaning, places):
        """Another step; one that cannot be obeyed is none: the result stays, the error goes on."""
        self._add(meaning, places)
        self.undone.clear()

    def undo(self):
        """Takes the last step back; False if there is none."""
        if not self.done:
            return False
        self.undone.append(self.done.pop())
        self._remove(self.undone[-1][1])
        return True

    def redo(self):
        """Brings the last step again that has been taken back; False if there is none."""
        if not self.undone:
            return False
        self._add(*self.undone.pop())
        return True

    def questions(self):
        """The parts of which the result is not sure."""
        table = self.filter.GetQuestions()
        names = ("x", "y", "z", "volume_ml", "included", "margin")
        rows = ([table.GetValueByName(row, name).ToDouble() for name in names]
                for row in range(table.GetNumberOfRows()))
        return [flipfree.Question((x, y, z), volume, bool(included), margin)
                for x, y, z, volume, included, margin in rows]

    def preview(self, meaning, place, changed):
        """The milliliters, and the voxels, that a click would change; -1 if it cannot be obeyed."""
        return PREVIEW[meaning](self.filter, *place, changed)

    def _add(self, meaning, places):
        for place in places:
            ADD[meaning](self.filter, *place)
        try:
            self._segment()
        except flipfree.FlipFreeError:
            self._remove(places)
            raise
        self.done.append((meaning, places))

    def _remove(self, places):
        for _ in places:
            self.filter.RemoveLastCorrection()
        self._segment()

    def _segment(self):
        """Runs the method with the points there are."""
        flipfree.update(self.filter)
        self.surface.ShallowCopy(self.filter.GetSurface())
