"""Pictures of images and surfaces for the examples: plain VTK, nothing of FlipFree's own.

A picture is a row of views. Slices are shown as radiologists look at them: the patient's right on
the left, the back at the bottom of an axial slice, the head at the top of a coronal one.
"""

import ctypes

# To import these is to choose the classes that draw.
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkLogger, vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import (
    vtkClipPolyData,
    vtkCutter,
    vtkPolyDataNormals,
    vtkProbeFilter,
    vtkStripper,
    vtkTriangleFilter,
)
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkImagingCore import vtkImageConstantPad, vtkImageShrink3D
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

INK = (0.045, 0.05, 0.06)
FRAME = (0.2, 0.21, 0.24)
LIVER = (0.86, 0.42, 0.33)
RED = (0.90, 0.10, 0.10)
YELLOW = (1.0, 0.76, 0.2)
BLUE = (0.35, 0.65, 1.0)
FINER = 2  # drawn this many times as large and scaled down, for smooth lines

# To the right and up, in LPS coordinates; the viewer is where their cross product points.
AXIAL = ((1, 0, 0), (0, -1, 0))
CORONAL = ((1, 0, 0), (0, 0, 1))


def surface_actor(surface, color=LIVER, opacity=1.0, edges=False):
    """A surface with smooth shading, with the mesh's own edges on demand."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    normals.ConsistencyOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(color)
    look.SetOpacity(opacity)
    look.SetInterpolationToPhong()
    look.SetAmbient(0.1)
    look.SetDiffuse(0.85)
    look.SetSpecular(0.2)
    look.SetSpecularPower(25)
    if edges:
        look.EdgeVisibilityOn()
        look.SetEdgeColor([0.5 * part for part in color])
        look.SetLineWidth(1.2 * FINER / 2)
    return actor


def defect_actor(surface, color, mark):
    """A surface with its edges, of which vtkSurfaceValidity has marked faces: these are red."""
    colors = vtkLookupTable()
    colors.SetNumberOfTableValues(2)
    colors.SetTableValue(0, *color, 1)
    colors.SetTableValue(1, *RED, 1)
    actor = surface_actor(surface, edges=True)
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("Defects")
    mapper.SetLookupTable(colors)
    mapper.SetColorModeToMapScalars()
    mapper.SetScalarRange(0, mark)
    actor.GetProperty().SetEdgeColor(0.35, 0.33, 0.30)
    return actor


def slice_actor(image, center, plane, window=(-150, 250), samples=500):
    """A slice through a point in gray values, over the whole image, by default the abdomen's."""
    probe = _sampled(image, center, plane, samples)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(probe.GetOutputPort())
    mapper.SetScalarRange(window)
    mapper.InterpolateScalarsBeforeMappingOn()
    gray = mapper.GetLookupTable()
    gray.SetSaturationRange(0, 0)
    gray.SetValueRange(0, 1)
    gray.SetRampToLinear()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    return actor


