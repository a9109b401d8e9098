"""Packages that only a part of this one needs, and what is said where they are missing."""

from __future__ import annotations

import importlib
from typing import Any

from ._errors import FileError, FlipFreeError


def needed(module: str, what: str, extra: str) -> Any:
    """Imports a module, or raises an error that says how to install it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise FlipFreeError(missing(module, what, extra)) from error


def missing(module: str, what: str, extra: str) -> str:
    """The message."""
    package = module.partition(".")[0]
    return f"{what} needs {package}, which is not installed: pip install 'flipfree[{extra}]'"


def simpleitk(name: str) -> Any:
    """SimpleITK, which keeps its warnings to itself."""
    try:
        sitk = importlib.import_module("SimpleITK")
    except ImportError as error:
        raise FileError(
            f"'{name}': {missing('SimpleITK', 'an image file', 'io')}; or give an array with spacing, "
            "origin and direction, or an image of nibabel"
        ) from error
    sitk.ProcessObject.SetGlobalWarningDisplay(False)
    return sitk
