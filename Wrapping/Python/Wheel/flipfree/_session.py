"""Sessions that the page in the browser and --save-session save, as `flipfree segment --session` repeats them."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, TypeVar, get_args

from . import _kernels
from ._backend import SEGMENT_PARAMETERS, TRACE_PARAMETERS, VesselAlgorithm
from ._errors import FileError, FlipFreeError
from ._image import Image
from ._messages import listed
from ._options import is_label
from ._parameters import snake_case
from ._seed_radius import is_seed_radius, seed_radius_rule
from ._session_record import file_name_of
from ._types import Preset
from ._unreadable import unreadable

T = TypeVar("T")

# They change no surface.
IGNORED = {"keep_history", "label_value"}


@dataclass
class SessionOrgan:
    """An organ of a session: what `segment` takes; or a vessel, which has points."""

    name: str  # as it can stand in names of files
    title: str  # as it was given
    color: str
    parameters: dict[str, Any]
    seed: list[float] = field(default_factory=list)
    radius: float = 0.0
    preset: str = "default"
    corrections: dict[str, list[Any]] = field(default_factory=dict)
    points: list[list[float]] = field(default_factory=list)
    start_labels: str | None = None
    start_label: str = "1"


@dataclass
class Session:
    """The image by name and voxels, and the organs that have a seed."""

    file: str
    image: str
    size: list[int]
    spacing: list[float]
    origin: list[float]
    direction: list[float]
    organs: list[SessionOrgan]
    together: bool = False
    fixed: list[str] = field(default_factory=list)
    series: str = ""  # of an image that is a folder of DICOM files


def read_session(name: str) -> Session:
    """Raises FileError that says what is wrong in the file."""
    try:
        with open(name, encoding="utf-8") as file:
            content = json.load(file)
    except OSError as error:
        raise unreadable(name) from error
    except ValueError as error:
        raise FileError(
            f"'{name}' is not a session that the page or --save-session has saved: {error}. Save it again."
        ) from error
    try:
        if content["format"] != "flipfree-session" or content["version"] not in (1, 2):
            raise ValueError("it has another format or a newer version")
        return _session_of(name, content)
    except (KeyError, TypeError) as error:
        raise FileError(
            f"'{name}' is not a session that the page or --save-session has saved: {_reason(error)}. "
            "Save it again."
        ) from error
    except ValueError as error:
        raise FileError(
            f"'{name}' cannot be repeated: {error}. Open it in the page and save it again."
        ) from error


def _reason(error: Exception) -> str:
    """What is wrong in a file, in place of what Python says of it."""
    if isinstance(error, KeyError):
        return f"key {error} not found"
    return "a value is of another type than it has in a session"


def _session_of(name: str, content: dict[str, Any]) -> Session:
    entries = _each(content["organs"], "organ", _entry_of)
    organs = [organ for organ in entries if organ is not None]
    names = [organ.name for organ in organs]
    twice = next((one for one in names if names.count(one) > 1), None)
    if twice:
        raise ValueError(f"two organs have the name '{twice}'")
    if not organs:
        raise ValueError("no organ has a seed")
    image = content["image"]
    return Session(
        name,
        str(image["name"]),
        [int(count) for count in _numbers(image["size"], 3)],
        _numbers(image["spacing"], 3),
        _numbers(image["origin"], 3),
        _numbers(image["direction"], 9),
        organs,
        _together(content, organs),
        [str(one) for one in content.get("fixed", ())],
        str(image.get("series", "")),
    )


def _together(content: dict[str, Any], organs: list[SessionOrgan]) -> bool:
    together = bool(content.get("together", False))
    first = organs[0]
    for organ in organs if together else ():
        fits = organ.preset == first.preset and organ.parameters == first.parameters
        if not fits or organ.points or organ.start_labels is not None:
            raise ValueError(
                f"'{organ.title}': organs that were segmented together have a seed each, and the same "
                "parameters"
            )
    return together


def _each(entries: Iterable[Any], name: str, read: Callable[[Any], T]) -> list[T]:
    """What is wrong in an entry is said with its number."""
    found = []
    for number, entry in enumerate(entries, 1):
        try:
            found.append(read(entry))
        except (KeyError, TypeError, AttributeError) as error:
            raise ValueError(f"{name} {number}: {_reason(error)}") from error
        except (ValueError, FlipFreeError) as error:
            raise ValueError(f"{name} {number}: {error}") from error
    return found


def _entry_of(entry: dict[str, Any]) -> SessionOrgan | None:
    """None for organs that have not been given a seed yet, and vessels without enough points."""
    # Organs of version 1 have neither a kind nor corrections.
    kind = entry.get("kind", "organ")
    if kind not in ("organ", "vessel"):
        raise ValueError(f"the kind is '{kind}'; it can be organ or vessel")
    if kind == "vessel":
        if len(entry["points"]) < 2:
            return None
    elif entry["seed"] is None and "startLabels" not in entry:
        return None
    name = file_name_of(entry["name"])
    try:
        return (_vessel_of if kind == "vessel" else _organ_of)(name, entry)
    except (ValueError, FlipFreeError) as error:
        raise ValueError(f"'{entry['name']}': {error}") from error


def _vessel_of(name: str, entry: dict[str, Any]) -> SessionOrgan:
    known = {one.property: one for one in TRACE_PARAMETERS.values() if one.name not in IGNORED}
    settings = VesselAlgorithm().settings
    parameters = {}
    for key, value in entry["parameters"].items():
        title = key[:1].upper() + key[1:]
        if title not in known:
            raise ValueError(
                f"there is no parameter '{title}' of a vessel; there are {listed(known)}"
            )
        try:
            known[title].set(settings, value)
        except (TypeError, ValueError) as error:
            raise ValueError(f"the parameter '{title}' is out of its range") from error
        parameters[known[title].name] = value
    points = _each(entry["points"], "point", lambda point: _numbers(point, 3))
    return SessionOrgan(
        name,
        entry["name"],
        str(entry.get("color", "")),
        parameters,
        corrections=_corrections_of(entry, ("inside", "outside", "boundary")),
        points=points,
    )


def _organ_of(name: str, entry: dict[str, Any]) -> SessionOrgan:
    parameters = {}
    for key, value in entry["parameters"].items():
        keyword = snake_case(key)
        if keyword not in SEGMENT_PARAMETERS:
            raise ValueError(f"there is no parameter '{key}'")
        if keyword not in IGNORED:
            parameters[keyword] = value
    if entry["preset"] not in get_args(Preset):
        raise ValueError(f"there is no preset '{entry['preset']}'")
    if entry.get("startSurface"):
        raise ValueError("it began with a surface, which a session does not hold")
    kinds = ("inside", "outside", "boundary", "seeds")
    organ = SessionOrgan(
        name,
        entry["name"],
        str(entry.get("color", "")),
        parameters,
        preset=entry["preset"],
        corrections=_corrections_of(entry, kinds),
    )
    if "startLabels" in entry:
        organ.start_labels = str(entry["startLabels"]["name"])
        organ.start_label = str(entry["startLabels"]["label"])
        if not is_label(organ.start_label):
            raise ValueError("the label of its start is negative, or empty")
    else:
        organ.seed = _numbers(entry["seed"]["center"], 3)
        organ.radius = float(entry["seed"]["radius"])
        if not is_seed_radius(organ.radius):
            raise ValueError(f"the radius {seed_radius_rule(organ.radius)}")
    return organ


def _corrections_of(entry: dict[str, Any], kinds: tuple[str, ...]) -> dict[str, list[Any]]:
    corrections: dict[str, list[Any]] = {kind: [] for kind in kinds}
    for kind, point in _each(entry.get("corrections", ()), "correction", _correction_of):
        if kind not in corrections:
            raise ValueError("a seed is of no use to a vessel")
        corrections[kind].append(point)
    return corrections


def _correction_of(entry: dict[str, Any]) -> tuple[str, Any]:
    """The argument of segment(), and what it takes."""
    kind, place = entry["kind"], _numbers(entry["position"], 3)
    if kind == "seed":
        radius = float(entry["radius"])
        if not radius > 0:
            raise ValueError("a seed has no radius")
        return "seeds", (place, radius)
    if kind not in ("outside", "inside", "boundary"):
        raise ValueError(f"the kind is '{kind}'; it can be outside, inside, boundary or seed")
    return kind, place


def _numbers(values: Any, count: int) -> list[float]:
    numbers = [float(value) for value in values]
    if len(numbers) != count or not all(map(math.isfinite, numbers)):
        raise ValueError(f"{values} are not {count} finite numbers")
    return numbers


def image_beside(session: Session) -> str:
    """Where the session's image should be: beside the session."""
    path = os.path.join(os.path.dirname(session.file), session.image)
    if not session.image or not os.path.exists(path):
        raise FileError(
            f"The image '{session.image}' is not beside '{session.file}'. Give it, too: flipfree segment "
            f"IMAGE --session '{session.file}'."
        )
    return path


