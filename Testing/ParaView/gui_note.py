"""In ParaView's window, for TestGui.py: after each drawing of a view, a note of its size and of what the segmentation
is by then, in the file FLIPFREE_GUI_NOTE."""

import json
import os

from paraview import servermanager
from paraview.simple import FindSource, GetAnimationScene, GetSources

NOTE = os.environ["FLIPFREE_GUI_NOTE"]


def watch(view):
    view.SMProxy.AddObserver("EndEvent", lambda *_: write(view))
    write(view)


def write(view):
    state = {"view": list(view.ViewSize)}
    organ = FindSource("FlipFreeSegmentation1") or FindSource("Organ")
    if organ is not None:
        organ.UpdatePropertyInformation()
        state.update({
            "placed": in_panel(organ, "SeedCenter"), "sized": in_panel(organ, "SeedRadius"),
            "center": list(organ.SeedCenter), "radius": organ.SeedRadius, "stop": organ.StopReason,
            "intersections": organ.NumberOfSelfIntersections,
            "points": organ.GetDataInformation().GetNumberOfPoints(),
            "history": organ.KeepHistory, "times": [GetAnimationScene().StartTime, GetAnimationScene().EndTime],
            "visible": sorted(name for (name, _), source in GetSources().items()
                              for port in range(source.SMProxy.GetNumberOfOutputPorts())
                              if shown(view, source, port))})
    with open(NOTE + ".part", "w", encoding="utf-8") as file:
        json.dump(state, file)
    os.rename(NOTE + ".part", NOTE)


def in_panel(organ, name):
    """What the panel shows, applied or not."""
    item = organ.SMProxy.GetProperty(name)
    return [item.GetUncheckedElement(index) for index in range(item.GetNumberOfUncheckedElements())]


def shown(view, source, port):
    found = view.SMProxy.FindRepresentation(source.SMProxy, port)
    return found is not None and servermanager._getPyProxy(found).Visibility
