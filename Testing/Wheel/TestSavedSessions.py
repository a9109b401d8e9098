"""What results say of their origin is the same with the wheel's command as with the toolkit's, and both repeat it."""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy

try:
    import nrrd  # another reader than the writers
    import SimpleITK
except ImportError:
    print("Skipped: SimpleITK or pynrrd is not installed.")
    sys.exit(77)

TOOLKIT = os.environ["FLIPFREE_COMMAND"]
OURS = os.environ.get("FLIPFREE_WHEEL_COMMAND", str(Path(sys.executable).parent / "flipfree"))


def run(program, *arguments):
    process = subprocess.run([*program.split(), *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                             timeout=300, check=False)
    if process.returncode:
        raise AssertionError(process.stderr)
    return process.stdout


class SavedSessions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="flipfree-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        words = run(TOOLKIT, "phantom", "abdomen", "-o", cls.folder, "--size", 110, 86, 46, "--spacing", 3, 3, 6)
        cls.volume = cls.folder / "abdomen.nii.gz"
        cls.seeds = {line.split(" (")[0].lower(): re.findall(r"-?[\d.]+", line.split(":")[1]) for line in words.splitlines()}

    def both(self, *arguments, outputs=("-o x.ply", "--save-session s.json")):
        """Both commands give the same, and both repeat the other's session to the same."""
        files = [(option, name) for option, name in (words.split() for words in outputs)]
        for path in self.folder.glob("*-x*"):
            path.unlink()
        for who, program in (("ours", OURS), ("theirs", TOOLKIT)):
            made = [word for option, name in files for word in (option, self.folder / f"{who}-{name}")]
            run(program, *arguments, "-q", *made)
        self.assertEqual(*(json.loads((self.folder / f"{who}-s.json").read_text("utf-8").replace(f'"{who}-', '"'))
                           for who in ("ours", "theirs")))
        for who, program, session in (("ours2", OURS, "theirs"), ("theirs2", TOOLKIT, "ours")):
            made = [word for option, name in files for word in (option, self.folder / f"{who}-{name}")]
            run(program, "segment", self.volume, "--session", self.folder / f"{session}-s.json", "-q", *made)
        return [sorted(self.folder.glob(f"{who}-x*")) for who in ("ours", "theirs", "ours2", "theirs2")]

    def assert_same_vertices(self, groups):
        for paths in zip(*groups):
            parts = [path.read_bytes().split(b"end_header\n", 1) for path in paths]
            count = int(re.search(rb"element vertex (\d+)", parts[0][0])[1])
            vertices = [numpy.frombuffer(content, "<f4", 3 * count) for _, content in parts]
            comments = [b"\n".join(re.findall(rb"^comment provenance.*$", header, re.MULTILINE)) for header, _ in parts]
            self.assertGreater(len(comments[0]), 300)
            for other, text in zip(vertices[1:], comments[1:]):
                numpy.testing.assert_array_equal(other, vertices[0])
                self.assertEqual(text, comments[0])

    def test_organs(self):
        x, y, z, radius = map(float, self.seeds["spleen"])
        self.assert_same_vertices(self.both("segment", self.volume, "--resolution", 16, "--seed", x, y, z, "--radius", radius,
                                            "--seed", x + 4, y, z, "--radius", radius / 2, "--outside", x, y + 30, z))
        self.assert_same_vertices(self.both("segment", self.volume, "--resolution", 16, "--start-labels",
                                            self.folder / "abdomen-truth.nii.gz", "--start-label", 6))

    def test_organs_together(self):
        organs = [word for name in ("liver", "spleen") for word in ("--organ", name, *self.seeds[name])]
        groups = self.both("segment", self.volume, "--resolution", 16, *organs)
        self.assertEqual([len(group) for group in groups], [2] * 4)
        self.assert_same_vertices(groups)

    def test_vessels(self):
        run(TOOLKIT, "phantom", "vessel", "-o", self.folder, "--size", 64, 64, 64, "--spacing", 1.5, 1.5, 1.5)
        volume, self.volume = self.volume, self.folder / "vessel.nii.gz"
        try:
            self.assert_same_vertices(self.both("trace", self.volume, "--point", 13.05, 44.745, 37.36, "--point", 81.45, 49.75, 37.96,
                                                "--wall-thickness", 0.5))
        finally:
            self.volume = volume

    def test_segments(self):
        organs = [word for name in ("liver", "spleen") for word in ("--organ", name, *self.seeds[name])]
        headers = []
        for who, program in (("ours", OURS), ("theirs", TOOLKIT)):
            for name in ("organs.seg.nrrd", "organs.nrrd"):
                run(program, "segment", self.volume, "-q", "--resolution", 16, *organs, "--labels", self.folder / f"{who}-{name}")
            voxels, header = nrrd.read(str(self.folder / f"{who}-organs.seg.nrrd"))
            plain, plain_header = nrrd.read(str(self.folder / f"{who}-organs.nrrd"))
            numpy.testing.assert_array_equal(voxels, plain)
            for key, value in plain_header.items():
                numpy.testing.assert_array_equal(header[key], value, err_msg=key)
            self.assertEqual([header[f"Segment{i}_Name"] for i in range(2)], ["liver", "spleen"])
            for index in range(2):
                places = [numpy.flatnonzero((voxels == index + 1).any(axis=axes)) for axes in ((1, 2), (0, 2), (0, 1))]
                extent = [bound for place in places for bound in (place[0], place[-1])]
                self.assertEqual([int(bound) for bound in header[f"Segment{index}_Extent"].split()], extent)
            image = SimpleITK.ReadImage(str(self.folder / f"{who}-organs.seg.nrrd"))
            original = SimpleITK.ReadImage(str(self.volume))
            self.assertEqual(image.GetSize(), original.GetSize())
            for found, wanted in ((image.GetSpacing(), original.GetSpacing()), (image.GetOrigin(), original.GetOrigin()),
                                  (image.GetDirection(), original.GetDirection())):
                numpy.testing.assert_allclose(found, wanted, atol=1e-5)
            self.assertEqual(image.GetMetaData("Segment1_Name"), "spleen")
            headers.append({key: value for key, value in header.items() if key.startswith("Segment")})
        self.assertEqual(*headers)


if __name__ == "__main__":
    unittest.main()
