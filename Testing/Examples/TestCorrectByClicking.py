"""Plays a user of the window for corrections: clicks, paints, takes back, brings again, answers.

  TestCorrectByClicking.py FOLDER_OF_THE_EXAMPLE PICTURE
"""

import os
import re
import sys

FOLDER, PICTURE = sys.argv[1:]
sys.path.insert(0, FOLDER)

import correct_by_clicking  # noqa: E402
import inputs  # noqa: E402
import numpy  # noqa: E402
import scene  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkRenderingCore import vtkCoordinate  # noqa: E402


def on_screen(renderer, point):
    """Where a view shows a point in space."""
    place = vtkCoordinate()
    place.SetCoordinateSystemToWorld()
    place.SetValue(point)
    return place.GetComputedDisplayValue(renderer)


def click(window, pixel, drag=0):
    """With the left button, with the mouse moved by so many pixels before it is let go."""
    press_at(window, pixel)
    move(window, [(pixel[0] + drag, pixel[1])])
    window.interactor.InvokeEvent("LeftButtonReleaseEvent")


def press_at(window, pixel):
    window.interactor.SetEventInformation(*pixel)
    window.interactor.InvokeEvent("LeftButtonPressEvent")


def move(window, pixels):
    for pixel in pixels:
        window.interactor.SetEventInformation(*pixel)
        window.interactor.InvokeEvent("MouseMoveEvent")


def press(window, key):
    window.interactor.SetKeyCode(key)
    window.interactor.InvokeEvent("KeyPressEvent")


def points(window):
    return vtk_to_numpy(window.organ.surface.GetPoints().GetData()).copy()


def label_at(window, place):
    labels = window.organ.filter.GetLabelMap()
    return labels.GetPointData().GetScalars().GetTuple1(labels.FindPoint(place))


def covers(actor, place):
    """Whether the box of what is drawn, a little in front of its slice, holds a place."""
    bounds = numpy.reshape(actor.GetBounds(), (3, 2))
    return bool(((bounds[:, 0] - 1 <= place) & (place <= bounds[:, 1] + 1)).all())


def one_voxel():
    """Of a mask whose first two axes run backward, and its place."""
    mask = vtkImageData()
    mask.SetExtent(7, 7, 5, 5, 3, 3)
    mask.SetSpacing(2, 2, 3)
    mask.SetOrigin(100, 50, 0)
    mask.SetDirectionMatrix(-1, 0, 0, 0, -1, 0, 0, 0, 1)
    mask.AllocateScalars(VTK_UNSIGNED_CHAR, 1)
    mask.SetScalarComponentFromDouble(7, 5, 3, 0, 1)
    return mask, [86, 40, 9]


def volume_of(window):
    """In ml."""
    labels = window.organ.filter.GetLabelMap()
    return numpy.count_nonzero(vtk_to_numpy(labels.GetPointData().GetScalars())) * numpy.prod(labels.GetSpacing()) / 1000


