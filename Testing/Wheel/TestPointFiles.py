"""Files of points, which the toolkit's command and the wheel's read by the same code: whatever programs write, and what is refused."""

import json
import os
import tempfile
import unittest
from pathlib import Path

import flipfree
from flipfree import _kernels, _point_files
from flipfree._corrections import INSIDE, Constraint

MARK = b"\xef\xbb\xbf"
POINTS = "inside,62,32,32,\noutside,32,54,32,\nseed,40,32,32,4\n"


def markups(*controls, **entries):
    """As 3D Slicer saves them; controls are label, position and, if wanted, positionStatus."""
    points = [dict(zip(("label", "position", "positionStatus"), control), id=str(number)) for number, control in enumerate(controls)]
    return json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": points, **entries}]})


LPS = (("inside-1", [62, 32, 32]), ("Outside_2", [32, 54, 32.0]), ("seed 4", [40, 32, 32]))
RAS = tuple((label, [-x, -y, z]) for label, (x, y, z) in LPS)


def scaled(factor, points=LPS):
    return [(label, [factor * x for x in place]) for label, place in points]


# All of them hold the points above.
GOOD = {
    "plain.csv": POINTS,
    "header.csv": "kind,x,y,z,radius\n" + POINTS,
    "capitals.CSV": "Kind, X, Y, Z, Radius\n" + POINTS.upper(),
    "mark.csv": MARK + ("kind,x,y,z,radius\n" + POINTS).encode(),
    "windows.csv": ("kind,x,y,z,radius\n" + POINTS).replace("\n", "\r\n"),
    "blank.csv": "\n  \nkind,x,y,z,radius\n\n" + POINTS.replace("\n", "\n\n,,,,\n"),
    "spaces.csv": POINTS.replace(",", " ,\t"),
    "quotes.csv": '"kind","x","y","z","radius"\n' + POINTS.replace("inside", '" inside"').replace("54", '"54"'),
    "cut.csv": POINTS.rstrip("\n").replace(",\n", "\n"),
    "wide.csv": POINTS.replace("\n", ",,,\n"),
    "numbers.csv": "inside,6.2e1,+32,32.\noutside,3200E-2,54,032\nseed,40,32,32,.4e1\n",
    "german.csv": "kind;x;y;z;radius\n" + POINTS.replace(",", ";").replace("54", "54,0"),
    "tabs.csv": POINTS.replace(",", "\t"),
    "sep.csv": "sep=;\n" + POINTS.replace(",", ";"),
    "order.csv": "z,radius,Kind,y,x\n32,,inside,32,62\n32,,outside,54,32\n32,4,seed,32,40\n",
    "radius.csv": POINTS.replace("inside,62,32,32,", "inside,62,32,32,7"),
    "lps.mrk.json": markups(*LPS),
    "ras.mrk.json": markups(*RAS, coordinateSystem="RAS"),
    "zero.mrk.json": markups(*RAS, coordinateSystem=0),
    "text.mrk.json": markups(*RAS, coordinateSystem="0"),
    "one.MRK.JSON": markups(*LPS, coordinateSystem=1),
    "none.mrk.json": markups(*LPS).replace('"coordinateSystem": "LPS", ', ""),
    "mark.mrk.json": MARK + markups(*LPS).encode(),
    "words.mrk.json": markups(("inside the left lobe", [62, 32, 32]), *LPS[1:2], ("\tSEED-1 4.0 mm", [40, 32, 32])),
    "floats.mrk.json": markups(*LPS).replace("62", "6.2e1"),
    "defined.mrk.json": markups(*((*control, "defined") for control in LPS), type="Curve"),
    "undefined.mrk.json": markups(*LPS, ("inside-4", "", "undefined"), ("outside-5", [0, 0, 0], "undefined")),
    "missing.mrk.json": markups(("F-1", "", "missing"), *LPS[:2], ("F-2", [1, 2, 3], "preview"), *LPS[2:]),
    "unplaced.mrk.json": markups(*LPS, ("inside-4", "")),
    "nanometers.mrk.json": markups(*scaled(1000000), coordinateUnits="nm"),
    "micrometers.mrk.json": markups(*scaled(1000, RAS), coordinateSystem="RAS", coordinateUnits="um"),
    "millimeters.mrk.json": markups(*LPS, coordinateUnits=["mm", "UCUM", "millimeter"]),
    "centimeters.mrk.json": markups(*scaled(0.1), coordinateUnits=["cm", "UCUM", "centimeter"]),
    "meters.mrk.json": markups(*scaled(0.001), coordinateUnits="m"),
    "lists.mrk.json": json.dumps({"other": 1, "markups": [json.loads(markups(LPS[0]))["markups"][0], {"controlPoints": []},
                                                          json.loads(markups(*LPS[1:]))["markups"][0]]}),
}

