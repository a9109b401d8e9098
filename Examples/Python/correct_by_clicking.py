"""A window in which one clicks on what is wrong with a segmentation, and answers its questions.

    python3 correct_by_clicking.py                         # the built-in phantom
    python3 correct_by_clicking.py ct.nii.gz --seed 83 -154 321 --radius 26

A key says what the next clicks mean: o, the organ does not reach that place; i, it holds it; b, its
boundary is there; l, look, the slices only go there. Click on a slice or on the surface, and the
surface obeys; after o and i, a slice shows in color what a click under the mouse would take or add,
and a drag over it paints a stroke of such points. Where the result has a question, there is a
question mark: g, the slices go there, and again to the next one; y, yes, that part is organ; n, no.
u takes the last step back, a brings it again. The wheel over a slice moves it; drag beside the
slices to turn the view; q ends. With --picture, the window is saved as it opens.
"""

import math
import textwrap

import flipfree
import inputs
import scene
from corrections import BOUNDARY, INSIDE, OUTSIDE, PREVIEW, Corrections
from three_views import ThreeViews
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor

CLICK_PIXELS = 3  # a mouse that moves farther than this drags
STROKE_STEP = 3  # mm between the points of a stroke
MILLISECONDS = 30  # of a pause of the mouse
VIOLET, DIM = (0.95, 0.45, 1.0), (0.75, 0.5, 0.8)  # of the question that keys answer, of others
COLORS = {OUTSIDE: scene.RED, INSIDE: (0.3, 0.8, 0.35), BOUNDARY: scene.BLUE}
# What a click means, by the key that says so; l only moves the slices.
MEANINGS = {"o": OUTSIDE, "i": INSIDE, "b": BOUNDARY, "l": "the slices go there"}


