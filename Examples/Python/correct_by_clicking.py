"""A window in which one clicks on what is wrong with a segmentation.

    python3 correct_by_clicking.py                         # the built-in phantom
    python3 correct_by_clicking.py ct.nii.gz --seed 83 -154 321 --radius 26

A key says what the next clicks mean: o, the organ does not reach that place; i, it holds it; b, its
boundary is there; n, nothing, the slices only go there. Click on a slice or on the surface, and the
surface obeys. u takes the last point back, y brings it again. The wheel over a slice moves it; drag
beside the slices to turn the view; q ends. With --picture, the window is saved as it opens.
"""

import textwrap

import flipfree
import inputs
import scene
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCellPicker,
    vtkPolyDataMapper,
    vtkRenderWindowInteractor,
)

CLICK_PIXELS = 3  # a mouse that moves farther than this turns the view
MARK_RADIUS = 4  # mm
GREEN = (0.3, 0.8, 0.35)
# What a click means, by the key that says so: in words, as the filter's method, and as a color.
MEANINGS = {
    "n": ("the slices go there", None, None),
    "o": ("outside the organ", flipfree.vtkFlipFreeSegmentation.AddOutsidePoint, scene.RED),
    "i": ("inside the organ", flipfree.vtkFlipFreeSegmentation.AddInsidePoint, GREEN),
    "b": ("on its boundary", flipfree.vtkFlipFreeSegmentation.AddBoundaryPoint, scene.BLUE),
}


