"""What the subcommands do."""

from __future__ import annotations

import contextlib
import math
import os
import re
import sys
import time
from collections.abc import Callable, Iterable
from dataclasses import asdict, replace
from functools import partial
from typing import Any, get_args

from ._atomic import replacing, write_table
from ._backend import (
    GROUP_PARAMETERS,
    SEGMENT_PARAMETERS,
    TRACE_PARAMETERS,
    VesselAlgorithm,
    set_threads,
    surface_validity,
)
from ._corrections import BOUNDARY, INSIDE, OUTSIDE, SEED, Constraint, constraints_of
from ._errors import FileError, FlipFreeError
from ._evaluate import evaluate as evaluate_segmentation
from ._files import WRITE_ENDINGS, read_image, write_image
from ._messages import confidence_text, warn
from ._options import WrongUsage
from ._phantom import Organ
from ._phantom import phantom as make_phantom
from ._point_files import ENDINGS as POINT_ENDINGS
from ._point_files import arguments_of, read_points, write_points
from ._segment import default_parameters
from ._segment import segment as segment_organ
from ._segmentation import Segmentation, Vessel
from ._segment_organs import segment_organs
from ._session import (
    Session,
    SessionOrgan,
    file_beside,
    image_beside,
    name_for,
    read_session,
    require_image_of,
    runs_of,
)
from ._session_record import OriginNames, named, organ_of_file, session_text
from ._surface_files import ENDINGS, read_surface, write_centerline, write_surface
from ._trace import trace as trace_vessel
from ._types import Shape

# Columns of the toolkit's table that are not their field's name with a capital letter.
COLUMNS = {"asd": "ASD", "rms": "RMS", "hd95": "HD95", "hd": "HD"}
OUTPUTS = {
    "output": ENDINGS,
    "labels": WRITE_ENDINGS,
    "convergence": (".csv",),
    "snapshot": (".png",),
    "save_session": (".json",),
    "save_points": POINT_ENDINGS,
}
# Of all organs of a session, one each.
SHARED = ("labels", "save_session")
# Of vessels, in the order of the options.
TRACE_OUTPUTS = {
    "output": ENDINGS,
    "labels": WRITE_ENDINGS,
    "centerline": (".vtp",),
    "convergence": (".csv",),
    "snapshot": (".png",),
    "save_session": (".json",),
    "save_points": POINT_ENDINGS,
}


def segment(values: dict[str, Any]) -> None:
    """`flipfree segment`."""
    progress = _wants_bar(values)
    if {"organ", "fixed"} & values.keys():
        _segment_group(values, _organs_of(values), {}, None, progress)
        return
    session = _session_of(values)
    runs = [values]
    if session:
        values = {"input": image_beside(session) if "input" not in values else None, **values}
        if session.together:
            _segment_together(session, values, progress)
            return
        runs = runs_of(session, values, [name for name in OUTPUTS if name not in SHARED])
    for run in runs:
        _require_sense(run, {name: run[name] for name in OUTPUTS if name in run})
    points = [] if session else _points_of(values)  # a session's organs have their own
    set_threads(values.get("threads", 0))
    start = time.perf_counter()
    image = read_image(values["input"], series=values.get("series"), progress=progress)
    reading = time.perf_counter() - start
    if session:
        require_image_of(session, values["input"], image)
    with contextlib.ExitStack() as files:  # either all files or none
        said = [_segment_one(run, image, points, files, progress) for run in runs]
        if "labels" in values:
            names = [_names_of(run) for run in runs]
            label = values.get("label_value", 1)
            titles = {label + index: one.organs[0] for index, one in enumerate(names)}
            colors = {label + index: one.colors[0] for index, one in enumerate(names)}
            _write_to(
                files,
                values["labels"],
                lambda name: write_image(_label_map(said), name, names=titles, colors=colors),
            )
        if "save_session" in values:
            sessions = [
                named(organ.provenance, _names_of(run)) for run, (organ, _) in zip(runs, said)
            ]
            _write_to(files, values["save_session"], partial(_write_text, session_text(sessions)))
    for run, (organ, working) in zip(runs, said):
        _report(run, organ, reading, working)


