"""The fields of the kernels' settings as parameters."""

from __future__ import annotations

import math
import operator
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ._documentation import PROPERTIES
from ._parameters import Parameter, floats, snake_case

TYPES: Mapping[str, type] = {"bool": bool, "int": int, "float": float}


@dataclass(frozen=True)
class Setting(Parameter):
    """A number, or several, of the settings; the kernels keep each in its range."""

    kind: type
    """Of each of its numbers."""

    count: int = 1

    def get(self, algorithm: Any) -> Any:
        values = tuple(self.kind(value) for value in algorithm.get(self.property))
        return values if self.count > 1 else values[0]

    def assign(self, algorithm: Any, value: Any) -> None:
        values = floats(self.name, value, self.count) if self.count > 1 else [_number(self, value)]
        algorithm.set(self.property, values)


def _number(setting: Setting, value: Any) -> float:
    if setting.kind is int and isinstance(value, float):
        raise TypeError("integer argument expected, got float")
    if setting.kind is int:
        return float(operator.index(value))
    return math.ldexp(value, 0)  # refuses what is not a number, text that looks like one included


def settings_of(
    settings: Any, filters: Sequence[str], without: Collection[str] = ()
) -> dict[str, Parameter]:
    """The parameters of a class of settings, in the order of the filters' properties.

    Of several filters that have a property, the first one documents it.
    """
    known = {name: (TYPES[kind], count) for name, kind, count in settings.parameters()}
    parameters: dict[str, Parameter] = {}
    for name, text in (item for header in filters for item in PROPERTIES[header].items()):
        if name in known and name not in without and snake_case(name) not in parameters:
            kind, count = known[name]
            parameters[snake_case(name)] = Setting(
                snake_case(name), name, tuple if count > 1 else kind, text, kind, count
            )
    return parameters