def file_beside(session: Session, name: str, what: str) -> str:
    """The same of another file of the session; `what` is it."""
    path = os.path.join(os.path.dirname(session.file), os.path.basename(name))
    if not name or not os.path.exists(path):
        raise FileError(f"{what} '{name}' is not beside '{session.file}'. Copy the file there.")
    return path


def require_image_of(session: Session, name: str, image: Image) -> None:
    """Voxels in the same places, up to a tenth of the least spacing; in whichever order."""
    wanted = session.size, session.spacing, session.origin, session.direction
    found = image.voxels.shape[::-1], image.spacing, image.origin, image.direction
    if not _kernels.have_same_places(wanted, found):
        raise FlipFreeError(
            f"'{name}' is not the image of '{session.file}', which is '{session.image}' of "
            f"{' x '.join(map(str, session.size))} voxels: its voxels are elsewhere. Give that image."
        )


def runs_of(session: Session, values: dict[str, Any], outputs: list[str]) -> list[dict[str, Any]]:
    """The command's values for each organ; its options come after the session's parameters."""
    runs = []
    for index, organ in enumerate(session.organs):
        label = values.get("label_value", 1) + index
        if label > 255:
            raise FlipFreeError(
                f"'{session.file}': labels go up to 255. Remove organs, or leave out --label-value."
            )
        run: dict[str, Any] = {**({} if organ.points else organ.parameters), **values}
        run.update(repeated=organ, label_value=label)
        if not organ.points:
            run["preset"] = organ.preset
        if organ.start_labels is not None:
            what = f"{organ.title}: the label map of its start"
            run["start_labels"] = file_beside(session, organ.start_labels, what)
            run["start_label"] = organ.start_label
        elif not organ.points:
            run.update(seed=[organ.seed], radius=[organ.radius])
        if len(session.organs) > 1:
            run["organ"] = organ.name
            run.update({name: name_for(organ.name, run[name]) for name in outputs if name in run})
        runs.append(run)
    return runs


def name_for(organ: str, path: str) -> str:
    """out-liver.vtp for out.vtp."""
    folder, name = os.path.split(path)
    stem, dot, ending = name[1:].partition(".")
    return os.path.join(folder, f"{name[:1]}{stem}-{organ}{dot}{ending}")
