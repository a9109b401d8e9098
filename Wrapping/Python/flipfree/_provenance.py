"""What a result says of its image, apart from the voxels."""

from __future__ import annotations

import json


def with_series(provenance: str, series: str) -> str:
    """The provenance of a result from a DICOM series; as it is where there was none.

    >>> with_series('{"image":{"name":""}}', "1.2.3#2")
    '{"image":{"name":"","series":"1.2.3#2"}}'
    """
    if not series:
        return provenance
    session = json.loads(provenance)
    session["image"]["series"] = series
    return json.dumps(session, ensure_ascii=False, separators=(",", ":"))
