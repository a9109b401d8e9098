"""Whatever is wrong: one line that helps, the right status, and no file."""

import os
import re
import resource
import shutil
import struct
import subprocess
import unittest
import zlib

import command


def limit_file_size(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


class TestBadInput(command.CommandTest):
    def segment(self, *arguments, volume=None, **options):
        return command.run("segment", volume or self.volume, *arguments, **options)

    def output(self):
        return ("-o", self.result("out.vtp"), "--labels", self.result("out.nii.gz"),
                "--convergence", self.result("out.csv"))

    def input(self, name, data=b""):
        path = os.path.join(self.inputs, name)
        with open(path, "wb") as file:
            file.write(data)
        return path

    def test_mistyped_words(self):
        self.assert_refused(command.run("segmant", self.volume), 2, r"subcommand 'segmant'\. Did you mean 'segment'\?", "flipfree --help")
        self.assert_refused(command.run("segmant", self.volume, *self.seed), 2, r"subcommand 'segmant'\. Did you mean 'segment'\?")
        self.assert_refused(command.run("--foo"), 2, "option '--foo'", "flipfree --help")
        for words, message in ((("--resolutoin", 5), r"no option '--resolutoin'\. Did you mean '--resolution'\?"),
                               (("--qwertyuiop",), r"no option '--qwertyuiop'\. See"),
                               (("another.nii.gz",), "Unexpected argument 'another.nii.gz'")):
            self.assert_refused(self.segment(*self.seed, *self.output(), *words), 2, message, "segment --help")

    def test_volumes(self):
        with open(self.volume, "rb") as whole:
            truncated = self.input("truncated.nii.gz", whole.read()[:20000])
        folder = os.path.join(self.inputs, "empty")
        os.makedirs(folder, exist_ok=True)
        for volume, *patterns in (("/nowhere/ct.nii.gz", "Check"), (truncated,), (folder, "DICOM"),
                                  (self.input("letter.txt", b"Dear Sir or Madam"),)):
            with self.subTest(volume=volume):
                self.assert_refused(self.segment(*self.seed, *self.output(), volume=volume), 1, f"'{volume}'", *patterns)

    def test_seeds(self):
        center, radius = self.seed[:4], self.seed[4:]
        cases = [(1, ("--seed", 500, 32, 32, *radius), (r"the seed's center \(500, 32, 32\) mm lies outside the image, which spans .* \(LPS\)",)),
                 (1, ("--seed", 500, 32, 32, *radius, "--ras"), (r"the seed's center \(-500, -32, 32\) mm lies outside the image",)),
                 (1, ("--seed", 32, 32, 32, *radius, "--ras"), ("with x and y negated it would lie inside: check whether it is LPS or RAS",)),
                 (1, ("--seed-voxel", 20, 20, 40, *radius), ("--seed-voxel:", r"\(20, 20, 40\)", "indices of a voxel count from 0")),
                 (2, (*self.seed, *radius), (r"There are more radii \(2\) than seeds \(1\)",)),
                 (2, center, ("--radius is missing", "--radius MM")),
                 (1, (*center, "--radius", 0.1), ("'" + self.volume, "radius")),
                 (2, (*self.seed, "--seed-voxel", 1, 2, 3), ("--seed-voxel",)),
                 (2, radius, ("--seed",))]
        cases += [(2, (*center, "--radius", value), ("--radius must be a positive number of millimeters, 1e-6 to 1e6, not " + re.escape(f"{float(value):g}. The sphere"),))
                  for value in (0, -5, 1e-9, 2e6, "nan", "inf")]
        cases += [(2, (*center, "--radius", "large"), ("--radius",))]
        cases += [(2, ("--seed", *point, *radius), ("--seed",)) for point in (("nan", 0, 0), (1, 2), ("here", 0, 0))]
        for status, seed, patterns in cases:
            with self.subTest(seed=seed):
                self.assert_refused(self.segment(*seed, *self.output()), status, *patterns)

    def test_what_options_take(self):
        missing = "--organ: a value is missing. Give --organ NAME X Y Z MM."
        for words, message in ((("--organ", "a", 1, 2, 3, 4, "--organ", "b", 1, "-o", self.result("out.vtp")), missing),
                               (("--quiet=a",), "--quiet: it takes no value. Leave it out."),
                               (("--organ", "liver", 1, 2), missing),
                               (("--radius", "large"), "--radius: 'large' is not a number. Give --radius MM."),
                               (("--levels", 2.5), "--levels: '2.5' is not a whole number, or is too large. Give --levels N."),
                               (("--threads", -1), "--threads: -1 is out of range. Give 0 to 1024."),
                               (("--threads", "all"), "--threads: 'all' is not a whole number. Give 0 to 1024."),
                               (("--preset", "best"), "--preset: there is no 'best'. Choose one of default, published, naive."),
                               (("-o", "a.vtp", "-o", "b.vtp"), "--output: it is given more than once. Give it once: --output FILE."),
                               (("--start-label", 3), "--start-label requires --start-labels. Give both, or none.")):
            with self.subTest(words):
                process = self.segment(*words)
                self.assertEqual((process.returncode, process.stderr),
                                 (2, f"flipfree: error: {message} See 'flipfree segment --help'.\n"))

    def test_a_sphere_larger_than_the_image(self):
        process = self.segment(*self.seed[:4], "--radius", 500, "--resolution", 8, *self.output())
        self.assertEqual(process.returncode, 1)
        self.assertIn("the seed sphere, with a radius of 500 mm, is larger than the image, which is at most 64 mm long; lower --radius",
                      process.stderr)
        self.assertEqual(os.listdir(self.results), [])

    def test_an_organ_without_a_boundary(self):
        process = self.segment(*self.seed[:4], "--radius", 4, "--search-distance", 1, "--resolution", 8, "--levels", 1,
                               "--iterations", 1, "--no-carving", *self.output())
        self.assertEqual(process.returncode, 1)
        self.assertIn("no boundary of the organ was found; check that the seed sphere lies within", process.stderr)
        self.assertEqual(os.listdir(self.results), [])

    def test_options(self):
        for option, value in (("--resolution", 100000), ("--levels", 0), ("--opening", -1), ("--fairing", "nan"), ("--preset", "best"),
                              ("--threads", -1), ("--label-value", 256), ("--iterations", "many"),
                              ("--series", "1.2.3")):
            with self.subTest(option=option):
                self.assert_refused(self.segment(*self.seed, *self.output(), option, value), 2, option)

    def test_results_are_checked_before_any_work(self):
        self.assert_refused(self.segment(*self.seed), 2, "--output")
        for option, name in (("-o", "out.vtk"), ("-o", "out"), ("--labels", "out.nii.bz2"),
                             ("--convergence", "out.txt"), ("--snapshot", "out.jpg")):
            with self.subTest(name=name):
                process = self.segment(*self.seed, option, self.result(name), volume="/nowhere/ct.nii.gz")
                self.assert_refused(process, 2, name, "Use ")
        for folder, reason in ((self.result("absent"), "Create it"), ("/proc", "take files")):
            name = os.path.join(folder, "out.vtp")
            with self.subTest(name=name):
                self.assert_refused(self.segment(*self.seed, "-o", name), 1, name, reason)

    def test_parameters_of_surfaces_are_checked_before_any_work(self):
        for option, value, limits in (("--distance", 3, "0.5 to 1"), ("--iterations", -1, "0 to 10000")):
            with self.subTest(option=option):
                process = command.run("surfaces", "/nowhere/labels.nii.gz", "-o", self.result("x"), option, value)
                self.assert_refused(process, 2, f"{option}: {value} is out of range. Give {limits}. See 'flipfree surfaces --help'.")

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_folder_without_permission(self):
        os.chmod(self.results, 0o500)
        self.addCleanup(os.chmod, self.results, 0o700)
        self.assert_refused(self.segment(*self.seed, *self.output()), 1, "permissions")

    def test_the_input_as_output(self):
        copy = os.path.join(self.inputs, "copy.nii.gz")
        shutil.copy(self.volume, copy)
        self.assert_refused(self.segment(*self.seed, "--labels", copy, volume=copy), 2, copy, "overwritten")
        self.assertEqual(os.path.getsize(copy), os.path.getsize(self.volume))

    def test_full_disk(self):
        for option, name, limit in (("-o", "out.vtp", 20000), ("-o", "out.stl", 20000), ("-o", "out.ply", 20000),
                                    ("-o", "out.obj", 20000), ("--labels", "out.nii", 20000),
                                    ("--labels", "out.nii.gz", 300), ("--convergence", "out.csv", 100)):
            with self.subTest(name=name):
                # VTK's writers leak then.
                process = self.segment(*self.seed, option, self.result(name), env=command.without_leak_check(),
                                       preexec_fn=limit_file_size(limit))
                self.assert_refused(process, 1, "'" + self.result(name), "disk")

    def test_full_disk_leaves_the_former_file_and_no_other_result(self):
        with open(self.result("out.csv"), "w") as file:
            file.write("a former result")
        process = self.segment(*self.seed, *self.output(), env=command.without_leak_check(),
                               preexec_fn=limit_file_size(20000))
        self.assertEqual(process.returncode, 1)
        self.assertEqual(os.listdir(self.results), ["out.csv"])
        with open(self.result("out.csv")) as file:
            self.assertEqual(file.read(), "a former result")

    @unittest.skipIf(command.IS_OF_PIP, "it needs none")
    def test_snapshot_without_display(self):
        environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
        process = self.segment(*self.seed, "--snapshot", self.result("out.png"), env=environment)
        self.assert_refused(process, 1, "--snapshot", "xvfb-run")

    def test_standard_output_that_goes_nowhere(self):
        with open("/dev/full", "w") as full:
            process = command.run("evaluate", self.truth, self.truth, stdout=full)
        self.assert_refused(process, 1, "standard output")

    def test_phantom(self):
        for status, arguments, patterns in ((2, ("teapot", "-o", self.results), ("teapot", "u-tube")),
                                            (1, ("sphere", "-o", self.result("a/b/c")), ("a/b/c",)),
                                            (2, ("sphere", "-o", self.results, "--spacing", -1, 1, 1), ("--spacing: -1 is not positive. Give",)),
                                            (2, ("sphere", "-o", self.results, "--size", 0, 0, 0), ("--size: 0 is not positive. Give",))):
            with self.subTest(arguments=arguments):
                self.assert_refused(command.run("phantom", *arguments), status, *patterns)

    def test_evaluate(self):
        command.make_phantom(self.inputs, "cube", "--size", 20, 20, 20)
        cube = os.path.join(self.inputs, "cube-truth.nii.gz")
        # Named as the filter's properties are, and still called as they are.
        named = [shutil.copy(cube, os.path.join(self.inputs, name + ".nii.gz"))
                 for name in ("SegmentationLabel", "ReferenceLabel")]
        damaged = self.input("damaged.vtp", b"<VTKFile type='PolyData'")
        for arguments, names in (((cube, self.truth), (cube, self.truth)),
                                 ((named[0], self.truth), named[:1]), ((self.truth, named[1]), named[1:]),
                                 ((damaged, self.truth), (damaged,)),
                                 (("/nowhere/a.stl", self.truth), ("/nowhere/a.stl",)),
                                 ((self.truth, "/nowhere/a.nii"), ("/nowhere/a.nii",)),
                                 ((self.truth, self.truth, "--label", 9), (self.truth,))):
            with self.subTest(arguments=arguments):
                process = command.run("evaluate", *arguments, "--csv", self.result("out.csv"))
                self.assert_refused(process, 1, *(f"'{name}'" for name in names))
        process = command.run("evaluate", self.truth, self.truth, "--csv", self.result("out.txt"))
        self.assert_refused(process, 2, "--csv")

    # A tetrahedron in the sphere, in several forms.
    CORNERS = ((28.0, 28, 28), (36, 28, 28), (28, 36, 28), (28, 28, 36))
    FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))

    def ply(self, form, corners=CORNERS, faces=FACES, counts=None):
        order = ">" if form == "binary_big_endian" else "<"
        counts = counts or (len(corners), len(faces))
        header = (f"ply\nformat {form} 1.0\ncomment made here\nelement vertex {counts[0]}\nproperty float x\n"
                  f"property float y\nproperty float z\nproperty uchar gray\nelement face {counts[1]}\n"
                  "property list uchar int vertex_indices\nend_header\n").encode()
        if form == "ascii":
            lines = [" ".join(map(str, corner)) + " 7" for corner in corners]
            lines += [" ".join(map(str, (len(face), *face))) for face in faces]
            return header + "\n".join(lines).encode()
        return header + b"".join([struct.pack(order + "3fB", *corner, 7) for corner in corners] +
                                 [struct.pack(f"{order}B{len(face)}i", len(face), *face) for face in faces])

    def obj(self, faces=FACES, word="{}"):
        lines = ["v " + " ".join(map(str, corner)) for corner in self.CORNERS]
        lines += ["f " + " ".join(word.format(vertex + 1) for vertex in face) for face in faces]
        return "\n".join(lines).encode()

    def stl(self, count=None):
        triangles = [struct.pack("<12fH", 0, 0, 0, *(x for vertex in face for x in self.CORNERS[vertex]), 0)
                     for face in self.FACES]
        return bytes(80) + struct.pack("<I", len(triangles) if count is None else count) + b"".join(triangles)

    def stl_text(self):
        facets = ["facet normal 0 0 0\nouter loop\n" +
                  "".join("vertex {} {} {}\n".format(*self.CORNERS[vertex]) for vertex in face) +
                  "endloop\nendfacet\n" for face in self.FACES]
        return ("solid\n" + "".join(facets) + "endsolid\n").encode()

    def vtp(self, points="4", last="12"):
        numbers = " ".join(str(x) for corner in self.CORNERS for x in corner)
        faces = " ".join(str(vertex) for face in self.FACES for vertex in face)
        return (f"<VTKFile type='PolyData' version='0.1' byte_order='LittleEndian'><PolyData><Piece NumberOfPoints='{points}'"
                " NumberOfPolys='4'><Points><DataArray type='Float32' NumberOfComponents='3' format='ascii'>"
                f"{numbers}</DataArray></Points><Polys><DataArray type='Int64' Name='connectivity' format='ascii'>{faces}"
                f"</DataArray><DataArray type='Int64' Name='offsets' format='ascii'>3 6 9 {last}</DataArray></Polys></Piece>"
                "</PolyData></VTKFile>").encode()

    def test_surfaces_of_every_form(self):
        scores = set()
        for name, data in (("a.ply", self.ply("ascii")), ("b.ply", self.ply("binary_little_endian")),
                           ("c.ply", self.ply("binary_big_endian")), ("a.obj", self.obj()), ("b.obj", self.obj(word="{}/1/2")),
                           ("c.obj", self.obj([[vertex - 5 for vertex in face] for face in self.FACES])),
                           ("a.stl", self.stl()), ("b.stl", self.stl_text()), ("a.vtp", self.vtp())):
            with self.subTest(name=name):
                process = command.run("evaluate", self.input(name, data), self.truth)
                self.assert_succeeds(process)
                self.assertIn("closed, Euler number 2", process.stdout)
                scores.add(process.stdout)
        self.assertEqual(len(scores), 1)

    def test_surface_beyond_the_reference(self):
        far = ((28, 28, 28), (600, 28, 28), (28, 36, 28), (28, 28, 36))
        process = command.run("evaluate", self.input("far.ply", self.ply("ascii", corners=far)), self.truth)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("Dice", process.stdout)
        self.assertRegex(process.stderr, "warning: About 25 % of the segmentation's surface lies outside the reference")

    def test_damaged_surfaces(self):
        far = (*self.CORNERS[:3], (0, 0, 1e30))
        beyond = (*self.FACES[:3], (1, 2, 4))
        cases = [("obj", self.obj(beyond), "face 3 has a vertex that does not exist"),
                 ("obj", self.obj(word="{}e99"), "whole number"), ("obj", self.obj(word="x{}"), "not a number"),
                 ("obj", self.obj().replace(b"28.0", b"nan"), "vertex 0 is not finite"),
                 ("obj", self.obj(((0, 1),)), "fewer than three"),
                 ("stl", self.stl(5), "fewer triangles"), ("stl", self.stl(2**32 - 1), "fewer triangles"),
                 ("stl", self.stl()[:60], "fewer triangles"),
                 ("stl", self.stl_text().replace(b"endsolid", b"vertex 1 2"), "not a number"),
                 ("stl", self.stl_text().replace(b"endsolid", b"vertex 1 2 3"), "last triangle"),
                 ("vtp", self.vtp(points="99999999999"), "cannot hold"), ("vtp", self.vtp(last="13"), "damaged"),
                 ("vtp", self.vtp().replace(b"0 2 1", b"0 2 4"), "does not exist|there are 4 points"),
                 ("ply", b"ply\nformat ascii 1.0\n", "does not end"), ("ply", b"plx\n", "begin with 'ply'"),
                 ("ply", self.ply("ascii").replace(b"property float z\n", b""), "no x, y and z|whole number")]
        # Blocks that are larger than the file, and a first block that does not exist.
        packed = (b"<VTKFile type='PolyData' byte_order='LittleEndian' header_type='UInt32' "
                  b"compressor='vtkZLibDataCompressor'><PolyData><Piece NumberOfPoints='4' NumberOfPolys='4'><Points>"
                  b"<DataArray type='Float32' NumberOfComponents='3' format='appended' offset='0'/></Points></Piece>"
                  b"</PolyData><AppendedData encoding='raw'>_%s</AppendedData></VTKFile>")
        cases += [("vtp", packed % struct.pack("<4I", *words), "cannot hold")
                  for words in ((2**31, 2**31, 0, 9), (0, 48, 12, 0), (1, 48, 99, 9), (1, 48, 0, 2**31))]
        cases.append(("vtp", packed.replace(b"format=", b"form=") % struct.pack("<4I", 2**28, 48, 0, 9), "cannot hold"))
        block = zlib.compress(bytes(48))
        misplaced = packed.replace(b">_", b"><Points/>_") % (struct.pack("<4I", 1, 48, 0, len(block)) + block)
        cases.append(("vtp", misplaced, "cannot hold"))
        for form in ("ascii", "binary_little_endian", "binary_big_endian"):
            cases += [("ply", self.ply(form, counts=(4, 5)), "the file is truncated"),
                      ("ply", self.ply(form, counts=(2**31 - 1, 4)), "truncated|number"),
                      ("ply", self.ply(form, faces=beyond), "face 3 has a vertex that does not exist"),
                      ("ply", self.ply(form, corners=far), "vertex 3 is not finite")]
        for index, (ending, data, pattern) in enumerate(cases):
            with self.subTest(index=index, pattern=pattern):
                name = self.input(f"damaged{index}.{ending}", data)
                process = command.run("evaluate", name, self.truth, "--csv", self.result("out.csv"))
                self.assert_refused(process, 1, f"'{name}'", pattern)

    def test_libraries_are_quiet(self):
        """ITK's library prints a line about voxels that cannot be inflated, in a thread of its own."""
        header = ("ObjectType = Image\nNDims = 3\nOffset = 0 0 0\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nBinaryData = True\nCompressedData = True\nElementSpacing = 1 1 1\n"
                  "DimSize = 20 20 20\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n").encode()
        for index in range(10):
            name = self.input(f"broken{index}.mha", header + zlib.compress(bytes(8000))[:2] + bytes(1000))
            self.assert_refused(command.run("evaluate", name, self.truth), 1, f"'{name}'", "damaged")

    def test_inputs_that_never_end(self):
        # A stream that asks for a dictionary, which ITK's MetaImage library would wait for.
        asking = self.input("asking.mha", b"ObjectType = Image\nNDims = 3\nOffset = 0 0 0\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nBinaryData = True\nCompressedData = True\n"
                            b"ElementSpacing = 1 1 1\nDimSize = 20 20 20\nElementType = MET_UCHAR\n"
                            b"ElementDataFile = LOCAL\nx " + bytes(1000))
        self.assert_refused(command.run("evaluate", asking, self.truth), 1, f"'{asking}'", "damaged")

    def test_texts_of_any_length(self):
        """ITK's MetaImage library copied them into buffers of fixed size."""
        voxels = b"ElementDataFile = LOCAL\n" + bytes(8000)
        long = self.input("long.mha", b"ObjectType = Image" + 300 * b" 0" + b"\nNDims = 3\nOffset = 0 0 0\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nElementSpacing = 1 1 1\n"
                          b"DimSize = 20 20 20\nElementType = MET_UCHAR\n" + voxels)
        self.assert_refused(command.run("evaluate", long, self.truth), 1, f"'{long}'", "spacings")

    def test_pipes(self):
        for name in ("pipe.nii", "pipe.nrrd", "pipe.stl"):
            pipe = os.path.join(self.inputs, name)
            os.mkfifo(pipe)
            with self.subTest(name=name):
                process = command.run("evaluate", pipe, self.truth, "--csv", self.result("out.csv"))
                self.assert_refused(process, 1, f"'{pipe}'", "not a regular file")


if __name__ == "__main__":
    unittest.main()
