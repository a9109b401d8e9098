"""The radii of seed spheres, which options and sessions give: one check and one text for all.

The toolkit's command has the same (SeedRadius.h); a test holds the two together.
"""

from __future__ import annotations

from ._backend import RADII


def is_seed_radius(radius: float) -> bool:
    """False for NaN, too.

    >>> is_seed_radius(28), is_seed_radius(0), is_seed_radius(float("nan"))
    (True, False, False)
    """
    return RADII[0] <= radius <= RADII[1]


def seed_radius_rule(radius: float) -> str:
    """What a message says of any other radius, after its name."""
    return (
        f"must be a positive number of millimeters, 1e-6 to 1e6, not {radius:g}. "
        "The sphere should lie within the organ"
    )
