"""A surface whose vertices found no boundary is not an organ's: one rule and one text for all.

The toolkit's command fails for the same reason.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._errors import SegmentationError
from ._messages import escaped, with_names

if TYPE_CHECKING:
    from ._segmentation import Segmentation


def require_boundary(organ: Segmentation, name: str = "") -> None:
    """Raises an error unless the organ's boundary was found; `name` is one of several organs."""
    if not organ.boundary_found:
        where = f"'{escaped(name)}': " if name else ""
        text = (
            f"No segmentation: {where}no boundary of the organ was found; check that the seed sphere "
            "lies within the organ, or raise {SearchDistance}."
        )
        raise SegmentationError(with_names(text, {"SearchDistance": "search_distance"}))


def require_vessel_boundary(vessel: Segmentation) -> None:
    """Raises an error unless the boundary of a vessel between points was found."""
    if not vessel.boundary_found:
        raise SegmentationError("no boundary of the vessel was found; place the points inside it")
