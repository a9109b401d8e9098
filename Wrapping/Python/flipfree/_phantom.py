"""Synthetic volumes with known organs."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, get_args

from ._backend import PHANTOM_PARAMETERS, PhantomAlgorithm
from ._parameters import described, set_parameters, signature_with
from ._types import Shape

if TYPE_CHECKING:
    from collections.abc import Sequence as Sequence  # of the parameters spelled out

    from ._images import Image

SHAPES = get_args(Shape)


class Organ(IntEnum):
    """The labels of the abdomen; the one object of every other phantom has the label 1."""

    SPLEEN = 1
    RIGHT_KIDNEY = 2
    LEFT_KIDNEY = 3
    GALLBLADDER = 4
    ESOPHAGUS = 5
    LIVER = 6
    STOMACH = 7
    AORTA = 8
    VENA_CAVA = 9
    PORTAL_VEIN = 10
    PANCREAS = 11


@dataclass(frozen=True, repr=False)
class Phantom:
    """A volume and the truth about it."""

    image: Image
    label_map: Image
    seeds: dict[int, tuple[tuple[float, float, float], float]]
    """By label, the center (mm) and the radius (mm) of a ball deep inside the organ."""

    ends: tuple[tuple[float, float, float], ...] = ()
    """Of the vessel, the points (mm) between which trace() finds it."""


def phantom(shape: Shape = "abdomen", **parameters: Any) -> Phantom:
    """Makes a volume in which the organs are known.

    The shapes are 'sphere', 'cube', 'cup', 'u-tube' and 'vessel', and 'abdomen', a schematic
    contrast-enhanced CT.

    >>> import flipfree
    >>> ball = flipfree.phantom("sphere")
    >>> center, radius = ball.seeds[1]
    >>> organ = flipfree.segment(ball.image, center, radius)
    >>> flipfree.evaluate(organ, ball.label_map).dice > 0.97
    True
    """
    if shape not in SHAPES:
        raise ValueError(f"shape: {shape!r} does not exist; there are {', '.join(SHAPES)}")
    algorithm = PhantomAlgorithm(SHAPES.index(shape))
    set_parameters("phantom", algorithm.settings, PHANTOM_PARAMETERS, parameters)
    return Phantom(*algorithm.run())


# Help and completion show the parameters as if they were spelled out above.
_PARAMETERS = described(PHANTOM_PARAMETERS)
phantom.__doc__ = f"{phantom.__doc__}\n    The other parameters:\n\n{_PARAMETERS}\n"
_SIGNATURE = signature_with(phantom, PhantomAlgorithm(0).settings, PHANTOM_PARAMETERS)
phantom.__signature__ = _SIGNATURE  # type: ignore[attr-defined]
