"""What goes wrong, as exceptions that carry VTK's message."""


class FlipFreeError(Exception):
    """A filter failed. The message says what, where and what to do."""

    __module__ = "flipfree"


class SegmentationError(FlipFreeError):
    """There is no segmentation: of the seed, the image, the start surface or a parameter."""

    __module__ = "flipfree"


class EvaluationError(FlipFreeError):
    """Segmentation and reference cannot be compared."""

    __module__ = "flipfree"


class FileError(FlipFreeError, OSError):
    """A file cannot be read or written."""

    __module__ = "flipfree"


class FlipFreeWarning(UserWarning):
    """There is a result, and something about it to know."""

    __module__ = "flipfree"
