"""Files: this package, which pip has built without VTK and ITK, reads and writes none."""

from __future__ import annotations

from ._errors import FileError
from ._image import Image
from ._types import PathName, ProgressOption

REASON = (
    "this flipfree, which was installed by pip, reads and writes no image files: use SimpleITK or "
    "nibabel, and give segment() and evaluate() arrays with spacing, origin and direction"
)


def read_image(
    path: PathName, *, series: str | None = None, progress: ProgressOption = None
) -> Image:
    """Raises FileError: this package reads no files.

    >>> import flipfree
    >>> flipfree.read_image("abdomen.nii.gz")
    Traceback (most recent call last):
      ...
    flipfree.FileError: 'abdomen.nii.gz': this flipfree, which was installed by pip, reads and ...
    """
    raise FileError(f"'{path}': {REASON}")


def write_image(image: Image, path: PathName) -> None:
    """Raises FileError: this package writes no files.

    >>> import flipfree
    >>> flipfree.write_image(flipfree.phantom("sphere").label_map, "truth.nii.gz")
    Traceback (most recent call last):
      ...
    flipfree.FileError: 'truth.nii.gz': this flipfree, which was installed by pip, reads and ...
    """
    raise FileError(f"'{path}': {REASON}")
