"""Plays a user of the live window: drags the sphere with the mouse, waits, and looks at the surface.

  TestLiveWindow.py FOLDER_OF_THE_EXAMPLE PICTURE
"""

import os
import sys

FOLDER, PICTURE = sys.argv[1:]
sys.path.insert(0, FOLDER)

import flipfree  # noqa: E402
import inputs  # noqa: E402
import live_window  # noqa: E402
import numpy  # noqa: E402
from vtkmodules.vtkRenderingCore import vtkCoordinate  # noqa: E402


def on_screen(window, point):
    """Where a point in space is drawn."""
    place = vtkCoordinate()
    place.SetCoordinateSystemToWorld()
    place.SetValue(point)
    return place.GetComputedDisplayValue(window.views.space)


def drag(window, start, end, steps=5):
    """Presses the left button, moves the mouse, lets go."""
    interactor = window.interactor
    interactor.SetEventInformation(*start)
    interactor.InvokeEvent("MouseMoveEvent")
    interactor.InvokeEvent("LeftButtonPressEvent")
    for step in range(1, steps + 1):
        interactor.SetEventInformation(*(a + (b - a) * step // steps for a, b in zip(start, end)))
        interactor.InvokeEvent("MouseMoveEvent")
    interactor.InvokeEvent("LeftButtonReleaseEvent")


def wait(window):
    """As long as the timer has something to do."""
    rings = 0
    while window.growth is not None and not window.growth.has_converged():
        window.interactor.InvokeEvent("TimerEvent")
        rings += 1
    return rings


def main():
    source = inputs.phantom()
    liver, radius = inputs.seed_in(source, source.LIVER)
    window = live_window.LiveWindow(source.GetOutput(), liver, radius)
    assert window.growth is None, "nothing grows before the sphere has been let go"
    # Smaller than users have it: without a graphics card, most of the time goes into pixels.
    window.views.window.SetSize(600, 400)
    window.views.window.Render()

    # Out of the organ and back; the mouse moves it in the plane of the screen.
    start = on_screen(window, liver)
    aside = (start[0] + 125, start[1] + 30)
    drag(window, start, aside)
    seed, size = window.seed()
    assert numpy.allclose(on_screen(window, seed), aside, atol=4), "the sphere follows the mouse"
    assert numpy.linalg.norm(numpy.subtract(seed, liver)) > 50
    drag(window, on_screen(window, seed), start)
    seed, size = window.seed()
    assert numpy.allclose(seed, liver, atol=10), f"the sphere is back, and not at {seed}"
    assert abs(size - radius) < 1e-9, f"the sphere keeps its size, but has {size}"
    assert window.growth is not None, "letting go begins the growth"

    window.interactor.InvokeEvent("TimerEvent")
    first = window.surface.GetLength()
    rings = wait(window)
    assert rings > 10, f"the surface evolves while one watches, not in {rings} iterations"
    grown = window.surface.GetLength() / first
    assert grown > 1.3, f"the surface grows, not by {grown}"
    for _, contour in window.views.shown["slices"][2::3]:
        lines = contour.GetMapper().GetInput()
        assert lines.GetNumberOfLines() > 0 and lines.GetNumberOfPolys() == 0, "slices show contours, no areas"
    os.makedirs(os.path.dirname(PICTURE), exist_ok=True)
    window.views.save(PICTURE)

    # What one has watched is what the whole method gives from there.
    labels = flipfree.vtkSurfaceToLabelMap()
    labels.SetInputData(window.surface)
    labels.SetReferenceImageData(source.GetOutput())
    labels.Update()
    whole = flipfree.segment(source.GetOutput(), seed, size)
    dice = flipfree.evaluate(labels.GetOutput(), whole.label_map).dice
    assert dice > 0.97, f"Dice with flipfree.segment is {dice}"

    # A sphere outside the image is told in the window, and one can go on.
    drag(window, on_screen(window, seed), (2, 2))
    wait(window)
    assert "No " in window.views.words.GetInput() or "outside" in window.views.words.GetInput(), \
        window.views.words.GetInput()
    assert window.surface.GetNumberOfPoints() == 0
    print("as it should be")


main()
