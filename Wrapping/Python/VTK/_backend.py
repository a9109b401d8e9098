"""The package over VTK's wrapped filters."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkFieldData, vtkImageData, vtkPolyData

from . import _pickles as _pickles  # of what results hold
from ._corrections import SEED, Constraint, GivenOrgan
from ._errors import EvaluationError, FlipFreeError, SegmentationError
from ._images import series_of
from ._parameters import ARGUMENTS, names_of, of_several_organs, snake_case
from ._properties import Property, properties_of
from ._provenance import with_series
from ._questions import questions_of
from ._segmentation import Segmentation, Vessel, columns_of
from ._types import Preset, Progress
from ._update import update
from .FlipFreeEvaluation import vtkSegmentationMetrics
from .FlipFreePhantoms import vtkPhantomSource
from .FlipFreeSegmentation import (
    vtkFlipFreeLabelSurfaces,
    vtkFlipFreeOrganGroup,
    vtkFlipFreeSegmentation,
    vtkFlipFreeVesselSegmentation,
)

if TYPE_CHECKING:
    from ._images import AnySurface

# By the kind of a constraint.
ADDING = ("AddOutsidePoint", "AddInsidePoint", "AddBoundaryPoint", "AddSeed")

# The seed has arguments of its own; the stages know two parameters by other names than the method.
SEGMENT_PARAMETERS = properties_of(
    vtkFlipFreeSegmentation(),
    without=(
        "seed_center",
        "seed_radius",
        "start_label",
        "number_of_iterations",
        "threshold",
        "keep_for_corrections",
    ),
)
RADIUS = Property("radius", "SeedRadius", float, "")
NAMES = {**names_of(SEGMENT_PARAMETERS), **ARGUMENTS}
GROUP_PARAMETERS = of_several_organs(SEGMENT_PARAMETERS)
TRACE_PARAMETERS = properties_of(vtkFlipFreeVesselSegmentation())
EVALUATE_PARAMETERS = properties_of(vtkSegmentationMetrics())
SURFACES_PARAMETERS = properties_of(vtkFlipFreeLabelSurfaces())
# The shape is an argument of its own.
PHANTOM_PARAMETERS = properties_of(vtkPhantomSource(), without=("shape", "generate_surface"))


class SegmentationAlgorithm:
    """One run of the whole method."""

    def __init__(self, preset: Preset) -> None:
        self.settings = vtkFlipFreeSegmentation()
        getattr(self.settings, f"Use{preset.capitalize()}Parameters")()

    def set_seed(self, center: list[float], radius: float) -> None:
        self.settings.SetSeedCenter(center)
        RADIUS.set(self.settings, radius)

    def set_start(self, start: AnySurface) -> None:
        self.settings.SetStartData(_given("start", start))

    def set_start_labels(self, labels: vtkImageData, label: int) -> None:
        self.settings.SetStartLabelsData(labels)
        self.settings.SetStartLabel(label)

    def keep_for_corrections(self) -> None:
        """From the next run on, what points do not change is kept."""
        self.settings.SetKeepForCorrections(True)

    def run(
        self, image: vtkImageData, constraints: tuple[Constraint, ...], tell: Progress | None
    ) -> Segmentation:
        self.settings.SetInputData(image)
        self.settings.RemoveAllCorrections()
        for constraint in constraints:
            _add(self.settings, constraint)
        update(self.settings, SegmentationError, tell, names=NAMES)
        return Segmentation(
            **_found(self.settings, image),
            questions=questions_of(columns_of(self.settings.GetQuestions())),
            history=self._history(),
        )

    def _history(self) -> tuple[vtkPolyData, ...]:
        """The surfaces after each iteration, which are the time steps of the first output."""
        if not self.settings.GetKeepHistory():
            return ()
        history = []
        for iteration in range(1, self.settings.GetConvergence().GetNumberOfRows() + 1):
            self.settings.UpdateTimeStep(iteration)
            history.append(_detached(self.settings.GetSurface()))
        return tuple(history)


class GroupAlgorithm:
    """Runs of several organs."""

    def __init__(self) -> None:
        self._group = vtkFlipFreeOrganGroup()
        self.settings = self._group.GetParameters()

    def add_fixed(self, fixed: AnySurface) -> None:
        self._group.AddFixedData(_given("fixed", fixed))

    def first_label(self) -> int:
        """The first organ's value in the label map."""
        return int(self.settings.GetLabelValue())

    def run(
        self, image: vtkImageData, given: Sequence[GivenOrgan], tell: Progress | None
    ) -> tuple[list[Segmentation], vtkImageData]:
        group = self._group
        group.RemoveAllOrgans()
        for organ in given:
            x, y, z = organ.center
            group.AddOrgan(organ.name, x, y, z, organ.radius)
            for constraint in organ.points:
                _add(group, constraint, organ.name)
        group.SetLabelValue(self.first_label())
        group.SetInputData(image)
        update(group, SegmentationError, tell, names=NAMES)
        label_map = _detached(group.GetLabelMap())
        organs = [
            Segmentation(
                surface=_of_series(_detached(group.GetSurface(number)), image),
                label_map=label_map,
                convergence=_detached(group.GetConvergence(number)),
                stop_reason=group.GetStopReasonAsString(number),
                boundary_found=_has_boundary(group.GetStopReason(number)),
                self_intersections=group.GetNumberOfSelfIntersections(number),
                stage_seconds=tuple(group.GetStageSeconds()),
                constraints=organ.points,
                questions=questions_of(columns_of(group.GetQuestions(number))),
            )
            for number, organ in enumerate(given)
        ]
        return organs, label_map