# What each is refused for.
BAD = {
    "cells.csv": ("inside,1,2\n", "line 1: 3 cells; needed are kind, x, y, z and"),
    "many.csv": ("\ninside,1,2,3,4,5\n", "line 2: 6 cells"),
    "bars.csv": ("kind|x|y|z\ninside|1|2|3\n", "line 1: the header must be kind, x, y, z and"),
    "places.csv": ("x,y,z\n1,2,3\n", "in any order; a table of x, y and z alone is for --inside-stroke or --outside-stroke"),
    "rows.csv": ("1,2,3\n", "line 1: 3 cells; needed are kind, x, y, z and, for seeds, radius; a table of x, y and z alone is"),
    "columns.csv": ("Kind,x,y,z,radius,name\n", "line 1: the header must be kind, x, y, z and"),
    "open.csv": ('inside,"1,2,3\n', "line 1: a cell begins with a quote"),
    "thousands.csv": ("inside;1,5;2.5;3\n", "some numbers have a decimal point"),
    "twice.csv": ("kind,x,y,z\nkind,x,y,z\n", "line 2: 'x' is not a number"),
    "kind.csv": ("kind,x,y,z\nAbove,1,2,3\n", "line 2: the kind is 'above'; it can be outside"),
    "umlaut.csv": ("ÄUSSEN,1,2,3\n", "line 1: the kind is 'Äussen'"),
    "no-kind.csv": (",1,2,3\n", "line 1: the column kind is empty"),
    "unit.csv": ("inside,1,2,3mm\n", "line 1: '3mm' is not a number"),
    "empty.csv": ("inside,1,,3\n", "line 1: the column y is empty"),
    "hexadecimal.csv": ("inside,1,0x10,3\n", "'0x10' is not a number"),
    "underscore.csv": ("inside,1,1_0,3\n", "'1_0' is not a number"),
    "arabic.csv": ("inside,1,٣,3\n", "'٣' is not a number"),
    "nan.csv": ("inside,nan,2,3\n", "'nan' is not a number"),
    "infinite.csv": ("inside,1,2,-Infinity\n", "'-Infinity' is not a number"),
    "huge.csv": ("inside,1,2,1e999\n", "'1e999' is not a number"),
    "exponent.csv": ("inside,1e,2,3\n", "'1e' is not a number"),
    "space.csv": ("inside,1 0,2,3\n", "'1 0' is not a number"),
    "two.csv": ("inside,here,there,3\n", "'here' is not a number"),
    "both.csv": ("above,1,2,x\n", "'x' is not a number"),
    "no-radius.csv": ("seed,1,2,3\n", "line 1: a seed has no radius"),
    "negative.csv": ("seed,1,2,3,-4\n", "line 1: a seed has no radius"),
    "letters.csv": ("seed,1,y,3,big\n", "'y' is not a number"),
    "latin.csv": ("inside,1,2,3\näbc,1,2,3\n".encode("latin-1"), "is not UTF-8 text"),
    "utf16.csv": (POINTS.encode("utf-16"), "is not UTF-8 text"),
    "nul.csv": (b"inside,1,2,3\0\n", "is not UTF-8 text"),
    "broken.mrk.json": ("{", "does not hold markups"),
    "nothing.mrk.json": ("", "does not hold markups"),
    "table.mrk.json": (POINTS, "does not hold markups"),
    "more.mrk.json": (markups(*LPS) + "x", "does not hold markups"),
    "list.mrk.json": ("[1]", "does not hold markups"),
    "other.mrk.json": ('{"a": 1}', "does not hold markups"),
    "null.mrk.json": ('{"markups": null}', "does not hold markups"),
    "object.mrk.json": ('{"markups": {"a": {"controlPoints": []}}}', "does not hold markups"),
    "numbers.mrk.json": ('{"markups": [7]}', "does not hold markups"),
    "controls.mrk.json": ('{"markups": [{}]}', "does not hold markups"),
    "word.mrk.json": (markups(controlPoints=""), "does not hold markups"),
    "mapping.mrk.json": (markups(controlPoints={}), "does not hold markups"),
    "label.mrk.json": (markups((7, [1, 2, 3])), "does not hold markups"),
    "no-label.mrk.json": (markups(*LPS).replace("label", "name"), "control point 1: it has no label; give it one that begins with its kind"),
    "no-place.mrk.json": (markups(*LPS).replace("position", "place"), "does not hold markups"),
    "null-place.mrk.json": (markups(("inside", None)), "does not hold markups"),
    "not-a-number.mrk.json": (markups(("inside", [1, 2, float("nan")])), "does not hold markups"),
    "infinite.mrk.json": (markups(("inside", [1, 2, 3])).replace("3]", "1e999]"), "does not hold markups"),
    "long.mrk.json": (markups(("inside", [1, 2, 10**400])), "does not hold markups"),
    "surrogate.mrk.json": (markups(("\ud800", [1, 2, 3])), "does not hold markups"),
    "latin.mrk.json": (b'{"markups": "\xe4"}', "is not UTF-8 text"),
    "system.mrk.json": (markups(coordinateSystem="IJK"), 'the coordinate system is "IJK"; it can be'),
    "no-system.mrk.json": (markups(coordinateSystem=None), "the coordinate system is null"),
    "true.mrk.json": (markups(*LPS, coordinateSystem=True), "the coordinate system is true"),
    "part.mrk.json": (markups(*LPS, coordinateSystem=0.0), "the coordinate system is 0.0"),
    "tree.mrk.json": (markups(*LPS, coordinateSystem={"b": [1, 2], "a": "x"}), r'is {"a":"x","b":\[1,2\]}'),
    "pixels.mrk.json": (markups(*LPS, coordinateUnits="px"), r'the unit of coordinates is "px"; it can be nm, um, .*or \[in_i\]'),
    "no-unit.mrk.json": (markups(*LPS, coordinateUnits=None), "the unit of coordinates is null"),
    "no-code.mrk.json": (markups(*LPS, coordinateUnits=[]), r"the unit of coordinates is \[\]"),
    "flat.mrk.json": (markups(("inside", [1, 2])), 'control point "inside": its position is not three numbers'),
    "four.mrk.json": (markups(("inside", [1, 2, 3, 4])), "its position is not three numbers"),
    "quoted.mrk.json": (markups(("inside", ["1", "2", "3"])), "its position is not three numbers"),
    "truth.mrk.json": (markups(("inside", [True, 2, 3])), "its position is not three numbers"),
    "default.mrk.json": (markups(("F-1", [1, 2, 3])), 'control point "F-1": the kind is \'f\'.*begins with its kind'),
    "no-word.mrk.json": (markups(*LPS, ("", [1, 2, 3])), "control point 4: it has no label"),
    "quote.mrk.json": (markups(('say "ö"\n', [1, 2, 3])), r'control point "say \\"ö\\"\\n": the kind is \'say\''),
    "seed.mrk.json": (markups(("Seed-1", [1, 2, 3])), "a seed has no radius"),
    "big.mrk.json": (markups(("seed big", [1, 2, 3])), "'big' is not a number"),
}


