"""Writes a small DICOM series, by hand: explicit little endian, one file per slice."""

import os
import struct

import numpy

LONG = ("OB", "OW")


def element(group, number, kind, value):
    if isinstance(value, str):
        value = value.encode() + b" " * (len(value) % 2)
        if kind == "UI":
            value = value.replace(b" ", b"\0")
    elif isinstance(value, int):
        value = struct.pack("<H", value)
    length = struct.pack("<HI", 0, len(value)) if kind in LONG else struct.pack("<H", len(value))
    return struct.pack("<HH", group, number) + kind.encode() + length + value


def write_series(folder, volume, spacing, origin, series, prefix="slice"):
    """A volume of short, indexed [z, y, x]; spacing and origin along x, y, z."""
    for index, pixels in enumerate(volume.astype("<i2")):
        instance = f"{series}.{index + 1}"
        position = (origin[0], origin[1], origin[2] + index * spacing[2])
        meta = b"".join([
            element(2, 1, "OB", b"\0\1"), element(2, 2, "UI", "1.2.840.10008.5.1.4.1.1.2"),
            element(2, 3, "UI", instance), element(2, 0x10, "UI", "1.2.840.10008.1.2.1"),
            element(2, 0x12, "UI", series)])
        data = b"".join([
            element(8, 0x16, "UI", "1.2.840.10008.5.1.4.1.1.2"), element(8, 0x18, "UI", instance),
            element(8, 0x60, "CS", "CT"), element(0x20, 0xD, "UI", series + ".0"),
            element(0x20, 0xE, "UI", series), element(0x20, 0x13, "IS", str(index + 1)),
            element(0x20, 0x32, "DS", "\\".join(map(str, position))),
            element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0"), element(0x20, 0x52, "UI", series + ".9"),
            element(0x28, 2, "US", 1), element(0x28, 4, "CS", "MONOCHROME2"),
            element(0x28, 0x10, "US", pixels.shape[0]), element(0x28, 0x11, "US", pixels.shape[1]),
            element(0x28, 0x30, "DS", f"{spacing[1]}\\{spacing[0]}"), element(0x28, 0x100, "US", 16),
            element(0x28, 0x101, "US", 16), element(0x28, 0x102, "US", 15), element(0x28, 0x103, "US", 1),
            element(0x28, 0x1052, "DS", "0"), element(0x28, 0x1053, "DS", "1"),
            element(0x7FE0, 0x10, "OW", numpy.ascontiguousarray(pixels).tobytes())])
        with open(os.path.join(folder, f"{prefix}{len(volume) - index:03}"), "wb") as file:  # in no order
            file.write(b"\0" * 128 + b"DICM" + element(2, 0, "UL", struct.pack("<I", len(meta))) + meta + data)
