"""Points that correct a segmentation: options, files of points, and what is refused."""

import json
import math
import os
import unittest

import command


class TestCorrections(command.CommandTest):
    points = ("--inside", 62, 32, 32, "--outside", 32, 54, 32, "--boundary", 32, 32, 60)

    def segment(self, *arguments):
        return command.run("segment", self.volume, *self.seed, "--resolution", 16, *arguments)

    def surface(self, name, *arguments):
        self.assert_succeeds(self.segment("-q", "-o", self.result(name), *arguments))
        with open(self.result(name), "rb") as file:
            return file.read()

    def file(self, name, text):
        path = os.path.join(self.inputs, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_files_repeat_the_options(self):
        corrected = self.surface("a.stl", *self.points, "--save-points", self.result("a.csv"))
        self.assertNotEqual(corrected, self.surface("free.stl"))
        with open(self.result("a.csv"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "kind,x,y,z,radius\ninside,62,32,32,\noutside,32,54,32,\nboundary,32,32,60,\n")
        markups = self.result("b.mrk.json")
        self.assertEqual(self.surface("b.stl", "--points", self.result("a.csv"), "--save-points", markups), corrected)
        self.assertEqual(self.surface("c.stl", "--points", markups), corrected)
        with open(markups, encoding="utf-8") as file:
            content = json.load(file)
        fiducials = content["markups"][0]
        self.assertIn("markups-schema-v1", content["@schema"])
        self.assertEqual((fiducials["type"], fiducials["coordinateSystem"]), ("Fiducial", "LPS"))
        # As 3D Slicer names and places them.
        for number, control in enumerate(fiducials["controlPoints"]):
            control["label"] = f"{control['label'].capitalize()}-{number}"
            control["position"] = [-control["position"][0], -control["position"][1], control["position"][2]]
        fiducials["coordinateSystem"] = "RAS"
        markups = self.file("d.mrk.json", json.dumps(content))
        self.assertEqual(self.surface("d.stl", "--points", markups), corrected)

    def test_coordinates_can_be_ras(self):
        def flipped(arguments):
            arguments = list(arguments)
            for index, argument in enumerate(arguments):
                if argument in ("--seed", "--inside", "--outside", "--boundary"):
                    arguments[index + 1] = -float(arguments[index + 1])
                    arguments[index + 2] = -float(arguments[index + 2])
            return arguments

        process = command.run("segment", self.volume, *flipped(self.seed), "--resolution", 16, "--ras", "-q", "-o",
                              self.result("e.stl"), *flipped(self.points))
        self.assert_succeeds(process)
        with open(self.result("e.stl"), "rb") as file:
            self.assertEqual(file.read(), self.surface("a.stl", *self.points))

    def test_seeds_in_files(self):
        seeds = self.file("seeds.csv", "seed, 62, 32, 32, 4\n\n")
        self.assertNotEqual(self.surface("f.stl", "--points", seeds), self.surface("free.stl"))

    def test_strokes(self):
        """Points of one kind, whatever their labels, and each place once."""
        stroke = [[62, 32, 30 + z] for z in range(4)]
        inside = self.file("stroke.csv", "X,Y,Z\n" + "".join("{},{},{}\n".format(*place) for place in [*stroke, stroke[0]]))
        curve = {"markups": [{"type": "Curve", "coordinateSystem": "RAS", "coordinateUnits": "mm", "controlPoints": [
            {"label": f"inside-{number}", "position": [-32, -54 - 5e-4 * number, 32]} for number in (0, 1)]}]}
        outside = self.file("curve.mrk.json", json.dumps(curve))
        saved = self.result("a.csv")
        session = self.result("a.json")
        drawn = self.surface("a.stl", "--inside-stroke", inside, "--outside-stroke", outside, "--boundary", 32, 32, 60,
                             "--save-points", saved, "--save-session", session)
        with open(saved, encoding="utf-8") as file:
            self.assertEqual(file.read(), "kind,x,y,z,radius\ninside,62,32,30,\ninside,62,32,31,\ninside,62,32,32,\n"
                                          "inside,62,32,33,\noutside,32,54,32,\nboundary,32,32,60,\n")
        self.assertEqual(self.surface("b.stl", "--points", saved), drawn)
        self.assert_succeeds(command.run("segment", self.volume, "--session", session, "-q", "-o", self.result("c.stl")))
        with open(self.result("c.stl"), "rb") as file:
            self.assertEqual(file.read(), drawn)
        more = self.file("more.csv", "60,32,32\n")
        self.surface("d.stl", "--inside-stroke", inside, "--inside-stroke", more, "--save-points", saved)
        with open(saved, encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), 6)

    def test_strokes_that_are_wrong(self):
        out = ("-o", self.result("bad.stl"))
        stroke = self.file("good.csv", "62,32,32\n")
        for status, arguments, patterns in (
                (2, ("--inside-stroke", "stroke.txt"), ("--inside-stroke", ".csv or .mrk.json")),
                (2, ("--outside-stroke",), ("--outside-stroke",)),
                (1, ("--outside-stroke", self.result("none.csv")), ("There is no file .*none.csv",)),
                (1, ("--inside-stroke", self.file("no.csv", "x,y,z\n")), ("no.csv' holds no points",)),
                (1, ("--inside-stroke", self.file("kinds.csv", "kind,x,y,z\ninside,1,2,3\n")),
                 ("kinds.csv', line 1: the header must be x, y, z, in any order",)),
                (1, ("--inside-stroke", self.file("names.csv", "r,a,s\n1,2,3\n")), ("the header must be x, y, z, in any order",)),
                (1, ("--inside-stroke", self.file("bad.mrk.json", "[]")), ("the columns x, y and z",)),
                (1, ("--inside-stroke", stroke, "--outside-stroke", stroke), ("are in the same place",)),
                (2, ("--inside-stroke", stroke, "--save-points", stroke), ("is an input",)),
                (2, ("--inside-stroke", stroke, "--session", "a.json"), ("--session",))):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.segment(*out, *arguments), status, *patterns)
        with open(stroke, encoding="utf-8") as file:
            self.assertEqual(file.read(), "62,32,32\n")

    def test_points_that_contradict_each_other(self):
        out = ("-o", self.result("bad.stl"))
        self.assert_refused(self.segment("--inside", 32, 54, 32, "--outside", 32, 54, 32, *out), 1,
                            r"the (in|out)side point \(32, 54, 32\) mm and the (in|out)side point \(32, 54, 32\) mm are in the same place")
        # A cage of outside points around one that is inside.
        golden = (1 + math.sqrt(5)) / 2
        cage = [(58.5 + 2 * a / golden, 31.5 + 2 * b / golden, 31.2 + 2 * c / golden) for s in (-1, 1) for t in (-golden, golden)
                for a, b, c in ((0, s, t), (s, t, 0), (t, 0, s))]
        words = [word for place in cage for word in ("--outside", *place)]
        self.assert_refused(command.run("segment", self.volume, *self.seed, "--resolution", 8, "--levels", 1,
                                        "--inside", 58.5, 31.5, 31.2, *words, *out), 1,
                            r"the inside point \(58.5, 31.5, 31.2\) mm cannot be obeyed: the surface of one piece does not get there")

    def test_a_file_of_no_points_is_a_warning(self):
        for content in ("", "kind,x,y,z,radius\n"):
            process = self.segment("--points", self.file("none.csv", content), "-o", self.result("none.stl"))
            self.assertEqual(process.returncode, 0)
            self.assertRegex(process.stderr, r"\Aflipfree: warning: '[^\n]*none\.csv' holds no points, so nothing is corrected[^\n]*\n\Z")

    def test_what_is_wrong_is_named(self):
        out = ("-o", self.result("bad.stl"))
        for status, arguments, patterns in (
                (2, ("--inside", 1, 2), ("--inside", "value is missing")),
                (2, ("--inside", 1, 2, 3, "--inside", 1, 2), ("--inside", "coordinate is missing")),
                (2, ("--outside", "nan", 2, 3), ("--outside", "finite")),
                (2, ("--points", "points.txt"), ("--points", ".csv or .mrk.json")),
                (2, ("--save-points", "points.txt"), ("--save-points", ".csv or .mrk.json")),
                (1, ("--points", self.result("none.csv")), ("There is no file .*none.csv",)),
                (2, ("--points", self.result("a.csv"), "--convergence", self.result("a.csv")), ("is an input",)),
                (2, ("--convergence", self.result("a.csv"), "--save-points", os.path.join(self.results, ".", "a.csv")),
                 ("--convergence and --save-points name the same file, '.*a.csv'. Give each one of its own",)),
                (2, ("--save-session", self.result("z.mrk.json"), "--save-points", self.result("z.mrk.json")),
                 ("--save-session and --save-points name the same file",)),
                (1, ("--inside", 500, 2, 3), (r"the inside point \(500, 2, 3\) mm lies outside",)),
                (1, ("--outside", *self.seed[1:4]), ("the outside point", "inner half of the seed sphere")),
                (1, ("--no-guard", "--inside", 32, 32, 34), ("switch --guard on",)),
                (1, ("--points", self.file("a.csv", "kind,x,y,z\nabove,1,2,3\n")), ("a.csv", "line 2", "'above'")),
                (1, ("--points", self.file("b.csv", "inside,1,2\n")), ("b.csv", "line 1", "3 cells; needed are kind, x, y, z")),
                (1, ("--points", self.file("e.csv", "1,2,3\n")), ("e.csv", "is for --inside-stroke or --outside-stroke")),
                (1, ("--points", self.file("c.csv", "inside,1,2,3mm\n")), ("c.csv", "'3mm' is not a number")),
                (1, ("--points", self.file("d.csv", "seed,1,2,3\n")), ("d.csv", "no radius")),
                (1, ("--points", self.file("a.mrk.json", "{")), ("a.mrk.json", "3D Slicer")),
                (1, ("--points", self.file("b.mrk.json", '{"markups": [{"controlPoints": [{"label": "F-1", '
                                                         '"position": [1, 2, 3]}]}]}')),
                 ("b.mrk.json", "F-1", "begins with its kind")),
                (1, ("--points", self.file("c.mrk.json", '{"markups": [{"coordinateSystem": "IJK"}]}')),
                 ("c.mrk.json", "IJK"))):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.segment(*out, *arguments), status, *patterns)


if __name__ == "__main__":
    unittest.main()
