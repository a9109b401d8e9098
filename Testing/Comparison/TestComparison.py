"""What Table 1 makes of runs: of those that found nothing, that were not made, and that broke down."""

import math
import os
import stat
import subprocess
import tempfile
import unittest

import flipfree
from comparison import cases, methods, runs, scores, tables

FLIPFREE, SNAKE = methods.METHODS[0], methods.METHODS[-1]


def row(case, method, dice, **others):
    """A row of scores.csv; nothing was found where `dice` is zero."""
    number = math.nan if dice == 0 else 1.0
    return {"case": case, "organ": "kidney", "scored": 1, "method": method.key, "volume_ml": 100.0, "slices": 10,
            "failed": int(dice == 0), "dice": dice, "jaccard": dice / (2 - dice), "asd": number, "hd95": number,
            "self_intersections": 0.0, "iterations": number, "segment_s": number, "wall_s": 2.0, "cpu_s": 2.0,
            "memory_mb": number, **others}


class Tables(unittest.TestCase):
    def setUp(self):
        self.rows = [row("left", FLIPFREE, 0.9), row("right", FLIPFREE, 0.8),
                     row("left", SNAKE, 0.7, segment_s=4.0, iterations=100.0), row("right", SNAKE, 0)]

    def test_what_was_not_run_did_not_find_nothing(self):
        lines = tables.case_table(self.rows[1:], [FLIPFREE, SNAKE])
        self.assertEqual(lines[2:], ["| right | 0.800 / 1.0 | nothing |", "| left | - | 0.700 / 1.0 |"])

    def test_nothing_found_counts_as_no_overlap_and_has_no_seconds(self):
        line = tables.paper_table(self.rows, [FLIPFREE, SNAKE])[-1].split(" | ")
        distance, overlap, iterations, seconds = line[3:7]
        self.assertEqual((distance, iterations, seconds), ("1.00 ± 0.00", "100 ± 0", "4.00 ± 0.00"))
        self.assertEqual(overlap, tables.spread([70 / 1.3, 0]))

    def test_medians_are_of_all_rows(self):
        line = tables.median_table(self.rows, [FLIPFREE, SNAKE])[-1].strip("| ").split(" | ")
        self.assertEqual(line[1:4], ["0.350", "0.350", "0.000"])  # kidneys alone, all, the least
        self.assertEqual(line[-2:], ["1.0", "1.0"])

    def test_each_organ_that_is_there_has_a_column_in_both_modalities(self):
        rows = [*self.rows, row("other", FLIPFREE, 0.6, organ="mr-liver")]
        lines = tables.median_table(rows, [FLIPFREE])
        self.assertEqual(lines[0].strip("| ").split(" | ")[1:5], ["Dice, kidney", "MR liver", "all", "minimum"])
        self.assertEqual(lines[-1].strip("| ").split(" | ")[1:5], ["0.850", "0.600", "0.800", "0.600"])

    def test_median_times_leave_out_what_is_no_number(self):
        record = {"wall_s": "3", "cpu_s": "2"}
        missing = {name: "nan" for name in ("iterations", "segment_s", "memory_mb")}
        found = {name: "5" for name in missing}
        times = scores.median_times([{**record, **missing}, {**record, **found}, {**record, **found}])
        self.assertEqual(times["segment_s"], 5)
        self.assertTrue(math.isnan(scores.median_times([{**record, **missing}])["segment_s"]))
        self.assertEqual(scores.median_times([{**record, **missing}])["wall_s"], 3)


class Lists(unittest.TestCase):
    def test_rows_come_from_the_lists_that_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            fields = "case,organ,image,labels,label_id,seed_x,seed_y,seed_z,radius_mm\n"
            for name, organ in (("cases", "liver"), ("more", "mr-spleen"), ("vessels", "aorta")):
                with open(os.path.join(folder, name + ".csv"), "w", encoding="utf-8") as file:
                    file.write(fields + f"{name}-1,{organ},a.nii,b.nii,3,1,2,3,4\n")
            found = cases.all_cases(folder, ["more.csv", "vessels.csv"], folder)
            self.assertEqual([(case.name, case.scored) for case in found], [("more-1", True), ("vessels-1", False)])
            self.assertEqual(cases.all_cases(os.path.join(folder, "none"), ["cases.csv"], folder), [])
            with self.assertRaises(FileNotFoundError):
                cases.all_cases(folder, ["mroe.csv"], folder)


