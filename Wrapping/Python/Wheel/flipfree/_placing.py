"""Seeds and corrections placed with the mouse in PyVista, with undo: `plotter.flipfree`."""

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
from ._parameters import floats, radius_of
from ._picture import CONTOUR, DOUBT, INK, LETTER, ORGAN, ROOM, VIEWS, Region
from ._pyvista_views import add_contour, add_slice, look
from ._segment import segment as segment_organ
from ._segmentation import Segmentation
from ._vtk_objects import imagedata_of, polydata_of

SEED = "seed"
# What a click means, by the key that says so.
MEANINGS = {"l": "look", "s": SEED, "i": "inside", "o": "outside", "b": "boundary"}
COLORS = {SEED: CONTOUR, "inside": "#4dcc59", "outside": "#e0493e", "boundary": DOUBT}
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

    Key s: a click is the middle of the seed, and the next one its rim. Keys i, o and b: a click is
    a point inside, outside or on the boundary, which the surface obeys at once. l: the slices go
    where one clicks. u takes the last click back, a makes it again. y and n answer the question
    that is shown.
    """

    def __init__(self, plotter: pyvista.Plotter) -> None:
        self._plotter = plotter
        self._image: Image | None = None
        self._parameters: dict[str, Any] = {}
        self._meaning = MEANINGS["l"]
        self._steps: list[Step] = []
        self._undone: list[Step] = []
        self._known: dict[tuple[Step, ...], Segmentation | None] = {(): None}
        self._listens = False
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

        The plotter needs 2 x 2 views; a seed needs a radius; parameters are those of
        flipfree.segment.
        """
        import numpy

        if self._plotter.shape != (2, 2):
            raise ValueError(
                "plotter: 2 x 2 views are needed, three slices and the surface: "
                "Plotter(shape=(2, 2))"
            )
        if (seed is None) != (radius is None):
            raise ValueError(
                "seed, radius: give both, or neither and place the seed with the mouse"
            )
        volume = adopted("image", image)
        steps: list[Step] = []
        if seed is not None and radius is not None:
            x, y, z = floats("seed", seed, 3)
            rim = (x + radius_of("radius", radius), y, z)
            steps = [(SEED, (x, y, z)), (SEED, rim)]
        organ = _organ_of(volume, steps, parameters)  # may raise: nothing has changed yet
        self._image, self._parameters = volume, parameters
        self._steps, self._undone, self._words, self._shown_at = steps, [], "", ()
        self._known = {(): None, tuple(steps[:1]): None, tuple(steps): organ}
        bounds = imagedata_of(self._image).GetBounds()
        self._corners = numpy.array(bounds).reshape(3, 2).T
        self._middle = tuple(self._corners.mean(axis=0).tolist())
        self._place = steps[0][1] if steps else self._middle
        interactor = self._plotter.iren
        if not self._listens:
            interactor.add_observer("RightButtonPressEvent", self._press)
            interactor.add_observer("RightButtonReleaseEvent", self._release)
            self._listens = True
        actions: dict[str, Any] = {
            key: partial(self._mean, meaning) for key, meaning in MEANINGS.items()
        }
        actions.update(
            u=self.undo, a=self.redo, y=partial(self.answer, True), n=partial(self.answer, False)
        )
        for key, action in actions.items():
            interactor.clear_events_for_key(key, raise_on_missing=False)
            self._plotter.add_key_event(key, action)
        self._meaning = MEANINGS["l" if self._steps else "s"]
        self._show()
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
        """What a click does: 'seed' (a second one is its rim), or another of MEANINGS."""
        if meaning not in MEANINGS.values():
            raise ValueError(f"meaning: {meaning!r} is none of {', '.join(MEANINGS.values())}")
        where = tuple(floats("place", place, 3))
        is_middle = meaning == SEED and len(_seeds_of(self._steps)) % 2 == 0
        self._words = ""
        if meaning != "look":
            steps = [*self._steps, (meaning, where)]
            try:
                self._known[tuple(steps)] = self._organ_after(steps)
            except (FlipFreeError, ValueError) as error:
                self._words = str(error)
                self._show()
                return
            self._steps, self._undone = steps, []
            self._known = {
                key: organ for key, organ in self._known.items() if key == tuple(steps[: len(key)])
            }
        if meaning == "look" or is_middle:
            self._place = where  # the slices go there
        self._show()

    def undo(self) -> None:
        """Takes the last step back."""
        self._move(self._steps, self._undone)

    def redo(self) -> None:
        """Makes again what undo() has taken back last."""
        self._move(self._undone, self._steps)

    def answer(self, yes: bool) -> None:
        """The first question's answer is a point where it is."""
        if self.organ is not None and self.organ.questions:
            self.place("inside" if yes else "outside", self.organ.questions[0].place)

    def _move(self, source: list[Step], target: list[Step]) -> None:
        """What comes of it is known."""
        if source:
            target.append(source.pop())
            self._words = ""
            self._show()

    def _mean(self, meaning: str) -> None:
        self._meaning = meaning
        self._say()

    def _press(self, *_: Any) -> None:
        self._pressed = self._plotter.iren.get_event_position()

    def _release(self, *_: Any) -> None:
        """A click, if the mouse has not moved, and a slice is there."""
        # PyVista has put this in its place, and the drag would go on.
        self._plotter.iren.style.OnRightButtonUp()
        at = self._plotter.iren.get_event_position()
        if max(abs(a - b) for a, b in zip(at, self._pressed)) > CLICK_PIXELS:
            return
        renderer, picker = self._plotter.iren.get_poked_renderer(*at), vtkCellPicker()
        picker.PickFromListOn()
        if renderer in self._slices:
            picker.AddPickList(self._slices[renderer])
        if picker.Pick(*at, 0, renderer):
            self.place(self._meaning, picker.GetPickPosition())

    def _organ_after(self, steps: list[Step]) -> Segmentation | None:
        """What the last step makes of the organ that is shown."""
        assert self._image is not None
        before, (meaning, place), seeds = self.organ, steps[-1], _seeds_of(steps)
        if meaning == SEED and len(seeds) % 2 == 1:
            return before  # until there is a rim
        if before is None:
            return _organ_of(self._image, steps, self._parameters)
        if meaning == SEED:
            return before.corrected(seeds=_spheres_of(seeds[-2:]))
        points: dict[str, Any] = {meaning: [place]}
        return before.corrected(**points)

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
                    self._slices[plotter.renderer] = add_slice(
                        plotter, self._image, region, right, up, name=name, **quiet
                    )
                if surface is not None:
                    add_contour(
                        plotter,
                        surface,
                        region,
                        normal,
                        CONTOUR,
                        name=f"flipfree-organ-{number}",
                        **quiet,
                    )
            elif surface is not None:
                plotter.add_mesh(
                    surface,
                    color=ORGAN,
                    opacity=0.6,
                    smooth_shading=True,
                    name=f"flipfree-organ-{number}",
                    **quiet,
                )
            for meaning, color in COLORS.items():
                near = [
                    place
                    for what, place in self._steps
                    if what == meaning
                    and (normal is None or abs((numpy.array(place) - self._place) @ normal) < ball)
                ]
                if near:
                    balls = pyvista.MultiBlock(
                        [pyvista.Sphere(radius=ball, center=place) for place in near]
                    )
                    plotter.add_mesh(
                        balls.combine(), color=color, name=f"flipfree-{meaning}-{number}", **quiet
                    )
            plotter.reset_camera_clipping_range()
        self._say()

    def _say(self) -> None:
        questions = self.organ.questions if self.organ is not None else ()
        lines = [HELP[0].format(self._meaning), HELP[1], self._words, *map(str, questions[:1])]
        self._plotter.subplot(1, 1)
        self._plotter.add_text(
            "\n".join(filter(None, lines)),
            position="upper_left",
            font_size=9,
            color=LETTER,
            name="flipfree-words",
            render=False,
        )
        self._plotter.render()


def _seeds_of(steps: Sequence[Step]) -> list[tuple[float, ...]]:
    """Middles and rims in turn."""
    return [place for meaning, place in steps if meaning == SEED]


def _spheres_of(seeds: Sequence[tuple[float, ...]]) -> list[tuple[tuple[float, ...], float]]:
    return [(middle, math.dist(middle, rim)) for middle, rim in zip(seeds[::2], seeds[1::2])]


def _organ_of(
    image: Image, steps: Sequence[Step], parameters: dict[str, Any]
) -> Segmentation | None:
    """None if there is no seed yet."""
    spheres = _spheres_of(_seeds_of(steps))
    if not spheres:
        return None
    points: dict[str, Any] = {
        kind: [place for meaning, place in steps if meaning == kind]
        for kind in ("inside", "outside", "boundary")
    }
    (seed, radius), *seeds = spheres
    return segment_organ(image, seed, radius, seeds=seeds, **points, **parameters)
