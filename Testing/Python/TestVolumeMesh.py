"""A volume mesher takes the surfaces as they are: TetGen fills each with tetrahedra at the first try."""

import os
import shutil
import subprocess
import tempfile
import unittest

import flipfree
from example import abdomen


def tetrahedra(organ):
    """How many TetGen makes of the certified triangulation; fails if it cannot."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "surface.off")
        with open(path, "w", encoding="ascii") as file:
            file.write(f"OFF\n{len(organ.points)} {len(organ.triangles)} 0\n")
            file.writelines("%.17g %.17g %.17g\n" % tuple(point) for point in organ.points)
            file.writelines("3 %d %d %d\n" % tuple(triangle) for triangle in organ.triangles)
        subprocess.run(["tetgen", "-pQ", path], check=True, timeout=300, capture_output=True)
        with open(os.path.join(folder, "surface.1.ele"), encoding="ascii") as file:
            return int(file.readline().split()[0])


def segmentation_of(shape, label, **parameters):
    phantom = abdomen() if shape == "abdomen" else flipfree.phantom(shape)
    return flipfree.segment(phantom.image, *phantom.seeds[label], **parameters)


@unittest.skipUnless(shutil.which("tetgen"), "TetGen is not installed")
class VolumeMesh(unittest.TestCase):
    def test_valid_surfaces_are_taken(self):
        for shape, label in (("sphere", 1), ("vessel", 1), ("abdomen", flipfree.Organ.LIVER)):
            with self.subTest(shape):
                organ = segmentation_of(shape, label)
                self.assertGreater(tetrahedra(organ), len(organ.points))

    def test_a_surface_that_intersects_itself_is_not(self):
        organ = segmentation_of("vessel", 1, preset="naive")
        self.assertGreater(organ.self_intersections, 0)
        with self.assertRaises(subprocess.CalledProcessError):
            tetrahedra(organ)


if __name__ == "__main__":
    unittest.main()
