"""The command that comes with the wheel: its options and answers are those of the toolkit's."""

import csv
import json
import math
import os
import pty
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import flipfree
import numpy

try:
    import SimpleITK  # pylint: disable=unused-import
except ImportError:
    print("Skipped: SimpleITK is not installed.")
    sys.exit(77)

sys.path.append(str(Path(__file__).resolve().parent.parent / "Support"))
import lobed_ball  # pylint: disable=wrong-import-position

TOOLKIT = os.environ["FLIPFREE_COMMAND"]
OURS = str(Path(sys.executable).parent / "flipfree")


def run(*arguments, program=OURS, **options):
    return subprocess.run([program, *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=120, check=False, **options)


def vertices_of(path):
    """Of a binary PLY file."""
    header, content = path.read_bytes().split(b"end_header\n", 1)
    return numpy.frombuffer(content, "<f4", 3 * int(re.search(rb"element vertex (\d+)", header)[1]))


class Options(unittest.TestCase):
    def test_help_is_the_toolkits(self):
        for name in ("segment", "trace", "surfaces", "evaluate", "series", "phantom"):
            ours, theirs = (re.sub(" +\n", "\n", run(name, "--help", program=program).stdout)
                            for program in (OURS, TOOLKIT))
            if name == "segment":  # matplotlib draws its pictures
                self.assertIn("needs\nmatplotlib", ours)
                theirs = theirs.replace(" a\ndisplay (or xvfb-run -a).",
                                        "\nmatplotlib, which the extra plot installs, and no display.")
            self.assertEqual(ours, theirs)
            self.assertNotIn("xvfb", ours)
        self.assertIn("  cohort ", run("--help").stdout)
        # Examples work without the packages of extras.
        self.assertNotRegex(run("--help").stdout + run("evaluate", "--help").stdout, r"evaluate \S+\.vtp")

    def test_module_is_the_command(self):
        process = run("-m", "flipfree", "--version", program=sys.executable)
        self.assertEqual(process.stdout, f"flipfree {flipfree.__version__}\n")
        self.assertEqual(process.stdout, run("--version").stdout)

    def test_standard_output_that_nobody_reads(self):
        """As behind `| head`, it is no error; where there is no space, it is one."""
        for arguments in (("segment", "--help"), ("--version",)):
            reader, writer = os.pipe()
            os.close(reader)
            with self.subTest(arguments), open(writer, "wb") as closed, open("/dev/full", "wb") as full:
                for output, status, message in ((closed, 128 + signal.SIGPIPE, r"\Z"),
                                                (full, 1, r"flipfree: error: Writing failed \(.*\)\.\n\Z")):
                    process = subprocess.run([OURS, *arguments], stdout=output, stderr=subprocess.PIPE, text=True, timeout=120,
                                             check=False)
                    self.assertEqual(process.returncode, status)
                    self.assertRegex(process.stderr, rf"\A{message}")

    def test_another_pipe_that_nobody_reads(self):
        """Of a scheduler, say: it is an error, which says so."""
        code = ("import sys\nfrom flipfree import _command\n"
                "def run(words):\n    print('so far')\n    raise BrokenPipeError(32, 'Broken pipe')\n"
                "_command._run = run\nsys.exit(_command.main([]))\n")
        process = run("-c", code, program=sys.executable)
        self.assertEqual((process.returncode, process.stdout, process.stderr),
                         (1, "so far\n", "flipfree: error: Writing failed (Broken pipe).\n"))


class Work(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.seeds = run("phantom", "sphere", "-o", cls.folder, "--size", 48, 48, 32, "--spacing", 1, 1, 1.6).stdout
        cls.seed = re.search("--seed.*", cls.seeds)[0].split()
        cls.volume, cls.truth = cls.folder / "sphere.nii.gz", cls.folder / "sphere-truth.nii.gz"

    def segment(self, program, *arguments):
        process = run("segment", self.volume, *self.seed, *arguments, program=program)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        return process.stdout

    def test_results_are_the_toolkits(self):
        """Files of each are read by the other, and a surface has the same scores wherever it is measured."""
        options = ("--resolution", 16, "--no-leak-control", "--start-offset", 1, -2, -1e-1)
        scores, volumes = [], set()
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            text = self.segment(program, *options, "-o", self.folder / f"{name}.vtp", "--labels",
                                self.folder / f"{name}.nii.gz", "--convergence", self.folder / f"{name}.csv")
            self.assertRegex(text, r"volume \d+\.\d ml, \d+ iterations, [a-z ]+, 0 self-intersections, confidence 0\.9\d; reading ")
            volumes.add(re.search(r"volume (\S+) ml", text)[1])
            surfaces = {run("evaluate", self.folder / f"{name}.vtp", self.truth, program=judge).stdout
                        for judge in (OURS, TOOLKIT)}
            self.assertEqual(len(surfaces), 1, surfaces)
            scores.append(surfaces.pop())
        self.assertEqual(*scores)
        self.assertEqual(len(volumes), 1, volumes)
        self.assertRegex(scores[0], r"Dice +0\.9[5-9].*\n(.*\n)*surface +valid: closed, Euler number 2, self-inter")
        ours, theirs = (flipfree.read_image(self.folder / f"{name}.nii.gz") for name in ("ours", "theirs"))
        numpy.testing.assert_array_equal(ours.voxels, theirs.voxels)
        self.assertEqual((ours.spacing, ours.origin, ours.direction),
                         (theirs.spacing, theirs.origin, theirs.direction))
        ours, theirs = (list(csv.DictReader((self.folder / f"{name}.csv").read_text(encoding="utf-8").splitlines()))
                        for name in ("ours", "theirs"))
        self.assertEqual(len(ours), len(theirs))
        self.assertEqual(list(ours[0]), list(theirs[0]))

    def test_start_labels(self):
        """A label map in place of a seed."""
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            process = run("segment", self.volume, "--start-labels", self.truth, "--outside", 24, 38, 24, "-o",
                          self.folder / f"{name}.vtp", program=program)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
        scores = {run("evaluate", self.folder / f"{name}.vtp", self.truth).stdout for name in ("ours", "theirs")}
        self.assertEqual(len(scores), 1, scores)
        self.assertRegex(scores.pop(), r"Dice +0\.9[89]")
        for arguments, status, message in (
                ([*self.seed, "--start-labels", self.truth], 2, "--start-labels takes the place of the seed"),
                (["--start-labels", self.truth, "--session", "a.json"], 2, "--session has the seed"),
                (["--start-labels", self.truth, "--start-label", 9], 1, "the start labels have no voxels with the value 9; they have 1: set --start-label to a value that they have"),
                (["--start-labels", "nowhere.nii"], 1, r"\Aflipfree: error: [^:\n]*'nowhere.nii'"),
                ([*self.seed, "--start-label", 9], 2, "--start-label")):
            with self.subTest(message):
                process = run("segment", self.volume, *arguments, "-o", self.folder / "bad.stl")
                self.assertEqual(process.returncode, status, process.stderr)
                self.assertRegex(process.stderr, r"\Aflipfree: error: [^\n]*\.\n\Z")
                self.assertRegex(process.stderr, message)
        self.assertFalse((self.folder / "bad.stl").exists())

    def test_surfaces_of_labels(self):
        """All labels of a label map, under the names of a table."""
        run("phantom", "abdomen", "-o", self.folder, "--size", 40, 32, 24, "--spacing", 8, 8, 10)
        names = self.folder / "names.csv"
        names.write_text('label,name\n6,liver – all\n2,"right kidney"\n9;vena\n', encoding="utf-8")
        wrong, latin = self.folder / "wrong.csv", self.folder / "latin.csv"
        wrong.write_text("6,liver\n-2,kidney\n", encoding="utf-8")
        latin.write_text("6,Leber \u00e4\n", encoding="latin-1")
        made = {}
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            folder = self.folder / f"surfaces-{name}"
            process = run("surfaces", self.folder / "abdomen-truth.nii.gz", "-o", folder, "--names", names, "--format", "ply",
                          "--label", 6, "--label", 2, "--label", 9, "--distance", 0.8, program=program)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            self.assertEqual(sorted(path.name for path in folder.iterdir()),
                             ["2-right_kidney.ply", "6-liver_–_all.ply", "9-vena.ply", "surfaces.csv"])
            rows = list(csv.DictReader((folder / "surfaces.csv").read_text(encoding="utf-8").splitlines()))
            numbers = [[float(f"{float(value):.5g}") for key, value in row.items() if key not in ("Name", "File")] for row in rows]
            made[name] = (process.stdout, list(rows[0]), [row["Name"] for row in rows], numbers,
                          [vertices_of(folder / row["File"]).tolist() for row in rows])
        self.assertEqual(made["ours"], made["theirs"])
        for arguments in (("--exact", "--distance", 0.7), ("--distance", 3), ("--label", 77), ("--names", "nowhere.csv"),
                          ("--names", wrong), ("--names", latin)):
            vain = self.folder / "vain"
            said = [run("surfaces", self.folder / "abdomen-truth.nii.gz", "-o", vain, *arguments, program=program)
                    for program in (OURS, TOOLKIT)]
            self.assertFalse(vain.exists())
            self.assertEqual(*(process.returncode for process in said))
            for process in said:
                self.assertRegex(process.stderr, r"\Aflipfree: error: [^\n]+\n\Z")

    def test_questions(self):
        """Both ask the same, and the same answers give the same surface."""
        volume = self.folder / "lobed.nii.gz"
        voxels = numpy.frombuffer(lobed_ball.lobed_ball(4), numpy.int16).reshape(lobed_ball.SIZE[::-1])
        flipfree.write_image(flipfree.image_from_array(voxels, lobed_ball.SPACING), volume)
        arguments = ["segment", volume, "--seed", *lobed_ball.SEED, "--radius", lobed_ball.RADIUS, "--resolution", 16, "-q"]
        tables, prompts, surfaces = [], set(), set()
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            table, surface = self.folder / f"{name}.csv", self.folder / f"{name}.ply"
            process = run(*arguments, "--questions", table, program=program)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            tables.append(list(csv.DictReader(table.read_text(encoding="utf-8").splitlines())))
            process = run(*arguments, "--ask", "-o", surface, program=program)
            self.assertEqual((process.returncode, surface.exists()), (2, False))
            self.assertRegex(process.stderr, "^flipfree: error: --ask needs a terminal to ask at")
            prompts.add(self.answered(b"y\n", program, *arguments, "--ask", "-o", surface, "--save-points", table))
            surfaces.add(vertices_of(surface).tobytes())
            self.assertRegex(table.read_text(encoding="utf-8"), r"^kind,x,y,z,radius\ninside,\d+,\d+,\d+,\n$")
        self.assertEqual([list(table[0]) for table in tables], [["x", "y", "z", "volume_ml", "included", "margin"]] * 2)
        for ours, theirs in zip(tables[0][0].values(), tables[1][0].values()):
            self.assertLess(abs(float(ours) - float(theirs)), 1e-4 * max(1, abs(float(ours))))
        self.assertEqual((len(prompts), len(surfaces)), (1, 1), prompts)
        labels = self.folder / "lobed-labels.nii.gz"
        self.assertEqual(run(*arguments, "--labels", labels).returncode, 0)
        for start in (arguments, ["segment", volume, "--start-labels", labels, "--resolution", 8, "-q"]):
            no_carving = ["--no-carving"] if start is arguments else []
            said = {self.answered(b"", program, *start, *no_carving, "--ask", "-o", self.folder / "a.ply")
                    for program in (OURS, TOOLKIT)}
            self.assertRegex("".join(said), r"\A--ask: there is nothing to ask; [^\n]+\.\n\Z")

    def answered(self, answer, program, *arguments):
        """What is written on the standard error stream while a terminal gives the answer."""
        try:
            ours, theirs = pty.openpty()
        except OSError as error:  # a chroot without /dev/pts
            self.skipTest(f"no pseudo-terminal: {error}")
        os.write(ours, answer)  # the terminal keeps it until it is read
        process = subprocess.run([program, *map(str, arguments)], stdin=theirs, capture_output=True, text=True, timeout=120, check=False)
        os.close(theirs)
        os.close(ours)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stderr

    def test_session(self):
        """What the page in the browser saves, repeated by both commands."""
        organ = {"name": "left/lobe", "color": "#ffd24a", "preset": "default", "parameters": {"resolution": 8, "carving": False},
                 "seed": {"center": list(map(float, self.seed[1:4])), "radius": float(self.seed[5])}}
        image = {"name": self.volume.name, "size": [48, 48, 32], "spacing": [1, 1, 1.6], "origin": [0, 0, 0],
                 "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1]}
        session = {"format": "flipfree-session", "version": 1, "image": image,
                   "organs": [organ, {**organ, "name": "right", "preset": "published", "parameters": {"maximumIterations": 2}}]}
        path = self.folder / "session.json"
        path.write_text(json.dumps(session), encoding="utf-8")
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            process = run("segment", "--session", path, "--resolution", 12, "-o", self.folder / f"{name}.ply",
                          "--labels", self.folder / f"{name}.nii.gz", program=program)
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertRegex(process.stdout, r"sphere\.nii\.gz, left-lobe: volume .*\n.*sphere\.nii\.gz, right: volume ")
        for name in ("left-lobe", "right"):
            scores = {run("evaluate", self.folder / f"{one}-{name}.ply", self.truth).stdout for one in ("ours", "theirs")}
            self.assertEqual(len(scores), 1, scores)
        ours, theirs = (flipfree.read_image(self.folder / f"{name}.nii.gz") for name in ("ours", "theirs"))
        numpy.testing.assert_array_equal(ours.voxels, theirs.voxels)
        for change, message in (({"organs": [organ, organ]}, "two organs"), ({"image": {**image, "size": [48, 48, 33]}}, "not the image"),
                                ({"organs": [{**organ, "parameters": {"speling": 1}}]}, "speling"), ({"organs": [{}]}, "seed")):
            path.write_text(json.dumps({**session, **change}), encoding="utf-8")
            process = run("segment", "--session", path, "-o", self.folder / "bad.ply")
            self.assertEqual(process.returncode, 1, process)
            self.assertRegex(process.stderr, f"flipfree: error: (?=[^\n]*session.json)[^\n]*{message}")
        self.assertEqual(run("segment", "-o", self.folder / "bad.ply").returncode, 2)
        self.assertFalse((self.folder / "bad.ply").exists())

    def test_wrong_values_in_the_same_words(self):
        """Status and message are the toolkit's."""
        path = self.folder / "session.json"
        image = {"name": self.volume.name, "size": [48, 48, 32], "spacing": [1, 1, 1.6], "origin": [0, 0, 0],
                 "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1]}
        session = {"format": "flipfree-session", "version": 2, "image": image}
        cases = [({}, ("segment", self.volume, *self.seed, "--threads", number), 2, f"--threads: {number} is out of range. Give 0 to 1024")
                 for number in (-2, 1025)]
        cases += [(content, ("segment", "--session", path), 1, message) for content, message in (
            ({}, "key 'format' not found"), (session, "key 'organs' not found"),
            ({**session, "organs": [{"name": "a", "preset": "default", "parameters": {}}]}, "organ 1: key 'seed' not found"))]
        for content, arguments, status, message in cases:
            path.write_text(json.dumps(content), encoding="utf-8")
            found = [run(*arguments, "-o", self.folder / "never.stl", program=program) for program in (OURS, TOOLKIT)]
            with self.subTest(message):
                self.assertEqual([process.returncode for process in found], [status, status])
                self.assertEqual(found[0].stderr, found[1].stderr)
                self.assertIn(message, found[0].stderr)
        path.write_text(json.dumps({**session, "organs": 7}), encoding="utf-8")
        self.assertNotRegex(run("segment", "--session", path, "-o", self.folder / "never.stl").stderr, r"Error\(|object")
        process = run("cohort", "table.csv", "-o", self.folder / "never", "--threads", 0)
        self.assertEqual(process.returncode, 2)
        self.assertRegex(process.stderr, "--threads: 0 is out of range")

    def test_session_with_corrections_and_vessels(self):
        """The same by both commands, and the same words where it is wrong."""
        run("phantom", "vessel", "-o", self.folder, "--size", 64, 64, 64, "--spacing", 1.5, 1.5, 1.5)
        x, y, z = map(float, self.seed[1:4])
        organ = {"name": "liver", "kind": "organ", "color": "#ffd24a", "preset": "default",
                 "parameters": {"resolution": 16, "carving": False}, "seed": {"center": [x, y, z], "radius": float(self.seed[5])},
                 "corrections": [{"kind": "outside", "position": [x - 14, y, z]}, {"kind": "inside", "position": [x, y, z + 17]},
                                 {"kind": "boundary", "position": [x, y + 13, z]},
                                 {"kind": "seed", "position": [x + 3, y, z], "radius": 3}]}
        grid = {"origin": [0, 0, 0], "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1]}
        sphere = {"name": self.volume.name, "size": [48, 48, 32], "spacing": [1, 1, 1.6], **grid}
        cube = {"name": "vessel.nii.gz", "size": [64, 64, 64], "spacing": [1.5, 1.5, 1.5], **grid}
        center = 63 / 2 * 1.5
        ends = [[center + 36 * t, center + 16 * math.sin(math.pi * t), center + 10 * math.cos(0.8 * math.pi * t + 0.5)]
                for t in (-0.95, 0.95)]
        vessel = {"name": "aorta", "kind": "vessel", "color": "#ffffff", "points": ends, "parameters": {"wallThickness": 0.5}}
        path = self.folder / "corrected.json"
        session = {"format": "flipfree-session", "version": 2}

        def write(image, *organs):
            path.write_text(json.dumps({**session, "image": image, "organs": organs}), encoding="utf-8")

        for image, entry in ((sphere, organ), (cube, vessel)):
            write(image, entry)
            for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
                process = run("segment", "--session", path, "-o", self.folder / f"{name}.ply",
                              "--labels", self.folder / f"{name}.nii.gz", program=program)
                self.assertEqual(process.returncode, 0, process.stderr)
            ours, theirs = (vertices_of(self.folder / f"{name}.ply") for name in ("ours", "theirs"))
            self.assertGreater(len(ours), 300)
            numpy.testing.assert_array_equal(ours, theirs)
            ours, theirs = (flipfree.read_image(self.folder / f"{name}.nii.gz").voxels for name in ("ours", "theirs"))
            numpy.testing.assert_array_equal(ours, theirs)
            self.assertGreater(ours.sum(), 500)
        wrong = [{**organ, "corrections": [{"kind": "near", "position": [1, 2, 3]}]},
                 {**organ, "corrections": [{"kind": "seed", "position": [1, 2, 3], "radius": 0}]},
                 {**vessel, "parameters": {"speling": 1}}, {**vessel, "parameters": {"levels": 9}}, {**organ, "kind": "tumor"},
                 {**vessel, "corrections": [{"kind": "seed", "position": [1, 2, 3], "radius": 2}]}]
        for entry, message in zip(wrong, ("organ 1: 'liver': correction 1: the kind is 'near'; it can be",
                                          "correction 1: a seed has no radius", "there is no parameter 'Speling' of a vessel",
                                          "the parameter 'Levels' is out of its range", "the kind is 'tumor'; it can be",
                                          "organ 1: 'aorta': a seed is of no use to a vessel. Open it in the page")):
            write(sphere, entry)
            for program in (OURS, TOOLKIT):
                process = run("segment", "--session", path, "-o", self.folder / "wrong.ply", program=program)
                self.assertEqual(process.returncode, 1, process)
                self.assertRegex(process.stderr, f"flipfree: error: (?=[^\n]*corrected.json)[^\n]*{message}")
        write(sphere, {**organ, "corrections": [{"kind": "inside"}]})
        self.assertRegex(run("segment", "--session", path, "-o", self.folder / "wrong.ply").stderr, "correction 1: .*position")

    def test_surroundings_that_differ(self):
        """Standard streams that are closed, and outputs that are symbolic links."""
        plain, other, link = (self.folder / name for name in ("plain.stl", "other.stl", "link.stl"))
        arguments = [str(word) for word in ("segment", self.volume, *self.seed, "--resolution", 8, "-o")]
        self.assertEqual(run(*arguments, plain).returncode, 0)
        for closed in ("2>&-", ">&-", "<&- >&- 2>&-"):
            with self.subTest(closed):
                subprocess.run(["sh", "-c", f'"$@" {closed}', "sh", OURS, *arguments, other], capture_output=True,
                               timeout=120, check=True)
                self.assertEqual(other.read_bytes(), plain.read_bytes())
                other.unlink()
        (self.folder / "target").mkdir()
        target = self.folder / "target" / "real.stl"
        link.symlink_to(target)
        for program in (OURS, TOOLKIT):
            with self.subTest("link", program=program):
                target.write_bytes(b"former")
                target.chmod(0o640)
                self.assertEqual(run(*arguments, link, program=program).returncode, 0)
                self.assertTrue(link.is_symlink())
                self.assertGreater(len(target.read_bytes()), 1000)
                self.assertEqual(target.stat().st_mode & 0o777, 0o640)
                self.assertEqual(os.listdir(target.parent), ["real.stl"])
                self.assertEqual(run(*arguments, os.devnull, program=program).returncode, 2)  # of no known ending

    def test_simpleitk_that_cannot_be_loaded(self):
        package = self.folder / "broken" / "SimpleITK"
        package.mkdir(parents=True)
        for raised, message in (("ImportError('libz.so.9: cannot open it')", r"which is installed but cannot be loaded \(libz.so.9: c"),
                                ("ModuleNotFoundError('No module', name='other')", r"cannot be loaded \(No module\): install it anew"),
                                ("ModuleNotFoundError('No module', name='SimpleITK')", "which is not installed: pip install")):
            (package / "__init__.py").write_text(f"raise {raised}")
            process = run("segment", self.volume, *self.seed, "-o", self.folder / "never.stl", "--labels", self.folder / "never.mha",
                          env={**os.environ, "PYTHONPATH": str(package.parent)})
            with self.subTest(raised):
                self.assertEqual(process.returncode, 1)
                self.assertRegex(process.stderr, rf"\Aflipfree: error: [^\n]*{message}[^\n]*\n\Z")

    @unittest.skipUnless(sys.platform == "linux", "limits memory as Linux does")
    def test_no_memory_for_the_voxels(self):
        """It is not the file that is damaged."""
        program = """
import resource, sys
import numpy, SimpleITK
from flipfree._command import main
SimpleITK.Image(2, 2, SimpleITK.sitkInt16)
pages = int(open("/proc/self/statm").read().split()[0])
limit = pages * resource.getpagesize() + 8_000_000
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
sys.exit(main(sys.argv[1:]))
"""
        large = flipfree.image_from_array(numpy.zeros((100, 200, 200), "float32"), (1, 1, 1))
        flipfree.write_image(large, self.folder / "large.nii.gz")
        process = subprocess.run([sys.executable, "-c", program, "segment", self.folder / "large.nii.gz", *self.seed, "-o",
                                  self.folder / "never.stl"], capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual((process.returncode, process.stderr),
                         (1, "flipfree: error: Out of memory. Crop the volume, or use a machine with more memory.\n"))

    def test_every_surface_format_is_read_by_the_toolkit(self):
        for ending in ("vtp", "stl", "ply", "obj"):
            path = self.folder / f"each.{ending}"
            self.segment(OURS, "--resolution", 8, "-q", "-o", path)
            for judge in (OURS, TOOLKIT):
                with self.subTest(ending, judge=judge):
                    process = run("evaluate", path, self.truth, program=judge)
                    self.assertIn("valid: closed, Euler number 2, self-intersections 0", process.stdout, process)

    def test_surfaces_of_other_programs_are_read_alike(self):
        """A tetrahedron with normals and texture, as one strip, and with more than its faces need."""
        try:
            import vtkmodules  # pylint: disable=unused-import
        except ImportError:
            self.skipTest("VTK is not installed")
        points = [(10, 10, 40), (38, 10, 40), (10, 38, 40), (14, 14, 8)]
        faces = [(0, 1, 2), (2, 1, 3), (2, 3, 0), (0, 3, 1)]
        obj = ["# by hand", "mtllib none.mtl", "o Solid", *(f"v {x} {y} {z}" for x, y, z in points),
               "vt 0 0", "vt 1 0", "vt 1 1", "vn 0 0 1", "vn 1 0 0", "vn 0 1 0", "vn 0 0 -1", "s 0", "usemtl none",
               *("f " + " ".join(f"{corner + 1}/{at + 1}/{face + 1}" for at, corner in enumerate(corners))
                 for face, corners in enumerate(faces[:2])),
               f"f {faces[2][0] - 4}//1 {faces[2][1] - 4}//1 \\", f" {faces[2][2] - 4}//1", "f 1 4 2"]
        text = " ".join(str(x) for point in points for x in point)
        vtp = ('<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="4" NumberOfStrips="1">'
               f'<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">{text}</DataArray></Points>'
               '<Strips><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 0 1</DataArray>'
               '<DataArray type="Int64" Name="offsets" format="ascii">6</DataArray></Strips></Piece></PolyData></VTKFile>\n')
        ply = ["ply", "format ascii 1.0", "comment by hand", "element vertex 4", *(f"property double {axis}" for axis in "xyz"),
               "property uchar red", "property float quality", "element face 4", "property list uchar uint vertex_index",
               "property uchar red", "element edge 0", "property int vertex1", "property int vertex2", "end_header",
               *(f"{x} {y} {z} 9 0.5" for x, y, z in points), *(f"3 {a} {b} {c} 7" for a, b, c in faces)]
        answers = set()
        for name, content in (("a.obj", "\n".join(obj) + "\n"), ("a.vtp", vtp), ("a.ply", "\n".join(ply) + "\n")):
            (self.folder / name).write_text(content)
            for program in (OURS, TOOLKIT):
                with self.subTest(name, program=program):
                    process = run("evaluate", self.folder / name, self.truth, program=program)
                    self.assertIn("valid: closed, Euler number 2, self-intersections 0", process.stdout, process.stderr)
                    answers.add(process.stdout)
        self.assertEqual(len(answers), 1)
        for content in ("v 0 0 0\nf 1 2 3\n", "v 0 0\n", "v 0 0 nan\nf 1 1 1\n", "v 0 0 0\nf 1 1\n", "v 0 0 0\nf 1 1 one\n", ""):
            (self.folder / "bad.obj").write_text(content)
            for program in (OURS, TOOLKIT):
                with self.subTest(content, program=program):
                    process = run("evaluate", self.folder / "bad.obj", self.truth, program=program)
                    self.assertRegex(process.stderr, r"\Aflipfree: error: '[^\n]*bad.obj' (cannot be read|has no faces)[^\n]*\n\Z")

    def test_surfaces_of_other_programs(self):
        """Both read the same of them, or say the same of what is wrong."""
        points = [(20, 20, 20), (60, 20, 20), (20, 60, 20), (20, 20, 60)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for corner in face for x in points[corner]), 0) for face in faces)
        vertices = "".join("{} {} {}\n".format(*point) for point in points)
        corners = "".join("3 {} {} {}\n".format(*face) for face in faces)
        turned = "".join(f"{-x} {-y} {z}\n" for x, y, z in points)
        element = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        lists = "element face 4\nproperty list uchar int vertex_indices\n"
        count = struct.pack("<I", 4)
        ply = "ply\nformat ascii 1.0\n"
        said = {}
        for name, content in {
                "plain.ply": ply + element + lists + "end_header\n" + vertices + corners,
                "faces-first.ply": ply + lists + element + "end_header\n" + corners + vertices,
                "ras.ply": ply + "comment 3D Slicer output. SPACE=RAS\n" + element + lists + "end_header\n" + turned + corners,
                "more.stl": bytes(80) + count + triangles + b"more",
                "none.stl": bytes(80) + bytes(4) + triangles,
                "promise.vtp": '<VTKFile type="PolyData"><PolyData><Piece NumberOfPoints="99999999999"></Piece></PolyData></VTKFile>\n',
                "half.stl": bytes(80) + count + triangles[:100],
                "index.ply": ply + element + lists + "end_header\n" + vertices + corners.replace("3 1 2 3", "3 1 2 9")}.items():
            with self.subTest(name):
                path = self.folder / name
                path.write_bytes(content if isinstance(content, bytes) else content.encode())
                both = [run("evaluate", path, self.truth, program=program) for program in (OURS, TOOLKIT)]
                self.assertEqual(*((process.returncode, process.stdout, process.stderr) for process in both))
                said[name] = both[0].stdout or both[0].stderr
                self.assertLessEqual(both[0].stderr.count("\n"), 1)
        for name in ("faces-first.ply", "ras.ply", "more.stl"):
            self.assertEqual(said[name], said["plain.ply"])
        self.assertIn("Dice", said["plain.ply"])
        self.assertIn("has no faces", said["none.stl"])
        self.assertIn("fewer triangles", said["half.stl"])
        self.assertIn("it cannot hold as much as its header says", said["promise.vtp"])
        self.assertIn("face 3 has a vertex that does not exist", said["index.ply"])

    def test_written_surfaces_serve_again(self):
        """As triangles, of which most programs read no other faces; as what stays, and as a start."""
        for name in ("again.ply", "again.stl"):
            path = self.folder / name
            self.segment(OURS, "--resolution", 8, "-q", "-o", path)
            mesh = flipfree.read_surface(path)
            self.assertEqual(set(numpy.diff(mesh.offsets)), {3})
            x, y, z = map(float, self.seed[1:4])
            organ = flipfree.segment(str(self.volume), (x, y, z), float(self.seed[-1]), start=mesh, resolution=8, levels=1)
            self.assertEqual(organ.self_intersections, 0)
            self.assertGreater(flipfree.evaluate(organ, str(self.truth)).dice, 0.95)
            self.assertEqual(len(organ.points), 3 * len(mesh.triangles) // 2)
            process = run("segment", self.volume, "--organ", "other", x, y, z, 3, "--fixed", path, "-o", self.folder / "never.vtp")
            self.assertRegex(process.stderr, "the start sphere of 'other' meets the fixed surface 1")

    def test_picture(self):
        try:
            from PIL import Image
        except ImportError:
            self.skipTest("matplotlib is not installed")
        path = self.folder / "picture.png"
        self.segment(OURS, "--resolution", 8, "--snapshot", path)
        pixels = numpy.asarray(Image.open(path)).reshape(-1, 3).astype(int)
        self.assertEqual(len(pixels), 1200 * 1200)
        contour = (pixels[:, 0] > 230) & (abs(pixels[:, 1] - 190) < 20) & (pixels[:, 2] < 80)
        organ = (pixels[:, 0] > 90) & (pixels[:, 1] < 130) & (pixels[:, 2] < 120) & (pixels[:, 0] > 1.5 * pixels[:, 1])
        self.assertGreater(contour.sum(), 2000)
        self.assertGreater(organ.sum(), 20000)

    def test_wrong_words(self):
        here = self.folder / "never.vtp"
        for arguments, status, message in (
                ([], 2, "A subcommand is required. See 'flipfree --help'"),
                (["transmogrify"], 2, "There is no subcommand 'transmogrify'"),
                (["segmant"], 2, r"no subcommand 'segmant'\. Did you mean 'segment'\? See"),
                (["segment", "a", "--resolutoin", 3], 2, r"no option '--resolutoin'\. Did you mean '--resolution'\? See"),
                (["segment", "a", "--radius", 3, "--frobnicate"], 2, "There is no option '--frobnicate'"),
                (["segment", self.volume, "--radius", 3, "-o", here], 2, "There is no seed"),
                (["segment", self.volume, *self.seed], 2, "No output is requested"),
                (["segment", self.volume, *self.seed, "-o", "a.jpg"], 2, "--output: the file extension of 'a.jpg'"),
                (["segment", self.volume, *self.seed, "-o", here, "--levels", 99], 2, "--levels: 99 is out of range"),
                (["segment", self.volume, *self.seed, "-o", here, "--levels", "x"], 2, "--levels: .*'x'"),
                (["segment", self.volume, *self.seed, "-o", here, "--preset", "fast"], 2, "--preset: .*'fast'"),
                (["segment", "nowhere.nii", *self.seed, "-o", here], 1, "There is no file 'nowhere.nii'"),
                (["segment", self.volume, *self.seed, "-o", self.folder / "no" / "a.vtp"], 1, "cannot be written"),
                (["segment", self.volume, "--seed", 500, 0, 0, "--radius", 9, "-o", here], 1,
                 r"the seed's center \(500, 0, 0\) mm lies outside the image, which spans .* \(LPS\)"),
                (["segment", self.volume, "--seed-voxel", 9, 9, 32, "--radius", 9, "-o", here], 1,
                 r"--seed-voxel: \(9, 9, 32\) lies outside"),
                (["evaluate", self.volume, self.truth, "--reference-label", 7], 1, "--reference-label"),
        ):
            with self.subTest(message):
                process = run(*arguments)
                self.assertEqual((process.returncode, process.stdout), (status, ""), process.stderr)
                self.assertRegex(process.stderr, rf"\Aflipfree: error: [^\n]*{message}[^\n]*\.\n\Z")
        self.assertFalse(here.exists())
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(".")], [])

    def test_wrong_seeds_are_refused_in_the_toolkits_words(self):
        """Radii of options and sessions by one rule, which names where they are."""
        here = self.folder / "never.vtp"
        rule = "must be a positive number of millimeters, 1e-6 to 1e6"
        center, radius = self.seed[:4], self.seed[4:]
        cases = [(["--organ", "liver", 1, 2, "x", 4], 2, "--organ liver: 'x' is not a number"),
                 (["--organ", "liver", 1, 2, "inf", 4], 2, "--organ liver: a coordinate is not a finite number"),
                 (["--seed", 1, 2, "nan", *radius], 2, "--seed: a coordinate is not a finite number"),
                 ([*self.seed, "--inside", 1, 2, "nan"], 2, "--inside: a coordinate is not a finite number"),
                 ([], 2, "There is no seed"), (center, 2, "--radius is missing"),
                 ([*self.seed, *radius], 2, r"There are more radii \(2\) than seeds \(1\)"),
                 (["--seed-voxel", 9, 9, 32, *radius], 1, r"\(9, 9, 32\) lies outside .* The indices of a voxel count from 0"),
                 ([*self.seed, "--convergence", "a.csv", "--save-points", "./a.csv"], 2,
                  "--convergence and --save-points name the same file, './a.csv'"),
                 ([*self.seed, "--points", "a.csv", "--convergence", "a.csv"], 2, "'a.csv' is an input")]
        for wrong in (0, -5, 1e-9, 2e6, "nan", "inf"):
            cases += [([*center, "--radius", wrong], 2, f"--radius {rule}"),
                      (["--organ", "liver", *center[1:], wrong], 2, f"--organ liver: the radius {rule}")]
        image = {"name": self.volume.name, "size": [48, 48, 32], "spacing": [1, 1, 1.6], "origin": [0, 0, 0],
                 "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1]}
        organ = {"name": "liver", "color": "#ffd24a", "preset": "default", "parameters": {}}
        for wrong in (0, -5, 1e-9, 2e6):
            for together in (False, True):
                path = self.folder / f"radius-{wrong}-{together}.json"
                seed = {"center": list(map(float, center[1:])), "radius": wrong}
                path.write_text(json.dumps({"format": "flipfree-session", "version": 2, "image": image, "together": together,
                                            "organs": [{**organ, "seed": seed}]}), encoding="utf-8")
                cases.append((["--session", path], 1, f"organ 1: 'liver': the radius {rule}"))
        for arguments, status, message in cases:
            with self.subTest(message, arguments=arguments):
                ours, theirs = (run("segment", self.volume, *arguments, "-o", here, program=program) for program in (OURS, TOOLKIT))
                self.assertEqual((ours.returncode, ours.stdout), (status, ""), ours.stderr)
                self.assertRegex(ours.stderr, rf"\Aflipfree: error: [^\n]*{message}[^\n]*\.\n\Z")
                self.assertEqual((ours.returncode, ours.stderr), (theirs.returncode, theirs.stderr))
        self.assertFalse(here.exists())

    def test_seeds_may_be_points_of_the_command_line(self):
        """In RAS, too, and what is saved has the order of the toolkit's."""
        seed = [*map(float, self.seed[1:4])]
        saved = set()
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            out = self.folder / f"{name}.csv"
            process = run("segment", self.volume, "--seed", -seed[0], -seed[1], seed[2], "--radius", self.seed[5], "--ras",
                          "--outside", -seed[0] - 18, -seed[1], seed[2], "--inside", -seed[0], -seed[1] - 3, seed[2],
                          "--resolution", 8, "--save-points", out, "-q", "-o", self.folder / f"{name}.stl", program=program)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            saved.add(out.read_text())
        self.assertEqual(len(saved), 1, saved)
        self.assertRegex(saved.pop(), r"\Akind,x,y,z,radius\ninside,.*\noutside,.*\n\Z")

    @unittest.skipIf(sys.platform == "win32", "signals of Unix")
    def test_ctrl_c(self):
        out = self.folder / "endless.vtp"
        process = subprocess.Popen([OURS, "segment", str(self.volume), *self.seed, "--iterations", "100000",
                                    "--change-tolerance=-1", "--distance-tolerance=0", "-o", str(out)],
                                   stderr=subprocess.PIPE, text=True)
        time.sleep(2.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=30)[1], "")
        self.assertEqual(process.returncode, 130)
        self.assertFalse(out.exists())


class Vessels(unittest.TestCase):
    POINTS = ("--point", 13.3, 44.6, 44.5, "--point", 82, 50.4, 37.6)

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        run("phantom", "vessel", "-o", cls.folder)
        cls.volume, cls.truth = cls.folder / "vessel.nii.gz", cls.folder / "vessel-truth.nii.gz"

    def test_results_are_the_toolkits(self):
        try:
            import vtkmodules  # pylint: disable=unused-import
        except ImportError:
            self.skipTest("VTK is not installed")
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

        found = []
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            files = [self.folder / (name + ending) for ending in (".vtp", ".nii.gz", "-line.vtp", ".csv")]
            process = run("trace", *self.POINTS, self.volume, "--wall-thickness", 0.5, "--label-value", 7, "-o", files[0],
                          "--labels", files[1], "--centerline", files[2], "--convergence", files[3], program=program)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            found.append(re.sub(r"\d+\.\d\d s", "0 s", process.stdout))
        self.assertEqual(*found)
        self.assertRegex(found[0], r"vessel\.nii\.gz: 1 branch, \d+ vertices, .*, 0 self-intersections, support (0[.]9\d|1[.]00); path 0 s, start 0 s, "
                                   r"deformation 0 s, label map 0 s\n\Z")
        origins = []
        for ending in (".vtp", "-line.vtp"):
            contents = []
            for name in ("ours", "theirs"):
                reader = vtkXMLPolyDataReader()
                reader.SetFileName(str(self.folder / (name + ending)))
                reader.Update()
                data = reader.GetOutput()
                cells = data.GetLines() if "line" in ending else data.GetPolys()
                arrays = {"points": data.GetPoints().GetData(), "offsets": cells.GetOffsetsArray(),
                          "corners": cells.GetConnectivityArray()}
                for group in (data.GetPointData(), data.GetCellData(), data.GetFieldData()):
                    arrays.update({group.GetArrayName(i): group.GetAbstractArray(i) for i in range(group.GetNumberOfArrays())})
                if "line" not in ending:
                    origin = json.loads(arrays.pop("Provenance").GetValue(0))
                    self.assertEqual(origin["organs"][0].pop("name"), name)  # the file's
                    origins.append(origin)
                contents.append({key: (vtk_to_numpy(array).shape, vtk_to_numpy(array).tolist())
                                 for key, array in arrays.items()})
            self.assertEqual(*contents)
        self.assertEqual(*origins)
        ours, theirs = (flipfree.read_image(self.folder / f"{name}.nii.gz") for name in ("ours", "theirs"))
        numpy.testing.assert_array_equal(ours.voxels, theirs.voxels)
        self.assertEqual(ours.voxels.max(), 7)
        ours, theirs = (list(csv.reader((self.folder / f"{name}.csv").read_text(encoding="utf-8").splitlines()))
                        for name in ("ours", "theirs"))
        self.assertEqual((len(ours), ours[0]), (len(theirs), theirs[0]))

    def test_every_surface_format_and_a_picture(self):
        for ending in ("stl", "ply", "obj", "png"):
            path = self.folder / f"each.{ending}"
            option = "--snapshot" if ending == "png" else "-o"
            process = run("trace", self.volume, *self.POINTS, "--levels", 1, "-q", option, path)
            self.assertEqual((process.returncode, process.stdout, process.stderr), (0, "", ""))
            if ending != "png":
                self.assertIn("valid: closed", run("evaluate", path, self.truth, program=TOOLKIT).stdout)
            self.assertGreater(path.stat().st_size, 10000)

    def test_wrong_words_are_the_toolkits(self):
        """Where the toolkit's come from its parser, the status alone is."""
        out = ("-o", self.folder / "never.vtp")
        first, second = self.POINTS[:4], self.POINTS[4:]
        for arguments, status, message, same in (
                ([self.volume, *out], 2, "at least two points", True),
                ([self.volume, *first, *out], 2, "at least two points", True),
                ([self.volume, *first, "--point", "nan", 0, 0, *out], 2, "--point: a coordinate is not", True),
                ([self.volume, *first, "--point", 1, 2, *out], 2, "--point", False),
                ([self.volume, *self.POINTS], 2, "No output is requested", True),
                ([self.volume, *self.POINTS, "-o", "a.vtk"], 2, "--output: the file extension of 'a.vtk'", True),
                ([self.volume, *self.POINTS, "--labels", "a.png"], 2, "--labels: the file extension of 'a.png'", True),
                ([self.volume, *self.POINTS, "--centerline", "a.stl"], 2, "--centerline: the file extension of 'a.stl'.*Use .vtp", True),
                ([self.volume, *self.POINTS, *out, "--radius", -1], 2, "--radius must be a number", True),
                ([self.volume, *self.POINTS, *out, "--radius", "nan"], 2, "--radius must be a number", True),
                ([self.volume, *self.POINTS, *out, "--wall-thickness", 9], 2, "--wall-thickness must be", True),
                ([self.volume, *self.POINTS, *out, "--levels", 0], 2, "--levels", False),
                ([self.volume, *self.POINTS, *out, "--iterations", -1], 2, "--iterations", False),
                ([self.volume, *self.POINTS, *out, "--label-value", 0], 2, "--label-value", False),
                ([self.volume, *self.POINTS, *out, "--threads", "all"], 2, "--threads", False),
                ([*self.POINTS, *out], 2, "INPUT|input", False),
                ([self.volume, *self.POINTS, "-o", self.volume.with_suffix("").with_suffix(".vtp"), "--labels", self.volume], 2,
                 "is an input, which would be overwritten", True),
                ([self.volume, *self.POINTS, *out, "--centerline", out[1]], 2, "--output and --centerline name the same file", True),
                ([self.volume, *self.POINTS, *out, "--wall-thickness", -5], 1, "a --wall-thickness of -5 mm leaves less than 0.5 mm", True),
                ([self.volume, *self.POINTS, *out, "--outside", *first[1:]], 1, "lies at the vessel's point", True),
                ([self.volume, *first, "--point", 500, 0, 0, *out], 1, r"\(500, 0, 0\) mm lies outside", True),
                ([self.volume, *first, *first, *out], 1, "closer than 3 mm", True),
                (["nowhere.nii", *self.POINTS, *out], 1, "'nowhere.nii'", False),
        ):
            with self.subTest(message, arguments=arguments):
                ours, theirs = (run("trace", *arguments, program=program) for program in (OURS, TOOLKIT))
                self.assertEqual((ours.returncode, ours.stdout), (status, ""), ours.stderr)
                self.assertEqual(theirs.returncode, status, theirs.stderr)
                self.assertRegex(ours.stderr, rf"\Aflipfree: error: [^\n]*({message})[^\n]*\.\n\Z")
                if same:
                    self.assertEqual(ours.stderr, theirs.stderr)
        self.assertFalse((self.folder / "never.vtp").exists())


if __name__ == "__main__":
    unittest.main()
