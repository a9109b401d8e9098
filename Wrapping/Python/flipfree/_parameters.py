"""Parameters as keyword arguments: the property SearchDistance is search_distance.

The backend reads them where they are defined, documentation included: a new one is a keyword at once.
"""

from __future__ import annotations

import difflib
import inspect
import math
import operator
import re
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Parameter:
    """A property of an algorithm; the backend knows how to get and to assign it."""

    name: str
    property: str
    type: type
    documentation: str

    def get(self, algorithm: Any) -> Any:
        """The present value."""
        raise NotImplementedError

    def assign(self, algorithm: Any, value: Any) -> None:
        """Sets the value, or the nearest in its range; raises TypeError for another type."""
        raise NotImplementedError

    def set(self, algorithm: Any, value: Any) -> None:
        """Sets it; raises TypeError or ValueError where another value would silently be taken."""
        if self.type is bool and value not in (False, True):
            raise TypeError(f"{self.name}: True or False is needed, not {value!r}")
        _require_number(self, value)
        try:
            self.assign(algorithm, value)
        except (TypeError, ValueError, OverflowError) as error:
            raise TypeError(f"{self.name}: {value!r} is not accepted; {_reason(error)}") from None
        if self.type in (int, float) and value == value and self.get(algorithm) != value:
            raise ValueError(
                f"{self.name}: {value!r} is out of range; give {self._range(algorithm)}"
            )

    def limits(self, algorithm: Any) -> tuple[float, float | None]:
        """The least and, if there is one, the greatest value, by what is taken in place of numbers that
        no range has; for a number, whose value is lost."""
        most = 2**31 - 1 if self.type is int else sys.float_info.max
        self.assign(algorithm, -most)
        least = self.get(algorithm)
        self.assign(algorithm, most)
        greatest = self.get(algorithm)
        return least, None if greatest == most else greatest

    def _range(self, algorithm: Any) -> str:
        """In words."""
        least, greatest = self.limits(algorithm)
        return f"{least:g} or more" if greatest is None else f"{least:g} to {greatest:g}"


# What messages call the arguments of segment() that are no parameters.
ARGUMENTS: Mapping[str, str] = {
    "SeedCenter": "seed",
    "SeedRadius": "radius",
    "StartLabel": "start_label",
    "AddInsidePoint": "inside",
    "AddOutsidePoint": "outside",
}


def of_several_organs(parameters: Mapping[str, Parameter]) -> dict[str, Parameter]:
    """Those of segment() that segment_organs() has, too: a history is of one organ."""
    return {name: one for name, one in parameters.items() if name != "keep_history"}


def set_parameters(
    caller: str,
    algorithm: Any,
    parameters: Mapping[str, Parameter],
    values: Mapping[str, Any],
) -> None:
    """Sets the values, or raises an error that names the wrong one."""
    for name, value in values.items():
        if name not in parameters:
            raise TypeError(
                f"{caller}() has no parameter '{name}'; {suggestion(name, parameters)}"
                f"help(flipfree.{caller}) lists them"
            )
        parameters[name].set(algorithm, value)


def signature_with(
    function: Any, algorithm: Any, parameters: Mapping[str, Parameter]
) -> inspect.Signature:
    """The function's signature with its **parameters spelled out, defaults included."""
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
    spelled = [
        inspect.Parameter(
            parameter.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=parameter.get(algorithm),
            annotation=_annotation(parameter),
        )
        for parameter in parameters.values()
    ]
    return signature.replace(parameters=own + spelled)


def described(parameters: Mapping[str, Parameter]) -> str:
    """The parameters and what they do, as a part of a docstring."""
    return "\n".join(
        f"    {parameter.name}\n        {parameter.documentation}"
        for parameter in parameters.values()
    )


def names_of(parameters: Mapping[str, Parameter]) -> dict[str, str]:
    """What Python calls the properties."""
    return {parameter.property: name for name, parameter in parameters.items()}


def floats(name: str, values: Any, count: int) -> list[float]:
    """`count` numbers, or an error that says which argument needs them."""
    try:
        given = list(values)
        if any(isinstance(value, (str, bytes)) for value in (values, *given)):
            raise TypeError  # text that looks like a number is none
        numbers = [float(value) for value in given]
    except (TypeError, ValueError):
        wrong = values[0] if count == 1 else values
        raise TypeError(f"{name}: {_numbers(count)} needed, not {wrong!r:.80}") from None
    if len(numbers) != count:
        raise ValueError(f"{name}: {_numbers(count)} needed, not {len(numbers)}")
    return numbers


def radius_of(name: str, value: Any) -> float:
    """The radius of a seed sphere, or an error that says which argument needs it.

    >>> radius_of("radius", float("nan"))
    Traceback (most recent call last):
      ...
    ValueError: radius: nan is not a number (NaN); give the radius of a sphere within the organ, in mm
    """
    radius = floats(name, [value], 1)[0]
    if math.isnan(radius):
        raise ValueError(
            f"{name}: nan is not a number (NaN); give the radius of a sphere within the organ, in mm"
        )
    if radius <= 0:
        raise ValueError(
            f"{name}: {value!r} is not positive; give the radius of a sphere within the organ, in mm"
        )
    return radius


def snake_case(name: str) -> str:
    """How Python spells the name of a property.

    >>> snake_case("MinimumComponentWeight")
    'minimum_component_weight'
    >>> snake_case("HD95")
    'hd95'
    """
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


def _require_number(parameter: Parameter, value: Any) -> None:
    try:
        if parameter.type is int:
            operator.index(value)
        elif parameter.type is float:
            math.isnan(value)  # text that looks like a number is none
    except TypeError:
        needed = "a whole number" if parameter.type is int else "a number"
        raise TypeError(f"{parameter.name}: {needed} is needed, not {value!r:.80}") from None
    except OverflowError:
        pass  # an integer beyond all ranges


def _numbers(count: int) -> str:
    return "a number is" if count == 1 else f"{count} numbers are"


def _annotation(parameter: Parameter) -> str:
    return "Sequence[float]" if parameter.type is tuple else parameter.type.__name__


def suggestion(name: str, parameters: Iterable[str]) -> str:
    """What may have been meant, if anything."""
    parameters = list(parameters)
    near = difflib.get_close_matches(name, parameters, n=3)
    near = near or [other for other in parameters if len(name) > 3 and name in other]
    return f"did you mean {' or '.join(map(repr, near))}? " if near else ""


def _reason(error: Exception) -> str:
    """What VTK's wrapping says, without the name of the method."""
    return re.sub(r"^Set\w+ argument \d+: ", "", str(error))
