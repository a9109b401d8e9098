"""Images of other packages: those of SimpleITK, nibabel and VTK are taken as they are.

None of these packages is imported here, or needed: an image of theirs brings it along.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, Union

from ._arrays import image_from_array
from ._coordinates import swap_lps_ras

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._images import Image


class SimpleITKImage(Protocol):
    """A SimpleITK.Image, in LPS millimeters."""

    def GetSpacing(self) -> Any: ...

    def GetDirection(self) -> Any: ...


class NibabelImage(Protocol):
    """Such as a nibabel.Nifti1Image: voxels [i, j, k] and the matrix that takes them to RAS."""

    @property
    def affine(self) -> Any: ...

    @property
    def dataobj(self) -> Any: ...


class VtkImage(Protocol):
    """A vtkImageData of any VTK, such as a pyvista.ImageData."""

    def GetDirectionMatrix(self) -> Any: ...

    def GetPointData(self) -> Any: ...


ForeignImage = Union[SimpleITKImage, NibabelImage, VtkImage]


def is_foreign(thing: Any) -> bool:
    """Whether it is an image of another package."""
    return _is_simpleitk(thing) or _is_nibabel(thing) or _is_vtk(thing)


def adopted(name: str, thing: Any) -> Image:
    """The image as the package's own; voxels are shared where they can be."""
    if _is_simpleitk(thing):
        return _from_simpleitk(name, thing)
    return _from_nibabel(name, thing) if _is_nibabel(thing) else _from_vtk(name, thing)


def _is_simpleitk(thing: Any) -> bool:
    return type(thing).__module__.partition(".")[0] == "SimpleITK" and hasattr(thing, "GetDirection")


def _is_nibabel(thing: Any) -> bool:
    return hasattr(thing, "affine") and hasattr(thing, "dataobj")


def _is_vtk(thing: Any) -> bool:
    return hasattr(thing, "GetDirectionMatrix") and hasattr(thing, "GetPointData")


def _from_simpleitk(name: str, image: Any) -> Image:
    from SimpleITK import GetArrayFromImage

    if image.GetDimension() != 3 or image.GetNumberOfComponentsPerPixel() != 1:
        raise ValueError(
            f"{name}: a SimpleITK image of {image.GetDimension()} dimensions and "
            f"{image.GetNumberOfComponentsPerPixel()} components; 3 and 1 are needed: take a volume "
            "or a component of it"
        )
    return image_from_array(
        GetArrayFromImage(image), image.GetSpacing(), image.GetOrigin(), image.GetDirection()
    )


def _from_nibabel(name: str, image: Any) -> Image:
    """NIfTI's axes point to the right, front and head; LPS millimeters are the package's."""
    import numpy

    voxels = numpy.asanyarray(image.dataobj)
    while voxels.ndim > 3 and voxels.shape[-1] == 1:
        voxels = voxels[..., 0]
    if voxels.ndim != 3 or image.affine is None:
        raise ValueError(
            f"{name}: a nibabel image of shape {voxels.shape}"
            f"{' without an affine' if image.affine is None else ''}; a volume with an affine is "
            "needed (nibabel.four_to_three takes a series apart)"
        )
    return image_from_affine(name, voxels.T, _millimeters(image) * numpy.asarray(image.affine))


def image_from_affine(name: str, voxels: npt.NDArray[Any], affine: npt.NDArray[Any]) -> Image:
    """The voxels array[k, j, i], whose indices (i, j, k) the 4 x 4 matrix takes to RAS millimeters.

    The axes may be oblique. `name` is the argument's, for the error that the matrix has no inverse.
    """
    import numpy

    # Without negative zeros.
    matrix: Any = numpy.array(swap_lps_ras(affine)) + 0.0
    axes, origin = matrix[:, :3], matrix[:, 3]
    spacing = numpy.sqrt((axes**2).sum(axis=0))
    if not numpy.isfinite(matrix).all() or not abs(numpy.linalg.det(axes)) > 1e-9 * spacing.prod():
        raise ValueError(f"{name}: its affine cannot be inverted; correct it:\n{affine}")
    return image_from_array(voxels, spacing, origin, axes / spacing)


def _millimeters(image: Any) -> float:
    """What a unit of the affine is; most files do not say, and mean millimeters."""
    units = getattr(image.header, "get_xyzt_units", None)
    unit: str = units()[0] if units else "mm"
    return {"meter": 1000.0, "micron": 0.001}.get(unit, 1.0)


def _from_vtk(name: str, image: Any) -> Image:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    scalars = image.GetPointData().GetScalars()
    if scalars is None or scalars.GetNumberOfComponents() != 1:
        raise ValueError(
            f"{name}: the points of the vtkImageData have "
            f"{'no scalars' if scalars is None else 'scalars of several components'}; set the "
            "active scalars, one number per point (in PyVista, cells_to_points() makes points of cells)"
        )
    extent = image.GetExtent()
    origin = [0.0, 0.0, 0.0]
    image.TransformIndexToPhysicalPoint(extent[::2], origin)
    matrix = image.GetDirectionMatrix()
    axes = [matrix.GetElement(row, column) for row in range(3) for column in range(3)]
    voxels = vtk_to_numpy(scalars).reshape(image.GetDimensions()[::-1])
    return image_from_array(voxels, image.GetSpacing(), origin, axes)
