"""What results say of their origin: in surfaces, in .seg.nrrd files, and as a session that repeats them."""

import json
import math
import os
import re
import shutil
import unittest

import command
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkNrrdReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


class ProvenanceTest(command.CommandTest):
    def bytes_of(self, name):
        with open(self.result(name), "rb") as file:
            return file.read()

    def json_of(self, name):
        with open(self.result(name), encoding="utf-8") as file:
            return json.load(file)

    def field_of(self, name, field="Provenance"):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(self.result(name))
        reader.Update()
        return reader.GetOutput().GetFieldData().GetAbstractArray(field).GetValue(0)

    def comments_of(self, name, prefix):
        """The provenance in the comments of a file."""
        text = self.bytes_of(name).split(b"end_header")[0].decode("latin-1")
        lines = re.findall(rf"^{prefix} provenance (.*)$", text, re.MULTILINE)
        self.assertLess(max(map(len, lines)), 250)
        return "".join(lines)


class TestProvenance(ProvenanceTest):
    def segment(self, *arguments):
        process = command.run("segment", self.volume, "-q", "--resolution", 16, *arguments)
        self.assertEqual(process.returncode, 0, process.stderr)  # presets warn

    def assert_repeats(self, *arguments, session="s.json"):
        """A run and its session give the same bits, and the same session."""
        outputs = [("-o", "x.ply"), ("--labels", "x.nii"), ("--save-session", session)]
        first = [word for option, name in outputs for word in (option, self.result(name))]
        again = [word for option, name in outputs for word in (option, self.result(f"again-{name}"))]
        self.segment(*arguments, *first)
        for name in os.listdir(self.results):
            self.assertNotIn("again", name)
        # The session finds its files beside it.
        volume = os.path.join(self.results, os.path.basename(self.volume))
        shutil.copy(self.volume, volume)
        process = command.run("segment", "--session", self.result(session), *again)
        self.assertEqual(process.returncode, 0, process.stderr)
        os.remove(volume)
        made = [name for name in os.listdir(self.results) if name.startswith("again-")]
        self.assertGreaterEqual(len(made), 3)
        for name in made:
            with self.subTest(name):
                self.assertEqual(self.bytes_of(name), self.bytes_of(name[len("again-"):]))
        return self.json_of(session)

    def test_sessions_repeat_what_options_gave(self):
        x, y, z = map(float, self.seed[self.seed.index("--seed") + 1:][:3])
        points = ("--inside", x, y, z + 26.123456789, "--outside", x - 20, y, z, "--boundary", x, y + 18, z)
        further = ("--seed", x + 6, y, z, "--radius", 4)
        parameters = ("--no-carving", "--foreground-mass", 0.987654321, "--start-offset", 1, 0, 0.1)
        for name, arguments in (
                ("plain", self.seed), ("points", (*self.seed, *points)), ("seeds", (*further, *self.seed)),
                ("parameters", (*self.seed, *parameters)), ("published", (*self.seed, "--preset", "published")),
                ("naive", (*self.seed, "--preset", "naive", "--iterations", 20)),
                ("voxels", ("--seed-voxel", 32, 32, 20, "--seed-voxel", 38, 32, 20, "--radius", 9, "--radius", 4.5))):
            with self.subTest(name):
                session = self.assert_repeats(*arguments)
                self.assertEqual(session["format"], "flipfree-session")
                self.assertEqual(session["image"]["name"], "sphere.nii.gz")
                self.assertEqual([organ["name"] for organ in session["organs"]], ["x"])
                for file in os.listdir(self.results):
                    os.remove(self.result(file))

    def test_label_maps_in_place_of_a_seed(self):
        labels = self.result("network.nii.gz")
        shutil.copy(self.truth, labels)
        session = self.assert_repeats("--start-labels", labels, "--outside", 32, 54, 32)
        self.assertEqual(session["organs"][0]["startLabels"], {"name": "network.nii.gz", "label": 1})
        os.remove(labels)
        process = command.run("segment", self.volume, "--session", self.result("s.json"), "-o", self.result("y.ply"))
        self.assertEqual(process.returncode, 1)
        self.assertRegex(process.stderr, "the label map of its start 'network.nii.gz' is not beside")

    def test_several_seeds_are_seeds_of_one_organ(self):
        # As from a file of points; in RAS, too.
        table = os.path.join(self.inputs, "seeds.csv")
        with open(table, "w", encoding="utf-8") as file:
            file.write("seed,44,32,32,4\n")
        self.segment(*self.seed, "--points", table, "-o", self.result("a.ply"))
        self.segment(*self.seed, "--seed", 44, 32, 32, "--radius", 4, "-o", self.result("b.ply"))
        x, y, z = map(float, self.seed[self.seed.index("--seed") + 1:][:3])
        radius = self.seed[self.seed.index("--radius") + 1]
        self.segment("--ras", "--seed", -44, -32, 32, "--radius", 4, "--radius", radius, "--seed", -x, -y, z, "-o", self.result("c.ply"))
        self.assertEqual(self.bytes_of("a.ply"), self.bytes_of("b.ply"))
        self.assertEqual(self.bytes_of("a.ply"), self.bytes_of("c.ply"))
        self.segment(*self.seed, "-o", self.result("d.ply"))
        self.assertNotEqual(self.bytes_of("a.ply"), self.bytes_of("d.ply"))
        for name in os.listdir(self.results):
            os.remove(self.result(name))
        out = ("-o", self.result("e.ply"))
        for status, arguments, pattern in (
                (2, (*self.seed, "--seed", 1, 2, 3), r"There are fewer radii \(1\) than seeds \(2\)\. Give a --radius for each seed"),
                (2, (*self.seed, "--radius", 3), r"There are more radii \(2\) than seeds \(1\)"),
                (2, (*self.seed, "--seed", 1, 2, "--radius", 3), "--seed: a coordinate is missing"),
                (2, (*self.seed, "--seed", 1, 2, 3, "--radius", -3), "--radius must be a positive number"),
                (2, (*self.seed, "--seed", 1, 2, "nan", "--radius", 3), "--seed: a coordinate is not a finite"),
                (1, (*self.seed, "--seed", 900, 2, 3, "--radius", 3), r"the further seed at \(900, 2, 3\) mm lies outside|the seed's center \(900, 2, 3\) mm lies outside")):
            with self.subTest(pattern):
                self.assert_refused(command.run("segment", self.volume, *arguments, *out), status, pattern)

    def test_surfaces_hold_it(self):
        point = ("--inside", 62.1, 32, 32)
        for name in ("liver.vtp", "liver.ply", "liver.obj", "liver.stl"):
            self.segment(*self.seed, *point, "-o", self.result(name))
        self.segment(*self.seed, *point, "--save-session", self.result("liver.json"))
        text = self.field_of("liver.vtp")
        session = json.loads(text)
        self.assertEqual(session, self.json_of("liver.json"))
        self.assertEqual((session["organs"][0]["name"], session["image"]["name"]), ("liver", "sphere.nii.gz"))
        self.assertEqual(session["organs"][0]["corrections"], [{"kind": "inside", "position": [62.1, 32, 32]}])
        self.assertEqual(session["flipfree"], command.run("--version").stdout.split()[1])
        parameters = session["organs"][0]["parameters"]
        self.assertEqual((parameters["resolution"], parameters["guard"], parameters["levels"]), (16, True, 4))
        # Files that are named after the organ have no name in the comments: the same surface, the same bytes.
        session["organs"][0]["name"], session["image"]["name"] = "organ", ""
        self.assertEqual(json.loads(self.comments_of("liver.ply", "comment")), session)
        self.assertEqual(json.loads(self.comments_of("liver.obj", "#")), session)
        self.assertRegex(self.bytes_of("liver.stl")[:80], rb"^FlipFree [\d.]+, millimeters, SPACE=LPS[\0 ]*$")
        # The text is a session by itself.
        with open(self.result("text.json"), "w", encoding="utf-8") as file:
            file.write(text)
        process = command.run("segment", self.volume, "--session", self.result("text.json"), "-o", self.result("again.ply"))
        self.assert_succeeds(process, may_be_doubtful=True)
        self.assertEqual(self.bytes_of("again.ply"), self.bytes_of("liver.ply"))
        # Others read the file all the same.
        reader = vtkPLYReader()
        reader.SetFileName(self.result("liver.ply"))
        reader.Update()
        self.assertEqual(reader.GetOutput().GetNumberOfPoints(), 6 * 16 * 16)

    def test_what_cannot_be_repeated_is_said(self):
        self.segment(*self.seed, "--save-session", self.result("s.json"))
        session = self.json_of("s.json")
        organ = session["organs"][0]
        os.remove(self.result("s.json"))
        path = os.path.join(self.inputs, "s.json")
        other = {**organ, "name": "other", "parameters": {**organ["parameters"], "levels": 2}}
        for changes, pattern in (
                ({"organs": [{**organ, "startSurface": True}]}, "organ 1: 'organ|'s': it began with a surface"),
                ({"organs": [{**organ, "seed": None, "startLabels": {"name": "x", "label": -1}}]}, "label of its start is negative"),
                ({"organs": [{**organ, "seed": None, "startLabels": {"label": 1}}]}, "key 'name' not found"),
                ({"organs": [{**organ, "seed": None, "startLabels": {"name": "x.nii", "label": 1}}]}, "'x.nii' is not beside"),
                ({"organs": [organ, other], "together": True}, "'other': organs that were segmented together"),
                ({"together": True, "fixed": ["gone.vtp"]}, "The fixed surface 'gone.vtp' is not beside")):
            with self.subTest(pattern):
                with open(path, "w", encoding="utf-8") as file:
                    json.dump({**session, **changes}, file)
                process = command.run("segment", self.volume, "--session", path, "-o", self.result("a.ply"))
                self.assert_refused(process, 1, pattern)
        self.assert_refused(command.run("segment", self.volume, *self.seed, "--save-session", self.result("a.txt")),
                            2, "--save-session", ".json")

    def test_vessels(self):
        command.make_phantom(self.inputs, "vessel", "--size", 64, 64, 64, "--spacing", 1.5, 1.5, 1.5)
        volume = os.path.join(self.inputs, "vessel.nii.gz")
        center = 63 / 2 * 1.5
        places = [[center + 36 * t, center + 16 * math.sin(math.pi * t), center + 10 * math.cos(0.8 * math.pi * t + 0.5)]
                  for t in (-0.95, 0.2, 0.95)]
        points = [word for place in places for word in ("--point", *place)]
        middle = places[1]
        outputs = ("-o", self.result("aorta.vtp"), "--labels", self.result("aorta.seg.nrrd"),
                   "--save-session", self.result("s.json"))
        self.assert_succeeds(command.run("trace", volume, *points, "--wall-thickness", 0.5, "--boundary", middle[0], middle[1],
                                         middle[2] + 7.5, *outputs, "-q"))
        process = command.run("segment", volume, "--session", self.result("s.json"), "-o", self.result("b.vtp"),
                              "--labels", self.result("b.seg.nrrd"))
        self.assert_succeeds(process)
        self.assertEqual(self.field_of("b.vtp"), self.field_of("aorta.vtp"))
        self.assertEqual(json.loads(self.field_of("b.vtp")), self.json_of("s.json"))
        self.assertEqual(self.bytes_of("b.vtp"), self.bytes_of("aorta.vtp"))
        self.assertEqual(self.bytes_of("b.seg.nrrd"), self.bytes_of("aorta.seg.nrrd"))
        self.assertIn(b"Segment0_Name:=aorta\n", self.bytes_of("aorta.seg.nrrd"))


