"""Opens a CT, puts a seed into an organ, segments it, and shows the surface on slices beside its convergence.

In ParaView with the plugin FlipFree loaded, run it from the Python Shell (Run Script) or as a macro: the built-in
abdomen serves as the image, and the seed sphere can then be moved in the Properties panel of "Organ". In the shell, on
a volume of one's own:

    pvbatch segment-organ.py [VOLUME X Y Z RADIUS] [-o PICTURE.png] [--state STATE.pvsm]

VOLUME is a NIfTI, NRRD or MetaImage file or a folder of DICOM files; X Y Z and RADIUS are the seed in millimeters.
"""

import argparse
import os
import re
import sys

from paraview.simple import *
from vtkmodules.vtkCommonCore import vtkLogger

# Of the built-in abdomen's liver.
SEED = [99.75, 83.75, 167, 28]
# The gray values that are drawn black and white: soft tissue of a CT. None takes the image's whole range.
WINDOW = [-110, 240]


def parse_arguments():
    parser = argparse.ArgumentParser(description="Segments one organ and shows it on slices.")
    parser.add_argument("volume", nargs="?")
    parser.add_argument("seed", nargs="*", type=float, help="X Y Z RADIUS, in millimeters")
    parser.add_argument("-o", "--output", metavar="PICTURE.png")
    parser.add_argument("--state", metavar="STATE.pvsm")
    arguments = parser.parse_args()
    if arguments.volume and len(arguments.seed) != 4:
        parser.error("after the volume, give its seed: X Y Z RADIUS, in millimeters")
    return arguments


def open_image(volume):
    if volume is None:
        return SegmentationPhantom(registrationName="CT", Shape="Abdomen")
    if os.path.isdir(volume):
        return DICOMSeriesReader(registrationName="CT", FileName=volume)
    return MedicalImageReader(registrationName="CT", FileName=volume)


def update(source):
    """Ends the script, with what the source's filter says in one line, where that fails."""
    errors = []

    def keep(_filter, _event, text):
        errors.append(text)

    keep.CallDataType = "string0"  # how VTK is asked for the text
    algorithm = source.GetClientSideObject()  # none where the server is another process
    if algorithm:
        observed = [(speaker, speaker.AddObserver("ErrorEvent", keep))
                    for speaker in (algorithm, algorithm.GetExecutive())]
        algorithm.Modified()
        algorithm.Update()
        for speaker, observer in observed:  # or they would keep what is said later from being shown
            speaker.RemoveObserver(observer)
    if not errors:
        source.UpdatePipeline()
    if errors or source.GetDataInformation().GetNumberOfPoints() == 0:
        # Without the place in the source and the object's address, which VTK puts in front.
        text = re.sub(r"\A\w+: In .*, line \d+\n\w+ \(\w+\): ", "", (errors or ["there is no result"])[0])
        sys.exit("segment-organ.py: " + " ".join(text.split()))


def show_slices(image, center, view):
    """The coronal and the axial plane through the seed, in gray."""
    name = image.PointData[0].GetName()
    for plane, normal in (("Coronal", [0, 1, 0]), ("Axial", [0, 0, 1])):
        cut = Slice(registrationName=plane, Input=image)
        cut.SliceType.Origin = center
        cut.SliceType.Normal = normal
        HideInteractiveWidgets(proxy=cut.SliceType)
        ColorBy(Show(cut, view), ("POINTS", name))
    colors = GetColorTransferFunction(name)
    colors.ApplyPreset("Grayscale", True)
    if WINDOW:
        colors.RescaleTransferFunction(*WINDOW)


def show_surface(organ, view):
    surface = Show(OutputPort(organ, 0), view)
    ColorBy(surface, ("POINTS", ""))  # none
    surface.AmbientColor = surface.DiffuseColor = [0.86, 0.45, 0.36]
    surface.SetRepresentationType("Surface With Edges")
    surface.EdgeColor = [0.55, 0.2, 0.15]


def show_convergence(organ, layout, hint):
    chart = CreateView("XYChartView")
    AssignViewToLayout(view=chart, layout=layout, hint=hint)
    lines = Show(OutputPort(organ, 2), chart, "XYChartRepresentation")
    lines.UseIndexForXAxis = 0
    lines.XArrayName = "Iteration"
    lines.SeriesVisibility = ["MeanDistance"]
    chart.ShowLegend = 0
    chart.ChartTitle = "Mean distance to the targets"
    chart.BottomAxisTitle = "iteration"
    chart.LeftAxisTitle = "mm"
    chart.ChartTitleFontSize = chart.BottomAxisTitleFontSize = chart.LeftAxisTitleFontSize = 14
    chart.BottomAxisLabelFontSize = chart.LeftAxisLabelFontSize = 12
    return chart


def main():
    arguments = parse_arguments()
    seed = arguments.seed or SEED

    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # what a reader complains of at once, it tells again below
    image = open_image(arguments.volume)
    vtkLogger.SetStderrVerbosity(verbosity)
    update(image)
    organ = FlipFreeSegmentation(registrationName="Organ", Input=image, SeedCenter=seed[:3], SeedRadius=seed[3])
    update(organ)
    organ.UpdatePropertyInformation()
    print(f"{organ.GetDataInformation().GetNumberOfPoints()} vertices, "
          f"{organ.NumberOfSelfIntersections} self-intersections; stopped: {organ.StopReason}")

    view = GetActiveViewOrCreate("RenderView")
    view.ViewSize = [800, 700]
    layout = GetLayout(view)
    show_slices(image, seed[:3], view)
    show_surface(organ, view)
    # From the front and above, the patient's left on the right.
    view.CameraViewUp = [0, 0, 1]
    view.CameraPosition = [seed[0] + 350, seed[1] - 800, seed[2] + 350]
    view.CameraFocalPoint = seed[:3]
    ResetCamera(view)
    view.GetActiveCamera().Zoom(1.4)
    layout.SplitHorizontal(layout.GetViewLocation(view), 0.62)
    chart = show_convergence(organ, layout, layout.GetViewLocation(view) + 1)
    SetActiveView(view)
    SetActiveSource(organ)
    RenderAllViews()

    if arguments.output:
        SaveScreenshot(arguments.output, layout, ImageResolution=[1400, 700])
    if arguments.state:
        SaveState(arguments.state)
    return view, chart


if __name__ in ("__main__", "__vtkconsole__"):
    VIEWS = main()
