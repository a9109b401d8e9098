"""What MeasureVessels prints of methods that FlipFree is compared with."""

import math
import os
import subprocess
import tempfile
import unittest

import flipfree


class MeasureVessels(unittest.TestCase):
    """Other methods beside FlipFree's on the vessel phantom, from the same points and between the same planes."""

    PROGRAM = os.environ["FLIPFREE_MEASURE_VESSELS"]

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        phantom = flipfree.phantom("vessel", dimensions=(64,) * 3, spacing=(1.5,) * 3)
        for image, name in ((phantom.image, "vessel.nii.gz"), (phantom.label_map, "truth.nii.gz")):
            flipfree.write_image(image, os.path.join(cls.folder, name))
        axis = [(47.25 + 36 * place, 47.25 + 16 * math.sin(math.pi * place),
                 47.25 + 10 * math.cos(0.8 * math.pi * place + 0.5)) for place in (-0.8, 0.8)]
        with open(os.path.join(cls.folder, "tubes.csv"), "w", encoding="utf-8") as file:
            file.write("case,organ,role,image,labels,label_id,x1,y1,z1,r1,x2,y2,z2,r2,x3,y3,z3,r3\n")
            points = ",".join(f"{x},{y},{z},4" for x, y, z in axis)
            file.write(f"volume-vessel,vessel,tube,vessel.nii.gz,truth.nii.gz,1,{points},,,,\n")
        with open(os.path.join(cls.folder, "halves.csv"), "w", encoding="utf-8") as file:
            file.write("volume,half\nvolume,B\n")

    def table(self, *options):
        """Rows of the last table, by vessels and method."""
        halves = os.path.join(self.folder, "halves.csv")
        process = subprocess.run([self.PROGRAM, "--data", self.folder, "--halves", halves, *options],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=True)
        lines = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in process.stdout.split("\n")]
        return {tuple(line[:2]): [float(cell) for cell in line[2:]] for line in lines if len(line) == 7 and
                line[0].endswith(")")}

    def test_each_method_has_a_row(self):
        names = ("region-growing", "graph-cut-volume")
        table = self.table("--methods", *names)
        self.assertEqual(set(table), {(vessels, name) for vessels in ("vessel (1)", "vessel B (1)")
                                      for name in ("flipfree", *names)})
        for row, (dice, least, distance, seconds, ratio) in table.items():
            with self.subTest(row=row):
                self.assertEqual(dice, least)
                self.assertGreater(dice, 0.8)
                self.assertTrue(0 < distance < 2, distance)
                self.assertEqual(ratio == 1, row[1] == "flipfree")

    def test_nothing_found_has_no_distance(self):
        row = self.table("--methods", "region-growing", "--set", "SeedRadius=0.01")["vessel (1)", "region-growing"]
        self.assertEqual(row[:2], [0, 0])
        self.assertTrue(all(math.isnan(number) for number in row[2:]), row)

    def test_a_table_without_vessels_is_named(self):
        process = subprocess.run([self.PROGRAM, "--data", self.folder, "--cases", "none.csv"], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(process.returncode, 1)
        self.assertEqual(process.stderr, f"MeasureVessels: there is no vessel in '{self.folder}/none.csv'\n")


if __name__ == "__main__":
    unittest.main()
