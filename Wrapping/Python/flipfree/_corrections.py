"""Points that correct a segmentation, and results that can be corrected."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, cast

from ._errors import FlipFreeError
from ._parameters import floats, radius_of, suggestion
from ._types import ProgressOption

if TYPE_CHECKING:
    from typing_extensions import Self

    from ._questions import Question

Method = TypeVar("Method", bound=Callable[..., Any])
Again = TypeVar("Again", bound=Callable[..., Any])

# The values of the array `Constraint`.
OUTSIDE, INSIDE, BOUNDARY, SEED = range(4)


@dataclass(frozen=True)
class Constraint:
    """A point that the surface must obey, or a further seed sphere."""

    kind: int
    place: tuple[float, ...]
    radius: float = 0.0


class GivenOrgan(NamedTuple):
    """One of several organs: its name, its seed sphere and its points."""

    name: str
    center: list[float]
    radius: float
    points: tuple[Constraint, ...]


Points = Sequence[Sequence[float]]
Seeds = Sequence[tuple[Sequence[float], float]]


def constraints_of(
    inside: Points, outside: Points, boundary: Points, seeds: Seeds
) -> tuple[Constraint, ...]:
    """All of them as a list; TypeError or ValueError names the argument that is wrong."""
    constraints: list[Constraint] = []
    for name, kind, points in (
        ("inside", INSIDE, inside),
        ("outside", OUTSIDE, outside),
        ("boundary", BOUNDARY, boundary),
    ):
        constraints += [Constraint(kind, place) for place in places_of(name, points)]
    for seed in _items("seeds", seeds):
        try:
            center, radius = seed
        except (TypeError, ValueError):
            raise TypeError(
                f"seeds: pairs of a center and a radius are needed, not {seed!r:.80}"
            ) from None
        place = tuple(floats("seeds", center, 3))
        constraints.append(Constraint(SEED, place, radius_of("seeds", radius)))
    return tuple(constraints)


def answers_of(
    questions: Sequence[Question], answers: Mapping[int, bool]
) -> tuple[Constraint, ...]:
    """The points that answer questions; TypeError or ValueError names the answer that is wrong."""
    if not isinstance(answers, Mapping):
        raise TypeError(
            "answers: a dict is needed, such as {0: True} for the first question, "
            f"not {answers!r:.80}"
        )
    for number, answer in answers.items():
        if number not in range(len(questions)):
            raise ValueError(
                f"answers: there is no question {number!r}; there are {len(questions)}"
            )
        if answer not in (True, False):
            raise TypeError(
                f"answers: question {number} is answered by True or False, not {answer!r:.80}"
            )
    return tuple(
        Constraint(INSIDE if answer else OUTSIDE, questions[number].place)
        for number, answer in answers.items()
    )


def _suggesting(method: Method) -> Method:
    """A method whose error about a wrong keyword says which one was meant."""
    known = [name for name in inspect.signature(method).parameters if name != "self"]

    @functools.wraps(method)
    def checked(*arguments: Any, **keywords: Any) -> Any:
        for name in keywords:
            if name not in known:
                raise TypeError(
                    f"{method.__name__}() has no parameter '{name}'; {suggestion(name, known)}"
                    f"there are {', '.join(known)}"
                )
        return method(*arguments, **keywords)

    return cast("Method", checked)


class Correctable:
    """A result that can be corrected by points."""

    constraints: tuple[Constraint, ...]
    questions: tuple[Question, ...]
    _again: Callable[[tuple[Constraint, ...], ProgressOption], Any] | None

    def __getstate__(self) -> dict[str, Any]:
        # In another process, only the result is there.
        return {**self.__dict__, "_again": None}

    @_suggesting
    def corrected(
        self,
        *,
        inside: Points = (),
        outside: Points = (),
        boundary: Points = (),
        seeds: Seeds = (),
        progress: ProgressOption = None,
    ) -> Self:
        """The segmentation with these points besides those that it has already.

        See segment(), segment_organs() and trace(). This result stays as it is.

        >>> import flipfree
        >>> abdomen = flipfree.phantom("abdomen").image
        >>> liver = flipfree.segment(abdomen, seed=(99.75, 83.75, 167), radius=28)
        >>> smaller = liver.corrected(outside=[(60, 83, 167)])
        >>> len(smaller.constraints), smaller.self_intersections
        (1, 0)
        """
        return self._with(constraints_of(inside, outside, boundary, seeds), progress)

    def answered(self, answers: Mapping[int, bool], progress: ProgressOption = None) -> Self:
        """The segmentation with answers to some of its questions, by their numbers, from 0 on.

        True, it is a part of the organ, is an inside point at the question's place, and False an
        outside point. What is answered is not asked again. This result stays as it is.

        >>> import flipfree
        >>> abdomen = flipfree.phantom("abdomen").image
        >>> liver = flipfree.segment(abdomen, seed=(99.75, 83.75, 167), radius=28)
        >>> liver.answered({9: True})
        Traceback (most recent call last):
          ...
        ValueError: answers: there is no question 9; there are ...
        """
        return self._with(answers_of(self.questions, answers), progress)

    def _with(self, more: tuple[Constraint, ...], progress: ProgressOption) -> Self:
        result: Self = again_of(self._again)(self.constraints + more, progress)
        return result


def again_of(again: Again | None) -> Again:
    """What segments again; raises FlipFreeError for a copy, which has lost it."""
    if again is None:
        raise FlipFreeError(
            "only what segment(), segment_organs() or trace() has returned can be corrected, "
            "not a copy of it; call the function again with the points"
        )
    return again


def _items(name: str, values: Any) -> Iterable[Any]:
    try:
        return list(values)
    except TypeError:
        raise TypeError(f"{name}: a list is needed, not {values!r:.80}") from None


def places_of(name: str, points: Any) -> list[tuple[float, ...]]:
    """A list of points; TypeError or ValueError names the argument that is wrong."""
    items = _items(name, points)
    for item in items:
        if isinstance(item, (int, float)):
            raise TypeError(f"{name}: a list of points is needed: [(x, y, z)], not {points!r:.80}")
    return [tuple(floats(name, item, 3)) for item in items]
