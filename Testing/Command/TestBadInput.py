"""Whatever is wrong: one line that helps, the right status, and no file."""

import os
import resource
import shutil
import unittest

import command


class TestBadInput(command.CommandTest):
    def segment(self, *arguments, volume=None, **options):
        return command.run("segment", volume or self.volume, *arguments, **options)

    def output(self):
        return ("-o", self.result("out.vtp"), "--labels", self.result("out.nii.gz"),
                "--convergence", self.result("out.csv"))

    def test_mistyped_subcommand(self):
        self.assert_refused(command.run("segmant", self.volume), 2, "subcommand 'segmant'", "flipfree --help")
        self.assert_refused(command.run("--foo"), 2, "option '--foo'", "flipfree --help")
        self.assert_refused(self.segment(*self.seed, *self.output(), "--resolutoin", 5), 2,
                            "no option '--resolutoin'", "segment --help")
        self.assert_refused(self.segment(*self.seed, *self.output(), "another.nii.gz"), 2,
                            "no use for 'another.nii.gz'", "segment --help")

    def test_missing_file(self):
        self.assert_refused(self.segment(*self.seed, *self.output(), volume="/nowhere/ct.nii.gz"),
                            1, "'/nowhere/ct.nii.gz'", "Check")

    def test_truncated_file(self):
        volume = os.path.join(self.inputs, "truncated.nii.gz")
        with open(self.volume, "rb") as whole, open(volume, "wb") as part:
            part.write(whole.read()[:20000])
        self.assert_refused(self.segment(*self.seed, *self.output(), volume=volume), 1, volume)

    def test_file_of_no_known_format(self):
        volume = os.path.join(self.inputs, "letter.txt")
        with open(volume, "w") as file:
            file.write("Dear Sir or Madam")
        self.assert_refused(self.segment(*self.seed, *self.output(), volume=volume), 1, volume)

    def test_folder_without_dicom(self):
        folder = os.path.join(self.inputs, "empty")
        os.makedirs(folder, exist_ok=True)
        self.assert_refused(self.segment(*self.seed, *self.output(), volume=folder), 1, folder,
                            "DICOM")

    def test_series_of_a_file(self):
        self.assert_refused(self.segment(*self.seed, *self.output(), "--series", "1.2.3"), 2,
                            "--series")

    def test_seed_outside(self):
        self.assert_refused(
            self.segment("--seed", 500, 32, 32, "--radius", 5, *self.output()), 1, "--seed:",
            r"\(500, 32, 32\) mm", "64 x 64 x 40", "LPS")

    def test_seed_voxel_outside(self):
        self.assert_refused(
            self.segment("--seed-voxel", 20, 20, 40, "--radius", 5, *self.output()), 1,
            "--seed-voxel:", r"\(20, 20, 40\)")

    def test_seed_without_contrast_or_too_small(self):
        self.assert_refused(
            self.segment(*self.seed[:4], "--radius", 0.1, *self.output()), 1, "'" + self.volume,
            "radius")

    def test_radius(self):
        for radius in (0, -5, "nan", "inf", "large"):
            with self.subTest(radius=radius):
                self.assert_refused(self.segment(*self.seed[:4], "--radius", radius,
                                                 *self.output()), 2, "--radius")

    def test_seed_that_is_no_point(self):
        for seed in (("nan", 0, 0), (1, 2), ("here", 0, 0)):
            with self.subTest(seed=seed):
                self.assert_refused(
                    self.segment("--seed", *seed, "--radius", 5, *self.output()), 2, "--seed")

    def test_both_seeds(self):
        self.assert_refused(
            self.segment(*self.seed, "--seed-voxel", 1, 2, 3, *self.output()), 2, "--seed-voxel")

    def test_no_seed(self):
        self.assert_refused(self.segment("--radius", 5, *self.output()), 2, "--seed")

    def test_no_result(self):
        self.assert_refused(self.segment(*self.seed), 2, "--output")

    def test_unknown_endings_are_refused_before_any_work(self):
        for option, name in (("-o", "out.vtk"), ("-o", "out"), ("--labels", "out.nii.bz2"),
                             ("--convergence", "out.txt"), ("--snapshot", "out.jpg")):
            with self.subTest(name=name):
                process = self.segment(*self.seed, option, self.result(name),
                                       volume="/nowhere/ct.nii.gz")
                self.assert_refused(process, 2, name, "Use ")

    def test_values_out_of_range(self):
        for option, value in (("--resolution", 100000), ("--levels", 0), ("--preset", "best"),
                              ("--threads", -1), ("--label-value", 256), ("--iterations", "many")):
            with self.subTest(option=option):
                self.assert_refused(self.segment(*self.seed, *self.output(), option, value), 2,
                                    option)

    def test_folder_that_takes_no_files(self):
        for folder, reason in ((self.result("absent"), "Create it"), ("/proc", "take files")):
            name = os.path.join(folder, "out.vtp")
            with self.subTest(folder=folder):
                self.assert_refused(self.segment(*self.seed, "-o", name), 1, name, reason)

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_folder_without_permission(self):
        os.chmod(self.results, 0o500)
        self.addCleanup(os.chmod, self.results, 0o700)
        self.assert_refused(self.segment(*self.seed, *self.output()), 1, "permissions")

    def test_the_input_as_output(self):
        copy = os.path.join(self.inputs, "copy.nii.gz")
        shutil.copy(self.volume, copy)
        self.assert_refused(self.segment(*self.seed, "--labels", copy, volume=copy), 2, copy,
                            "overwritten")
        self.assertEqual(os.path.getsize(copy), os.path.getsize(self.volume))

    def test_full_disk(self):
        for option, name, limit in (("-o", "out.vtp", 20000), ("-o", "out.stl", 20000),
                                    ("-o", "out.ply", 20000), ("-o", "out.obj", 20000),
                                    ("--labels", "out.nii", 20000),
                                    ("--labels", "out.nii.gz", 300),
                                    ("--convergence", "out.csv", 100)):
            with self.subTest(name=name):
                process = self.segment(
                    *self.seed, option, self.result(name),
                    env=command.without_leak_check(),  # VTK's writers leak then
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                self.assert_refused(process, 1, "'" + self.result(name), "disk")

    def test_full_disk_leaves_the_former_file_and_no_other_result(self):
        with open(self.result("out.csv"), "w") as file:
            file.write("a former result")
        process = self.segment(
            *self.seed, *self.output(), env=command.without_leak_check(),
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000)))
        self.assertEqual(process.returncode, 1)
        self.assertEqual(os.listdir(self.results), ["out.csv"])
        with open(self.result("out.csv")) as file:
            self.assertEqual(file.read(), "a former result")

    def test_snapshot_without_display(self):
        environment = {key: value for key, value in os.environ.items() if key != "DISPLAY"}
        process = self.segment(*self.seed, "--snapshot", self.result("out.png"), env=environment)
        self.assert_refused(process, 1, "--snapshot", "xvfb-run")

    def test_output_that_goes_nowhere(self):
        with open("/dev/full", "w") as full:
            process = command.subprocess.run(
                [command.PROGRAM, "evaluate", self.truth, self.truth], stdout=full,
                stderr=command.subprocess.PIPE, text=True)
        self.assert_refused_without_output(process)

    def assert_refused_without_output(self, process):
        self.assertEqual(process.returncode, 1)
        self.assertRegex(process.stderr, r"\Aflipfree: error: [^\n]+\n\Z")

    def test_phantom(self):
        process = command.run("phantom", "teapot", "-o", self.results)
        self.assert_refused(process, 2, "teapot", "u-tube")
        process = command.run("phantom", "sphere", "-o", self.result("a/b/c"))
        self.assert_refused(process, 1, "a/b/c")
        process = command.run("phantom", "sphere", "-o", self.results, "--spacing", -1, 1, 1)
        self.assert_refused(process, 1, "[Ss]pacing")

    def test_evaluate(self):
        other = os.path.join(self.inputs, "other")
        command.make_phantom(other, "cube", "--size", 20, 20, 20)
        cube = os.path.join(other, "cube-truth.nii.gz")
        damaged = os.path.join(self.inputs, "damaged.vtp")
        with open(damaged, "w") as file:
            file.write("<VTKFile type='PolyData'")
        for arguments, patterns in (
                ((cube, self.truth), (cube, self.truth)),
                ((damaged, self.truth), (damaged,)),
                (("/nowhere/a.stl", self.truth), ("/nowhere/a.stl",)),
                ((self.truth, "/nowhere/a.nii"), ("/nowhere/a.nii",)),
                ((self.truth, self.truth, "--label", 9), (self.truth,))):
            with self.subTest(arguments=arguments):
                process = command.run("evaluate", *arguments, "--csv", self.result("out.csv"))
                self.assert_refused(process, 1, *patterns)
        # Named as the filter's properties are, and still named as they are.
        for name in ("SegmentationLabel.nii.gz", "ReferenceLabel.nii.gz"):
            path = os.path.join(other, name)
            shutil.copy(cube, path)
            process = command.run("evaluate", path, self.truth)
            self.assert_refused(process, 1, "'" + path + "'")
            process = command.run("evaluate", self.truth, path)
            self.assert_refused(process, 1, "'" + path + "'")
        process = command.run("evaluate", self.truth, self.truth, "--csv", self.result("out.txt"))
        self.assert_refused(process, 2, "--csv")


if __name__ == "__main__":
    unittest.main()
