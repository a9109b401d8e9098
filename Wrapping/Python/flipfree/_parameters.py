"""The properties of a filter and of its stages as keyword arguments: SearchDistance is search_distance.

They are read from the wrapped classes, documentation included, so a new property is a keyword at once.
"""

from __future__ import annotations

import difflib
import inspect
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm


@dataclass(frozen=True)
class Parameter:
    """A property of a filter or of one of its stages: SetX, GetX and their documentation."""

    name: str
    property: str
    type: type
    documentation: str
    stage: str = ""
    """The method that hands out the stage; empty for the filter's own properties."""

    def get(self, algorithm: vtkAlgorithm) -> Any:
        """The present value."""
        return getattr(self._owner(algorithm), "Get" + self.property)()

    def set(self, algorithm: vtkAlgorithm, value: Any) -> None:
        """Sets it; raises TypeError or ValueError where VTK would silently take another value."""
        if self.type is bool and value not in (False, True):
            raise TypeError(f"{self.name}: True or False is needed, not {value!r}")
        try:
            getattr(self._owner(algorithm), "Set" + self.property)(value)
        except (TypeError, ValueError, OverflowError) as error:
            raise TypeError(f"{self.name}: {value!r} will not do; {_reason(error)}") from None
        if self.type in (int, float) and value == value and self.get(algorithm) != value:
            raise ValueError(
                f"{self.name}: {value!r} is out of range; the nearest is {self.get(algorithm)!r}"
            )

    def _owner(self, algorithm: vtkAlgorithm) -> Any:
        return getattr(algorithm, self.stage)() if self.stage else algorithm


def parameters_of(algorithm: vtkAlgorithm, without: Collection[str] = ()) -> dict[str, Parameter]:
    """Every property that a filter or one of its stages adds to its ancestors', by its Python name.

    The filter's own properties hide those of the same name of its stages.
    """
    parameters, stages = {}, {}
    for method in vars(type(algorithm)):
        property_name = method[3:]
        if method.startswith("Set") and hasattr(algorithm, "Get" + property_name):
            name = snake_case(property_name)
            value = getattr(algorithm, "Get" + property_name)()
            if isinstance(value, vtkAlgorithm):
                stages["Get" + property_name] = value
            elif name not in without:
                parameters[name] = _parameter(type(algorithm), name, property_name)
    for getter, stage in stages.items():
        for name, parameter in parameters_of(stage, without).items():
            parameters.setdefault(name, replace(parameter, stage=getter))
    return parameters


def set_parameters(
    caller: str,
    algorithm: vtkAlgorithm,
    parameters: Mapping[str, Parameter],
    values: Mapping[str, Any],
) -> None:
    """Sets the values, or raises an error that names the wrong one."""
    for name, value in values.items():
        if name not in parameters:
            raise TypeError(
                f"{caller}() has no parameter '{name}'; {_suggestion(name, parameters)}"
                f"help(flipfree.{caller}) lists them"
            )
        parameters[name].set(algorithm, value)


def signature_with(
    function: Any, algorithm: vtkAlgorithm, parameters: Mapping[str, Parameter]
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
    """So many numbers, or an error that says which argument needs them."""
    try:
        numbers = [float(value) for value in values]
    except (TypeError, ValueError):
        raise TypeError(f"{name}: {_numbers(count)} needed, not {values!r:.80}") from None
    if len(numbers) != count:
        raise ValueError(f"{name}: {_numbers(count)} needed, not {len(numbers)}")
    return numbers


def snake_case(name: str) -> str:
    """How Python spells the name of a property.

    >>> snake_case("MinimumComponentWeight")
    'minimum_component_weight'
    >>> snake_case("HD95")
    'hd95'
    """
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


def _numbers(count: int) -> str:
    return "a number is" if count == 1 else f"{count} numbers are"


def _parameter(algorithm_class: type, name: str, property_name: str) -> Parameter:
    text = getattr(algorithm_class, "Set" + property_name).__doc__
    signature, _, documentation = text.partition("\n\n")
    types = {"float": float, "int": int, "bool": bool, "str": str}
    found = re.search(r"\(self, \w+:(\w+)\) -> None", signature)
    kind = types.get(found.group(1), tuple) if found else tuple
    words = " ".join(documentation.split())
    return Parameter(name, property_name, kind, words)


def _annotation(parameter: Parameter) -> str:
    return "Sequence[float]" if parameter.type is tuple else parameter.type.__name__


def _suggestion(name: str, parameters: Mapping[str, Parameter]) -> str:
    near = difflib.get_close_matches(name, parameters, n=3)
    near = near or [other for other in parameters if len(name) > 3 and name in other]
    return f"did you mean {' or '.join(map(repr, near))}? " if near else ""


def _reason(error: Exception) -> str:
    """What VTK's wrapping says, without the name of the method."""
    return re.sub(r"^Set\w+ argument \d+: ", "", str(error))
