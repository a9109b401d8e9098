"""Writes small DICOM files, by hand: explicit little endian."""

import os
import struct

import numpy

LONG = ("OB", "OW", "SQ")
CT, ENHANCED_CT = "1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.5.1.4.1.1.2.1"
AXIAL = "1\\0\\0\\0\\1\\0"


def element(group, number, kind, value):
    if isinstance(value, str):
        value = value.encode() + b" " * (len(value) % 2)
        if kind == "UI":
            value = value.replace(b" ", b"\0")
    elif isinstance(value, int):
        value = struct.pack("<H", value)
    length = struct.pack("<HI", 0, len(value)) if kind in LONG else struct.pack("<H", len(value))
    return struct.pack("<HH", group, number) + kind.encode() + length + value


def sequence(group, number, *items):
    """Of items that are elements."""
    return element(group, number, "SQ", b"".join(
        struct.pack("<HHI", 0xFFFE, 0xE000, len(item)) + item for item in items))


def write_file(path, data, storage, instance):
    """A data set, after what stands before each."""
    meta = b"".join([
        element(2, 1, "OB", b"\0\1"), element(2, 2, "UI", storage),
        element(2, 3, "UI", instance), element(2, 0x10, "UI", "1.2.840.10008.1.2.1"),
        element(2, 0x12, "UI", instance)])
    with open(path, "wb") as file:
        file.write(b"\0" * 128 + b"DICM" + element(2, 0, "UL", struct.pack("<I", len(meta))) + meta + data)


def pixel_elements(pixels):
    """Of one or several frames of short."""
    return b"".join([
        element(0x28, 0x10, "US", pixels.shape[-2]), element(0x28, 0x11, "US", pixels.shape[-1]),
        element(0x28, 0x100, "US", 16), element(0x28, 0x101, "US", 16), element(0x28, 0x102, "US", 15),
        element(0x28, 0x103, "US", 1)])


def write_series(folder, volume, spacing, origin, series, prefix="slice"):
    """A volume of short, indexed [z, y, x], one file per slice; spacing and origin along x, y, z."""
    for index, pixels in enumerate(volume.astype("<i2")):
        instance = f"{series}.{index + 1}"
        position = (origin[0], origin[1], origin[2] + index * spacing[2])
        data = b"".join([
            element(8, 0x16, "UI", CT), element(8, 0x18, "UI", instance),
            element(8, 0x60, "CS", "CT"), element(0x20, 0xD, "UI", series + ".0"),
            element(0x20, 0xE, "UI", series), element(0x20, 0x13, "IS", str(index + 1)),
            element(0x20, 0x32, "DS", "\\".join(map(str, position))),
            element(0x20, 0x37, "DS", AXIAL), element(0x20, 0x52, "UI", series + ".9"),
            element(0x28, 2, "US", 1), element(0x28, 4, "CS", "MONOCHROME2"),
            element(0x28, 0x30, "DS", f"{spacing[1]}\\{spacing[0]}"), pixel_elements(pixels),
            element(0x28, 0x1052, "DS", "0"), element(0x28, 0x1053, "DS", "1"),
            element(0x7FE0, 0x10, "OW", numpy.ascontiguousarray(pixels).tobytes())])
        name = f"{prefix}{len(volume) - index:03}"  # in no order
        write_file(os.path.join(folder, name), data, CT, instance)


def write_stacks(path, volumes, spacing, series):
    """Volumes of one grid as the stacks of an enhanced CT file; its frames take turns."""
    frames = numpy.stack(volumes, axis=1).astype("<i2")
    groups = [
        sequence(0x20, 0x9111, element(0x20, 0x9056, "SH", str(stack + 1)))
        + sequence(0x20, 0x9113, element(0x20, 0x32, "DS", f"0\\0\\{z * spacing[2]}"))
        for z, stack in numpy.ndindex(frames.shape[:2])]
    shared = (sequence(0x20, 0x9116, element(0x20, 0x37, "DS", AXIAL))
              + sequence(0x28, 0x9110, element(0x28, 0x30, "DS", f"{spacing[1]}\\{spacing[0]}"))
              + sequence(0x28, 0x9145, element(0x28, 0x1052, "DS", "0") + element(0x28, 0x1053, "DS", "1")))
    data = b"".join([
        element(8, 8, "CS", "ORIGINAL\\PRIMARY\\VOLUME\\NONE"), element(8, 0x16, "UI", ENHANCED_CT),
        element(8, 0x18, "UI", series + ".1"), element(8, 0x60, "CS", "CT"), element(0x20, 0xD, "UI", series + ".0"),
        element(0x20, 0xE, "UI", series), element(0x28, 2, "US", 1), element(0x28, 4, "CS", "MONOCHROME2"),
        element(0x28, 8, "IS", str(len(groups))), pixel_elements(frames), sequence(0x5200, 0x9229, shared),
        sequence(0x5200, 0x9230, *groups), element(0x7FE0, 0x10, "OW", frames.tobytes())])
    write_file(path, data, ENHANCED_CT, series + ".1")
