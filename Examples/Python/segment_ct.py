"""Segments one organ of a CT from one seed.

    python3 segment_ct.py                          # the liver of the built-in phantom
    python3 segment_ct.py ct.nii.gz --seed 83 -154 321 --radius 26 --picture liver.png
"""

import flipfree
import inputs
import scene

arguments = inputs.parse(__doc__)
image, seed, radius = inputs.image_and_seed(arguments)

organ = flipfree.segment(image, seed, radius, progress=True)
voxel = image.GetSpacing()[0] * image.GetSpacing()[1] * image.GetSpacing()[2]
print(organ)
print(f"volume: {organ.labels.sum() * voxel / 1000:.0f} ml")

if arguments.picture:
    def view(plane, caption):
        return scene.slice_view([scene.slice_actor(image, seed, plane),
                                 scene.contour_actor(organ.surface, seed, plane)],
                                organ.surface, plane, caption)

    scene.write_picture(arguments.picture, [[
        view(scene.AXIAL, "axial"),
        view(scene.CORONAL, "coronal"),
        scene.space_view([scene.surface_actor(organ.surface, edges=True)], "surface")]])
