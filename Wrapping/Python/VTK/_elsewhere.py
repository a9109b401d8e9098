"""What only the package that pip installs has."""

from __future__ import annotations

from typing import NoReturn


def __getattr__(name: str) -> NoReturn:  # what the package is asked for and does not have
    missing = f"module 'flipfree' has no attribute '{name}'"
    if name in ("cohort", "Cohort"):
        missing += (
            " here: it is part of the package that pip installs. Run pip install '.[cohort]' in the source "
            "folder, in a virtual environment, and use its Python"
        )
    raise AttributeError(missing)
