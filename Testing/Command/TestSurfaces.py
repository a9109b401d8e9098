"""Surfaces of all labels of a label map: files of every format, names from everywhere, and one clear error each."""

import csv
import gzip
import os
import struct
import unittest

import command
import labelmaps

SIZE = (20, 18, 12)
SPACING = (1, 1, 2)


def three_labels():
    """Two boxes that share a wall, and a third one that touches the image's border."""
    voxels = bytearray(SIZE[0] * SIZE[1] * SIZE[2])
    for k in range(SIZE[2]):
        for j in range(SIZE[1]):
            for i in range(SIZE[0]):
                label = 3 if j > 13 and k > 8 else 0
                if 2 < i < 16 and 2 < j < 11 and 1 < k < 8:
                    label = 1 if i < 9 else 2
                voxels[i + SIZE[0] * (j + SIZE[1] * k)] = label
    return voxels


def write_nifti(path, voxels, names=None):
    """With a label table, as TotalSegmentator writes it."""
    extension = b""
    if names:
        labels = "".join(f'<Label Key="{label}" Red="1" Green="0" Blue="0" Alpha="1"><![CDATA[{name}]]></Label>\n'
                         for label, name in names.items())
        xml = f"<CaretExtension><VolumeInformation><LabelTable>{labels}</LabelTable></VolumeInformation></CaretExtension>"
        size = -(-(len(xml) + 8) // 16) * 16
        extension = struct.pack("<ii", size, 0) + xml.encode().ljust(size - 8, b"\0")
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *SIZE, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, 1, *SPACING, 1, 1, 1, 1)
    struct.pack_into("<f", header, 108, 352 + len(extension))
    header[123] = 2
    struct.pack_into("<2h", header, 252, 0, 1)
    struct.pack_into("<12f", header, 280, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0)
    header[344:348] = b"n+1\0"
    header[348] = 1 if extension else 0
    with gzip.open(path, "wb") as file:
        file.write(bytes(header) + extension + bytes(voxels))


