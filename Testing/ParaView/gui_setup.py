"""Run by ParaView's window at its start, for TestGui.py: the abdomen on two slices, the camera on its liver; and after
each drawing, a note of the view's size and of what the segmentation is by then, for the test to read."""

import json
import os

from paraview.simple import *

CENTER = [99.75, 83.75, 167]


def show_slices(image, view):
    for plane, normal in (("Coronal", [0, 1, 0]), ("Axial", [0, 0, 1])):
        cut = Slice(registrationName=plane, Input=image)
        cut.SliceType.Origin = CENTER
        cut.SliceType.Normal = normal
        Hide3DWidgets(proxy=cut.SliceType)
        ColorBy(Show(cut, view), ("POINTS", "Intensity"))
    colors = GetColorTransferFunction("Intensity")
    colors.ApplyPreset("Grayscale", True)
    colors.AutomaticRescaleRangeMode = "Never"
    colors.RescaleTransferFunction(-110, 240)
    # Only now: the window draws once by itself, and then looks at everything.
    Render(view)
    view.CameraViewUp = [0, 0, 1]
    view.CameraFocalPoint = CENTER
    view.CameraPosition = [CENTER[0] + 245, CENTER[1] - 635, CENTER[2] + 280]
    Render(view)


def note(*_):
    state = {"view": list(view.ViewSize)}
    organ = FindSource("FlipFreeSegmentation1")
    if organ is not None:
        organ.UpdatePropertyInformation()
        state.update({
            "center": list(organ.SeedCenter), "radius": organ.SeedRadius, "stop": organ.StopReason,
            "intersections": organ.NumberOfSelfIntersections,
            "points": organ.GetDataInformation().GetNumberOfPoints(),
            "history": organ.KeepHistory, "times": [GetAnimationScene().StartTime, GetAnimationScene().EndTime],
            "visible": sorted(name for (name, _), source in GetSources().items()
                              for port in range(source.SMProxy.GetNumberOfOutputPorts())
                              if shown(source, port))})
    partial = os.environ["FLIPFREE_GUI_NOTE"] + ".part"
    with open(partial, "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.rename(partial, os.environ["FLIPFREE_GUI_NOTE"])


def shown(source, port):
    found = view.SMProxy.FindRepresentation(source.SMProxy, port)
    return found is not None and servermanager._getPyProxy(found).Visibility


ct = SegmentationPhantom(registrationName="CT", Shape="Abdomen")
ct.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
show_slices(ct, view)
SetActiveSource(ct)
view.SMProxy.AddObserver("EndEvent", note)
note()