def _segment_together(session: Session, values: dict[str, Any], progress: bool) -> None:
    """`flipfree segment --session` of organs that were segmented together."""
    first = session.organs[0]
    organs = {
        organ.title: {"seed": organ.seed, "radius": organ.radius, **organ.corrections}
        for organ in session.organs
    }
    fixed = [file_beside(session, name, "The fixed surface") for name in session.fixed]
    colors = {organ.title: organ.color for organ in session.organs}
    values = {"preset": first.preset, **first.parameters, **values, "fixed": fixed}
    _segment_group(values, organs, colors, session, progress)


def _segment_group(
    values: dict[str, Any],
    organs: dict[str, dict[str, Any]],
    colors: dict[str, str],
    session: Session | None,
    progress: bool,
) -> None:
    """`flipfree segment --organ`."""
    outputs = {}
    for organ in organs:
        for name in OUTPUTS.keys() & values.keys() - set(SHARED):
            outputs[organ, name] = name_for(_file_name(organ), values[name])
    given = {name: values[name] for name in OUTPUTS if name in values}
    _require_outputs(given)
    shared = {name: path for name, path in given.items() if name in SHARED}
    for path in (*outputs.values(), *shared.values()):
        _require_place(path, [values["input"], *values.get("fixed", ())])
    _require_files(values, shared)
    names = OriginNames(
        values["input"],
        fixed=values.get("fixed", ()),
        organs=list(organs),
        colors=[colors.get(name, "") for name in organs],
    )
    parameters = {**default_parameters(values.get("preset", "default")), **values}
    set_threads(values.get("threads", 0))
    start = time.perf_counter()
    fixed = [read_surface(name) for name in values.get("fixed", ())]
    image = read_image(values["input"], series=values.get("series"), progress=progress)
    reading = time.perf_counter() - start
    if session:
        require_image_of(session, values["input"], image)
    try:
        found = segment_organs(
            image,
            organs,
            fixed=fixed,
            progress=progress or None,
            **{name: value for name, value in parameters.items() if name in GROUP_PARAMETERS},
        )
    except FlipFreeError as error:
        raise type(error)(f"'{values['input']}': {error}") from error
    working = time.perf_counter() - start - reading
    with contextlib.ExitStack() as files:  # either all files or none
        for organ, result in found.items():
            if result.stop_reason == "no boundary found":
                raise FlipFreeError(
                    f"'{values['input']}', {organ}: no boundary of the organ was found, so nothing is "
                    "written."
                )
        for (name, output), path in outputs.items():
            _write_to(files, path, partial(_write, output, found[name], image, names))
        if "labels" in values:
            shades = {found.label_of(name): color for name, color in colors.items()}
            _write_to(
                files,
                values["labels"],
                lambda name: write_image(found.label_map, name, colors=shades),
            )
        if "save_session" in values:
            text = session_text([named(next(iter(found.values())).provenance, names)])
            _write_to(files, values["save_session"], partial(_write_text, text))
    if "quiet" not in values:
        for organ, result in found.items():
            print(
                f"{values['input']}, {organ}: label {found.label_of(organ)}, volume {result.volume:.1f} "
                f"ml, {len(result.iterations['Iteration'])} iterations, {result.stop_reason}, "
                f"{result.self_intersections} self-intersections, "
                f"confidence {confidence_text(result.confidence)}"
            )
        print(
            f"{values['input']}: organs do not meet; reading {reading:.2f} s, segmenting "
            f"{working:.2f} s"
        )