class TestSurfaces(command.CommandTest):
    def setUp(self):
        super().setUp()
        self.labels = os.path.join(self.inputs, "labels.nii.gz")
        write_nifti(self.labels, three_labels())
        self.folder = self.result("surfaces")

    def files(self):
        return sorted(os.listdir(self.folder))

    def table(self):
        with open(os.path.join(self.folder, "surfaces.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_every_format_holds_valid_surfaces_of_the_same_voxels(self):
        for form in ("stl", "ply", "obj", "vtp"):
            with self.subTest(form):
                process = command.run("surfaces", self.labels, "-o", self.folder, "--exact", "--format", form)
                self.assert_succeeds(process)
                self.assertIn("0 voxels on the wrong side", process.stdout)
                for row in self.table():
                    self.assertEqual(row["File"], f"{row['Label']}.{form}")
                    self.assertEqual(row["WrongVoxels"], "0")
                    self.assertEqual(row["EulerNumber"], "2")
                    self.assertAlmostEqual(float(row["Milliliters"]), float(row["VoxelMilliliters"]), 2)
                    scores = command.run("evaluate", os.path.join(self.folder, row["File"]), self.labels,
                                         "--reference-label", row["Label"], "--voxelize")
                    self.assert_succeeds(scores)
                    self.assertEqual(command.dice_of(scores.stdout), 1)
                    self.assertRegex(scores.stdout, r"surface +valid: closed, .* self-intersections 0")
        self.assertEqual(len(self.files()), 13)

    def test_smooth_surfaces_say_what_they_leave(self):
        process = command.run("surfaces", self.labels, "-o", self.folder, "--distance", 1, "--iterations", 80)
        self.assert_succeeds(process)
        self.assertRegex(process.stdout, r"\n\d+ voxels on the wrong side; vertices lie at most [\d.]+ mm from the corners")

    def test_fewer_triangles_and_parts_are_told(self):
        voxels = three_labels()
        voxels[SIZE[0] + 1] = 4  # a speck of 2 mm3
        voxels[6 + SIZE[0] * (6 + SIZE[1] * 4)] = 0  # a cavity
        write_nifti(self.labels, voxels)
        self.assert_succeeds(command.run("surfaces", self.labels, "-o", self.folder, "--exact", "-q"))
        fine = self.table()
        self.assertEqual([row["EulerNumber"] for row in fine], ["4", "2", "2", "2"])
        process = command.run("surfaces", self.labels, "-o", self.result("other"), "--exact", "--edge-length", 6,
                              "--smallest-part", 3, "--fill-cavities")
        self.assert_succeeds(process)
        self.assertIn("2 voxels on the wrong side", process.stdout)
        self.assertRegex(process.stdout, r"\n\d+ triangles; walls lie at most 0\.\d+ mm from where they were before")
        self.folder = self.result("other")
        rows = self.table()
        self.assertEqual(self.files(), ["1.stl", "2.stl", "3.stl", "surfaces.csv"])
        self.assertEqual([(row["EulerNumber"], row["WrongVoxels"], row["File"]) for row in rows],
                         [("2", "1", "1.stl"), ("2", "0", "2.stl"), ("2", "0", "3.stl"), ("0", "1", "")])
        for before, after in zip(fine[:3], rows):
            self.assertLess(int(after["Triangles"]), int(before["Triangles"]) / 2)
            scores = command.run("evaluate", os.path.join(self.folder, after["File"]), self.labels, "--reference-label",
                                 after["Label"], "--voxelize")
            self.assertRegex(scores.stdout, r"surface +valid: closed, .* self-intersections 0")

    def test_names_come_from_nifti(self):
        write_nifti(self.labels, three_labels(), {1: "left kidney", 3: "liver & more"})
        self.assert_succeeds(command.run("surfaces", self.labels, "-o", self.folder, "-q"))
        self.assertEqual(self.files(), ["1-left_kidney.stl", "2.stl", "3-liver___more.stl", "surfaces.csv"])
        self.assertEqual([row["Name"] for row in self.table()], ["left kidney", "", "liver & more"])

    def test_names_come_from_slicer(self):
        segmentation = os.path.join(self.inputs, "labels.seg.nrrd")
        labelmaps.write_layers(segmentation, SIZE, SPACING, [({2: "spleen"}, three_labels())])
        self.assert_succeeds(command.run("surfaces", segmentation, "-o", self.folder, "-q"))
        self.assertEqual(self.files(), ["1.stl", "2-spleen.stl", "3.stl", "surfaces.csv"])

    def test_names_come_from_a_table(self):
        names = os.path.join(self.inputs, "names.csv")
        with open(names, "w", encoding="utf-8") as file:
            file.write('label,name\n1,liver\n3;"left kidney"\n2\tspleen\n')
        write_nifti(self.labels, three_labels(), {1: "other"})
        self.assert_succeeds(command.run("surfaces", self.labels, "-o", self.folder, "-q", "--names", names, "--label", 3,
                                         "--label", 1))
        self.assertEqual(self.files(), ["1-liver.stl", "3-left_kidney.stl", "surfaces.csv"])
        for content, message in ((b"nothing\n", "names.csv' names no labels. Give lines such as '5,liver'."),
                                 (b"1,liver\n-2,spleen\n", "names.csv', line 2: '-2,spleen' is not a label and its name."),
                                 (b"1,liver\n1,spleen\n", "line 2: '1,spleen' names label 1, which is 'liver'"),
                                 ("1,Nebenniere \u00e4".encode("latin-1"), "is not UTF-8 text"), (None, "There is no file")):
            with self.subTest(message):
                os.remove(names)
                if content is not None:
                    with open(names, "wb") as file:
                        file.write(content)
                self.assert_fails(command.run("surfaces", self.labels, "-o", self.folder, "--names", names), message)

    def assert_fails(self, process, *words):
        self.assertIn(process.returncode, (1, 2), process.stderr)
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        for word in words:
            self.assertIn(word, process.stderr)

    def test_what_is_wrong_is_said(self):
        self.assert_fails(command.run("surfaces", self.labels, "-o", self.folder, "--label", 9),
                          "the label map has no voxel with label 9; change --label")
        self.assert_fails(command.run("surfaces", self.labels, "-o", self.folder, "--exact", "--distance", 0.7), "--distance")
        self.assert_fails(command.run("surfaces", self.labels, "-o", self.folder, "--distance", 2), "--distance")
        self.assert_fails(command.run("surfaces", self.labels, "-o", self.folder, "--smallest-part", 1e6),
                          "no part of any label has 1e+06 mm3; lower --smallest-part")
        self.assert_fails(command.run("surfaces", self.labels), "--output")
        self.assert_fails(command.run("surfaces", self.labels + "x", "-o", self.folder), "labels.nii.gzx")
        self.assert_fails(command.run("surfaces", self.labels, "-o", self.labels), "is not a folder. Choose another name.")
        write_nifti(self.labels, bytes(len(three_labels())))
        self.assert_fails(command.run("surfaces", self.labels, "-o", self.folder), "has no labels")
        self.assertEqual(os.listdir(self.results), [], "nothing is left of a folder that was made in vain")
        os.mkdir(self.folder)
        self.assert_fails(command.run("surfaces", self.labels, "-o", self.folder), "has no labels")
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main()
