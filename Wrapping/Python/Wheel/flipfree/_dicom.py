"""A series of DICOM slices as a volume; its slices' own positions say where it lies."""

from __future__ import annotations

import os
from typing import Any

from ._arrays import image_from_array
from ._errors import FileError
from ._extras import ARRAY_INSTEAD, simpleitk
from ._image import Image
from ._messages import warn

POSITION = "0020|0032"
# Of the slice spacing: beyond the first there is a warning, beyond the second an error.
TOLERANCES = (0.01, 0.5)


def read_series(folder: str, series: str | None) -> Image:
    """Reads the series with this UID, or else the one of most files."""
    sitk = simpleitk(folder, ARRAY_INSTEAD)
    reader = sitk.ImageSeriesReader()
    names = _files_of(reader, folder, series)
    reader.SetFileNames(names)
    reader.MetaDataDictionaryArrayUpdateOn()
    try:
        image = reader.Execute()
    except RuntimeError as error:
        raise FileError(
            f"'{folder}': the slices of the series do not form one volume, or one of them is damaged "
            f"({str(error).strip().splitlines()[-1][-120:]})."
        ) from error
    if image.GetDimension() != 3 or image.GetNumberOfComponentsPerPixel() != 1:
        raise FileError(f"'{folder}': its series is not a volume of gray values.")
    return _placed(sitk, image, _positions(reader, len(names)), folder)


def _files_of(reader: Any, folder: str, series: str | None) -> list[str]:
    found = {uid: reader.GetGDCMSeriesFileNames(folder, uid) for uid in reader.GetGDCMSeriesIDs(folder)}
    if not found:
        raise FileError(f"'{folder}' holds no DICOM images. Give the folder of a series, or a file.")
    if series is None:
        series = max(found, key=lambda uid: len(found[uid]))
    if series not in found:
        raise FileError(f"'{folder}' has no series '{series}'. It has {', '.join(sorted(found))}.")
    return [os.fspath(name) for name in found[series]]


def _positions(reader: Any, count: int) -> Any:
    """Where the first voxel of each slice is; nothing where a slice does not say."""
    import numpy

    if not all(reader.HasMetaDataKey(index, POSITION) for index in range(count)):
        return None
    return numpy.array(
        [
            [float(number) for number in reader.GetMetaData(index, POSITION).split("\\")]
            for index in range(count)
        ]
    )


def _placed(sitk: Any, image: Any, positions: Any, folder: str) -> Image:
    """With the third axis along the slices' positions, which a tilted gantry turns."""
    import numpy

    spacing = numpy.array(image.GetSpacing())
    axes = numpy.reshape(image.GetDirection(), (3, 3)).copy()
    if positions is not None and len(positions) > 1:
        step = (positions[-1] - positions[0]) / (len(positions) - 1)
        length = numpy.linalg.norm(step)
        even = positions[0] + step * numpy.arange(len(positions))[:, None]
        astray = numpy.linalg.norm(positions - even, axis=1).max()
        if not length > 0 or astray > TOLERANCES[1] * length:
            raise FileError(
                f"'{folder}': the slices do not form an even stack; one lies {astray:.3g} mm from its "
                f"place, at a spacing of {length:.3g} mm. Slices are missing, or there are two series."
            )
        if astray > TOLERANCES[0] * length:
            warn(f"'{folder}': slices stray from an even stack by up to {astray:.3g} mm.")
        spacing[2], axes[:, 2] = length, step / length
    return image_from_array(sitk.GetArrayFromImage(image), spacing.tolist(), image.GetOrigin(), axes)
