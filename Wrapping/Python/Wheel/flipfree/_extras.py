"""Packages that only a part of this one needs, and what is said where they are missing."""

from __future__ import annotations

import importlib
from typing import Any

from ._errors import FileError, FlipFreeError

# What the extras of pyproject.toml bring.
PACKAGES = {
    "io": "SimpleITK",
    "plot": "matplotlib",
    "pyvista": "pyvista",
    "slicer": "slicer-core",
    "cohort": "SimpleITK matplotlib dask distributed pyarrow",
}


def needed(module: str, what: str, extra: str) -> Any:
    """Imports a module, or raises an error that says how to install it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise FlipFreeError(missing(module, what, extra, error)) from error


def missing(module: str, what: str, extra: str, error: ImportError) -> str:
    """The message: whether it is not installed, or why it cannot be loaded."""
    package = module.partition(".")[0]
    # VTK's is vtkmodules.
    if isinstance(error, ModuleNotFoundError) and (error.name or "").startswith(package):
        return f"{what} needs {package}, which is not installed: {remedy(extra)}"
    reason = " ".join(str(error).split())
    return f"{what} needs {package}, which is installed but cannot be loaded ({reason}): install it anew"


def remedy(extra: str) -> str:
    """How to install what an extra brings: from the source folder, since no package index has FlipFree."""
    return f"pip install '.[{extra}]' in FlipFree's source folder, or pip install {PACKAGES[extra]}"


# Without SimpleITK, for whoever wants to read.
ARRAY_INSTEAD = "; or give an array with spacing, origin and direction, or an image of nibabel"


def simpleitk(name: str, what: str = "an image file", instead: str = "") -> Any:
    """SimpleITK, which keeps its warnings to itself.

    `what` needs it, in the file or folder of that name; `instead` is what to do without it.
    """
    try:
        sitk = importlib.import_module("SimpleITK")
    except ImportError as error:
        raise FileError(
            f"'{name}': {missing('SimpleITK', what, 'io', error)}{instead}"
        ) from error
    sitk.ProcessObject.SetGlobalWarningDisplay(False)
    return sitk
