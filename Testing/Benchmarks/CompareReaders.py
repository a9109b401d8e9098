"""Where readers put the voxels of the images of a folder, and with which values: FlipFree, and nibabel, SimpleITK and pydicom,
which understand headers by code of their own.

    python CompareReaders.py FOLDER [FOLDER ...]

Each file of a folder is an image, each folder in it a DICOM folder; an archive (.tar.gz, .zip) of one is unpacked. Prints a
Markdown table. Of each reader it says by how much its eight corners (LPS, mm) and the values of ten random voxels differ from
FlipFree's; "same" is within 0.001 mm and rounding; "-" where the reader does not know the format. Needs the pip package:

    python3 -m venv ENV && ENV/bin/pip install . nibabel==5.4.2 SimpleITK==2.5.7 pydicom==3.0.2

Readers that are not installed have no column.
"""

import importlib
import importlib.util
import os
import shutil
import sys
import tempfile
import warnings
from pathlib import Path
from typing import NamedTuple

import flipfree
import numpy

VOXELS = 10
SAME_PLACE = 1e-3  # mm
LPS_OF_RAS = numpy.diag([-1.0, -1, 1])
ARCHIVES = (".tar.gz", ".zip")


class Grid(NamedTuple):
    """An image as a reader understands it."""

    first: numpy.ndarray  # the center of voxel (0, 0, 0); LPS, mm
    steps: numpy.ndarray  # to the next voxel along each axis, as columns
    voxels: numpy.ndarray  # [i, j, k]

    def places(self, indices):
        return self.first + numpy.asarray(indices) @ self.steps.T

    def corners(self):
        ends = [(0, count - 1) for count in self.voxels.shape]
        return self.places(numpy.array(numpy.meshgrid(*ends, indexing="ij")).reshape(3, -1).T)

    def indices(self, places):
        indices = numpy.rint(numpy.linalg.solve(self.steps, (places - self.first).T).T).astype(int)
        return numpy.clip(indices, 0, numpy.array(self.voxels.shape) - 1)

    def values(self, indices):
        return self.voxels[tuple(numpy.transpose(indices))].astype(float)


class Unknown(Exception):
    """A format that the reader does not have."""


def spatial(voxels):
    """Without a fourth axis of one."""
    return voxels.reshape(voxels.shape[:3]) if set(voxels.shape[3:]) == {1} else voxels


def by_nibabel(path, _series):
    import nibabel  # pylint: disable=import-outside-toplevel

    if not path.name.lower().endswith((".nii", ".nii.gz", ".hdr", ".img")):
        raise Unknown
    image = nibabel.load(path)
    # nibabel leaves it to its user to look at the unit; most do not.
    affine = LPS_OF_RAS @ image.affine[:3]
    return Grid(affine[:, 3], affine[:, :3], spatial(numpy.asanyarray(image.dataobj)))


def by_simpleitk(path, series):
    import SimpleITK  # pylint: disable=import-outside-toplevel

    SimpleITK.ProcessObject.SetGlobalWarningDisplay(False)
    if path.is_dir():
        reader = SimpleITK.ImageSeriesReader()
        names = {uid: reader.GetGDCMSeriesFileNames(str(path), uid) for uid in reader.GetGDCMSeriesIDs(str(path))}
        if not names:
            raise ValueError("no series")
        chosen = names.get(series.partition("#")[0]) or max(names.values(), key=len)
        image = SimpleITK.ReadImage(chosen[0] if len(chosen) == 1 else chosen)
    else:
        image = SimpleITK.ReadImage(str(path))
    directions = numpy.reshape(image.GetDirection(), (image.GetDimension(),) * 2)[:3, :3]
    return Grid(numpy.array(image.GetOrigin()[:3]), directions * image.GetSpacing()[:3],
                spatial(SimpleITK.GetArrayFromImage(image).T))


def planes_in(data):
    """The frames of a data set: where, the steps along a row and down a column, and values [row, column]."""
    import pydicom  # pylint: disable=import-outside-toplevel

    shared = data.get("SharedFunctionalGroupsSequence", [pydicom.Dataset()])[0]
    pixels = data.pixel_array
    groups = data.get("PerFrameFunctionalGroupsSequence", [data])
    for group, plane in zip(groups, pixels.reshape(-1, *pixels.shape[-2:])):

        def find(sequence, keyword, otherwise=None, group=group):
            for place in (group, shared):
                if sequence in place:
                    return place[sequence][0].get(keyword, otherwise)
            return data.get(keyword, otherwise)

        axes = numpy.array(find("PlaneOrientationSequence", "ImageOrientationPatient"), float).reshape(2, 3)
        down, along = (float(length) for length in find("PixelMeasuresSequence", "PixelSpacing"))
        slope = float(find("PixelValueTransformationSequence", "RescaleSlope", 1))
        intercept = float(find("PixelValueTransformationSequence", "RescaleIntercept", 0))
        yield (numpy.array(find("PlanePositionSequence", "ImagePositionPatient"), float), axes[0] * along, axes[1] * down,
               plane * slope + intercept)


