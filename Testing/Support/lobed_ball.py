"""A ball with a lobe on a neck, of which a segmentation is not sure, without any package."""

import array

SIZE = (80, 48, 48)
SPACING = (2, 2, 2)
SEED = (48, 47, 47)
RADIUS = 18
LOBE = (100, 46, 46)  # nearly the deepest place behind the neck


def lobed_ball(brighter):
    """The voxels, as shorts. Of the same gray value, the lobe is kept; a little brighter, it is cut off."""
    voxels = array.array("h")
    state = 1
    for k in range(SIZE[2]):
        for j in range(SIZE[1]):
            off_axis = (2 * j - 47) ** 2 + (2 * k - 47) ** 2
            for i in range(SIZE[0]):
                x = 2 * i
                behind = x > 78 and ((x - 106) ** 2 + off_axis < 24 ** 2 or (x < 106 and off_axis < 11 ** 2))
                inside = behind or (x - 48) ** 2 + off_axis < 30 ** 2 or (48 < x < 106 and off_axis < 11 ** 2)
                state = (state * 1664525 + 1013904223) & 0xFFFFFFFF
                voxels.append(20 + 80 * inside + brighter * behind + (state >> 16) % 25 - 12)
    return voxels
