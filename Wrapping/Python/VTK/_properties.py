"""The properties of a filter and of its stages as parameters, read from the wrapped classes."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Any

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from ._parameters import Parameter, snake_case


@dataclass(frozen=True)
class Property(Parameter):
    """A property of a filter or of one of its stages: SetX, GetX and their documentation."""

    stage: str = ""
    """The method that hands out the stage; empty for the filter's own properties."""

    def get(self, algorithm: vtkAlgorithm) -> Any:
        return getattr(self._owner(algorithm), "Get" + self.property)()

    def assign(self, algorithm: vtkAlgorithm, value: Any) -> None:
        getattr(self._owner(algorithm), "Set" + self.property)(value)

    def _owner(self, algorithm: vtkAlgorithm) -> Any:
        return getattr(algorithm, self.stage)() if self.stage else algorithm


def properties_of(algorithm: vtkAlgorithm, without: Collection[str] = ()) -> dict[str, Property]:
    """Every property that a filter or one of its stages adds to VTK's ancestors, by its Python name.

    The filter's own properties hide those of the same name of its stages.
    """
    properties, stages = {}, {}
    ours = [c for c in type(algorithm).__mro__ if c.__module__.startswith(__package__)]
    for method in (name for c in reversed(ours) for name in vars(c)):
        property_name = method[3:]
        if method.startswith("Set") and hasattr(algorithm, "Get" + property_name):
            name = snake_case(property_name)
            value = getattr(algorithm, "Get" + property_name)()
            if isinstance(value, vtkAlgorithm):
                stages["Get" + property_name] = value
            elif name not in without:
                properties[name] = _property(type(algorithm), name, property_name)
    for getter, stage in stages.items():
        for name, found in properties_of(stage, without).items():
            properties.setdefault(name, replace(found, stage=getter))
    return properties


def _property(algorithm_class: type, name: str, property_name: str) -> Property:
    text = getattr(algorithm_class, "Set" + property_name).__doc__
    signature, _, documentation = text.partition("\n\n")
    types = {"float": float, "int": int, "bool": bool, "str": str}
    found = re.search(r"\(self, \w+:(\w+)\) -> None", signature)
    kind = types.get(found.group(1), tuple) if found else tuple
    words = " ".join(documentation.split())
    return Property(name, property_name, kind, words)


