"""FlipFree as a filter in pipelines of any VTK from 9.3 on.

    from flipfree.vtk import FlipFreeSegmentation

    segmentation = FlipFreeSegmentation()
    segmentation.SetInputConnection(reader.GetOutputPort())
    segmentation.SetSeedCenter(99.75, 83.75, 167)
    segmentation.SetSeedRadius(28)
    segmentation.Update()
    segmentation.GetSurface(), segmentation.GetLabelMap(), segmentation.GetConvergence()
"""

from __future__ import annotations

from typing import Any

import numpy

from ._extras import missing

try:
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
    from vtkmodules.vtkCommonCore import vtkLogger, vtkTimeStamp
    from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPolyData, vtkTable
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
except ModuleNotFoundError as error:
    raise ImportError(missing("vtk", "flipfree.vtk", "pyvista", error)) from error

from ._backend import SEGMENT_PARAMETERS, SegmentationAlgorithm
from ._errors import FlipFreeError
from ._foreign import adopted
from ._questions import COLUMNS
from ._segmentation import Segmentation
from ._types import Preset
from ._vtk_objects import imagedata_of, polydata_of, surface_of_vtk


class Aborted(Exception):
    """The pipeline asked the filter to stop."""


class FlipFreeSegmentation(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """Segments an organ around a seed sphere.

    Port 0 takes the image (one number per point), port 1, if wanted, a start surface. Outputs: the
    surface (vtkPolyData), the label map (vtkImageData), the convergence and the questions
    (vtkTable). Every parameter of flipfree.segment is a property: search_distance is
    SetSearchDistance and GetSearchDistance. With KeepHistory, the iterations are time steps, and the
    last one is the result.
    Update() raises flipfree.SegmentationError if there is no segmentation.
    """

    def __init__(self) -> None:
        super().__init__(nInputPorts=2, nOutputPorts=4)
        self._center = [0.0, 0.0, 0.0]
        self._radius = 10.0
        self._algorithm = SegmentationAlgorithm("default")
        self._error: Exception | None = None
        self._organ: Segmentation | None = None
        self._done = vtkTimeStamp()
        self._stop_reason = ""
        self._self_intersections = 0

    def SetSeedCenter(self, *center: Any) -> None:
        """The seed's center in the image's millimeters, as three numbers or one sequence."""
        numbers = [float(x) for x in (center[0] if len(center) == 1 else center)]
        if len(numbers) != 3:
            raise ValueError(f"SeedCenter: 3 numbers are needed, not {len(numbers)}")
        self._center = numbers
        self.Modified()

    def GetSeedCenter(self) -> tuple[float, ...]:
        return tuple(self._center)

    def SetSeedRadius(self, radius: float) -> None:
        """In millimeters; default 10."""
        self._radius = float(radius)
        self.Modified()

    def GetSeedRadius(self) -> float:
        return self._radius

    def UsePreset(self, preset: Preset) -> None:
        """Sets all parameters: 'default', 'published' or 'naive'."""
        self._algorithm = SegmentationAlgorithm(preset)
        self.Modified()

    def SetStartConnection(self, port: Any) -> None:
        """A surface to start from instead of the sphere."""
        self.SetInputConnection(1, port)

    def SetStartData(self, surface: Any) -> None:
        self.SetInputDataObject(1, surface)

    def GetSurface(self) -> vtkPolyData:
        return self.GetOutputDataObject(0)

    def GetLabelMap(self) -> vtkImageData:
        return self.GetOutputDataObject(1)

    def GetConvergence(self) -> vtkTable:
        return self.GetOutputDataObject(2)

    def GetQuestions(self) -> vtkTable:
        return self.GetOutputDataObject(3)

    def GetStopReasonAsString(self) -> str:
        return self._stop_reason

    def GetNumberOfSelfIntersections(self) -> int:
        return self._self_intersections

    def Update(self, *port: Any) -> None:
        """Brings the outputs up to date; raises what RequestData found wrong."""
        self._error = None
        super().Update(*port)
        if self._error is not None:
            raise self._error

    def FillInputPortInformation(self, port: int, info: Any) -> int:
        info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData" if port else "vtkImageData")
        if port:
            info.Set(self.INPUT_IS_OPTIONAL(), 1)
        return 1

    def FillOutputPortInformation(self, port: int, info: Any) -> int:
        names = ("vtkPolyData", "vtkImageData", "vtkTable", "vtkTable")
        info.Set(vtkDataObject.DATA_TYPE_NAME(), names[port])
        return 1

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        """The label map has the image's grid."""
        del request
        self._announce_times(inputs, outputs.GetInformationObject(0))
        image, labels = inputs[0].GetInformationObject(0), outputs.GetInformationObject(1)
        for key in (
            vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT(),
            vtkDataObject.SPACING(),
            vtkDataObject.ORIGIN(),
            vtkDataObject.DIRECTION(),
        ):
            if image.Has(key):
                labels.CopyEntry(image, key)
        return 1

    def RequestUpdateExtent(self, request: Any, inputs: Any, outputs: Any) -> int:
        """The whole image is needed, whatever is asked for."""
        del request, outputs
        image = inputs[0].GetInformationObject(0)
        whole = vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT()
        if image.Has(whole):
            extent = [image.Get(whole, index) for index in range(6)]
            image.Set(vtkStreamingDemandDrivenPipeline.UPDATE_EXTENT(), extent, 6)
        if self._algorithm.settings.get("KeepHistory")[0]:
            # Time is the number of the iteration here, and none of the image's.
            image.Remove(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        del request
        data = vtkImageData.GetData(inputs[0], 0)
        try:
            if self._organ is None or not self._is_up_to_date(inputs):
                self._organ = None
                self._organ = self._run(data, vtkPolyData.GetData(inputs[1], 0))
                self._done.Modified()
            organ = self._organ
        except (Aborted, FlipFreeError, TypeError, ValueError) as error:
            if not isinstance(error, Aborted):
                self._error = error
                vtkLogger.Log(vtkLogger.VERBOSITY_ERROR, __file__, 0, f"FlipFreeSegmentation: {error}")
            return 0
        self._show_surface(organ, outputs.GetInformationObject(0), vtkPolyData.GetData(outputs, 0))
        self._announce_times(inputs, outputs.GetInformationObject(0))
        labels = vtkImageData.GetData(outputs, 1)
        imagedata_of(organ.label_map, labels)
        labels.SetOrigin(data.GetOrigin())
        labels.SetExtent(data.GetExtent())
        _fill(vtkTable.GetData(outputs, 2), organ.iterations)
        rows = [question.row() for question in organ.questions]
        columns = numpy.array(rows, float).reshape(-1, len(COLUMNS)).T
        _fill(vtkTable.GetData(outputs, 3), dict(zip(COLUMNS, columns)))
        if not organ.history:
            self._organ = None
        return 1

    def _is_up_to_date(self, inputs: Any) -> bool:
        """Whether the organ that is kept is that of these parameters and inputs."""
        given = (vtkDataObject.GetData(port, 0) for port in inputs)
        newest = max(self.GetMTime(), *(0 if one is None else one.GetMTime() for one in given))
        return self._organ is not None and self._done.GetMTime() > newest

    def _announce_times(self, inputs: Any, surface: Any) -> None:
        """The iterations, or how many there may be."""
        if not self._algorithm.settings.get("KeepHistory")[0]:
            return
        steps, span = vtkStreamingDemandDrivenPipeline.TIME_STEPS(), vtkStreamingDemandDrivenPipeline.TIME_RANGE()
        settings = self._algorithm.settings
        rounds = 2 if settings.get("Carving")[0] else 1
        last = max(1.0, rounds * settings.get("Levels")[0] * settings.get("MaximumIterations")[0])
        surface.Remove(steps)
        if self._organ is not None and self._is_up_to_date(inputs):
            last = float(max(1, len(self._organ.history)))
            surface.Set(steps, [float(time) for time in range(1, int(last) + 1)], int(last))
        surface.Set(span, [1.0, last], 2)

    @staticmethod
    def _show_surface(organ: Segmentation, information: Any, surface: vtkPolyData) -> None:
        """That of the iteration whose time is asked for."""
        time, mesh = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP(), organ.mesh
        if organ.history and information.Has(time):
            step = max(1, int(min(information.Get(time), len(organ.history))))
            mesh = mesh if step == len(organ.history) else organ.history[step - 1]
            surface.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), information.Get(time))
        polydata_of(mesh, surface)

    def _run(self, data: vtkImageData, start: vtkPolyData | None) -> Segmentation:
        algorithm = self._algorithm
        algorithm.set_seed(self._center, self._radius)
        algorithm.clear_start()
        if start is not None:
            algorithm.set_start(surface_of_vtk(start))
        organ = algorithm.run(adopted("image", data), (), self._tell)
        self._stop_reason = organ.stop_reason
        self._self_intersections = organ.self_intersections
        return organ

    def _tell(self, fraction: float) -> None:
        self.UpdateProgress(fraction)
        if self.GetAbortExecute():
            raise Aborted


def _fill(table: vtkTable, columns: dict[str, Any]) -> None:
    for name, values in columns.items():
        column = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
        column.SetName(name)
        table.AddColumn(column)


def _add_property(name: str, keyword: str) -> None:
    parameter = SEGMENT_PARAMETERS[keyword]

    def setter(self: FlipFreeSegmentation, *values: Any) -> None:
        several = parameter.type is tuple and len(values) > 1
        parameter.set(self._algorithm.settings, values if several else values[0])
        self.Modified()

    def getter(self: FlipFreeSegmentation) -> Any:
        return parameter.get(self._algorithm.settings)

    setter.__doc__ = parameter.documentation
    setattr(FlipFreeSegmentation, f"Set{name}", setter)
    setattr(FlipFreeSegmentation, f"Get{name}", getter)


for _keyword, _parameter in SEGMENT_PARAMETERS.items():
    _add_property(_parameter.property, _keyword)