class CorrectionWindow:
    """Three views: space with the surface, and two slices."""

    def __init__(self, image, seed, radius):
        self.image = image
        self.place = list(seed)
        self.mode = "n"
        self.done = []  # pairs of a key and a place
        self.undone = []
        self.shown = []
        self.pressed = (0, 0)
        self.surface = vtkPolyData()  # what all views show

        self.surface_shown = scene.surface_actor(self.surface, edges=True)
        self.space = scene.space_view([self.surface_shown])
        self.words = scene.text_actor("")
        self.space.AddViewProp(self.words)
        self.planes = {scene.AXIAL: scene.slice_view([], image, scene.AXIAL, margin=1.05),
                       scene.CORONAL: scene.slice_view([], image, scene.CORONAL, margin=1.05)}
        self.pictures = {}  # the slices' gray values
        self.window = scene.open_window(self.space, self.planes.values(), 0.5)

        self.filter = flipfree.vtkFlipFreeSegmentation()
        self.filter.SetInputData(image)
        self.filter.SetSeedCenter(seed)
        self.filter.SetSeedRadius(radius)
        self.filter.KeepForCorrectionsOn()  # a correction then takes a third of the time
        self.segment()

        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.style = vtkInteractorStyleTrackballCamera()
        self.interactor.SetInteractorStyle(self.style)
        self.interactor.Initialize()
        # In place of what the style does by itself; it takes the mouse for itself while a button is
        # held.
        for event, answer in (("LeftButtonPressEvent", self.press),
                              ("LeftButtonReleaseEvent", self.release),
                              ("MouseWheelForwardEvent", lambda: self.turn_wheel(1)),
                              ("MouseWheelBackwardEvent", lambda: self.turn_wheel(-1))):
            self.style.AddObserver(event, lambda *_, answer=answer: answer())
        self.interactor.AddObserver("KeyPressEvent", lambda *_: self.take_key())
        self.space.ResetCamera(image.GetBounds())
        self.space.GetActiveCamera().Zoom(1.2)
        self.say("o, i or b, then click on what is wrong")

    def segment(self):
        """Runs the method with the points there are."""
        flipfree.update(self.filter)
        self.surface.ShallowCopy(self.filter.GetSurface())

    def add(self, key, place):
        """Another point; one that cannot be obeyed is none, and the result stays."""
        MEANINGS[key][1](self.filter, *place)
        try:
            self.segment()
        except flipfree.FlipFreeError as error:
            self.filter.RemoveLastPoint()
            self.segment()
            self.say(str(error))
            return False
        self.done.append((key, place))
        self.say("obeyed: " + MEANINGS[key][0])
        return True

    def undo(self):
        """Takes the last point back."""
        if self.done:
            self.undone.append(self.done.pop())
            self.filter.RemoveLastPoint()
            self.segment()
            self.say("taken back; y brings it again")

    def redo(self):
        """Brings the last point again that has been taken back."""
        if self.undone:
            self.add(*self.undone.pop())

    def take_key(self):
        """What keys do."""
        key = self.interactor.GetKeyCode()
        if key in MEANINGS:
            self.mode = key
            self.say("")
        elif key == "u":
            self.undo()
        elif key == "y":
            self.redo()

    def press(self):
        """A click may begin."""
        self.pressed = self.interactor.GetEventPosition()
        if not self.slice_at(self.pressed):
            self.style.OnLeftButtonDown()

    def release(self):
        """A click, unless the mouse has been dragged."""
        self.style.OnLeftButtonUp()
        mouse = self.interactor.GetEventPosition()
        if max(abs(a - b) for a, b in zip(mouse, self.pressed)) > CLICK_PIXELS:
            return
        place = self.pick(mouse)
        if place is None:
            return
        self.place = list(place)
        if self.mode != "n" and self.add(self.mode, place):
            self.undone.clear()
        self.show()

    def slice_at(self, mouse):
        """The slice that the mouse is in, if any."""
        return next((plane for plane, renderer in self.planes.items()
                     if renderer.IsInViewport(*mouse)), None)

    def pick(self, mouse):
        """The place on a slice or, in space, on the surface that the mouse points at."""
        plane = self.slice_at(mouse)
        picker = vtkCellPicker()
        picker.SetTolerance(0)
        picker.PickFromListOn()
        for actor in [self.pictures[plane]] if plane else [self.surface_shown,
                                                           *self.pictures.values()]:
            picker.AddPickList(actor)
        renderer = self.planes[plane] if plane else self.space
        return picker.GetPickPosition() if picker.Pick(*mouse, 0, renderer) else None

    def turn_wheel(self, step):
        """Moves the slice under the mouse by a voxel, or the camera."""
        plane = self.slice_at(self.interactor.GetEventPosition())
        if plane:
            axis = _axis(plane)
            bounds = self.image.GetBounds()[2 * axis:2 * axis + 2]
            moved = self.place[axis] + step * self.image.GetSpacing()[axis]
            self.place[axis] = min(max(moved, bounds[0]), bounds[1])
            self.show()
        elif step > 0:
            self.style.OnMouseWheelForward()
        else:
            self.style.OnMouseWheelBackward()

    def say(self, words):
        """Below the view into space."""
        self.words.SetInput(f"click: {MEANINGS[self.mode][0]} (o, i, b, n; u, y)\n"
                            + textwrap.fill(words, 72))
        self.show()

    def show(self):
        """The slices through the place, and a ball at each point."""
        for renderer, actor in self.shown:
            renderer.RemoveActor(actor)
        self.shown = []
        for plane, renderer in self.planes.items():
            self.pictures[plane] = scene.slice_actor(self.image, self.place, plane, samples=200)
            contour = scene.contour_actor(self.surface, self.place, plane, width=1)
            self.shown += [(renderer, self.pictures[plane]), (self.space, self.pictures[plane]),
                           (renderer, contour)]
        views = (self.space, *self.planes.values())
        for key, place in self.done:
            ball = _ball(place, MEANINGS[key][2])
            self.shown += [(self.space, ball)]
            self.shown += [(renderer, ball) for plane, renderer in self.planes.items()
                           if abs(place[_axis(plane)] - self.place[_axis(plane)]) < MARK_RADIUS]
        for renderer, actor in self.shown:
            renderer.AddActor(actor)
        for renderer in views:
            renderer.ResetCameraClippingRange()
        self.window.Render()

    def save(self, picture):
        """What the window shows, as PNG."""
        scene.save_window(self.window, picture)


def _axis(plane):
    """Across a slice."""
    return 2 if plane == scene.AXIAL else 1


def _ball(place, color):
    """The mark of a point."""
    source = vtkSphereSource()
    source.SetCenter(place)
    source.SetRadius(MARK_RADIUS)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    return actor


if __name__ == "__main__":
    arguments = inputs.parse(__doc__)
    window = CorrectionWindow(*inputs.image_and_seed(arguments))
    if arguments.picture:
        window.save(arguments.picture)
    else:
        window.interactor.Start()
