"""Adds a point that corrects a segmentation: run it as a macro, once for each point.

Select the filter (Flip-Free Segmentation, Flip-Free Organ Group or Flip-Free Vessel Segmentation) in the pipeline
browser and run this macro. A Constraint Point comes up in the Properties panel, connected to the filter: say what it
means (outside, inside, boundary, seed), drag its handle or press P with the pointer over the place, and click Apply.
Its check box Enabled takes it back, and brings it back.

In a script, `add_point(filter, place, Kind="Inside")` does the same.
"""

from paraview.simple import *

FILTERS = ("FlipFreeSegmentation", "FlipFreeOrganGroup", "FlipFreeVesselSegmentation")


def filter_to_correct():
    """The filter that is selected, or else the only one there is."""
    active = GetActiveSource()
    if active is not None and active.GetXMLName() in FILTERS:
        return active
    found = [source for source in GetSources().values() if source.GetXMLName() in FILTERS]
    if len(found) != 1:
        # Not sys.exit(), which would end ParaView's window.
        raise RuntimeError("select the segmentation that is to be corrected; " +
                           ("there is none" if not found else f"there are {len(found)}"))
    return found[0]


def add_point(organ, place, **properties):
    """Another point beside those that are connected, at a place in millimeters."""
    count = sum(source.GetXMLName() == "FlipFreeConstraintPoint" for source in GetSources().values())
    point = ConstraintPoint(registrationName=f"Correction{count + 1}", Position=place, **properties)
    organ.Corrections = [*organ.Corrections, point]
    return point


def main():
    organ = filter_to_correct()
    # Where the camera looks, which is where the user does.
    point = add_point(organ, list(GetActiveViewOrCreate("RenderView").CameraFocalPoint), Enabled=0)
    SetActiveSource(point)


if __name__ in ("__main__", "__vtkconsole__"):
    main()
