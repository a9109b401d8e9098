"""Seeds and corrections placed with the mouse in a plotter of PyVista, with undo: `plotter.flipfree`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any

import pyvista
from vtkmodules.vtkRenderingCore import vtkCellPicker

from ._errors import FlipFreeError
from ._foreign import adopted
from ._image import Image
from ._picture import CONTOUR, DOUBT, INK, LETTER, ORGAN, ROOM, VIEWS, Region
from ._pyvista_views import add_contour, add_slice, look
from ._segment import segment as segment_organ
from ._segmentation import Segmentation
from ._vtk_objects import imagedata_of, polydata_of

# What a click means, by the key that says so.
MEANINGS = {"l": "look", "s": "seed", "i": "inside", "o": "outside", "b": "boundary"}
COLORS = {"seed": CONTOUR, "inside": "#4dcc59", "outside": "#e0493e", "boundary": DOUBT}
HELP = (
    "Right click: {} (s seed, then its rim; i inside, o outside, b boundary, l look)",
    "u undo, a again; of a question y yes, n no",
)
# Of the mouse, between press and release: what moves farther drags.
CLICK_PIXELS = 3
# Radius of a point's ball, of the volume's diagonal.
BALL = 0.008

Step = tuple[str, tuple[float, ...]]


class Placing:
    """`plotter.flipfree`: right clicks on the slices of a volume place a seed and corrections.

    Key s: a click is the middle of the seed, and the next one its rim. Keys i, o and b: a click is a point
    inside, outside or on the boundary, which the surface obeys at once. l: the slices go where one clicks.
    u takes the last click back, a makes it again. y and n answer the question that is shown.
    """

    def __init__(self, plotter: pyvista.Plotter) -> None:
        self._plotter = plotter
        self._image: Image | None = None
        self._parameters: dict[str, Any] = {}
        self._meaning = MEANINGS["l"]
        self._steps: list[Step] = []
        self._undone: list[Step] = []
        self._known: dict[tuple[Step, ...], Segmentation | None] = {}
        self._slices: dict[Any, Any] = {}
        self._shown_at: tuple[float, ...] = ()
        self._pressed = (0, 0)
        self._words = ""

    def open(
        self,
        image: pyvista.ImageData,
        seed: Sequence[float] | None = None,
        radius: float | None = None,
        **parameters: Any,
    ) -> Placing:
        """Shows an image on three slices, and, if a seed is given, the organ around it.

        The plotter needs 2 x 2 views; parameters are those of flipfree.segment.
        """
        import numpy

        if self._plotter.shape != (2, 2):
            raise ValueError("plotter: 2 x 2 views are needed, three slices and the surface: Plotter(shape=(2, 2))")
        self._image, self._parameters = adopted("image", image), parameters
        self._steps, self._undone, self._known, self._shown_at = [], [], {}, ()
        bounds = imagedata_of(self._image).GetBounds()
        self._corners = numpy.array(bounds).reshape(3, 2).T
        self._middle = tuple(self._corners.mean(axis=0).tolist())
        self._place = self._middle if seed is None else tuple(map(float, seed))
        if seed is not None and radius is not None:
            self._steps = [("seed", self._place), ("seed", (self._place[0] + radius, *self._place[1:]))]
        interactor = self._plotter.iren
        interactor.add_observer("RightButtonPressEvent", self._press)
        interactor.add_observer("RightButtonReleaseEvent", self._release)
        actions: dict[str, Any] = {key: partial(self._mean, meaning) for key, meaning in MEANINGS.items()}
        actions.update(u=self.undo, a=self.redo, y=partial(self.answer, True), n=partial(self.answer, False))
        for key, action in actions.items():
            interactor.clear_events_for_key(key, raise_on_missing=False)
            self._plotter.add_key_event(key, action)
        self._meaning = MEANINGS["l" if self._steps else "s"]
        self._update()
        self._plotter.set_background(INK)
        front = Region(self._image, self._corners)
        look(self._plotter, front, numpy.array([1.0, 0, 0]), numpy.array([0, 0, 1.0]), 1 / ROOM)
        self._plotter.render()
        return self

    @property
    def organ(self) -> Segmentation | None:
        """The segmentation with what has been placed; None before there is a seed."""
        return self._known.get(tuple(self._steps))

    @property
    def surface(self) -> pyvista.PolyData | None:
        """Its surface."""
        return None if self.organ is None else pyvista.PolyData(polydata_of(self.organ.mesh))

    def place(self, meaning: str, place: Sequence[float]) -> None:
        """What a click does: 'seed', of which the second is on the rim, 'inside', 'outside', 'boundary' or 'look'."""
        if meaning not in MEANINGS.values():
            raise ValueError(f"meaning: {meaning!r} is none of {', '.join(MEANINGS.values())}")
        where = tuple(map(float, place))
        seeds = sum(what == "seed" for what, _ in self._steps)
        if meaning == "look" or (meaning == "seed" and seeds % 2 == 0):
            self._place = where  # the slices go there
        if meaning != "look":
            self._steps.append((meaning, where))
            self._undone.clear()
        self._update()

    def undo(self) -> None:
        """Takes the last step back."""
        if self._steps:
            self._undone.append(self._steps.pop())
            self._update()

    def redo(self) -> None:
        """Makes again what undo() has taken back last."""
        if self._undone:
            self._steps.append(self._undone.pop())
            self._update()

    def answer(self, yes: bool) -> None:
        """The first question's answer is a point where it is."""
        if self.organ is not None and self.organ.questions:
            self.place("inside" if yes else "outside", self.organ.questions[0].place)

    def _mean(self, meaning: str) -> None:
        self._meaning = meaning
        self._say()

    def _press(self, *_: Any) -> None:
        self._pressed = self._plotter.iren.get_event_position()

    def _release(self, *_: Any) -> None:
        """A click, if the mouse has not moved, and a slice is there."""
        self._plotter.iren.style.OnRightButtonUp()  # PyVista has put this in its place, and the drag would go on
        at = self._plotter.iren.get_event_position()
        if max(abs(a - b) for a, b in zip(at, self._pressed)) > CLICK_PIXELS:
            return
        renderer, picker = self._plotter.iren.get_poked_renderer(*at), vtkCellPicker()
        picker.PickFromListOn()
        if renderer in self._slices:
            picker.AddPickList(self._slices[renderer])
        if picker.Pick(*at, 0, renderer):
            self.place(self._meaning, picker.GetPickPosition())

    def _update(self) -> None:
        """Segments, unless it is known; a step that is refused is taken back."""
        self._words = ""
        steps = tuple(self._steps)
        if steps not in self._known:
            try:
                self._known[steps] = self._run()
            except FlipFreeError as error:
                self._words = str(error)
                self._steps.pop()
        self._show()

    def _run(self) -> Segmentation | None:
        places: dict[str, list[tuple[float, ...]]] = {name: [] for name in MEANINGS.values()}
        for meaning, place in self._steps:
            places[meaning].append(place)
        spheres = [(middle, math.dist(middle, rim)) for middle, rim in zip(places["seed"][::2], places["seed"][1::2])]
        if not spheres:
            return None
        kinds = {name: places[name] for name in ("inside", "outside", "boundary")}
        (seed, radius), *seeds = spheres
        return segment_organ(self._image, seed, radius, seeds=seeds, **kinds, **self._parameters)  # type: ignore[arg-type]

    def _region(self, normal: Any) -> Region:
        """Of the slice through the last place, to the ends of the volume."""
        import numpy

        assert self._image is not None
        middle = numpy.array(self._middle)
        region = Region(self._image, middle + (self._corners - middle) / ROOM)
        region.center = middle + ((numpy.array(self._place) - middle) @ normal) * normal
        return region

    def _show(self) -> None:
        """Three slices with contours and the points near them, and the surface with all points."""
        import numpy

        plotter, surface = self._plotter, self.surface
        ball = BALL * math.dist(*self._corners)
        quiet: dict[str, Any] = {"reset_camera": False, "render": False}
        has_moved, self._shown_at = self._shown_at != self._place, self._place
        for number, view in enumerate((*VIEWS, None)):
            plotter.subplot(number // 2, number % 2)
            for name in ("organ", *COLORS):
                plotter.remove_actor(f"flipfree-{name}-{number}", **quiet)  # of all views
            normal = None if view is None else numpy.cross(view.right, view.up).astype(float)
            if view is not None:
                region = self._region(normal)
                right, up = numpy.array(view.right, float), numpy.array(view.up, float)
                if has_moved:
                    assert self._image is not None
                    name = f"flipfree-slice-{number}"
                    self._slices[plotter.renderer] = add_slice(plotter, self._image, region, right, up, name=name, **quiet)
                if surface is not None:
                    add_contour(plotter, surface, region, normal, CONTOUR, name=f"flipfree-organ-{number}", **quiet)
            elif surface is not None:
                plotter.add_mesh(surface, color=ORGAN, opacity=0.6, smooth_shading=True,
                                 name=f"flipfree-organ-{number}", **quiet)
            for meaning, color in COLORS.items():
                near = [place for what, place in self._steps if what == meaning and (
                    normal is None or abs((numpy.array(place) - self._place) @ normal) < ball)]
                if near:
                    balls = pyvista.MultiBlock([pyvista.Sphere(radius=ball, center=place) for place in near])
                    plotter.add_mesh(balls.combine(), color=color, name=f"flipfree-{meaning}-{number}", **quiet)
            plotter.reset_camera_clipping_range()
        self._say()

    def _say(self) -> None:
        questions = self.organ.questions if self.organ is not None else ()
        lines = [HELP[0].format(self._meaning), HELP[1], self._words, *map(str, questions[:1])]
        self._plotter.subplot(1, 1)
        self._plotter.add_text("\n".join(filter(None, lines)), position="upper_left", font_size=9, color=LETTER,
                               name="flipfree-words", render=False)
        self._plotter.render()
