"""Several organs as one function."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from ._arrays import array_from_image
from ._backend import GROUP_PARAMETERS, GroupAlgorithm
from ._boundary_found import require_boundary
from ._corrections import (
    Constraint,
    GivenOrgan,
    Points,
    Seeds,
    again_of,
    answers_of,
    constraints_of,
)
from ._parameters import described, floats, radius_of, set_parameters, signature_with, suggestion
from ._progress import progress_of
from ._segmentation import Segmentation
from ._types import ProgressOption

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import AnyImage, AnySurface, Image

KEYS = ("seed", "radius", "inside", "outside", "boundary", "seeds")


class SegmentedOrgans(Mapping[str, Segmentation]):
    """What segment_organs() has found: a Segmentation by the name of each organ.

    The label map of each is that of all. corrected() and answered() segment all organs again, with more points
    of one of them, so that they still do not meet; those of a single organ do the same, and return that one.
    """

    def __init__(
        self,
        organs: dict[str, Segmentation],
        label_map: Image,
        first: int,
        again: Callable[[str, tuple[Constraint, ...], ProgressOption], SegmentedOrgans],
    ) -> None:
        def of_one(
            name: str, points: tuple[Constraint, ...], progress: ProgressOption
        ) -> Segmentation:
            return again(name, points, progress)[name]

        self._organs = {
            name: replace(organ, _again=partial(of_one, name)) for name, organ in organs.items()
        }
        self._first = first
        self._again: Callable[..., SegmentedOrgans] | None = again
        self.label_map = label_map
        """Has the image's geometry; label_value inside the first organ, one more inside each next."""

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_again": None}  # as that of each organ

    def __getitem__(self, name: str) -> Segmentation:
        return self._organs[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._organs)

    def __len__(self) -> int:
        return len(self._organs)

    def __repr__(self) -> str:
        return f"<SegmentedOrgans: {', '.join(self)}>"

    @property
    def labels(self) -> npt.NDArray[Any]:
        """The voxels of the label map as labels[k, j, i]."""
        return array_from_image(self.label_map)

    def corrected(
        self,
        name: str,
        *,
        inside: Points = (),
        outside: Points = (),
        boundary: Points = (),
        seeds: Seeds = (),
        progress: ProgressOption = None,
    ) -> SegmentedOrgans:
        """All organs with these points of one of them, besides those that they have already."""
        return self._with(name, constraints_of(inside, outside, boundary, seeds), progress)

    def answered(
        self, name: str, answers: Mapping[int, bool], progress: ProgressOption = None
    ) -> SegmentedOrgans:
        """All organs with answers to some of the questions of one of them, by their numbers, from 0 on."""
        return self._with(name, answers_of(self[name].questions, answers), progress)

    def _with(
        self, name: str, more: tuple[Constraint, ...], progress: ProgressOption
    ) -> SegmentedOrgans:
        return again_of(self._again)(name, self[name].constraints + more, progress)

    def label_of(self, name: str) -> int:
        """The value of an organ in the label map."""
        return self._first + list(self).index(name)


