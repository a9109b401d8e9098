"""Volumes with voxels that are no numbers."""

import array
import gzip
import math
import os
import struct
import unittest

import command


class TestNoData(command.CommandTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        with gzip.open(cls.volume) as file:
            data = file.read()
        cls.size = struct.unpack("<3h", data[42:48])
        cls.spacing = struct.unpack("<3f", data[80:92])
        voxels = array.array({4: "h", 16: "f"}[struct.unpack("<h", data[70:72])[0]])
        voxels.frombytes(data[352:])
        cls.voxels = array.array("f", voxels)

    def write(self, name, value):
        """As NRRD of floats, value(place, gray value) in each voxel."""
        columns, rows, slices = self.size
        places = ((i, j, k) for k in range(slices) for j in range(rows) for i in range(columns))
        voxels = array.array("f", map(value, places, self.voxels))
        axes = " ".join(f"({x},{y},{z})" for x, y, z in zip(*([length if axis == along else 0 for along in range(3)]
                                                                for axis, length in enumerate(self.spacing))))
        header = ("NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nendian: little\nencoding: raw\n"
                  f"sizes: {columns} {rows} {slices}\nspace directions: {axes}\nspace origin: (0,0,0)\n\n")
        path = os.path.join(self.inputs, name)
        with open(path, "wb") as file:
            file.write(header.encode() + voxels.tobytes())
        return path

    def segment(self, name, *more):
        return command.run("segment", name, *self.seed, "-o", self.result("out.vtp"), *more)

    def test_seeds_and_points_without_data(self):
        x, y, z, radius = map(float, (*self.seed[1:4], self.seed[5]))
        last = int((x + radius) / self.spacing[0]) + 2
        name = self.write("cut.nrrd", lambda place, gray: gray if place[0] < last else math.nan)
        far = (x + radius + 4, y, z)
        for kind in ("inside", "boundary"):
            self.assert_refused(self.segment(name, f"--{kind}", *far), 1, f"the {kind} point",
                                "touches a voxel without data")
        hole = self.write("hole.nrrd", lambda place, gray: math.nan if place[0] == last - 4 else gray)
        self.assert_refused(self.segment(hole), 1, "the seed sphere touches a voxel without data", "move --seed")
        beside = self.segment(name, "--outside", *far)
        self.assertEqual(beside.returncode, 0, beside.stderr)
        self.assertRegex(beside.stderr,
                         r"flipfree: warning: \d+ % of the surface lies where the image has no data")


if __name__ == "__main__":
    unittest.main()
