"""The types of arguments."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, Union

from vtkmodules.vtkCommonDataModel import vtkImageData

Preset = Literal["default", "published", "naive"]
Progress = Callable[[float], Any]
ProgressOption = Union[Progress, bool, None]
PathName = Union[str, "os.PathLike[str]"]

if TYPE_CHECKING:  # numpy need not be there
    import numpy.typing as npt

    Image = Union[vtkImageData, npt.NDArray[Any], PathName]
