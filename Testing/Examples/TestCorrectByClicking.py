"""Plays a user of the window for corrections: clicks on slices and on the surface, takes back, brings again.

  TestCorrectByClicking.py FOLDER_OF_THE_EXAMPLE PICTURE
"""

import os
import sys

FOLDER, PICTURE = sys.argv[1:]
sys.path.insert(0, FOLDER)

import correct_by_clicking  # noqa: E402
import inputs  # noqa: E402
import numpy  # noqa: E402
import scene  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkRenderingCore import vtkCoordinate  # noqa: E402


def on_screen(renderer, point):
    """Where a view shows a point in space."""
    place = vtkCoordinate()
    place.SetCoordinateSystemToWorld()
    place.SetValue(point)
    return place.GetComputedDisplayValue(renderer)


def click(window, pixel, drag=0):
    """With the left button, with the mouse moved by so many pixels before it is let go."""
    window.interactor.SetEventInformation(*pixel)
    window.interactor.InvokeEvent("LeftButtonPressEvent")
    window.interactor.SetEventInformation(pixel[0] + drag, pixel[1])
    window.interactor.InvokeEvent("MouseMoveEvent")
    window.interactor.InvokeEvent("LeftButtonReleaseEvent")


def press(window, key):
    window.interactor.SetKeyCode(key)
    window.interactor.InvokeEvent("KeyPressEvent")


def points(window):
    return vtk_to_numpy(window.surface.GetPoints().GetData()).copy()


def label_at(window, place):
    labels = window.filter.GetLabelMap()
    return labels.GetPointData().GetScalars().GetTuple1(labels.FindPoint(place))


def main():
    source = inputs.phantom()
    liver, radius = inputs.seed_in(source, source.LIVER)
    window = correct_by_clicking.CorrectionWindow(source.GetOutput(), liver, radius)
    axial, coronal = window.planes[scene.AXIAL], window.planes[scene.CORONAL]
    free = points(window)

    # A click only looks, until a key says what it means.
    place = [60, 83.75, liver[2]]
    assert label_at(window, place) == 1
    click(window, on_screen(axial, place))
    assert not window.done and numpy.allclose(window.place, place, atol=1), window.place
    assert "slices go there" in window.words.GetInput()

    press(window, "o")
    click(window, on_screen(axial, place))
    (found,) = window.done
    assert found[0] == "o" and numpy.allclose(found[1], place, atol=1), found
    assert label_at(window, place) == 0, "the surface obeys"
    corrected = points(window)
    press(window, "u")
    assert not window.done and numpy.array_equal(points(window), free), "nothing of the point is left"
    press(window, "u")  # there is nothing else to take back
    press(window, "y")
    assert window.done == [found] and numpy.array_equal(points(window), corrected)
    press(window, "y")
    assert window.done == [found]

    # A place on the surface, in space, is on the boundary; a drag there turns the view and adds nothing.
    press(window, "b")
    middle = [window.surface.GetCenter()[0], window.surface.GetBounds()[2], window.surface.GetCenter()[2]]
    click(window, on_screen(window.space, middle), drag=40)
    assert window.done == [found]
    vertex = window.surface.GetPoint(int(numpy.argmin(points(window)[:, 1])))
    click(window, on_screen(window.space, vertex))
    kind, picked = window.done[-1]
    assert kind == "b" and numpy.linalg.norm(points(window) - picked, axis=1).min() < 6, picked

    # What cannot be obeyed is told, and changes nothing.
    before = points(window)
    press(window, "o")
    window.interactor.SetEventInformation(*on_screen(axial, liver))
    while window.place[2] < liver[2]:
        window.interactor.InvokeEvent("MouseWheelForwardEvent")
    while window.place[2] > liver[2]:
        window.interactor.InvokeEvent("MouseWheelBackwardEvent")
    click(window, on_screen(axial, liver))
    told = " ".join(window.words.GetInput().split())
    assert len(window.done) == 2 and "inner half of the seed" in told, told
    assert numpy.array_equal(points(window), before)

    # Another point forgets what was taken back.
    press(window, "u")
    press(window, "i")
    click(window, on_screen(coronal, [liver[0], window.place[1], window.place[2] + 20]))
    assert [key for key, _ in window.done] == ["o", "i"] and not window.undone
    assert window.filter.GetNumberOfSelfIntersections() == 0
    os.makedirs(os.path.dirname(PICTURE), exist_ok=True)
    window.save(PICTURE)
    print("as it should be")


main()
