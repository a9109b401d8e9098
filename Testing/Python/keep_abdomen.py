"""Keeps the abdomen phantom in a file, from which example.abdomen() takes it: making it takes seconds, in each test anew.

  keep_abdomen.py FILE.npz
"""

import sys

import flipfree
import numpy
from example import SIZE, SPACING, axes_of

phantom = flipfree.phantom("abdomen", dimensions=SIZE, spacing=SPACING)
numpy.savez(
    sys.argv[1],
    image=flipfree.array_from_image(phantom.image),
    label_map=flipfree.array_from_image(phantom.label_map),
    spacing=phantom.image.GetSpacing(),
    origin=phantom.image.GetOrigin(),
    direction=axes_of(phantom.image),
    seeds=[(label, *center, radius) for label, (center, radius) in phantom.seeds.items()])
