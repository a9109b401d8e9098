"""Label maps as other programs write them, for tests of the command, without any package."""

import gzip
import struct


def read_nifti(path):
    """The size and the bytes of a .nii.gz file of bytes."""
    with gzip.open(path) as file:
        data = file.read()
    offset = int(struct.unpack_from("<f", data, 108)[0])
    return struct.unpack_from("<3h", data, 42), data[offset:]


def write_nrrd(path, size, steps, origin, voxels, pairs=None):
    """A .nrrd file in LPS; `steps` are the axes, of layers None first, and pairs those of Slicer."""
    axes = " ".join("none" if step is None else "({},{},{})".format(*step) for step in steps)
    kinds = " ".join("list" if step is None else "domain" for step in steps)
    fields = ["NRRD0004", "type: uint8", f"dimension: {len(size)}", "space: left-posterior-superior",
              "sizes: " + " ".join(map(str, size)), f"space directions: {axes}", f"kinds: {kinds}", "encoding: raw",
              "space origin: ({},{},{})".format(*origin)]
    fields += [f"{key}:={value}" for key, value in (pairs or {}).items()]
    with open(path, "wb") as file:
        file.write("\n".join(fields).encode() + b"\n\n" + bytes(voxels))


def write_layers(path, size, spacing, layers):
    """A segmentation of 3D Slicer with a layer for each of (names by label, voxels)."""
    pairs = {}
    for layer, (names, _) in enumerate(layers):
        for label, name in names.items():
            start = f"Segment{len(pairs) // 4}_"
            pairs.update({start + "ID": name, start + "Name": name, start + "LabelValue": label, start + "Layer": layer})
    steps = [None, (spacing[0], 0, 0), (0, spacing[1], 0), (0, 0, spacing[2])]
    voxels = bytearray(len(layers) * len(layers[0][1]))
    for layer, (_, labels) in enumerate(layers):
        voxels[layer::len(layers)] = labels
    write_nrrd(path, (len(layers), *size), steps, (0, 0, 0), voxels, pairs)


def write_turned(path, size, spacing, voxels, crop=2):
    """The label map without its first slices, its axes in the order z, x, y, the last one backwards."""
    columns, rows, slices = size
    turned = bytearray()
    for j in reversed(range(rows)):
        for i in range(columns):
            turned += bytes(voxels[i + columns * (j + rows * k)] for k in range(crop, slices))
    steps = [(0, 0, spacing[2]), (spacing[0], 0, 0), (0, -spacing[1], 0)]
    write_nrrd(path, (slices - crop, columns, rows), steps, (0, (rows - 1) * spacing[1], crop * spacing[2]), turned)