def _organs_of(values: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Seeds and points by the names of the organs; points belong to the organ before them."""
    if "organ" not in values:
        raise WrongUsage("--fixed is for organs that are given by --organ. Give one or more")
    if {"seed", "seed_voxel", "radius", "session", "start_labels"} & values.keys():
        raise WrongUsage(
            "--organ has the seed. Leave out --seed, --seed-voxel, --radius, --session and "
            "--start-labels"
        )
    if {"points", "save_points"} & values.keys():
        raise WrongUsage(
            "--points and --save-points are for one organ. Give the points of several by --inside, "
            "--outside and --boundary, after the organ that they belong to"
        )
    if "input" not in values:
        raise WrongUsage("INPUT is required: a volume, or a folder of a DICOM series")
    for name in values.get("fixed", ()):
        _require_ending("--fixed", name, ENDINGS)
    organs: dict[str, dict[str, Any]] = {}
    files: dict[str, str] = {}
    for option, given in values["order"]:
        if option == "organ":
            name, *numbers = given
            if not name:
                raise WrongUsage("--organ: a name is empty. Give each organ one of its own")
            other = files.setdefault(_file_name(name), name)
            if name in organs or other != name:
                raise WrongUsage(
                    f"--organ: '{other}' and '{name}' are the same in names of files. Give each organ "
                    "a name of its own"
                )
            x, y, z, radius = (_number_of(name, text) for text in numbers)
            if radius <= 0:
                raise WrongUsage(
                    f"--organ {name}: the radius must be a positive number of millimeters. The sphere "
                    "should lie within the organ"
                )
            organs[name] = {"seed": _lps(values, [x, y, z]), "radius": radius}
        elif option in ("inside", "outside", "boundary"):
            if not organs:
                raise WrongUsage(
                    f"--{option}: the point comes before the first --organ. Give it after its own organ"
                )
            points = organs[next(reversed(organs))].setdefault(option, [])
            points.append(_lps(values, given))
    return organs


def _number_of(organ: str, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise WrongUsage(
            f"--organ {organ}: '{text}' is not a finite number. Give a name, the seed's center, and "
            "its radius: NAME X Y Z MM"
        )
    return number


def _file_name(organ: str) -> str:
    """As it can stand in names of files."""
    return "".join(c if c.isalnum() or not c.isascii() else "-" for c in organ)


def _session_of(values: dict[str, Any]) -> Session | None:
    """The session of the command line; checks that there is one, or else an image and a seed."""
    if "session" not in values:
        if "input" not in values:
            raise WrongUsage("INPUT is required: a volume, or a folder of a DICOM series")
        if "start_labels" in values:
            if {"seed", "seed_voxel", "radius"} & values.keys():
                raise WrongUsage(
                    "--start-labels takes the place of the seed. Leave out --seed, --seed-voxel and "
                    "--radius; points correct the result"
                )
            return None
        if not all(1e-6 <= radius <= 1e6 for radius in values.get("radius", [0])):
            raise WrongUsage(
                "--radius must be a positive number of millimeters, 1e-6 to 1e6. The sphere should lie "
                "within the organ"
            )
        return None
    if "start_labels" in values:
        raise WrongUsage("--session has the seed. Leave out --start-labels")
    given = {"seed", "seed_voxel", "radius"} & values.keys()
    if given or values.get("preset", "default") != "default":
        raise WrongUsage(
            "--session has the seed and the preset. Leave out --seed, --seed-voxel, --radius and "
            "--preset"
        )
    if {"inside", "outside", "boundary", "points", "save_points", "ras"} & values.keys():
        raise WrongUsage(
            "--session cannot be corrected by points. Give the image, --seed and --radius in its place"
        )
    return read_session(values["session"])


def _title_of(values: dict[str, Any], quote: str = "'") -> str:
    """How messages call what is segmented."""
    organ = f", {values['organ']}" if "organ" in values else ""
    return f"{quote}{values['input']}{quote}{organ}"


def _segment_one(
    values: dict[str, Any],
    image: Any,
    points: list[Constraint],
    files: contextlib.ExitStack,
    progress: bool,
) -> tuple[Segmentation, float]:
    """What was found and in how many seconds; its own files are written."""
    start = time.perf_counter()
    title = _title_of(values)
    repeated: SessionOrgan | None = values.get("repeated")
    organ: Segmentation
    try:
        if repeated and repeated.points:
            given: dict[str, Any] = {**repeated.corrections, **repeated.parameters}
            given["label_value"] = values["label_value"]
            organ = trace_vessel(image, repeated.points, progress=progress or None, **given)
        else:
            organ = segment_organ(
                image,
                **_start_of(values, image, points),
                preset=values.get("preset", "default"),
                progress=progress or None,
                **{name: value for name, value in values.items() if name in SEGMENT_PARAMETERS},
            )
    except FlipFreeError as error:
        raise type(error)(f"{title}: {error}") from error
    working = time.perf_counter() - start
    if organ.stop_reason == "no boundary found":
        raise FlipFreeError(f"{title}: no boundary of the organ was found, so nothing is written.")
    for name in OUTPUTS:
        if name in values and name == "save_points":
            _write_to(files, values[name], lambda path: write_points(path, points))
        elif name in values and name not in SHARED:
            write = partial(_write, name, organ, image, _names_of(values))
            _write_to(files, values[name], write)
    return organ, working


def _names_of(
    values: dict[str, Any], outputs: Iterable[str] = ("output", "labels", "convergence")
) -> OriginNames:
    """What files say of an organ, or of one of a session, apart from how it was found."""
    repeated: SessionOrgan | None = values.get("repeated")
    files = (values[name] for name in (*outputs, "save_session") if name in values)
    return OriginNames(
        values["input"],
        values.get("start_labels", ""),
        organs=[repeated.title if repeated else organ_of_file(next(files, ""))],
        colors=[repeated.color if repeated else ""],
    )


def _start_of(values: dict[str, Any], image: Any, points: list[Constraint]) -> dict[str, Any]:
    """The seed, or the label map in its place, and the corrections with all further seeds."""
    repeated: SessionOrgan | None = values.get("repeated")
    corrections = repeated.corrections if repeated else arguments_of(points)
    if "start_labels" in values:
        labels = {"start_labels": values["start_labels"], "start_label": values.get("start_label", 1)}
        return {**labels, **corrections}
    seeds = (
        [_lps(values, seed) for seed in values["seed"]]
        if "seed" in values
        else [_point_of(image, voxel) for voxel in values["seed_voxel"]]
    )
    (seed, radius), *more = zip(seeds, values["radius"])
    return {
        "seed": seed,
        "radius": radius,
        **corrections,
        "seeds": [*more, *corrections.get("seeds", ())],
    }


def _label_map(found: list[tuple[Segmentation, float]]) -> Any:
    """One label map of all organs. A voxel in several belongs to the first of them."""
    merged = found[0][0].label_map
    for organ, _ in found[1:]:
        labels = organ.label_map.voxels
        merged.voxels[merged.voxels == 0] = labels[merged.voxels == 0]
    return merged


def _report(values: dict[str, Any], organ: Segmentation, reading: float, working: float) -> None:
    if not organ.mesh.certified and organ.self_intersections == 0:
        warn("The surface is not certified: --guard is off. It does not intersect itself, though.")
    if "quiet" not in values:
        trust = (
            f"support {organ.support:.2f}"
            if isinstance(organ, Vessel)
            else f"confidence {confidence_text(organ.confidence)}"
        )
        print(
            f"{_title_of(values, '')}: volume {organ.volume:.1f} ml, "
            f"{len(organ.iterations['Iteration'])} iterations, {organ.stop_reason}, "
            f"{organ.self_intersections} self-intersections, {trust}; reading {reading:.2f} s, "
            f"segmenting {working:.2f} s"
        )


def trace(values: dict[str, Any]) -> None:
    """`flipfree trace`."""
    progress = _wants_bar(values)
    outputs = {name: values[name] for name in TRACE_OUTPUTS if name in values}
    _require_sense_of_trace(values, outputs)
    corrections = _points_of(values)
    if any(one.kind == SEED for one in corrections):
        raise FlipFreeError(
            "--points: a seed is of no use to a vessel. Give a further --point on its way"
        )
    set_threads(values.get("threads", 0))
    image = read_image(values["input"], series=values.get("series"), progress=progress)
    with contextlib.ExitStack() as files:  # either all files or none
        try:
            vessel = trace_vessel(
                image,
                [_lps(values, point) for point in values["point"]],
                inside=[one.place for one in corrections if one.kind == INSIDE],
                outside=[one.place for one in corrections if one.kind == OUTSIDE],
                boundary=[one.place for one in corrections if one.kind == BOUNDARY],
                progress=progress or None,
                **{name: value for name, value in values.items() if name in TRACE_PARAMETERS},
            )
        except FlipFreeError as error:
            raise type(error)(f"'{values['input']}': {error}") from error
        for name, path in outputs.items():
            if name == "save_points":
                _write_to(files, path, lambda name: write_points(name, corrections))
            else:
                origin = _names_of(values, ("output", "labels", "centerline"))
                _write_to(files, path, partial(_write, name, vessel, image, origin))
    if "quiet" not in values:
        count = len(vessel.branches)
        names = ("path", "start", "deformation", "label map")
        seconds = ", ".join(f"{name} {used:.2f} s" for name, used in zip(names, vessel.stage_seconds))
        print(
            f"{values['input']}: {count} {'branch' if count == 1 else 'branches'}, "
            f"{len(vessel.points)} vertices, {vessel.stop_reason}, "
            f"{vessel.self_intersections} self-intersections, support {vessel.support:.2f}; {seconds}"
        )


def _require_sense_of_trace(values: dict[str, Any], outputs: dict[str, str]) -> None:
    """Checks all that can be checked before the volume is read."""
    points = values.get("point", [])
    if len(points) < 2:
        raise WrongUsage(
            "A vessel needs two points or more. Give one at either end: --point X Y Z --point X Y Z "
            "(LPS mm)"
        )
    if not all(math.isfinite(x) for point in points for x in point):
        raise WrongUsage(
            "--point: a coordinate is not a finite number. Give three numbers, in millimeters"
        )
    if "points" in values:
        _require_ending("--points", values["points"], POINT_ENDINGS)
    if not set(outputs) - {"save_points"}:
        raise WrongUsage(
            "No output is requested. Give at least one of --output, --labels, --centerline, "
            "--convergence, --snapshot and --save-session"
        )
    for name, path in outputs.items():
        _require_ending(f"--{name.replace('_', '-')}", path, TRACE_OUTPUTS[name])
    if not 0 <= values.get("radius", 0) <= 100:
        raise WrongUsage("--radius must be a number of millimeters, 0 to 100; 0 finds it")
    if not -5 <= values.get("wall_thickness", 0) <= 5:
        raise WrongUsage("--wall-thickness must be a number of millimeters, -5 to 5")
    for name in TRACE_PARAMETERS.keys() & values.keys():
        TRACE_PARAMETERS[name].set(VesselAlgorithm().settings, values[name])
    _require_files(values, outputs)


def evaluate(values: dict[str, Any]) -> None:
    """`flipfree evaluate`."""
    progress = _wants_bar(values)
    names = {"segmentation": values["segmentation"], "reference": values["reference"]}
    if "csv" in values:
        _require_ending("--csv", values["csv"], (".csv",))
        _require_place(values["csv"], list(names.values()))
    label = values.get("label", -1)
    surface = None
    compared: Any
    if names["segmentation"].lower().endswith(ENDINGS):
        compared = surface = read_surface(names["segmentation"])
    else:
        compared = read_image(names["segmentation"], progress=progress)
    try:
        scores = evaluate_segmentation(
            compared,
            read_image(names["reference"], progress=progress),
            segmentation_label=values.get("segmentation_label", label),
            reference_label=values.get("reference_label", label),
            score_voxelization="voxelize" in values,
        )
    except FlipFreeError as error:
        raise type(error)(
            f"'{names['segmentation']}' against '{names['reference']}': {error}"
        ) from error
    if "csv" in values:
        row = {_column(name): value for name, value in {**names, **asdict(scores)}.items()}
        write_table(values["csv"], list(row), [list(row.values())])
    if "quiet" in values:
        return
    print(f"Dice                 {scores.dice:.4f}")
    print(f"Jaccard              {scores.jaccard:.4f}")
    print(
        f"volume               {scores.segmentation_volume:.2f} ml, reference "
        f"{scores.reference_volume:.2f} ml, difference "
        f"{100 * scores.relative_volume_difference:+.2f} %"
    )
    print(f"surface distance     mean {scores.asd:.3f} mm, RMS {scores.rms:.3f} mm")
    print(f"Hausdorff distance   {scores.hd:.3f} mm, 95th percentile {scores.hd95:.3f} mm")
    print(f"measured             overlap of the {scores.overlap_of}, distances of the {scores.distance_of}")
    if surface is not None:
        found = surface_validity(surface)
        open_edges = found["boundary_edges"]
        print(
            f"surface              {'valid' if found['valid'] else 'not valid'}: "
            f"{f'{open_edges} open edges' if open_edges else 'closed'}, Euler number "
            f"{found['euler_number']}, self-intersections {found['self_intersections']}"
        )


def phantom(values: dict[str, Any]) -> None:
    """`flipfree phantom`."""
    name = values["name"]
    if name not in get_args(Shape):
        raise WrongUsage(f"There is no phantom '{name}'. Choose {', '.join(get_args(Shape))}")
    folder = values.get("output", ".")
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise FileError(
            f"The folder '{folder}' cannot be created ({error.strerror}). Check the name and the "
            "permissions of its parent folder."
        ) from error
    keywords = {
        "size": "dimensions",
        "spacing": "spacing",
        "noise": "noise_standard_deviation",
        "random_seed": "random_seed",
        "lesions": "number_of_lesions",
    }
    made = make_phantom(name, **{keywords[key]: values[key] for key in keywords if key in values})
    stem = os.path.join(folder, name)
    write_image(made.image, f"{stem}.nii.gz")
    write_image(made.label_map, f"{stem}-truth.nii.gz")
    if "quiet" in values:
        return
    for label in sorted(made.seeds, key=lambda label: (label != Organ.LIVER, label)):
        (x, y, z), radius = made.seeds[label]
        organ = Organ(label).name.lower().replace("_", " ") if name == "abdomen" else "object"
        print(f"{organ} (label {label}): --seed {x:.2f} {y:.2f} {z:.2f} --radius {radius:.2f}")


def cohort(values: dict[str, Any]) -> None:
    """`flipfree cohort`."""
    from ._cohort import cohort as segment_cohort

    result = segment_cohort(
        values["table"],
        values["output"],
        scheduler=values.get("scheduler"),
        workers=values.get("workers", 0),
        threads=values.get("threads", 1),
        progress=_wants_bar(values) or None,
    )
    if "quiet" not in values:
        print(result)
    if result.failed:
        failed = [(n, row) for n, row in enumerate(result.rows, 1) if row["status"] != "done"]
        for number, row in failed[:3]:
            message = re.sub("^row [0-9]+, ", "", " ".join(row["message"].split()))
            print(f"flipfree: error: row {number}: {message}", file=sys.stderr)
        raise FlipFreeError(
            f"{len(failed)} of {len(result.rows)} rows failed. Their messages are in "
            f"'{os.path.join(values['output'], 'cohort.csv')}' and in report.html beside it."
        )


def _lps(values: dict[str, Any], point: list[float]) -> list[float]:
    """A point of the command line."""
    return [-point[0], -point[1], point[2]] if "ras" in values else point


def _points_of(values: dict[str, Any]) -> list[Constraint]:
    """The corrections; those of the file first."""
    points = read_points(values["points"]) if "points" in values else []
    inside, outside, boundary = (
        [_lps(values, point) for point in values.get(kind, ())]
        for kind in ("inside", "outside", "boundary")
    )
    return [*points, *constraints_of(inside, outside, boundary, ())]


def _wants_bar(values: dict[str, Any]) -> bool:
    return "quiet" not in values and sys.stderr.isatty()


def _require_sense(values: dict[str, Any], outputs: dict[str, str]) -> None:
    """Checks all that can be checked before the volume is read."""
    if not {"repeated", "start_labels"} & values.keys() and ("seed" in values) == ("seed_voxel" in values):
        raise WrongUsage(
            "Both --seed and --seed-voxel are given. Give only one of them"
            if "seed" in values
            else "There is no seed. Give a point deep inside the organ: --seed X Y Z (LPS mm) or "
            "--seed-voxel I J K; or a label map to fill: --start-labels FILE; or several organs: "
            "--organ NAME X Y Z MM"
        )
    seeds = len(values.get("seed", ())) + len(values.get("seed_voxel", ()))
    if seeds and seeds != len(values["radius"]):
        raise WrongUsage(
            f"There are {seeds} seeds and {len(values['radius'])} radii. Give a --radius for each seed, "
            "in the same order"
        )
    if "points" in values:
        _require_ending("--points", values["points"], POINT_ENDINGS)
    _require_outputs(outputs)
    _require_files(values, outputs)


def _require_outputs(outputs: dict[str, str]) -> None:
    """There are some, of endings that can be written."""
    if not set(outputs) - {"save_points"}:
        raise WrongUsage(
            "No output is requested. Give at least one of --output, --labels, --convergence, "
            "--snapshot and --save-session"
        )
    for name, path in outputs.items():
        _require_ending(f"--{name.replace('_', '-')}", path, OUTPUTS[name])


def _require_files(values: dict[str, Any], outputs: dict[str, str]) -> None:
    """The input is there, and the outputs can be written."""
    inputs = [values[name] for name in ("input", "start_labels") if name in values]
    for path in outputs.values():
        _require_place(path, inputs)
    if not os.path.isdir(values["input"]) and "series" in values:
        raise WrongUsage(
            f"--series selects a series of a DICOM folder, but '{values['input']}' is a file. Omit the "
            "option, or give the folder"
        )
    if not os.path.exists(values["input"]):
        raise FileError(f"There is no file '{values['input']}'. Check the name and the folder.")
    if "start_label" in values and "start_labels" not in values:
        raise WrongUsage("--start-label is a value of --start-labels. Give that file, too")
    if values.get("start_label", 0) < 0:
        raise WrongUsage("--start-label: a label is 0 or more; 0 takes all that are not 0")
    if "snapshot" in outputs:
        from ._picture import require_matplotlib

        require_matplotlib()


def _require_ending(option: str, name: str, endings: tuple[str, ...]) -> None:
    if not name.lower().endswith(endings):
        raise WrongUsage(
            f"{option}: the ending of '{name}' stands for no format known here. Use "
            f"{' or '.join([', '.join(endings[:-1])] * (len(endings) > 1) + [endings[-1]])}"
        )


def _require_place(path: str, inputs: list[str]) -> None:
    if any(os.path.realpath(path) == os.path.realpath(name) for name in inputs):
        raise WrongUsage(
            f"'{path}' is an input, which would be overwritten. Give the result another name"
        )
    folder = os.path.dirname(path) or "."
    if os.path.isdir(path) or not os.access(folder, os.W_OK):
        raise FileError(
            f"'{path}' cannot be written: it is a folder, or its folder does not exist or may not be "
            "written to."
        )


def _point_of(image: Any, voxel: list[int]) -> list[float]:
    import numpy

    axes = numpy.reshape(image.direction, (3, 3)) * image.spacing
    point: list[float] = (numpy.array(image.origin) + axes @ numpy.array(voxel, float)).tolist()
    return point


def _write_to(files: contextlib.ExitStack, path: str, write: Callable[[str], None]) -> None:
    """Writes under another name, which becomes the path's when `files` ends."""
    temporary = files.enter_context(replacing(path))
    try:
        write(temporary)
    except FileError as error:
        raise FileError(str(error).replace(temporary, path)) from error


def _write_text(text: str, path: str) -> None:
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(text)


def _write(name: str, organ: Segmentation, image: Any, names: OriginNames, path: str) -> None:
    provenance = named(organ.provenance, names)
    if name == "output":
        # The other formats have it without names: the same surface is the same bytes.
        is_vtp = path.lower().endswith(".vtp")
        write_surface(replace(organ.mesh, provenance=provenance) if is_vtp else organ, path)
    elif name == "save_session":
        _write_text(session_text([provenance]), path)
    elif name == "labels":
        label = int(organ.label_map.voxels.max())
        write_image(organ.label_map, path, names={label: names.organs[0]})
    elif name == "centerline" and isinstance(organ, Vessel):
        write_centerline(organ, path)
    elif name == "convergence":
        columns = organ.iterations
        rows = zip(*(values.tolist() for values in columns.values()))
        write_table(path, list(columns), [list(row) for row in rows])
    else:
        from ._picture import write_picture

        write_picture(path, image, organ)


def _column(field: str) -> str:
    return COLUMNS.get(field) or "".join(word.capitalize() for word in field.split("_"))
