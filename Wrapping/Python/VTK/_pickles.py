"""VTK's data objects in pickle, so that results go into files and to other processes as they do without VTK.

VTK 9.1 has no pickles of its own. What it sends between processes lacks an image's direction and
rounds its spacing and origin, so these travel beside it.
"""

from __future__ import annotations

import copyreg
from collections.abc import Callable
from typing import Any

from vtkmodules.vtkCommonCore import vtkCharArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPolyData, vtkTable
from vtkmodules.vtkParallelCore import vtkCommunicator

Geometry = tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]


def _reduced(data: vtkDataObject) -> tuple[Callable[..., Any], tuple[Any, ...]]:
    buffer = vtkCharArray()
    vtkCommunicator.MarshalDataObject(data, buffer)
    return _restored, (type(data), bytes(buffer), _geometry_of(data))


def _restored(kind: type[vtkDataObject], content: bytes, geometry: Geometry | None) -> vtkDataObject:
    buffer = vtkCharArray()
    buffer.SetNumberOfValues(len(content))
    memoryview(buffer).cast("B")[:] = content
    data = kind()
    if not vtkCommunicator.UnMarshalDataObject(buffer, data):
        raise ValueError(f"the pickle of a {kind.__name__} is damaged")
    if geometry is not None and isinstance(data, vtkImageData):
        spacing, origin, direction = geometry
        data.SetSpacing(spacing)
        data.SetOrigin(origin)
        data.SetDirectionMatrix(direction)
    return data


def _geometry_of(data: vtkDataObject) -> Geometry | None:
    if not isinstance(data, vtkImageData):
        return None
    matrix = data.GetDirectionMatrix()
    direction = tuple(matrix.GetElement(row, column) for row in range(3) for column in range(3))
    return data.GetSpacing(), data.GetOrigin(), direction


for _kind in (vtkImageData, vtkPolyData, vtkTable):
    copyreg.pickle(_kind, _reduced)
