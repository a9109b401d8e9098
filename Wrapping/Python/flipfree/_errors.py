"""The package's exceptions, which carry VTK's messages."""


class FlipFreeError(Exception):
    """A filter failed. The message says what, where and what to do."""

    __module__ = "flipfree"


class SegmentationError(FlipFreeError):
    """Seed, image, start surface or a parameter do not allow a segmentation."""

    __module__ = "flipfree"


class EvaluationError(FlipFreeError):
    """Segmentation and reference cannot be compared."""

    __module__ = "flipfree"


class FileError(FlipFreeError, OSError):
    """A file cannot be read or written."""

    __module__ = "flipfree"


class FlipFreeWarning(UserWarning):
    """There is a result, but it is doubtful."""

    __module__ = "flipfree"