class TestOrgansProvenance(ProvenanceTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.abdomen, cls.organs = command.make_small_abdomen(cls.inputs)

    def segment(self, *arguments):
        process = command.run("segment", *arguments, "-q")
        self.assert_succeeds(process, may_be_doubtful=True)

    def test_organs_together(self):
        x, y, z, radius = map(float, self.organs["spleen"])
        radius *= 0.8  # so that it keeps off the kidney, whose slices are 6 mm thick
        liver = ("--organ", "liver", *self.organs["liver"])
        spleen = ("--organ", "left spleen", x, y, z, radius, "--outside", x, y + 0.8 * radius, z)
        kidney = self.organs["left kidney"]
        self.segment(self.abdomen, "--resolution", 16, "--seed", *kidney[:3], "--radius", kidney[3], "-o", self.result("kidney.vtp"))
        self.segment(self.abdomen, *liver, *spleen, "--resolution", 16, "--fixed", self.result("kidney.vtp"),
                     "-o", self.result("out.vtp"), "--labels", self.result("out.seg.nrrd"),
                     "--save-session", self.result("s.json"))
        session = self.json_of("s.json")
        self.assertEqual([organ["name"] for organ in session["organs"]], ["liver", "left spleen"])
        self.assertEqual((session["together"], session["fixed"]), (True, ["kidney.vtp"]))
        self.assertEqual(json.loads(self.field_of("out-liver.vtp")), session)
        self.assertEqual(self.field_of("out-left-spleen.vtp", "Organ"), "left spleen")
        self.segment(self.abdomen, "--session", self.result("s.json"), "-o", self.result("b.vtp"),
                     "--labels", self.result("b.seg.nrrd"), "--save-session", self.result("b.json"))
        for ours, again in (("out-liver.vtp", "b-liver.vtp"), ("out-left-spleen.vtp", "b-left-spleen.vtp"),
                            ("out.seg.nrrd", "b.seg.nrrd"), ("s.json", "b.json")):
            with self.subTest(again):
                self.assertEqual(self.bytes_of(again), self.bytes_of(ours))
        self.check_segments("out.seg.nrrd")
        # Colors of a session are taken.
        session["organs"][0]["color"] = "#00ff00"
        with open(self.result("s.json"), "w", encoding="utf-8") as file:
            json.dump(session, file)
        self.segment(self.abdomen, "--session", self.result("s.json"), "--labels", self.result("c.seg.nrrd"))
        self.assertIn(b"Segment0_Color:=0.000000 1.000000 0.000000\n", self.bytes_of("c.seg.nrrd"))

    def check_segments(self, name):
        """As another reader has it: VTK's, and the lines of the header."""
        header, _ = self.bytes_of(name).split(b"\n\n", 1)
        fields = dict(line.split(":=", 1) for line in header.decode().splitlines() if ":=" in line)
        self.assertEqual((fields["Segment0_Name"], fields["Segment1_Name"]), ("liver", "left spleen"))
        self.assertEqual((fields["Segment0_LabelValue"], fields["Segment1_LabelValue"]), ("1", "2"))
        self.assertNotEqual(fields["Segment0_Color"], fields["Segment1_Color"])
        self.assertNotIn("Segment2_ID", fields)
        reader = vtkNrrdReader()
        reader.SetFileName(self.result(name))
        reader.Update()
        image = reader.GetOutput()
        voxels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])
        for index in range(2):
            low = [int(bound) for bound in fields[f"Segment{index}_Extent"].split()]
            inside = voxels[low[4]:low[5] + 1, low[2]:low[3] + 1, low[0]:low[1] + 1] == index + 1
            everywhere = voxels == index + 1
            self.assertEqual(inside.sum(), everywhere.sum())
            self.assertGreater(everywhere.sum(), 100)

    def test_segments_are_the_label_map(self):
        liver = self.organs["liver"]
        for name in ("liver.seg.nrrd", "liver.nrrd"):
            self.segment(self.abdomen, "--resolution", 16, "--seed", *liver[:3], "--radius", liver[3], "--labels", self.result(name))
        headers = [self.bytes_of(name).split(b"\n\n", 1)[0].decode().splitlines() for name in ("liver.seg.nrrd", "liver.nrrd")]
        self.assertIn("Segment0_Name:=liver", headers[0])
        self.assertEqual([line for line in headers[0] if not line.startswith("Segment")], headers[1])
        voxels = [self.bytes_of(name).split(b"\n\n", 1)[1] for name in ("liver.seg.nrrd", "liver.nrrd")]
        self.assertEqual(*voxels)


if __name__ == "__main__":
    unittest.main()