def main():
    source = inputs.phantom(noisy=True)
    liver, radius = inputs.seed_in(source, source.LIVER)
    window = correct_by_clicking.CorrectionWindow(source.GetOutput(), liver, radius)
    axial, coronal = window.views.planes[scene.AXIAL], window.views.planes[scene.CORONAL]
    free = points(window)

    # A click only looks, until a key says what it means.
    place = [60, 83.75, liver[2]]
    assert label_at(window, place) == 1
    click(window, on_screen(axial, place))
    assert not window.organ.done and numpy.allclose(window.views.place, place, atol=1), window.views.place
    assert "slices go there" in window.views.words.GetInput()

    # Before the click, the slice shows what it would do, at the mouse's last place only.
    press(window, "o")
    move(window, [on_screen(axial, liver), on_screen(axial, place)])
    window.interactor.InvokeEvent("TimerEvent")
    assert not window.preview, "nothing is computed while the mouse moves"
    window.interactor.InvokeEvent("TimerEvent")
    taken = re.search(r"a click here takes ([\d.]+) ml", window.views.words.GetInput())
    assert taken, window.views.words.GetInput()
    (_, part), _ = window.views.shown["mask"]
    assert covers(part, place), "the part is colored"
    volume = volume_of(window)
    click(window, on_screen(axial, place))
    assert abs(volume - volume_of(window) - float(taken[1])) < 0.5 * float(taken[1]), (volume, taken)
    (found,) = window.organ.done
    assert found[0] == "outside the organ" and numpy.allclose(found[1], [place], atol=1), found
    assert label_at(window, place) == 0, "the surface obeys"
    assert not window.views.shown["mask"]
    window.interactor.InvokeEvent("TimerEvent")
    window.interactor.InvokeEvent("TimerEvent")
    assert "takes nothing" in window.views.words.GetInput(), window.views.words.GetInput()
    corrected = points(window)
    press(window, "u")
    assert not window.organ.done and numpy.array_equal(points(window), free), "nothing of the point is left"
    press(window, "u")  # there is nothing else to take back
    press(window, "a")
    assert window.organ.done == [found] and numpy.array_equal(points(window), corrected)
    press(window, "a")
    assert window.organ.done == [found]

    mask, at = one_voxel()
    for plane in (scene.AXIAL, scene.CORONAL):
        assert covers(scene.mask_actor(mask, at, plane, scene.RED), at)

    # A place on the surface, in space, is on the boundary; a drag there turns the view and adds nothing.
    press(window, "b")
    middle = [window.organ.surface.GetCenter()[0], window.organ.surface.GetBounds()[2], window.organ.surface.GetCenter()[2]]
    click(window, on_screen(window.views.space, middle), drag=40)
    assert window.organ.done == [found]
    vertex = window.organ.surface.GetPoint(int(numpy.argmin(points(window)[:, 1])))
    click(window, on_screen(window.views.space, vertex))
    kind, (picked,) = window.organ.done[-1]
    assert kind == "on its boundary" and numpy.linalg.norm(points(window) - picked, axis=1).min() < 6, picked

    # What cannot be obeyed is told, and changes nothing.
    before = points(window)
    press(window, "o")
    window.interactor.SetEventInformation(*on_screen(axial, liver))
    while window.views.place[2] < liver[2]:
        window.interactor.InvokeEvent("MouseWheelForwardEvent")
    while window.views.place[2] > liver[2]:
        window.interactor.InvokeEvent("MouseWheelBackwardEvent")
    click(window, on_screen(axial, liver))
    told = " ".join(window.views.words.GetInput().split())
    assert len(window.organ.done) == 2 and "inner half of the seed" in told, told
    assert numpy.array_equal(points(window), before)

    # Another point forgets what was taken back.
    press(window, "u")
    press(window, "i")
    click(window, on_screen(coronal, [liver[0], window.views.place[1], window.views.place[2] + 20]))
    assert [kind for kind, _ in window.organ.done] == ["outside the organ", "inside the organ"]
    assert not window.organ.undone
    press(window, "u")
    press(window, "u")

    # A stroke is one step: points every 3 mm, straight on where the mouse is too fast.
    press(window, "o")
    press_at(window, on_screen(axial, place))
    move(window, [on_screen(axial, [60, 83.75 + step, liver[2]]) for step in (4, 20)])
    assert not window.organ.done and len(window.stroke) == 7, window.stroke
    beside = on_screen(window.views.space, liver)
    move(window, [beside])  # beside the slice, nothing is painted
    window.interactor.InvokeEvent("LeftButtonReleaseEvent")
    ((kind, stroke),) = window.organ.done
    assert kind == "outside the organ" and len(stroke) == 7, stroke
    assert numpy.allclose(numpy.linalg.norm(numpy.diff(stroke, axis=0), axis=1), 3, atol=0.05)
    assert all(label_at(window, point) == 0 for point in stroke)
    press(window, "u")
    assert not window.organ.done and numpy.array_equal(points(window), free)

    # Its question is marked, the slices go there, and the answer is a point.
    (question,) = window.questions
    assert str(question) in " ".join(window.views.words.GetInput().split())
    letters = [prop for _, prop in window.views.shown["marks"] if prop.IsA("vtkTextActor")]
    assert [letter.GetInput() for letter in letters] == ["?"] * len(letters) and letters
    press(window, "g")
    assert numpy.allclose(window.views.place, question.place)
    assert len([view for view, _ in window.views.shown["marks"]]) == 3, "in space and on both slices"
    os.makedirs(os.path.dirname(PICTURE), exist_ok=True)
    window.views.save(PICTURE)
    press(window, "y")
    assert window.organ.done == [("inside the organ", [question.place])] and not window.questions
    assert label_at(window, question.place) == 1
    press(window, "n")
    assert "there is no question" in window.views.words.GetInput() and len(window.organ.done) == 1
    press(window, "u")
    press(window, "n")
    assert window.organ.done == [("outside the organ", [question.place])]
    assert window.organ.filter.GetNumberOfSelfIntersections() == 0
    print("as it should be")


main()