def segment_organs(
    image: AnyImage,
    organs: Mapping[str, Any],
    *,
    series: str | None = None,
    spacing: Sequence[float] | None = None,
    origin: Sequence[float] | None = None,
    direction: npt.ArrayLike | None = None,
    fixed: Sequence[AnySurface] = (),
    progress: ProgressOption = None,
    **parameters: Any,
) -> SegmentedOrgans:
    """Segments several organs together: their surfaces never meet, and no voxel is in two of them.

    Each organ is the others' background: its seed and inside points are outside points of all others.
    corrected() and answered() of the result add points of one organ.

    image, series, spacing, origin, direction, progress
        As for segment().
    organs
        By the name of each organ its seed sphere, (seed, radius) as for segment(); or, with points
        that correct it, a dict(seed=..., radius=..., inside=..., outside=..., boundary=...,
        seeds=...). Their order only numbers them in the label map.
    fixed
        Closed surfaces that stay as they are, such as earlier results, and that no organ meets.

    Raises SegmentationError if there is no segmentation, naming the organ, FileError if the file
    cannot be read, TypeError and ValueError for arguments that do not exist or are out of range.
    Issues a FlipFreeWarning if a result is doubtful.

    >>> import flipfree
    >>> phantom = flipfree.phantom("abdomen")
    >>> seeds = {organ.name.lower(): phantom.seeds[organ] for organ in (flipfree.Organ.LIVER, flipfree.Organ.SPLEEN)}
    >>> organs = flipfree.segment_organs(phantom.image, seeds)
    >>> organs, organs["liver"].self_intersections, organs.label_of("spleen")
    (<SegmentedOrgans: liver, spleen>, 0, 2)
    >>> corrected = organs.corrected("liver", outside=[(60, 83, 167)])
    >>> [len(corrected[name].constraints) for name in corrected]
    [1, 0]
    >>> flipfree.segment_organs(phantom.image, {"a": ((99.75, 83.75, 167), 28), "b": ((100, 84, 180), 9)})
    Traceback (most recent call last):
      ...
    flipfree.SegmentationError: No segmentation: the seeds of 'a' and 'b' overlap: ...
    """
    from ._segment import _image_of  # not in its type stub

    algorithm = GroupAlgorithm()
    set_parameters("segment_organs", algorithm.settings, GROUP_PARAMETERS, parameters)
    if not isinstance(organs, Mapping):
        raise TypeError(
            f"organs: a dict of seeds by names is needed, {{'liver': (seed, radius)}}, not {organs!r:.80}"
        )
    given = [_organ_of(str(name), organ) for name, organ in organs.items()]
    for surface in fixed:
        algorithm.add_fixed(surface)
    volume = _image_of(image, series, spacing, origin, direction, progress)

    def run(given: list[GivenOrgan], progress: ProgressOption) -> SegmentedOrgans:
        with progress_of(progress, "segmenting") as tell:
            found, label_map = algorithm.run(volume, given, tell)
        for organ, result in zip(given, found):
            require_boundary(result, organ.name)

        def again(
            name: str, points: tuple[Constraint, ...], progress: ProgressOption
        ) -> SegmentedOrgans:
            changed = [one._replace(points=points) if one.name == name else one for one in given]
            return run(changed, progress)

        results = {organ.name: result for organ, result in zip(given, found)}
        return SegmentedOrgans(results, label_map, algorithm.first_label(), again)

    return run(given, progress)


def _organ_of(name: str, organ: Any) -> GivenOrgan:
    """TypeError or ValueError names the organ that is wrong."""
    if not isinstance(organ, Mapping):
        try:
            seed, radius = organ
        except (TypeError, ValueError):
            raise TypeError(
                f"organs: '{name}' needs a pair of seed and radius, or a dict, not {organ!r:.80}"
            ) from None
        organ = {"seed": seed, "radius": radius}
    unknown = [key for key in organ if key not in KEYS]
    missing = [key for key in ("seed", "radius") if key not in organ]
    if unknown or missing:
        raise TypeError(
            f"organs: '{name}': "
            + (f"there is no key '{unknown[0]}'; " if unknown else f"'{missing[0]}' is missing; ")
            + (suggestion(str(unknown[0]), KEYS) if unknown else "")
            + f"its keys are {', '.join(KEYS)}"
        )
    points = constraints_of(*(organ.get(key, ()) for key in KEYS[2:]))
    center, radius = floats("seed", organ["seed"], 3), radius_of("radius", organ["radius"])
    return GivenOrgan(name, center, radius, points)


# Help and completion show the parameters as if they were spelled out above.
segment_organs.__doc__ = (
    f"{segment_organs.__doc__}\n    The other parameters:\n\n{described(GROUP_PARAMETERS)}\n"
)
_SIGNATURE = signature_with(segment_organs, GroupAlgorithm().settings, GROUP_PARAMETERS)
segment_organs.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