class VesselAlgorithm:
    """One vessel between points."""

    def __init__(self) -> None:
        self.settings = vtkFlipFreeVesselSegmentation()

    def run(
        self,
        image: vtkImageData,
        points: list[tuple[float, ...]],
        constraints: tuple[Constraint, ...],
        tell: Progress | None,
    ) -> Vessel:
        self.settings.RemoveAllPoints()
        for point in points:
            self.settings.AddPoint(*point)
        self.settings.RemoveAllCorrections()
        for constraint in constraints:
            if constraint.kind == SEED:
                raise SegmentationError(
                    "No segmentation: a vessel takes no further seeds; give a point along it."
                )
            _add(self.settings, constraint)
        self.settings.SetInputData(image)
        update(self.settings, SegmentationError, tell, names=names_of(TRACE_PARAMETERS))
        return Vessel(
            **_found(self.settings, image),
            centerline=_detached(self.settings.GetCenterline()),
            support=self.settings.GetSupport(),
            confidence=self.settings.GetConfidence(),
        )


class Metrics:
    """One comparison."""

    def __init__(self) -> None:
        self.settings = vtkSegmentationMetrics()

    def run(
        self, compared: Segmentation | vtkPolyData | vtkImageData, reference: vtkImageData
    ) -> dict[str, Any]:
        data = compared.surface if isinstance(compared, Segmentation) else compared
        self.settings.SetInputDataObject(data)
        self.settings.SetReferenceData(reference)
        update(self.settings, EvaluationError, names=names_of(EVALUATE_PARAMETERS))
        row = self.settings.GetOutput()
        columns = range(row.GetNumberOfColumns())
        return {snake_case(row.GetColumnName(i)): _value(row, i) for i in columns}


class SurfacesAlgorithm:
    """The surfaces of one label map."""

    def __init__(self) -> None:
        self.settings = vtkFlipFreeLabelSurfaces()

    def run(self, labels: vtkImageData, only: list[int], tell: Progress | None) -> dict[str, Any]:
        from vtkmodules.util.numpy_support import vtk_to_numpy

        filter_ = self.settings
        filter_.RemoveAllLabels()
        for label in only:
            filter_.AddLabel(label)
        filter_.SetInputData(labels)
        names = {**names_of(SURFACES_PARAMETERS), "Labels": "only"}
        update(filter_, FlipFreeError, tell, names=names)
        walls, table = filter_.GetOutput(), filter_.GetTable()
        corners = vtk_to_numpy(walls.GetPolys().GetConnectivityArray())
        return {
            "points": vtk_to_numpy(walls.GetPoints().GetData()).astype("float64"),
            "triangles": corners.reshape(-1, 3).astype("int32"),
            "boundary_labels": vtk_to_numpy(walls.GetCellData().GetArray("BoundaryLabels")),
            "wrong_voxels": int(filter_.GetNumberOfWrongVoxels()),
            "greatest_distance": filter_.GetGreatestDistance(),
            "collapse_distance": filter_.GetCollapseDistance(),
            "rows": [
                {
                    table.GetColumnName(column): _cell(table, row, table.GetColumnName(column))
                    for column in range(table.GetNumberOfColumns())
                }
                for row in range(table.GetNumberOfRows())
            ],
        }