class Runs(unittest.TestCase):
    def run_program(self, script, files=()):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "case"))
            for name in files:
                with open(os.path.join(folder, "case", name), "w", encoding="utf-8"):
                    pass
            program = os.path.join(folder, "program")
            with open(program, "w", encoding="utf-8") as file:
                file.write("#!/bin/sh\n" + script)
            os.chmod(program, os.stat(program).st_mode | stat.S_IXUSR)
            case = cases.Case("case", "liver", "image", "labels", 1, (0, 0, 0), 5)
            return runs.run(program, case, FLIPFREE, folder)

    def test_what_is_printed_is_recorded(self):
        record = self.run_program("echo 12 0.5 1.25 99.5")
        self.assertEqual((record["failed"], record["iterations"], record["segment_s"]), (0, "12", "1.25"))

    def test_nothing_found_is_a_result(self):
        record = self.run_program("exit 1")
        self.assertEqual((record["failed"], record["iterations"], record["segment_s"]), (1, "nan", "nan"))
        self.assertGreater(float(record["wall_s"]), 0)

    def test_what_is_not_the_methods_fault_is_none(self):
        for script, message in (("exit 2", "ended with 2"), ("kill -SEGV $$", "ended by signal 11")):
            with self.assertRaisesRegex(SystemExit, message):
                self.run_program(script)

    def test_results_of_an_earlier_round_are_not_those_of_this_one(self):
        names = [FLIPFREE.key + end for end in (".mha", ".vtp", ".csv")]
        lines = [f'[ -e "$(dirname "$0")/case/{name}" ] && exit 2' for name in names]
        self.run_program("\n".join([*lines, "exit 1"]), names)


class RunMethod(unittest.TestCase):
    """The program itself, on a box of 40 x 40 x 40 mm at 100 in 64 x 64 x 64 mm of 0 (or all of it at 100)."""

    PROGRAM = os.environ["FLIPFREE_RUN_METHOD"]

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.box = cls.write("box.mha", lambda *voxel: all(6 <= index < 26 for index in voxel))
        cls.uniform = cls.write("uniform.mha", lambda *voxel: True)

    @classmethod
    def write(cls, name, is_inside):
        path = os.path.join(cls.folder, name)
        header = ("ObjectType = Image\nNDims = 3\nDimSize = 32 32 32\nElementSpacing = 2 2 2\nOffset = 0 0 0\n"
                  "TransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                  "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n")
        with open(path, "wb") as file:
            file.write(header.encode())
            file.write(bytes(100 if is_inside(x, y, z) else 0
                             for z in range(32) for y in range(32) for x in range(32)))
        return path

    def status(self, method, image, *options, seed=(32, 32, 32)):
        return subprocess.run([self.PROGRAM, method, image, "--seed", *map(str, seed), "--radius", "8", *options],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)

    def test_ends_well_with_its_results_written(self):
        for method in (FLIPFREE.key, "region-growing"):
            paths = [os.path.join(self.folder, method + end) for end in (".mha", ".vtp")]
            process = self.status(method, self.box, "--labels", paths[0], "--surface", paths[1])
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertEqual(len(process.stdout.split()), 4)
            self.assertTrue(all(os.path.getsize(path) > 100 for path in paths))

    def test_nothing_found_is_the_methods_verdict(self):
        process = self.status(FLIPFREE.key, self.uniform)
        self.assertEqual(process.returncode, 1, process.stderr)
        self.assertIn("no contrast", process.stderr)

    def test_a_seed_outside_the_image_is_not(self):
        for method in methods.METHODS:
            process = self.status(method.key, self.box, seed=(500, 32, 32))
            self.assertEqual(process.returncode, 2, process.stderr)
            self.assertIn("lies outside", process.stderr)

    def test_neither_is_an_image_that_cannot_be_read(self):
        self.assertEqual(self.status(FLIPFREE.key, os.path.join(self.folder, "none.mha")).returncode, 2)

    def test_neither_are_results_that_cannot_be_written(self):
        for option in ("--labels", "--surface"):
            process = self.status("region-growing", self.box, option, os.path.join(self.folder, "none", "file.vtp"))
            self.assertEqual(process.returncode, 2, process.stderr)
            self.assertIn("cannot be written", process.stderr)


if __name__ == "__main__":
    unittest.main()
