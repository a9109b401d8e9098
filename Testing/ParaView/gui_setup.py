"""Run by ParaView's window at its start, for TestGui.py: shows a scene, and notes after each drawing and each move of
the pointer, in the file FLIPFREE_GUI_NOTE, the view's size, where it sees the pointer, and what the segmentation is by
then. FLIPFREE_GUI_SCENE names the scene:

    organ       the abdomen on two slices, with the camera on its liver
    correction  the same, the liver segmented, and a point selected that may correct it
    vessel      a vessel between two points, segmented and selected, on a slice along the end that is to be moved
"""

import importlib.machinery
import json
import os

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

NOTE = os.environ["FLIPFREE_GUI_NOTE"]
SCENE = os.environ["FLIPFREE_GUI_SCENE"]
# The abdomen as in session.py, and its liver.
SIZE, SPACING = [110, 86, 46], [3, 3, 6]
CENTER = [99, 84.5, 168.5]
# The ends of the vessel phantom, as `flipfree phantom vessel` prints them; and how far the second one is to be moved
# along the vessel, in points of the centerline, which are 1.5 mm apart.
VESSEL = [13.3, 44.6, 44.5, 82, 50.4, 37.6]
MOVED = 22


def write_note(*_):
    across, up = view.SMProxy.GetInteractor().GetEventPosition()
    state = {"view": list(view.ViewSize), "pointer": from_middle(across, up)}
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
            ShowInteractiveWidgets(proxy=point)  # what a script makes has its handle hidden
            placed = point.SMProxy.GetProperty("Position")
            place = [placed.GetUncheckedElement(index) for index in range(3)]
            labels = servermanager.Fetch(organ, idx=1)
            state.update({"placed": place, "point": list(point.Position),
                          "label": labels.GetPointData().GetScalars().GetTuple1(labels.FindPoint(place))})
    vessel = FindSource("FlipFreeVesselSegmentation1")
    if vessel is not None:
        state.update(state_of(vessel))
    with open(NOTE + ".part", "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.rename(NOTE + ".part", NOTE)


def state_of(vessel):
    ShowInteractiveWidgets(proxy=vessel)
    vessel.UpdatePropertyInformation()
    placed = vessel.SMProxy.GetProperty("Points")
    placed = [placed.GetUncheckedElement(index) for index in range(placed.GetNumberOfUncheckedElements())]
    line = centerline(vessel)
    labels = servermanager.Fetch(vessel, idx=1)
    return {"placed": [placed[:3], placed[3:]], "points": [vessel.Points[:3], vessel.Points[3:]],
            "ends": [line[0].tolist(), line[-1].tolist()], "intersections": vessel.NumberOfSelfIntersections,
            "label": labels.GetPointData().GetScalars().GetTuple1(labels.FindPoint(way[MOVED // 4])),
            "way": way.tolist(), "seen_way": [seen_at(place) for place in way]}


def centerline(vessel):
    return vtk_to_numpy(servermanager.Fetch(vessel, idx=2).GetPoints().GetData()).astype(float)


def seen_at(place):
    renderer = view.GetClientSideObject().GetRenderer()
    renderer.SetWorldPoint(*place, 1)
    renderer.WorldToDisplay()
    return from_middle(*renderer.GetDisplayPoint()[:2])


def from_middle(across, up):
    """Pixels to the right of and below the view's middle."""
    # The last digits depend on how near and far the camera sees.
    return [round(across - view.ViewSize[0] / 2, 3), round(view.ViewSize[1] / 2 - up, 3)]


def show_organ_to_correct():
    """Its contour on the axial slice, and the point, which is far from it yet."""
    point = ConstraintPoint(registrationName="Correction1", Position=[10, 10, 10])
    organ = FlipFreeSegmentation(registrationName="FlipFreeSegmentation1", Input=ct, SeedCenter=CENTER, SeedRadius=28,
                                 Resolution=16, Corrections=point)
    contour = Slice(registrationName="Contour", Input=organ)
    contour.SliceType.Origin = CENTER
    contour.SliceType.Normal = [0, 0, 1]
    HideInteractiveWidgets(proxy=contour.SliceType)
    shown = Show(contour, view)
    ColorBy(shown, ("POINTS", ""))
    shown.AmbientColor = shown.DiffuseColor = [1, 0.76, 0.2]
    shown.LineWidth = 3
    Show(point, view)
    return point


def is_shown(source, port):
    found = view.SMProxy.FindRepresentation(source.SMProxy, port)
    return found is not None and servermanager._getPyProxy(found).Visibility


def show_abdomen():
    example = importlib.machinery.SourceFileLoader("segment_organ", os.environ["FLIPFREE_GUI_EXAMPLE"]).load_module()
    ct.Shape, ct.Dimensions, ct.Spacing = "Abdomen", SIZE, SPACING
    ct.UpdatePipeline()
    example.show_slices(ct, CENTER, view)
    GetColorTransferFunction("Intensity").AutomaticRescaleRangeMode = "Never"
    look_at(CENTER, [245, -635, 280])
    return show_organ_to_correct() if SCENE == "correction" else ct


def show_vessel():
    """Its surface, and the plane of the end and of the way along which it is to be moved; the camera looks straight at
    this plane, in which a handle then moves. Returns the vessel and the way."""
    ct.Shape = "Vessel"
    vessel = FlipFreeVesselSegmentation(registrationName="FlipFreeVesselSegmentation1", Input=ct, Points=VESSEL)
    vessel.UpdatePipeline()
    track = numpy.array([VESSEL[3:], *centerline(vessel)[-2:-MOVED - 1:-1]])
    normal = numpy.cross(track[-1] - track[0], track[len(track) // 2] - track[0])
    normal /= numpy.linalg.norm(normal) * (1 if normal[1] < 0 else -1)
    cut = Slice(registrationName="Along", Input=ct)
    cut.SliceType.Origin = track[0].tolist()
    cut.SliceType.Normal = normal.tolist()
    HideInteractiveWidgets(proxy=cut.SliceType)
    ColorBy(Show(cut, view), ("POINTS", "Intensity"))
    colors = GetColorTransferFunction("Intensity")
    colors.ApplyPreset("Grayscale", True)
    surface = Show(OutputPort(vessel, 0), view)
    ColorBy(surface, ("POINTS", ""))
    surface.AmbientColor = surface.DiffuseColor = [0.86, 0.45, 0.36]
    surface.Opacity = 0.3  # or the handles, which are within it, could not be seen
    look_at([47.5, 47.5, 47.5], (normal * 240).tolist())
    return vessel, track


def look_at(place, offset):
    # The window itself looks at everything after its first drawing; only then is the camera moved.
    Render(view)
    view.CameraViewUp = [0, 0, 1]
    view.CameraFocalPoint = place
    view.CameraPosition = [place[axis] + offset[axis] for axis in range(3)]
    Render(view)


ct = SegmentationPhantom(registrationName="CT")
view = GetActiveViewOrCreate("RenderView")
if SCENE == "vessel":
    selected, way = show_vessel()
else:
    selected = show_abdomen()
SetActiveSource(selected)
Render(view)
view.SMProxy.AddObserver("EndEvent", write_note)
view.SMProxy.GetInteractor().AddObserver("MouseMoveEvent", write_note)
write_note()