class CorrectionWindow:
    """What mouse and keys do."""

    def __init__(self, image, seed, radius):
        self.organ = Corrections(image, seed, radius)
        self.views = ThreeViews(image, self.organ.surface, 0.5, 1.2)
        self.meaning = MEANINGS["l"]
        self.questions = []
        self.asked = 0  # the question that keys answer
        self.has_gone = False  # whether the slices have gone to it
        self.words = ""  # about the last step
        self.preview = ""  # of a click where the mouse is
        self.is_preview_stale = False  # since the mouse has moved, or the organ changed
        self.has_moved = False  # the mouse, since the timer rang
        self.is_held = False  # the button
        self.pressed = (0, 0)
        self.stroke = []  # that is being painted

        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.views.window)
        self.style = vtkInteractorStyleTrackballCamera()
        self.interactor.SetInteractorStyle(self.style)
        self.interactor.Initialize()
        # In place of what the style does by itself; it takes the mouse for itself while a button is
        # held.
        for event, answer in (("LeftButtonPressEvent", self.press),
                              ("MouseMoveEvent", self.move),
                              ("LeftButtonReleaseEvent", self.release),
                              ("MouseWheelForwardEvent", lambda: self.turn_wheel(1)),
                              ("MouseWheelBackwardEvent", lambda: self.turn_wheel(-1))):
            self.style.AddObserver(event, lambda *_, answer=answer: answer())
        self.interactor.AddObserver("KeyPressEvent", lambda *_: self.take_key())
        self.interactor.AddObserver("TimerEvent", lambda *_: self.show_preview())
        self.interactor.CreateRepeatingTimer(MILLISECONDS)
        self.views.show_slices(seed)
        self.say("o, i or b, then click on what is wrong")

    def do(self, meaning, places):
        """A step, which may be refused."""
        try:
            self.organ.do(meaning, places)
        except flipfree.FlipFreeError as error:
            self.say(str(error))
        else:
            self.say("obeyed: " + meaning)

    def press(self):
        """A click or a stroke may begin."""
        self.is_held = True
        self.pressed = self.interactor.GetEventPosition()
        if not self.views.slice_at(self.pressed):
            self.style.OnLeftButtonDown()
        elif self.meaning in PREVIEW:
            place = self.views.pick(self.pressed)
            self.stroke = [place] if place else []

    def move(self):
        """Paints, or turns the view."""
        if not self.stroke:
            self.is_preview_stale = True
            self.has_moved = True
            self.style.OnMouseMove()
            return
        mouse = self.interactor.GetEventPosition()
        is_beside = self.views.slice_at(mouse) != self.views.slice_at(self.pressed)
        place = None if is_beside else self.views.pick(mouse)
        if place:
            _extend(self.stroke, place)
            self.show_marks()

    def release(self):
        """A stroke, if the mouse has been dragged over a slice; a click, if it has not moved."""
        self.is_held = False
        self.style.OnLeftButtonUp()
        mouse = self.interactor.GetEventPosition()
        is_click = max(abs(a - b) for a, b in zip(mouse, self.pressed)) <= CLICK_PIXELS
        stroke, self.stroke = self.stroke, []
        place = self.views.pick(mouse) if is_click else None
        if place:
            self.views.show_slices(place)
            self.has_gone = False
            if self.meaning in COLORS:
                self.do(self.meaning, [place])
            self.views.window.Render()
        elif stroke:
            self.do(self.meaning, stroke)

    def turn_wheel(self, step):
        """Moves the slice under the mouse by a voxel, or the camera."""
        plane = self.views.slice_at(self.interactor.GetEventPosition())
        if plane:
            self.views.move_slice(plane, step)
            self.views.window.Render()
        elif step > 0:
            self.style.OnMouseWheelForward()
        else:
            self.style.OnMouseWheelBackward()

    def take_key(self):
        """What keys do."""
        key = self.interactor.GetKeyCode()
        if key in MEANINGS:
            self.meaning = MEANINGS[key]
            self.say("")
        elif key == "u" and self.organ.undo():
            self.say("taken back; a brings it again")
        elif key == "a" and self.organ.redo():
            self.say("obeyed again: " + self.organ.done[-1][0])
        elif key in ("g", "y", "n") and not self.questions:
            self.say("there is no question")
        elif key == "g":
            self.go_to_question()
        elif key in ("y", "n"):
            self.answer(key == "y")

    def go_to_question(self):
        """The next one, where the slices are at one already."""
        if self.has_gone:
            self.asked = (self.asked + 1) % len(self.questions)
        self.has_gone = True
        self.views.show_slices(self.questions[self.asked].place)
        self.say("")

    def answer(self, is_part):
        """Yes is an inside point, no an outside point."""
        place = self.questions[self.asked].place
        self.asked = 0
        self.has_gone = False
        self.do(INSIDE if is_part else OUTSIDE, [place])

    def say(self, words):
        """About the last step."""
        self.questions = self.organ.questions()
        if self.asked >= len(self.questions):
            self.asked = 0
        self.words = words
        self.preview = ""
        self.is_preview_stale = True
        self.views.show_mask(None, None)
        self.show_words()
        self.show_marks()

    def show_words(self):
        """Below the view into space."""
        lines = [f"click: {self.meaning} (o, i, b, l; u, a)", self.preview, self.words]
        if self.questions:
            lines += [str(self.questions[self.asked]), "y: yes, n: no, g: the slices go there"]
        self.views.words.SetInput("\n".join(textwrap.fill(line, 72) for line in lines if line))

    def show_marks(self):
        """A ball at each point, a question mark at each question."""
        points = [(meaning, place) for meaning, places in self.organ.done for place in places]
        points += [(self.meaning, place) for place in self.stroke]
        marks = [(place, COLORS[meaning], None, 0) for meaning, place in points]
        marks += [(question.place, VIOLET if number == self.asked else DIM, "?", _reach(question))
                  for number, question in enumerate(self.questions)]
        self.views.show_marks(marks)
        self.views.window.Render()

    def show_preview(self):
        """Of a click where the mouse has paused; on its way, it would have to wait for others."""
        is_moving, self.has_moved = self.has_moved, False
        if not self.is_preview_stale or is_moving or self.is_held or self.meaning not in PREVIEW:
            return
        self.is_preview_stale = False
        mouse = self.interactor.GetEventPosition()
        place = self.views.pick(mouse) if self.views.slice_at(mouse) else None
        changed = vtkImageData()
        self.preview = ""
        if place:
            volume = self.organ.preview(self.meaning, place, changed)
            self.preview = _words_of_preview(volume, "adds" if self.meaning == INSIDE else "takes")
        self.views.show_mask(changed if changed.GetNumberOfPoints() else None, COLORS[self.meaning])
        self.show_words()
        self.views.window.Render()


def _extend(stroke, place):
    """Continues a stroke straight to a place, by whole steps."""
    start = stroke[-1]
    length = math.dist(start, place)
    for step in range(1, int(length / STROKE_STEP) + 1):
        part = step * STROKE_STEP / length
        stroke.append(tuple(a + part * (b - a) for a, b in zip(start, place)))


def _words_of_preview(volume, verb):
    if volume < 0:
        return "a click here cannot be obeyed"
    if volume == 0:
        return f"a click here {verb} nothing"
    return f"a click here {verb} {volume:.{1 if volume < 10 else 0}f} ml"


def _reach(question):
    """The radius of a ball of that volume, in mm."""
    return (3000 * question.volume / (4 * math.pi)) ** (1 / 3)


if __name__ == "__main__":
    arguments = inputs.parse(__doc__)
    window = CorrectionWindow(*inputs.image_and_seed(arguments))
    if arguments.picture:
        window.views.save(arguments.picture)
    else:
        window.interactor.Start()
