"""Run by ParaView's window at its start, for TestGui.py: the abdomen on two slices, the camera on its liver; and after
each drawing, a note for the test to read, see gui_note.py."""

import importlib.machinery
import os

import gui_note
from paraview.simple import *

CENTER = [99.75, 83.75, 167]


def look_at_liver(view):
    # Only after a first drawing: the window draws once by itself, and then looks at everything.
    Render(view)
    view.CameraViewUp = [0, 0, 1]
    view.CameraFocalPoint = CENTER
    view.CameraPosition = [CENTER[0] + 245, CENTER[1] - 635, CENTER[2] + 280]
    Render(view)


example = importlib.machinery.SourceFileLoader("segment_organ", os.environ["FLIPFREE_GUI_EXAMPLE"]).load_module()
ct = SegmentationPhantom(registrationName="CT", Shape="Abdomen")
ct.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
example.show_slices(ct, CENTER, view)
GetColorTransferFunction("Intensity").AutomaticRescaleRangeMode = "Never"
look_at_liver(view)
SetActiveSource(ct)
gui_note.watch(view)
