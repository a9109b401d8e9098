"""The command that comes with the wheel: it gives what the toolkit's gives, from other readers and writers.

Its command line is the toolkit's, and the tests of Testing/Command run with it, too.
"""

import csv
import json
import os
import pty
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from dataclasses import replace
from pathlib import Path

import flipfree
import numpy

try:
    import SimpleITK  # pylint: disable=unused-import
except ImportError:
    print("Skipped: SimpleITK is not installed.")
    sys.exit(77)

sys.path.append(str(Path(__file__).resolve().parent.parent / "Support"))
import forked_command  # pylint: disable=wrong-import-position
import lobed_ball  # pylint: disable=wrong-import-position

TOOLKIT = os.environ["FLIPFREE_COMMAND"]
OURS = str(Path(sys.executable).parent / "flipfree")


def run(*arguments, program=OURS, **options):
    if program == OURS and not options:
        return forked_command.run(OURS, list(map(str, arguments)))
    return subprocess.run([program, *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=120, check=False, **options)


class Forks(unittest.TestCase):
    def test_end_of_what_is_forked_is_told_with_its_status(self):
        with tempfile.TemporaryDirectory() as folder:
            python = Path(folder) / "python"
            python.write_text("#!/bin/sh\nexit 3\n", encoding="utf-8")
            python.chmod(0o755)
            for _ in range(2):  # it is started anew
                with self.assertRaisesRegex(ChildProcessError, "has ended with status 3$"):
                    forked_command.run(str(Path(folder) / "flipfree"), [])


def vertices_of(path):
    """Of a binary PLY file."""
    header, content = path.read_bytes().split(b"end_header\n", 1)
    return numpy.frombuffer(content, "<f4", 3 * int(re.search(rb"element vertex (\d+)", header)[1]))


class Options(unittest.TestCase):
    def test_help_is_that_of_this_package(self):
        text = run("segment", "--help").stdout
        self.assertIn("needs\nmatplotlib", text)
        self.assertNotIn("xvfb", text)
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
                                                (full, 1, r"flipfree: error: Writing to the standard output failed \(.*\)\..*\n\Z")):
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
        self.assertEqual(*(self.without_seconds(self.folder / f"{name}.csv") for name in ("ours", "theirs")))

    def without_seconds(self, path):
        """A table, text for text, but for what differs from run to run."""
        rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
        self.assertTrue(rows)
        return [{column: cell for column, cell in row.items() if not column.endswith("Seconds")} for row in rows]

    def test_surfaces_of_labels(self):
        """All labels of a label map, under the names of a table."""
        run("phantom", "abdomen", "-o", self.folder, "--size", 40, 32, 24, "--spacing", 8, 8, 10)
        names = self.folder / "names.csv"
        names.write_text('label,name\n6,liver – all\n2,"right kidney"\n9;vena\n', encoding="utf-8")
        made = {}
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            folder = self.folder / f"surfaces-{name}"
            process = run("surfaces", self.folder / "abdomen-truth.nii.gz", "-o", folder, "--names", names, "--format", "ply",
                          "--label", 6, "--label", 2, "--label", 9, "--distance", 0.8, program=program)
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            self.assertEqual(sorted(path.name for path in folder.iterdir()),
                             ["2-right_kidney.ply", "6-liver_–_all.ply", "9-vena.ply", "surfaces.csv"])
            table = (folder / "surfaces.csv").read_text(encoding="utf-8")
            rows = list(csv.DictReader(table.splitlines()))
            self.assertEqual([row["Name"] for row in rows], ["right kidney", "liver – all", "vena"])
            made[name] = (process.stdout, table, [vertices_of(folder / row["File"]).tolist() for row in rows])
        self.assertEqual(made["ours"], made["theirs"])

    def test_questions(self):
        """Both ask the same, and the same answers give the same surface."""
        volume = self.folder / "lobed.nii.gz"
        voxels = numpy.frombuffer(lobed_ball.lobed_ball(6), numpy.int16).reshape(lobed_ball.SIZE[::-1])
        flipfree.write_image(flipfree.image_from_array(voxels, lobed_ball.SPACING), volume)
        arguments = ["segment", volume, "--seed", *lobed_ball.SEED, "--radius", lobed_ball.RADIUS, "--resolution", 16, "-q"]
        tables, prompts, surfaces = [], set(), set()
        for name, program in (("ours", OURS), ("theirs", TOOLKIT)):
            table, surface = self.folder / f"{name}.csv", self.folder / f"{name}.ply"
            process = run(*arguments, "--questions", table, program=program)
            self.assertEqual(process.returncode, 0)
            self.assertRegex(process.stderr, r"\Aflipfree: warning: Is the part of \d\d ml at [^\n]+ --inside \d+ \d+ \d+ adds it\.\n\Z")
            tables.append(table.read_text(encoding="utf-8"))
            process = run(*arguments, "--ask", "-o", surface, program=program)
            self.assertEqual((process.returncode, surface.exists()), (2, False))
            self.assertRegex(process.stderr, "^flipfree: error: --ask needs a terminal to ask at")
            prompts.add(self.answered(b"y\n", program, *arguments, "--ask", "-o", surface, "--save-points", table))
            surfaces.add(vertices_of(surface).tobytes())
            self.assertRegex(table.read_text(encoding="utf-8"), r"^kind,x,y,z,radius\ninside,\d+,\d+,\d+,\n$")
        self.assertEqual(list(csv.DictReader(tables[0].splitlines()))[0].keys(), {"x", "y", "z", "volume_ml", "included", "margin"})
        self.assertEqual(*tables)
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
        """And has its bytes, but for VTP, which VTK writes there."""
        for ending in ("vtp", "stl", "ply", "obj"):
            path, theirs = self.folder / f"each.{ending}", self.folder / f"each-theirs.{ending}"
            self.segment(OURS, "--resolution", 8, "-q", "-o", path)
            self.segment(TOOLKIT, "--resolution", 8, "-q", "-o", theirs)
            if ending != "vtp":
                self.assertTrue(path.read_bytes() == theirs.read_bytes(), ending)
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
            corners = mesh.corners.copy()
            corners[-1] = len(mesh.points)
            path.unlink()
            with self.assertRaisesRegex(ValueError, "surface"):
                flipfree.write_surface(replace(mesh, corners=corners), path)
            self.assertFalse(path.exists())

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


if __name__ == "__main__":
    unittest.main()
