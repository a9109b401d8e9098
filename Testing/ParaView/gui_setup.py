"""Run by ParaView's window at its start, for TestGui.py: shows the abdomen on two slices, with the camera on its liver,
and notes after each drawing, in the file FLIPFREE_GUI_NOTE, the view's size and what the segmentation is by then. With
FLIPFREE_GUI_CORRECTS=1, the liver has been segmented, and a point that may correct it is selected."""

import importlib.machinery
import json
import os

from paraview import servermanager
from paraview.simple import *

NOTE = os.environ["FLIPFREE_GUI_NOTE"]
CENTER = [99.75, 83.75, 167]


def write_note(*_):
    state = {"view": list(view.ViewSize)}
    organ = FindSource("FlipFreeSegmentation1")
    if organ is not None:
        organ.UpdatePropertyInformation()
        # What the panel shows, applied or not.
        placed = organ.SMProxy.GetProperty("SeedCenter")
        state.update({"placed": [placed.GetUncheckedElement(index) for index in range(3)],
                      "center": list(organ.SeedCenter), "intersections": organ.NumberOfSelfIntersections,
                      "points": organ.GetDataInformation().GetNumberOfPoints(),
                      "visible": sorted(name for (name, _), source in GetSources().items()
                                        for port in range(source.SMProxy.GetNumberOfOutputPorts())
                                        if is_shown(source, port))})
        if organ.Corrections:
            (point,) = organ.Corrections
            Show3DWidgets(proxy=point)  # what a script makes has its handle hidden
            placed = point.SMProxy.GetProperty("Position")
            place = [placed.GetUncheckedElement(index) for index in range(3)]
            labels = servermanager.Fetch(organ, idx=1)
            state.update({"placed": place, "point": list(point.Position),
                          "label": labels.GetPointData().GetScalars().GetTuple1(labels.FindPoint(place))})
    with open(NOTE + ".part", "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.rename(NOTE + ".part", NOTE)


def show_organ_to_correct():
    """Its contour on the axial slice, and the point, which is far from it yet."""
    point = ConstraintPoint(registrationName="Correction1", Position=[10, 10, 10])
    organ = FlipFreeSegmentation(registrationName="FlipFreeSegmentation1", Input=ct, SeedCenter=CENTER, SeedRadius=28,
                                 Resolution=16, Corrections=point)
    contour = Slice(registrationName="Contour", Input=organ)
    contour.SliceType.Origin = CENTER
    contour.SliceType.Normal = [0, 0, 1]
    Hide3DWidgets(proxy=contour.SliceType)
    shown = Show(contour, view)
    ColorBy(shown, ("POINTS", ""))
    shown.AmbientColor = shown.DiffuseColor = [1, 0.76, 0.2]
    shown.LineWidth = 3
    Show(point, view)
    return point


def is_shown(source, port):
    found = view.SMProxy.FindRepresentation(source.SMProxy, port)
    return found is not None and servermanager._getPyProxy(found).Visibility


example = importlib.machinery.SourceFileLoader("segment_organ", os.environ["FLIPFREE_GUI_EXAMPLE"]).load_module()
ct = SegmentationPhantom(registrationName="CT", Shape="Abdomen")
ct.UpdatePipeline()
view = GetActiveViewOrCreate("RenderView")
example.show_slices(ct, CENTER, view)
GetColorTransferFunction("Intensity").AutomaticRescaleRangeMode = "Never"
# The window itself looks at everything after its first drawing; only then is the camera moved.
Render(view)
view.CameraViewUp = [0, 0, 1]
view.CameraFocalPoint = CENTER
view.CameraPosition = [CENTER[0] + 245, CENTER[1] - 635, CENTER[2] + 280]
Render(view)
SetActiveSource(show_organ_to_correct() if os.environ["FLIPFREE_GUI_CORRECTS"] == "1" else ct)
Render(view)
view.SMProxy.AddObserver("EndEvent", write_note)
write_note()