class PhantomAlgorithm:
    """One phantom."""

    def __init__(self, shape: int) -> None:
        self.settings = vtkPhantomSource()
        self.settings.SetShape(shape)

    def run(self) -> tuple[vtkImageData, vtkImageData, dict[int, Any], tuple[Any, ...]]:
        update(self.settings, names=names_of(PHANTOM_PARAMETERS))
        seeds = {}
        for label in range(1, vtkPhantomSource.PANCREAS + 1):
            seed = [0.0] * 4
            if self.settings.GetSeed(label, seed):
                seeds[label] = (tuple(seed[:3]), seed[3])
        places = [0.0] * 6
        has_ends = self.settings.GetVesselEnds(places)
        ends = (tuple(places[:3]), tuple(places[3:])) if has_ends else ()
        return self.settings.GetOutput(), self.settings.GetLabelMap(), seeds, ends


def _given(name: str, surface: AnySurface) -> vtkPolyData:
    """The surface of an argument of that name."""
    data = surface.surface if isinstance(surface, Segmentation) else surface
    if not isinstance(data, vtkPolyData):
        raise TypeError(f"{name}: a vtkPolyData or a Segmentation is needed, not {surface!r:.80}")
    return data


def _add(algorithm: Any, constraint: Constraint, *organ: str) -> None:
    """Gives a constraint to a filter; one of a group to an organ."""
    radius = (constraint.radius,) if constraint.kind == SEED else ()
    getattr(algorithm, ADDING[constraint.kind])(*organ, *constraint.place, *radius)


def _found(algorithm: Any, image: vtkImageData) -> dict[str, Any]:
    """What filters say of an organ or a vessel, as fields of a Segmentation."""
    return {
        "surface": _of_series(_detached(algorithm.GetSurface()), image),
        "label_map": _detached(algorithm.GetLabelMap()),
        "convergence": _detached(algorithm.GetConvergence()),
        "stop_reason": algorithm.GetStopReasonAsString(),
        "boundary_found": _has_boundary(algorithm.GetStopReason()),
        "self_intersections": algorithm.GetNumberOfSelfIntersections(),
        "stage_seconds": tuple(algorithm.GetStageSeconds()),
    }


def _has_boundary(stop_reason: int) -> bool:
    return stop_reason != vtkFlipFreeSegmentation.NO_BOUNDARY_FOUND


def _of_series(surface: vtkPolyData, image: vtkImageData) -> vtkPolyData:
    """The surface, whose provenance names the image's DICOM series, if it has one."""
    text = surface.GetFieldData().GetAbstractArray("Provenance")
    series = series_of(image)
    if text is not None and series:
        named = vtkStringArray()
        named.SetName(text.GetName())
        named.InsertNextValue(with_series(text.GetValue(0), series))
        fields = vtkFieldData()
        fields.ShallowCopy(surface.GetFieldData())
        fields.AddArray(named)
        surface.SetFieldData(fields)
    return surface


def _detached(output: Any) -> Any:
    """What the next run does not change."""
    copy = output.NewInstance()
    copy.ShallowCopy(output)
    return copy


def _cell(table: Any, row: int, column: str) -> Any:
    """A number or a text; whole numbers are such."""
    value = table.GetValueByName(row, column)
    if not value.IsNumeric():
        return value.ToString()
    return value.ToDouble() if value.IsDouble() else value.ToTypeInt64()


def _value(row: vtkDataObject, column: int) -> Any:
    value = row.GetValue(0, column)
    return value.ToDouble() if value.IsNumeric() else value.ToString()