class PointFiles(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        before = os.getcwd()
        os.chdir(cls.folder)
        cls.addClassCleanup(os.chdir, before)

    def write(self, name, content):
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())

    def test_good_files_hold_the_same_points(self):
        """Read exactly, as what is written shows."""
        saved = "kind,x,y,z,radius\n" + POINTS
        for name, content in GOOD.items():
            self.write(name, content)
            with self.subTest(name):
                _point_files.write_points("saved.csv", _point_files.read_points(name))
                self.assertEqual((self.folder / "saved.csv").read_text(), saved)

    def test_markups_are_read_again(self):
        self.write("lps.mrk.json", GOOD["lps.mrk.json"])
        points = [*_point_files.read_points("lps.mrk.json"), Constraint(INSIDE, (62.5, 32.0, 32.1))]
        _point_files.write_points("saved.mrk.json", points)
        self.assertEqual(_point_files.read_points("saved.mrk.json"), points)
        self.assertIn(b"62.5", (self.folder / "saved.mrk.json").read_bytes())

    def test_files_of_no_points(self):
        for name, content in {"empty.csv": "", "header.csv": "kind,x,y,z\n", "empty.mrk.json": '{"markups": []}'}.items():
            self.write(name, content)
            with self.subTest(name), self.assertWarnsRegex(flipfree.FlipFreeWarning, f"'{name}' holds no points, so nothing is corrected by it"):
                self.assertEqual(_point_files.read_points(name), [])

    def test_bad_files_are_refused(self):
        (self.folder / "folder.csv").mkdir()
        missing = {"gone.csv": (None, "Check the name and the folder"),
                   "folder.csv": (None, "cannot be read. Check the name and the permissions")}
        for name, (content, message) in {**BAD, **missing}.items():
            if content is not None:
                self.write(name, content)
            with self.subTest(name), self.assertRaisesRegex(flipfree.FileError, rf"\A(There is no file )?'{name}'[^\n]*{message}[^\n]*\Z"):
                _kernels_read(name)


