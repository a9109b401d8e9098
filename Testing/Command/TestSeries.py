"""Folders of DICOM files: what is in them, which series is read, and how it is found again."""

import csv
import json
import os
import shutil
import sys
import unittest

import numpy

import command

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Support"))

import dicom  # pylint: disable=wrong-import-position

FIRST, SECOND = "1.2.826.0.1.3680043.2.1143.79.1", "1.2.826.0.1.3680043.2.1143.79.2"
SEED = ("--seed", 20, 18, 24, "--radius", 8)


def ball(radius):
    """Bright in the dark, with a little noise."""
    z, y, x = numpy.mgrid[:24, :36, :40] * numpy.array([2.0, 1.0, 1.0])[:, None, None, None]
    inside = (x - 20) ** 2 + (y - 18) ** 2 + (z - 24) ** 2 < radius**2
    return numpy.where(inside, 100, -50) + numpy.random.default_rng(1).normal(0, 5, inside.shape).round()


class TestSeries(command.CommandTest):
    def setUp(self):
        super().setUp()
        self.folder = os.path.join(self.inputs, "dicom")
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        dicom.write_series(self.folder, ball(13), (1, 1, 2), (0, 0, 0), FIRST, "a")
        dicom.write_series(self.folder, ball(11), (1, 1, 2), (0, 0, 0), SECOND, "b")

    def segment(self, *options, name="out.ply"):
        return command.run("segment", self.folder, *SEED, *options, "-o", self.result(name))

    def bytes_of(self, name):
        with open(self.result(name), "rb") as file:
            return file.read()

    def test_the_list(self):
        process = command.run("series", self.folder)
        self.assert_succeeds(process)
        lines = process.stdout.splitlines()
        self.assertEqual(lines[0].split(), ["Number", "UID", "Modality", "Slices", "Spacing", "(mm)", "Description"])
        for line, uid in zip(lines[1:], (FIRST, SECOND)):
            self.assertRegex(line, rf"^ +{uid} +CT +24 +1 x 1 x 2 *$")
        self.assert_succeeds(command.run("series", self.folder, "--quiet", "--csv", self.result("list.csv")))
        with open(self.result("list.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([(row["uid"], row["slices"], row["spacing_z"], row["problem"]) for row in rows],
                         [(FIRST, "24", "2", ""), (SECOND, "24", "2", "")])

    def test_a_series_that_cannot_be_read_is_listed_with_the_reason(self):
        os.remove(os.path.join(self.folder, "b012"))
        process = command.run("series", self.folder)
        self.assertEqual(process.returncode, 0)
        self.assertRegex(process.stdout, rf"{SECOND} +CT +23 +- ")
        self.assertRegex(process.stderr, rf"^flipfree: warning: Series {SECOND}: 1 slice is missing")

    def test_the_series_is_named_recorded_and_repeated(self):
        process = self.segment()
        self.assert_succeeds(process)
        self.assertIn(f"series {FIRST}:", process.stdout)
        os.remove(self.result("out.ply"))
        session = os.path.join(self.inputs, "dicom-session.json")
        process = self.segment("--series", SECOND, "--save-session", session)
        self.assert_succeeds(process)
        self.assertIn(f"series {SECOND}:", process.stdout)
        with open(session, encoding="utf-8") as file:
            image = json.load(file)["image"]
        self.assertEqual((image["name"], image["series"]), ("dicom", SECOND))
        process = command.run("segment", "--session", session, "-o", self.result("again.ply"))
        self.assert_succeeds(process)
        self.assertEqual(self.bytes_of("again.ply"), self.bytes_of("out.ply"))

    def test_what_is_left_out_is_a_warning(self):
        shutil.copy(os.path.join(self.folder, "a012"), os.path.join(self.folder, "a012 (1)"))
        process = self.segment()
        self.assertEqual(process.returncode, 0)
        self.assertRegex(process.stderr, r"\Aflipfree: warning: In the folder '[^']+', 1 file is left out: 1 the same slice "
                                         r"again \('a012 \(1\)'\)\.\n\Z")

    def test_a_cd_with_a_damaged_directory(self):
        disk = os.path.join(self.inputs, "disk")
        shutil.rmtree(disk, ignore_errors=True)
        shutil.copytree(self.folder, os.path.join(disk, "IMAGES", "S1"))
        self.assert_refused(command.run("series", disk), 1, "holds no DICOM image")
        with open(os.path.join(disk, "DICOMDIR"), "wb") as file:
            file.write(bytes(128) + b"DICM" + b"\2\0")
        process = command.run("series", disk)
        self.assert_succeeds(process)
        self.assertEqual([line.split()[0] for line in process.stdout.splitlines()[1:]], [FIRST, SECOND])

    def test_a_file_of_several_stacks(self):
        path = os.path.join(self.inputs, "stacks", "stacks.dcm")
        os.makedirs(os.path.dirname(path), exist_ok=True)
        dicom.write_stacks(path, [ball(13), ball(11)], (1, 1, 2), FIRST)
        process = command.run("series", path)
        self.assert_succeeds(process)
        self.assertEqual([line.split()[:3] for line in process.stdout.splitlines()[1:]],
                         [[FIRST + "#1", "CT", "24"], [FIRST + "#2", "CT", "24"]])

        def segment(*options):
            return command.run("segment", path, *SEED, *options, "-o", self.result("out.ply"))

        surfaces = []
        for stack in ("#1", "#2"):
            process = segment("--series", FIRST + stack)
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertIn(f"series {FIRST}{stack}:", process.stdout)
            surfaces.append(self.bytes_of("out.ply"))
            os.remove(self.result("out.ply"))
        for surface, prefix in zip(surfaces, "ab"):  # of the same voxels in a folder
            folder = os.path.join(self.inputs, prefix)
            os.makedirs(folder, exist_ok=True)
            for name in filter(lambda name: name[0] == prefix, os.listdir(self.folder)):
                shutil.copy(os.path.join(self.folder, name), folder)
            self.assert_succeeds(command.run("segment", folder, *SEED, "-o", self.result("out.ply")))
            self.assertEqual(surface, self.bytes_of("out.ply"))
            os.remove(self.result("out.ply"))
        self.assert_refused(segment(), 1, f"Series {FIRST} holds 2 volumes", FIRST + "#1")
        self.assert_refused(segment("--series", FIRST + "#3"), 1, f"The file '{path}' holds no series '{FIRST}#3'")
        self.assert_refused(segment("--series", SECOND), 1, f"holds no series '{SECOND}'", FIRST + "#2")

    def test_bits_that_are_not_where_the_header_says(self):
        for name in os.listdir(self.folder):
            path = os.path.join(self.folder, name)
            with open(path, "rb") as file:
                data = file.read()
            stored = dicom.element(0x28, 0x101, "US", 16)
            self.assertIn(stored, data)
            with open(path, "wb") as file:
                file.write(data.replace(stored, dicom.element(0x28, 0x101, "US", 12)))  # HighBit stays 15
        self.assert_refused(self.segment(), 1, "HighBit is 15, not BitsStored - 1", "Export")

    def test_refusals(self):
        self.assert_refused(self.segment("--series", "9.9"), 1, "holds no series '9.9'", FIRST, SECOND)
        self.assert_refused(self.segment("--series", FIRST + "#2"), 1, f"holds no series '{FIRST}#2'")
        self.assert_refused(command.run("series", self.volume), 1, "is not a folder")
        self.assert_refused(command.run("series", self.inputs), 1, "holds no DICOM image")
        self.assert_refused(command.run("series"), 2, "FOLDER")
        with open(os.path.join(self.folder, "a012"), "r+b") as file:
            file.truncate(1000)
        self.assert_refused(self.segment(), 1, "a012' of series", "truncated")
        process = command.run("series", self.folder, "--quiet")
        self.assertEqual((process.returncode, process.stdout), (0, ""))
        self.assertRegex(process.stderr, rf"warning: The DICOM file '[^']+a012' of series {FIRST} cannot be read")


if __name__ == "__main__":
    unittest.main()
