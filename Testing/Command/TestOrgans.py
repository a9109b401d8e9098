"""Several organs by --organ: their files, points of each, surfaces that stay, and what is refused."""

import csv
import math
import os
import re
import unittest

import command
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


class TestOrgans(command.CommandTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.abdomen, cls.organs = command.make_small_abdomen(cls.inputs)

    def organ(self, name):
        return ("--organ", name, *self.organs[name])

    def segment(self, *arguments):
        return command.run("segment", self.abdomen, "--resolution", 16, *arguments)

    def bytes_of(self, name):
        with open(self.result(name), "rb") as file:
            return file.read()

    def test_together(self):
        process = self.segment(*self.organ("liver"), *self.organ("spleen"), "-o", self.result("out.stl"),
                               "--labels", self.result("out.nii.gz"), "--convergence", self.result("out.csv"))
        self.assert_succeeds(process, may_be_doubtful=True)
        self.assertRegex(process.stdout, r"liver: label 1, volume [^\n]*, 0 self-intersections, confidence [^\n]*\n"
                                         r"[^\n]*spleen: label 2, volume [^\n]*\n[^\n]*: organs do not meet; reading")
        self.assertEqual(sorted(os.listdir(self.results)),
                         ["out-liver.csv", "out-liver.stl", "out-spleen.csv", "out-spleen.stl", "out.nii.gz"])
        # Whatever their order; labels count on from --label-value.
        process = self.segment(*self.organ("spleen"), *self.organ("liver"), "-q", "-o", self.result("turned.stl"),
                               "--label-value", 5)
        self.assertEqual(process.stdout, "")
        self.assertEqual(self.bytes_of("turned-liver.stl"), self.bytes_of("out-liver.stl"))
        # One stays as it is, whatever its triangles.
        self.segment(*self.organ("liver"), *self.organ("spleen"), "-q", "-o", self.result("out.ply"))
        for ending in ("stl", "ply"):
            process = self.segment(*self.organ("spleen"), "--fixed", self.result(f"out-liver.{ending}"), "-q",
                                   "-o", self.result(f"beside-{ending}.stl"))
            self.assert_succeeds(process, may_be_doubtful=True)

    def confidence_of(self, name):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(self.result(name))
        reader.Update()
        return reader.GetOutput().GetFieldData().GetArray("Confidence").GetTuple1(0)

    def test_confidence_is_rounded_down_as_in_its_warning(self):
        organs = [self.segment(*self.organ("liver"), *self.organ("spleen"), "-o", self.result("out.vtp"))]
        files = ["out-liver.vtp", "out-spleen.vtp"]
        for name in ("left kidney", "vena cava"):
            x, y, z, radius = self.organs[name]
            organs.append(self.segment("--seed", x, y, z, "--radius", radius, "-o", self.result(f"{name}.vtp")))
            files.append(f"{name}.vtp")
        confidences = [self.confidence_of(name) for name in files]
        expected = [f"{math.floor(100 * confidence) / 100:.2f}" for confidence in confidences]
        self.assertNotEqual(expected, [f"{confidence:.2f}" for confidence in confidences])  # or the test sees nothing
        text = "".join(process.stdout for process in organs)
        self.assertEqual(re.findall(r", confidence ([\d.]+)", text), expected)
        for process in organs:
            for number in re.findall(r"its confidence is ([\d.]+),", process.stderr):
                self.assertIn(f", confidence {number}", process.stdout)

    def test_points_belong_to_the_organ_before(self):
        x, y, z, radius = map(float, self.organs["spleen"])
        point = ("--outside", x, y + 1.2 * radius, z)

        def spleen_of(*organs):
            self.assert_succeeds(self.segment(*organs, "-q", "-o", self.result("a.stl")), may_be_doubtful=True)
            return self.bytes_of("a-spleen.stl")

        liver, spleen = self.organ("liver"), self.organ("spleen")
        free = spleen_of(*liver, *spleen)
        self.assertNotEqual(spleen_of(*liver, *spleen, *point), free)
        self.assertEqual(spleen_of(*liver, *point, *spleen), free)
        stroke = os.path.join(self.inputs, "stroke.csv")
        with open(stroke, "w", encoding="utf-8") as file:
            file.write("{},{},{}\n".format(*point[1:]))
        self.assertEqual(spleen_of(*liver, *spleen, "--outside-stroke", stroke), spleen_of(*liver, *spleen, *point))
        self.assertEqual(spleen_of(*liver, "--outside-stroke", stroke, *spleen), free)
        process = self.segment(*spleen, *liver, "--inside", x, y, z, "-o", self.result("a.stl"))
        self.assertNotEqual(process.returncode, 0)
        self.assertRegex(process.stderr, "of 'liver' lies in the seed of 'spleen'")

    def test_surfaces_that_stay(self):
        self.assert_succeeds(self.segment(*self.organ("liver"), "-q", "-o", self.result("a.vtp")), may_be_doubtful=True)
        self.assert_succeeds(self.segment(*self.organ("spleen"), "-q", "--fixed", self.result("a-liver.vtp"),
                                          "-o", self.result("b.vtp")), may_be_doubtful=True)
        process = self.segment(*self.organ("liver"), "--fixed", self.result("a-liver.vtp"), "-o", self.result("c.vtp"))
        self.assertNotEqual(process.returncode, 0)
        self.assertRegex(process.stderr, "the start sphere of 'liver' meets the fixed surface 1")

    def test_volume_and_preset(self):
        # As that of one organ: the surface's. A preset is taken; the guard is needed.
        x, y, z, radius = self.organs["liver"]
        volumes = []
        for arguments in (self.organ("liver"), ("--seed", x, y, z, "--radius", radius)):
            process = self.segment(*arguments, "-o", self.result("a.vtp"))
            self.assert_succeeds(process, may_be_doubtful=True)
            volumes.append(re.search(r"volume ([\d.]+) ml", process.stdout)[1])
        self.assertEqual(*volumes)
        published = ("--preset", "published", "--convergence", self.result("a.csv"))
        process = self.segment(*self.organ("liver"), *published)
        self.assertEqual(process.returncode, 1)
        self.assertRegex(process.stderr, "switch --guard and --carving on")
        process = self.segment(*self.organ("liver"), *published, "--guard", "--carving")
        self.assert_succeeds(process, may_be_doubtful=True)
        with open(self.result("a-liver.csv"), encoding="utf-8") as file:
            self.assertEqual({row["Level"] for row in csv.DictReader(file)}, {"0", "1"})

    def test_misuse_is_refused(self):
        liver, spleen = self.organ("liver"), self.organ("spleen")
        out = ("-o", self.result("a.vtp"))
        for status, arguments, pattern in (
                (2, (*liver, *liver, *out), "would give the same file name"),
                (2, (*liver, "--organ", "", 1, 2, 3, 4, *out), "a name is empty"),
                (2, ("--inside", 1, 2, 3, *liver, *out), "comes before the first --organ"),
                (1, (*liver, "--inside-stroke", "no.csv", *out), "There is no file 'no.csv'"),
                (2, ("--organ", "liver", 1, 2, "x", 4, *out), "--organ liver: 'x' is not a number"),
                (2, ("--organ", "liver", 1, "nan", 3, 4, *out), "--organ liver: a coordinate is not a finite number"),
                *((2, ("--organ", "liver", 1, 2, 3, radius, *out),
                   "--organ liver: the radius must be a positive number of millimeters, 1e-6 to 1e6")
                  for radius in (0, -4, 1e-9, 2e6, "nan", "inf")),
                (2, (*liver, "--seed", 1, 2, 3, *out), "--organ has the seed"),
                (2, (*liver, "--points", "a.csv", *out), "--points and --save-points are for one organ"),
                (2, ("--fixed", "a.vtp", *self.seed, *out), "--fixed is for organs"),
                (2, (*liver, "--fixed", "a.txt", *out), "--fixed"),
                (2, (*liver,), "No output is requested"),
                (1, (*liver, "--fixed", "no.vtp", *out), "no.vtp"),
                (1, (*liver, *spleen, "--no-guard", *out), "switch --guard and --carving on"),
                (1, (*liver, "--organ", "copy", *self.organs["liver"], *out), "the seeds of ('copy' and 'liver'|'liver' and 'copy') overlap"),
                (1, (*liver, *spleen, "--label-value", 255, *out), "lower --label-value, or remove organs"),
                # A name is no option, whatever it is.
                (1, (*liver, "--organ", "{Levels}", *self.organs["liver"], *out),
                 "the seeds of ('{Levels}' and 'liver'|'liver' and '{Levels}') overlap"),
                (1, ("--organ", "the Guard's", 9e3, 2, 3, 4, *out), "'the Guard's': the seed"),
        ):
            with self.subTest(pattern, arguments=arguments):
                self.assert_refused(self.segment(*arguments), status, pattern)


if __name__ == "__main__":
    unittest.main()