def mask_actor(mask, center, plane, color):
    """The voxels of a mask in the slice through a point; the image shows through."""
    rim = vtkImageConstantPad()  # around a single voxel, too
    rim.SetInputData(mask)
    rim.SetOutputWholeExtent([end + outward for end, outward in
                              zip(mask.GetExtent(), (-1, 1) * 3)])
    rim.Update()
    padded = rim.GetOutput()
    padded.SetDirectionMatrix(mask.GetDirectionMatrix())  # which VTK 9.1 drops
    probe = _sampled(padded, center, plane, samples=150)
    part = vtkClipPolyData()
    part.SetInputConnection(probe.GetOutputPort())
    part.SetValue(0.5)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(part.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.SetPosition([x / 2 for x in _cross(*plane)])  # in front of the slice
    actor.GetProperty().SetColor(color)
    actor.GetProperty().SetOpacity(0.5)
    actor.GetProperty().LightingOff()
    return actor


def _sampled(image, center, plane, samples):
    """An image's values in the slice through a point, over its bounds."""
    right, up = plane
    bounds = image.GetBounds()
    corners = []
    for x, y in ((0, 0), (1, 0), (0, 1)):  # of the image's box, in the plane through the center
        corner = list(center)
        for direction, end in ((right, x), (up, y)):
            axis = [abs(part) for part in direction].index(1)
            upper = (direction[axis] > 0) == bool(end)
            corner[axis] = bounds[2 * axis + upper]
        corners.append(corner)
    grid = vtkPlaneSource()
    grid.SetOrigin(corners[0])
    grid.SetPoint1(corners[1])
    grid.SetPoint2(corners[2])
    grid.SetResolution(samples, samples)
    probe = vtkProbeFilter()  # knows direction matrices
    probe.SetInputConnection(grid.GetOutputPort())
    probe.SetSourceData(image)
    return probe


def contour_actor(surface, center, plane, color=YELLOW, width=2.2):
    """Where a surface crosses the slice through a point."""
    normal = _cross(*plane)
    cutting = vtkPlane()
    cutting.SetOrigin(center)
    cutting.SetNormal(normal)
    lines = vtkStripper()  # joined, so that there are no gaps between their ends
    if surface.GetNumberOfLines():  # an outline of that slice already
        lines.SetInputData(surface)
    else:  # which may still be empty, and grow
        # VTK 9.3's cutter says that it runs.
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)
        cutter = vtkCutter()
        cutter.SetInputData(surface)
        cutter.SetCutFunction(cutting)
        lines.SetInputConnection(cutter.GetOutputPort())
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(lines.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.SetPosition(normal)  # in front of the slice
    actor.GetProperty().SetColor(color)
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetLineWidth(width * FINER)
    return actor


def text_actor(words, color=(0.92, 0.92, 0.92), size=15):
    """Words on a dark ground, at the lower left."""
    text = vtkTextActor()
    text.SetInput(words)
    text.SetPosition(10, 10)
    look = text.GetTextProperty()
    look.SetFontSize(size)
    look.SetColor(color)
    look.SetBackgroundColor(INK)
    look.SetBackgroundOpacity(0.6)
    return text


def slice_view(actors, surface, plane, caption="", margin=1.4):
    """A view onto a slice, centered on a surface and wider than it by a factor."""
    center = surface.GetCenter()
    side = margin * max(high - low for low, high in zip(*[iter(surface.GetBounds())] * 2))
    renderer = _renderer(actors, caption)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(center)
    camera.SetPosition([c + 1000 * n for c, n in zip(center, _cross(*plane))])
    camera.SetViewUp(plane[1])
    camera.SetParallelScale(side / 2)
    renderer.ResetCameraClippingRange()
    return renderer


def space_view(actors, caption="", toward=(-0.35, -1, 0.3), zoom=1.2, bounds=None):
    """A view into space, from the front, a little from the right and from above."""
    renderer = _renderer(actors, caption)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(toward)
    camera.SetViewUp(0, 0, 1)
    if bounds is None:
        renderer.ResetCamera()
    else:
        renderer.ResetCamera(bounds)
    camera.Zoom(zoom)
    renderer.ResetCameraClippingRange()
    return renderer


def require_display():
    """Ends the program with a word where VTK would end it without: on X11 that has no display."""
    if vtkRenderWindow().GetClassName() != "vtkXOpenGLRenderWindow":
        return
    x11 = ctypes.CDLL("libX11.so.6")
    x11.XOpenDisplay.restype = ctypes.c_void_p
    display = x11.XOpenDisplay(None)
    if not display:
        raise SystemExit("There is no display to draw with: start the program by 'xvfb-run -a ...'.")
    x11.XCloseDisplay(ctypes.c_void_p(display))


def write_picture(path, rows, size=480):
    """Draws rows of views, each a square of this many pixels, and writes them as PNG."""
    require_display()
    columns = max(len(row) for row in rows)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(FINER * size * columns, FINER * size * len(rows))
    frame = vtkRenderer()
    frame.SetBackground(FRAME)
    window.AddRenderer(frame)
    for number, row in enumerate(reversed(rows)):
        for column, renderer in enumerate(row):
            gap = 1.5 / size  # through which the window's own background shows
            renderer.SetViewport((column + gap) / columns, (number + gap) / len(rows),
                                 (column + 1 - gap) / columns, (number + 1 - gap) / len(rows))
            window.AddRenderer(renderer)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    shrink = vtkImageShrink3D()
    shrink.SetInputConnection(picture.GetOutputPort())
    shrink.SetShrinkFactors(FINER, FINER, 1)
    shrink.MeanOn()
    writer = vtkPNGWriter()
    writer.SetInputConnection(shrink.GetOutputPort())
    writer.SetFileName(str(path))
    writer.Write()
    print(f"picture: {path}")


def open_window(space, slices, share):
    """A window: the view into space, over that share of its width, and two slices beside it."""
    require_display()
    window = vtkRenderWindow()
    window.SetWindowName("FlipFree")
    window.SetMultiSamples(0)
    window.SetSize(1200, 800)
    for renderer, viewport in zip((space, *slices),
                                  ((0, 0, share, 1), (share, 0.5, 1, 1), (share, 0, 1, 0.5))):
        renderer.SetViewport(viewport)
        window.AddRenderer(renderer)
    for renderer in slices:
        renderer.InteractiveOff()
    return window


def save_window(window, path):
    """Writes what a window shows as PNG."""
    shot = vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(shot.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()


def triangles_of(surface):
    """A surface as triangles: what STL and TetGen take."""
    triangles = vtkTriangleFilter()
    triangles.SetInputData(surface)
    triangles.Update()
    return triangles.GetOutput()


def _renderer(actors, caption):
    renderer = vtkRenderer()
    renderer.SetBackground(INK)
    for actor in actors:
        renderer.AddActor(actor)
    # One line, or several in colors of their own, from the bottom upwards.
    lines = [(caption, (0.92, 0.92, 0.92))] if isinstance(caption, str) else caption
    for number, (words, color) in enumerate(lines):
        if words:
            text = text_actor(words, color, 15 * FINER)
            text.SetPosition(10 * FINER, (10 + 22 * number) * FINER)
            renderer.AddViewProp(text)
    return renderer


def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
