"""The types of arguments."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, Literal, Union

Preset = Literal["default", "published", "naive"]
Shape = Literal["sphere", "cube", "cup", "u-tube", "vessel", "abdomen"]
Progress = Callable[[float], Any]
ProgressOption = Union[Progress, bool, None]
PathName = Union[str, "os.PathLike[str]"]