def _kernels_read(name):
    """As the option --points."""
    try:
        return _kernels.read_points(name, "--inside-stroke or --outside-stroke")
    except _kernels.Failure as failure:
        raise flipfree.FileError(str(failure)) from None


class VesselFiles(unittest.TestCase):
    """What a cohort reads: points of whatever label."""

    def read(self, name, content):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.write_text(content, encoding="utf-8")
            return _point_files.read_places(str(path))

    def test_good(self):
        expected = [(1.0, 2.0, 3.5), (-4.0, 5.0, 6.0)]
        for name, content in {"a.csv": "1,2,3.5\n-4,5,6\n", "b.csv": "X,Y,Z\n\n1 , 2,3.5,\n-4,5,6\n", "c.csv": "3,5;1;2\n6;-4;5\n".replace("3,5", "Z;X;Y\n3,5"),
                              "a.mrk.json": markups(("F-1", [1, 2, 3.5]), ("", [-4, 5, 6])),
                              "b.mrk.json": markups(("P", [-1, -2, 3.5]), ("Q", [4, -5, 6]), coordinateSystem="RAS"),
                              "c.mrk.json": markups(("", [1000, 2000, 3500], "defined"), ("F", "", "undefined"),
                                                    ("G", [-4000, 5000, 6000]), coordinateUnits="um")}.items():
            with self.subTest(name):
                self.assertEqual(self.read(name, content), expected)

    def test_bad(self):
        for message, name, content in ((r"line 1: 4 cells; needed are x, y, z\.$", "a.csv", "inside,1,2,3\n"),
                                       ("line 1: the header must be x, y, z, in any order", "a.csv", "x,z,a\n"),
                                       ("line 2: 'y' is not a number", "a.csv", "1,2,3\n1,y,3\n"),
                                       ("with the columns x, y and z", "a.mrk.json", "{"),
                                       ('control point "F": its position is not', "a.mrk.json", markups(("F", [1])))):
            with self.subTest(message), self.assertRaisesRegex(flipfree.FileError, message):
                self.read(name, content)


if __name__ == "__main__":
    unittest.main()
