"""Sessions that the page in the browser saves are repeated, and refused where they do not fit."""

import itertools
import json
import math
import os
import unittest

import command


class TestSession(command.CommandTest):
    def session(self, name="sphere.nii.gz", **changes):
        """A session of the sphere, beside its volume."""
        x, y, z = map(float, self.seed[self.seed.index("--seed") + 1:][:3])
        radius = float(self.seed[self.seed.index("--radius") + 1])
        organ = {"name": "liver", "color": "#ffd24a", "seed": {"center": [x, y, z], "radius": radius},
                 "preset": "default", "parameters": {"resolution": 16}}
        content = {"format": "flipfree-session", "version": 1, "flipfree": "0.1.0",
                   "image": {"name": name, "size": [64, 64, 40], "spacing": [1, 1, 1.6], "origin": [0, 0, 0],
                             "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1]},
                   "organs": [organ], **changes}
        path = os.path.join(self.inputs, "session.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(content, file)
        return path, content

    def bytes_of(self, name):
        with open(self.result(name), "rb") as file:
            return file.read()

    def test_one_organ(self):
        path, _ = self.session()
        self.assert_succeeds(command.run("segment", self.volume, *self.seed, "--resolution", 16,
                                         "-o", self.result("a.ply"), "--labels", self.result("a.nii")))
        self.assert_succeeds(command.run("segment", "--session", path, "-o", self.result("b.ply"), "--labels", self.result("b.nii")))
        self.assertEqual(self.bytes_of("a.ply"), self.bytes_of("b.ply"))
        self.assertEqual(self.bytes_of("a.nii"), self.bytes_of("b.nii"))
        # Options come after the session's parameters.
        self.assert_succeeds(command.run("segment", "--session", path, "--resolution", 8, "-o", self.result("c.ply")))
        self.assertLess(len(self.bytes_of("c.ply")), len(self.bytes_of("a.ply")))

    def test_several_organs(self):
        _, content = self.session()
        organ = content["organs"][0]
        organs = [organ, {**organ, "seed": None}, {**organ, "name": "left lobe/1", "parameters": {"resolution": 8, "carving": False}}]
        path, _ = self.session(organs=organs)
        process = command.run("segment", self.volume, "--session", path, "-o", self.result("out.stl"),
                              "--labels", self.result("out.nii.gz"), "--convergence", self.result("out.csv"))
        self.assert_succeeds(process)
        self.assertRegex(process.stdout, r"sphere\.nii\.gz, liver: volume .*\n.*sphere\.nii\.gz, left-lobe-1: volume ")
        self.assertEqual(sorted(os.listdir(self.results)), ["out-left-lobe-1.csv", "out-left-lobe-1.stl", "out-liver.csv",
                                                            "out-liver.stl", "out.nii.gz"])
        # The first has the voxels that are in both.
        process = command.run("evaluate", self.result("out.nii.gz"), self.truth, "--label", 1)
        self.assert_succeeds(process)
        self.assertGreater(command.dice_of(process.stdout), 0.96)

    def test_every_parameter_of_the_page(self):
        """The kernels' names, of which the page writes any."""
        parameters = {"maximumIterations": 3, "levels": 1, "resolution": 8, "diffusionIterations": 2, "startCenterOffset": [1, 0, 0],
                      "foregroundMass": 0.9, "leakControl": False, "guard": True, "edgeWindow": 1, "positionWeight": 1.5}
        _, content = self.session()
        organ = {**content["organs"][0], "parameters": parameters}
        path, _ = self.session(organs=[organ])
        self.assert_succeeds(command.run("segment", "--session", path, "-o", self.result("a.ply")))

    def test_corrections(self):
        """Bit for bit what the options give, a further seed among them."""
        _, content = self.session()
        organ = content["organs"][0]
        x, y, z = organ["seed"]["center"]
        points = [("inside", (x, y, z + 26)), ("outside", (x - 20, y, z)), ("boundary", (x, y + 18, z))]
        corrections = [{"kind": kind, "position": place} for kind, place in points]
        corrections.append({"kind": "seed", "position": (x + 6, y, z), "radius": 4})
        table = self.result("points.csv")
        with open(table, "w", encoding="utf-8") as file:
            file.writelines(f"{kind},{','.join(map(str, place))},\n" for kind, place in points)
            file.write(f"seed,{x + 6},{y},{z},4\n")
        self.assert_succeeds(command.run("segment", self.volume, *self.seed, "--resolution", 16, "--points", table,
                                         "-o", self.result("a.ply"), "--labels", self.result("a.nii")))
        path, _ = self.session(version=2, organs=[{**organ, "kind": "organ", "corrections": corrections}])
        self.assert_succeeds(command.run("segment", "--session", path, "-o", self.result("b.ply"), "--labels", self.result("b.nii")))
        self.assertEqual(self.bytes_of("a.ply"), self.bytes_of("b.ply"))
        self.assertEqual(self.bytes_of("a.nii"), self.bytes_of("b.nii"))
        # They do change the organ.
        path, _ = self.session()
        self.assert_succeeds(command.run("segment", "--session", path, "-o", self.result("c.ply")))
        self.assertNotEqual(self.bytes_of("a.ply"), self.bytes_of("c.ply"))

    def test_what_is_wrong_in_corrections(self):
        _, content = self.session()
        organ = {**content["organs"][0], "kind": "organ"}
        right = {"kind": "inside", "position": organ["seed"]["center"]}
        vessel = {"name": "aorta", "color": "#ffffff", "kind": "vessel", "parameters": {}}
        ends = [[20, 30, 30], [40, 30, 30]]
        cases = [({**organ, "corrections": [right, {"kind": "near", "position": [1, 2, 3]}]},
                  "organ 1: 'liver': correction 2: the kind is 'near'; it can be"),
                 ({**organ, "corrections": [{"kind": "inside"}]}, "correction 1: key 'position' not found"),
                 ({**organ, "corrections": [{"kind": "inside", "position": [1, 2]}]}, "correction 1: "),
                 ({**organ, "corrections": [{"kind": "seed", "position": [1, 2, 3]}]}, "correction 1: key 'radius'"),
                 ({**organ, "corrections": [{"kind": "seed", "position": [1, 2, 3], "radius": -1}]}, "a seed has no radius"),
                 ({**organ, "kind": "tumor"}, "the kind is 'tumor'; it can be organ or vessel"),
                 ({**vessel}, "key 'points' not found"),
                 ({**vessel, "points": [[1, 2, 3], [1, 2]]}, "organ 1: 'aorta': point 2: "),
                 ({**vessel, "points": [[1, 2, 3]]}, "no organ has a seed"),
                 ({**vessel, "points": ends, "corrections": [{"kind": "seed", "position": [30, 30, 30], "radius": 3}]},
                  "organ 1: 'aorta': a seed is of no use to a vessel. Open it in the page"),
                 ({**vessel, "points": ends, "parameters": {"speling": 1}}, "aorta: there is no parameter 'Speling' of a vessel"),
                 ({**vessel, "points": ends, "parameters": {"levels": 9}}, "aorta: the parameter 'Levels' is out of its range")]
        for entry, message in cases:
            with self.subTest(entry=entry):
                path, _ = self.session(version=2, organs=[entry])
                self.assert_refused(command.run("segment", "--session", path, "-o", self.result("a.ply")), 1, "session.json", message)
        # What the image refuses.
        path, _ = self.session(version=2, organs=[{**organ, "corrections": [{"kind": "outside", "position": [9999, 0, 0]}]}])
        self.assert_refused(command.run("segment", "--session", path, "-o", self.result("a.ply")), 1,
                            "the outside point .9999, 0, 0. mm lies outside")
        path, _ = self.session(version=2, organs=[{**vessel, "points": [[20, 30, 30], [9999, 0, 0]]}])
        self.assert_refused(command.run("segment", "--session", path, "-o", self.result("a.ply")), 1,
                            "the point .9999, 0, 0. mm lies outside")

    def test_vessels(self):
        """Bit for bit what `trace` gives, beside an organ."""
        command.make_phantom(self.inputs, "vessel", "--size", 64, 64, 64, "--spacing", 1.5, 1.5, 1.5)
        volume = os.path.join(self.inputs, "vessel.nii.gz")
        center = 63 / 2 * 1.5
        ends = [[center + 36 * t, center + 16 * math.sin(math.pi * t), center + 10 * math.cos(0.8 * math.pi * t + 0.5)]
                for t in (-0.95, 0.95)]
        image = {"name": "vessel.nii.gz", "size": [64, 64, 64], "spacing": [1.5, 1.5, 1.5], "origin": [0, 0, 0],
                 "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1]}
        vessel = {"name": "aorta", "kind": "vessel", "color": "#ffffff", "points": ends,
                  "parameters": {"wallThickness": 0.5, "modality": 2, "levels": 1}}
        start = [center + 36 * 0.2, center + 16 * math.sin(math.pi * 0.2), center + 10 * math.cos(0.8 * math.pi * 0.2 + 0.5)]
        organ = {"name": "piece", "kind": "organ", "color": "#ffffff", "seed": {"center": start, "radius": 3},
                 "preset": "default", "parameters": {"resolution": 8, "levels": 1}, "corrections": []}
        waiting = {**vessel, "name": "later", "points": ends[:1]}
        path, _ = self.session(version=2, image=image, organs=[vessel, waiting, organ])
        points = [word for end in ends for word in ("--point", *end)]
        self.assert_succeeds(command.run("trace", volume, *points, "--wall-thickness", 0.5, "--modality", 2, "--levels", 1,
                                         "-o", self.result("a.ply"), "--convergence", self.result("a.csv")))
        process = command.run("segment", "--session", path, "-o", self.result("b.ply"), "--labels", self.result("b.nii"),
                              "--convergence", self.result("b.csv"))
        self.assert_succeeds(process, may_be_doubtful=True)  # the piece of a vessel as an organ
        self.assertRegex(process.stdout, r"vessel\.nii\.gz, aorta: volume .*; reading .* path .*\n.*, piece: volume .* smoothing ")
        self.assertEqual(self.bytes_of("a.ply"), self.bytes_of("b-aorta.ply"))
        self.assertIn("b-aorta.csv", os.listdir(self.results))
        scores = command.run("evaluate", self.result("b.nii"), os.path.join(self.inputs, "vessel-truth.nii.gz"),
                             "--segmentation-label", 1, "--reference-label", 1)
        self.assert_succeeds(scores)
        self.assertGreater(command.dice_of(scores.stdout), 0.85)

    def test_what_does_not_fit(self):
        _, content = self.session()
        organ = content["organs"][0]
        image = content["image"]
        cases = [({"format": "letter"}, "format"), ({"version": 3}, "version"), ({"organs": []}, "no organ has a seed"),
                 ({"organs": [organ, organ]}, "name 'liver'"), ({"organs": [{"name": "liver"}]}, "key 'seed' not found"),
                 ({"organs": [{**organ, "preset": "best"}]}, "preset 'best'"),
                 ({"organs": [{**organ, "parameters": {"speling": 1}}]}, "parameter 'Speling'"),
                 ({"organs": [{**organ, "parameters": {"guard": "on"}}]}, "type must be number"),
                 ({"image": {**image, "size": [64, 64, 41]}}, "not the image"),
                 ({"image": {**image, "origin": [0, 0, 1]}}, "not the image"),
                 ({"image": {**image, "direction": [1, 2]}}, "session.json"),
                 ({"image": {**image, "name": "other.nii.gz"}}, "not beside")]
        for changes, message in cases:
            with self.subTest(**changes):
                path, _ = self.session(**changes)
                self.assert_refused(command.run("segment", "--session", path, "-o", self.result("a.ply")), 1, "session.json", message)
        for radius, together in itertools.product((0, -1, 1e-9, 2e6), (False, True)):
            with self.subTest(radius=radius, together=together):
                path, _ = self.session(organs=[{**organ, "seed": {**organ["seed"], "radius": radius}}], together=together)
                self.assert_refused(command.run("segment", "--session", path, "-o", self.result("a.ply")), 1,
                                    "organ 1: 'liver': the radius must be a positive number of millimeters, 1e-6 to 1e6")
        path, _ = self.session(organs=[{**organ, "parameters": {"levels": 99}}])
        self.assert_refused(command.run("segment", "--session", path, "-o", self.result("a.ply")), 2, "--levels")
        with open(path, "w", encoding="utf-8") as file:
            file.write('{"format": ')
        self.assert_refused(command.run("segment", "--session", path, "-o", self.result("a.ply")), 1, "not a session")
        self.assert_refused(command.run("segment", "--session", "/nowhere.json", "-o", self.result("a.ply")), 1, "/nowhere.json")

    def test_what_excludes_it(self):
        path, _ = self.session()
        for words in (self.seed, ("--seed-voxel", 1, 2, 3), ("--radius", 3), ("--preset", "naive")):
            with self.subTest(words=words):
                self.assert_refused(command.run("segment", self.volume, "--session", path, *words, "-o", self.result("a.ply")),
                                    2, "--session")
        self.assert_refused(command.run("segment", *self.seed, "-o", self.result("a.ply")), 2, "INPUT")


if __name__ == "__main__":
    unittest.main()
