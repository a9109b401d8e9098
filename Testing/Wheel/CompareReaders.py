"""Corners and random voxels of volumes, by this package and by nibabel, SimpleITK and pydicom, which understand headers by code
of their own. Not a test: it compares whatever volumes it is given.

    python CompareReaders.py PATH [PATH ...]

PATH is a file, a folder of DICOM files, or an archive (.tar.gz) of one. A row for each: size; for each reader the farthest of the
eight corners in mm, and how many of ten random voxels differ; "-" where the reader does not know the format, and its error's
type where it refuses the file.
"""

import os
import sys
import tarfile
import tempfile
import warnings
from pathlib import Path

import flipfree
import nibabel
import numpy
import pydicom
import SimpleITK

LPS = numpy.diag([-1.0, -1, 1])
VOXELS = 10


def corners(size):
    ends = [(0, count - 1) for count in size]
    return numpy.array(numpy.meshgrid(*ends, indexing="ij")).reshape(3, -1).T


def own_places(image, indices):
    return numpy.array(image.origin) + numpy.asarray(indices) @ image.steps.T


def same(value, other):
    return bool(numpy.isclose(value, other, rtol=1e-5, atol=1e-9 * max(1, abs(value)), equal_nan=True))


def by_nibabel(path, image, indices):
    other = nibabel.load(path)
    affine = LPS @ other.affine[:3]
    unit = {"meter": 1000.0, "micron": 0.001}.get(getattr(other.header, "get_xyzt_units", lambda: ("mm",))()[0], 1.0)
    voxels = numpy.asanyarray(other.dataobj)
    voxels = voxels.reshape(voxels.shape[:3])
    place = lambda index: unit * (affine[:, :3] @ index + affine[:, 3])
    return place, lambda index: voxels[tuple(index)]


def by_simpleitk(path, image, indices):
    if os.path.isdir(path):
        reader = SimpleITK.ImageSeriesReader()
        series = {uid: reader.GetGDCMSeriesFileNames(path, uid) for uid in reader.GetGDCMSeriesIDs(path)}
        reader.SetFileNames(max(series.values(), key=len))
        other = reader.Execute()
    else:
        other = SimpleITK.ReadImage(path)
    return (lambda index: numpy.array(other.TransformContinuousIndexToPhysicalPoint([float(i) for i in index])),
            lambda index: other[tuple(int(i) for i in index)])


class Frames:
    """All slices of a folder, each with where pydicom says that it is."""

    def __init__(self, folder):
        self.frames = []
        for name in sorted(Path(folder).rglob("*")):
            try:
                data = pydicom.dcmread(name, force=True)
                if not data.get("PixelSpacing") and "PerFrameFunctionalGroupsSequence" not in data:
                    continue
                if "file_meta" not in dir(data) or "TransferSyntaxUID" not in data.file_meta:
                    data.file_meta.TransferSyntaxUID = pydicom.uid.ImplicitVRLittleEndian
                self.add(data)
            except Exception:  # pylint: disable=broad-except
                continue

    def add(self, data):
        pixels = data.pixel_array
        shared = data.get("SharedFunctionalGroupsSequence", [pydicom.Dataset()])[0]
        groups = data.get("PerFrameFunctionalGroupsSequence", [data])
        for at, group in enumerate(groups):
            def find(sequence, keyword, otherwise=None, group=group):
                for place in (group, shared):
                    if sequence in place:
                        return place[sequence][0].get(keyword, otherwise)
                return data.get(keyword, otherwise)
            iop = numpy.array(find("PlaneOrientationSequence", "ImageOrientationPatient"), float)
            ipp = numpy.array(find("PlanePositionSequence", "ImagePositionPatient"), float)
            rows, columns = (float(x) for x in find("PixelMeasuresSequence", "PixelSpacing"))
            slope = float(find("PixelValueTransformationSequence", "RescaleSlope", 1) or 1)
            intercept = float(find("PixelValueTransformationSequence", "RescaleIntercept", 0) or 0)
            plane = pixels[at] if pixels.ndim == 3 else pixels
            self.frames.append((ipp, iop[:3] * columns, iop[3:] * rows, plane, slope, intercept, data.get("SeriesInstanceUID")))

    def values_at(self, place):
        """Of all frames that have a voxel just there."""
        found = []
        for ipp, along, down, plane, slope, intercept, _ in self.frames:
            axes = numpy.array([along, down]).T
            index = numpy.linalg.lstsq(axes, place - ipp, rcond=None)[0]
            i, j = (int(round(x)) for x in index)
            if 0 <= j < plane.shape[0] and 0 <= i < plane.shape[1]:
                if numpy.abs(ipp + i * along + j * down - place).max() < 0.02:
                    found.append(slope * float(plane[j, i]) + intercept)
        return found


def compare(path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        image = flipfree.read_image(path)
        size = image.voxels.shape[::-1]
        random = numpy.random.default_rng(0)
        indices = numpy.array([random.integers(0, count, VOXELS) for count in size]).T
        texts = []
        for known, reader in ((str(path).endswith((".nii", ".nii.gz")), by_nibabel), (True, by_simpleitk)):
            if not known:
                texts.append("-")
                continue
            try:
                place, value = reader(str(path), image, indices)
                ends = corners(size)
                far = max(numpy.abs(place(a) - b).max() for a, b in zip(ends, own_places(image, ends)))
                differ = sum(not same(float(image.voxels[tuple(index[::-1])]), float(value(index))) for index in indices)
                texts.append(f"{far:.2g} mm, {differ}")
            except Exception as error:  # pylint: disable=broad-except
                texts.append(type(error).__name__)
        if os.path.isdir(path):
            frames = Frames(path)
            places = own_places(image, indices)
            missing = wrong = 0
            for index, place in zip(indices, places):
                values = frames.values_at(place)
                missing += not values
                wrong += bool(values) and not any(same(float(image.voxels[tuple(index[::-1])]), value) for value in values)
            texts.append(f"{missing} elsewhere, {wrong}")
        else:
            texts.append("-")
        return " x ".join(map(str, size)), texts


def main():
    print("| input | voxels | nibabel | SimpleITK | pydicom |\n|---|---|---|---|---|")
    for argument in sys.argv[1:]:
        with tempfile.TemporaryDirectory() as scratch:
            path = Path(argument)
            if path.name.endswith(".tar.gz"):
                with tarfile.open(path) as archive:
                    archive.extractall(scratch)
                path = Path(scratch)
                while len(list(path.iterdir())) == 1 and next(path.iterdir()).is_dir():
                    path = next(path.iterdir())
            try:
                size, texts = compare(path)
            except flipfree.FlipFreeError as error:
                size, texts = "refused", [str(error).replace(str(path), "...")[:160]] + [""] * 2
            print(f"| {Path(argument).name} | {size} | {' | '.join(texts)} |", flush=True)


if __name__ == "__main__":
    main()
