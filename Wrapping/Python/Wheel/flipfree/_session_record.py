"""Where results come from: the session that travels with a surface, with the names of files and organs.

The toolkit's command does the same (SessionRecord.cxx); a test holds the two together.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass
class OriginNames:
    """Names that a surface's own text leaves open; an empty one stays open."""

    image: str = ""
    series: str = ""
    start_labels: str = ""
    start_label: str = ""
    fixed: Sequence[str] = ()
    organs: Sequence[str] = ()
    colors: Sequence[str] = ()


def named(provenance: str, names: OriginNames) -> str:
    """With the names, of files without their folders."""
    session = json.loads(provenance)
    _fill(session["image"], "name", _name_in(names.image))
    _fill(session["image"], "series", names.series)
    for organ, name, color in zip(session["organs"], names.organs, names.colors):
        _fill(organ, "name", name)
        _fill(organ, "color", color)
    for organ in session["organs"]:
        if "startLabels" in organ:
            start = organ["startLabels"]
            _fill(start, "name", _name_in(names.start_labels))
            # A name stays one: in other layers of the file, its value means other segments.
            if names.start_label not in ("", str(start["label"])):
                start["label"] = names.start_label
    if names.fixed:
        session["fixed"] = [_name_in(name) for name in names.fixed]
    return json.dumps(session, ensure_ascii=False, separators=(",", ":"))


def session_text(sessions: Sequence[str]) -> str:
    """The sessions, one for each organ or one for all, as one."""
    first, *more = (json.loads(text) for text in sessions)
    if not first.get("together"):
        for session in more:
            first["organs"] += session["organs"]
    return json.dumps(first, ensure_ascii=False, indent=2) + "\n"


def organ_of_file(path: str) -> str:
    """The name of an organ that has none, after a file: liver for out/liver.vtp."""
    name = _name_in(path)
    return name[:1] + name[1:].partition(".")[0]


def file_name_of(organ: str) -> str:
    """An organ's name as it can stand in names of files: letters, digits and dashes.

    >>> file_name_of("left/lobe 2"), file_name_of("Müller")
    ('left-lobe-2', 'Müller')
    """
    return re.sub(r"[\0-\x7f]", lambda letter: letter[0] if letter[0].isalnum() else "-", organ)


def _name_in(path: str) -> str:
    return os.path.basename(path.rstrip("/")) if path else ""


def _fill(entry: dict[str, Any], key: str, name: str) -> None:
    if name:
        entry[key] = name