def by_pydicom(path, series):
    """pydicom gives data sets; the rest is what its users do: the largest stack of like frames, sorted by position."""
    import pydicom  # pylint: disable=import-outside-toplevel

    if path.is_file() and not pydicom.misc.is_dicom(path):
        raise Unknown
    stacks = {}
    problem = ValueError("no slices")
    for name in sorted(path.rglob("*")) if path.is_dir() else [path]:
        try:
            data = pydicom.dcmread(name, force=True)
            if series and data.get("SeriesInstanceUID") != series.partition("#")[0]:
                continue
            if "TransferSyntaxUID" not in data.file_meta:
                data.file_meta.TransferSyntaxUID = pydicom.uid.ImplicitVRLittleEndian
            for plane in planes_in(data):
                like = (plane[3].shape, *numpy.round([*plane[1], *plane[2]], 2))
                stacks.setdefault(like, {})[tuple(plane[0])] = plane  # the same slice twice is one
        except Exception as error:  # pylint: disable=broad-except
            problem = error
    if not stacks:
        raise problem
    planes = list(max(stacks.values(), key=len).values())
    normal = numpy.cross(planes[0][1], planes[0][2])
    planes.sort(key=lambda plane: plane[0] @ normal)
    apart = (planes[-1][0] - planes[0][0]) / max(1, len(planes) - 1)
    return Grid(planes[0][0], numpy.array([planes[0][1], planes[0][2], apart if apart.any() else normal]).T,
                numpy.array([plane[3] for plane in planes]).T)


READERS = {"nibabel": by_nibabel, "SimpleITK": by_simpleitk, "pydicom": by_pydicom}


def own_grid(image):
    return Grid(numpy.array(image.origin), image.steps, image.voxels.T)


def difference(own, other):
    """In words; empty where there is none."""
    if other.voxels.shape != own.voxels.shape and sorted(other.voxels.shape) != sorted(own.voxels.shape):
        return f"{' x '.join(map(str, other.voxels.shape))} voxels"
    # Axes may come in another order.
    between = numpy.linalg.norm(own.corners()[:, None] - other.corners()[None], axis=2)
    far = max(between.min(axis=0).max(), between.min(axis=1).max())
    random = numpy.random.default_rng(0)
    indices = numpy.array([random.integers(0, count, VOXELS) for count in own.voxels.shape]).T
    values = own.values(indices)
    # Where the places are others, the same voxel in the file's order.
    near = far < numpy.linalg.norm(own.steps, axis=0).min() / 2
    in_order = numpy.minimum(indices, numpy.array(other.voxels.shape) - 1)
    others = other.values(other.indices(own.places(indices)) if near else in_order)
    wrong = ~numpy.isclose(values, others, rtol=1e-5, atol=1e-9, equal_nan=True)
    texts = [f"{far:.2g} mm"] if far >= SAME_PLACE else []
    if wrong.any():
        texts.append(f"{wrong.sum()} values by up to {numpy.nanmax(numpy.abs(values - others)[wrong]):.4g}")
    return ", ".join(texts)


def compare(path, readers):
    """The cells of a row: what FlipFree says, and what each reader does."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            image = flipfree.read_image(path)
            own = own_grid(image)
            cells = [" x ".join(map(str, own.voxels.shape)) + (", warns" if caught else "")]
        except flipfree.FlipFreeError as error:
            image = own = None
            cells = ["refuses: " + str(error).replace(str(path), path.name).replace("\n", " ")]
        for reader in readers:
            try:
                other = READERS[reader](path, image.series if image else "")
                cells.append("reads it" if own is None else difference(own, other) or "same")
            except Unknown:
                cells.append("-")
            except Exception as error:  # pylint: disable=broad-except
                reason = str(error).replace(str(path), path.name).strip().splitlines()[-1:]
                cells.append(": ".join(["cannot read", type(error).__name__, *(line[:80] for line in reason)]))
    return [cell.replace("|", "/") for cell in cells]


def images_in(folder, scratch):
    """A name and a path for each."""
    for path in sorted(folder.iterdir()):
        name = path.name
        if name.endswith(ARCHIVES):
            unpacked = Path(scratch, name)
            shutil.unpack_archive(path, unpacked)
            path = unpacked
        while path.is_dir() and len(inner := list(path.iterdir())) == 1 and inner[0].is_dir():
            path = inner[0]
        yield name, path


def counts(rows, column):
    """A reader's cells in the rows that FlipFree reads, by what they say."""
    cells = [row[column] for row in rows if not row[1].startswith("refuses")]
    same, unknown = cells.count("same"), cells.count("-")
    failed = sum(cell.startswith("cannot read") for cell in cells)
    return f"{same} same, {len(cells) - same - unknown - failed} differ, {failed} cannot be read"


def table(folders, readers):
    """The lines of the table."""
    versions = [getattr(importlib.import_module(name), "__version__", "") for name in readers]
    yield f"| input | FlipFree {flipfree.__version__} | " + " | ".join(map(" ".join, zip(readers, versions))) + " |"
    yield "|---" * (len(readers) + 2) + "|"
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        for folder in folders:
            for name, path in images_in(Path(folder), scratch):
                rows.append([name, *compare(path, readers)])
                yield f"| {' | '.join(rows[-1])} |"
    read = sum(not row[1].startswith("refuses") for row in rows)
    yield f"| {len(rows)} images | {read} read | " + " | ".join(
        counts(rows, column) for column in range(2, len(readers) + 2)) + " |"


def main():
    if len(sys.argv) < 2 or not all(os.path.isdir(folder) for folder in sys.argv[1:]):
        raise SystemExit(__doc__)
    readers = [name for name in READERS if importlib.util.find_spec(name)]
    for line in table(sys.argv[1:], readers):
        print(line, flush=True)


if __name__ == "__main__":
    main()
