"""Whatever is wrong: one line that helps, the right status, and no file."""

import os
import resource
import shutil
import subprocess
import unittest

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
        self.assert_refused(command.run("segmant", self.volume), 2, "subcommand 'segmant'", "flipfree --help")
        self.assert_refused(command.run("--foo"), 2, "option '--foo'", "flipfree --help")
        for words, message in ((("--resolutoin", 5), "no option '--resolutoin'"),
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
        cases = [(1, ("--seed", 500, 32, 32, *radius), ("--seed:", r"\(500, 32, 32\) mm", "64 x 64 x 40", "LPS")),
                 (1, ("--seed-voxel", 20, 20, 40, *radius), ("--seed-voxel:", r"\(20, 20, 40\)")),
                 (1, (*center, "--radius", 0.1), ("'" + self.volume, "radius")),
                 (2, (*self.seed, "--seed-voxel", 1, 2, 3), ("--seed-voxel",)),
                 (2, radius, ("--seed",))]
        cases += [(2, (*center, "--radius", value), ("--radius",)) for value in (0, -5, "nan", "inf", "large")]
        cases += [(2, ("--seed", *point, *radius), ("--seed",)) for point in (("nan", 0, 0), (1, 2), ("here", 0, 0))]
        for status, seed, patterns in cases:
            with self.subTest(seed=seed):
                self.assert_refused(self.segment(*seed, *self.output()), status, *patterns)

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
                                            (1, ("sphere", "-o", self.results, "--spacing", -1, 1, 1), ("[Ss]pacing",))):
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


if __name__ == "__main__":
    unittest.main()
