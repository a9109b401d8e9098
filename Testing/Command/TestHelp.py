"""The help teaches: purpose, units, defaults, examples; and the version is printed."""

import unittest

import command

WORDS = {
    (): ("segment", "trace", "surfaces", "evaluate", "series", "phantom", "LPS", "Examples:", "Exit status"),
    ("segment",): ("--seed ", "--seed-voxel", "--radius", "LPS", "millimeters", ".vtp", ".nii.gz", "--preset",
                   "published", "naive", "--threads", "--series", "Examples:"),
    ("trace",): ("--point X Y Z", "LPS", "millimeters", "--radius", "--wall-thickness", "--centerline", "Examples:"),
    ("evaluate",): ("SEGMENTATION", "REFERENCE", "--label", "--csv", "Examples:"),
    ("surfaces",): ("LABELS", "--output", "--format", "--names", "--exact", "--distance", "Examples:"),
    ("series",): ("FOLDER", "--csv", "--series", "UID#1", "Examples:"),
    ("phantom",): ("sphere", "cube", "cup", "u-tube", "vessel", "abdomen", "Examples:"),
}


class TestHelp(unittest.TestCase):
    def test_every_command_explains_itself(self):
        for words, expected in WORDS.items():
            process = command.run(*words, "--help")
            self.assertEqual((process.returncode, process.stderr), (0, ""))
            for word in expected:
                self.assertIn(word, process.stdout)

    def test_defaults_are_the_filters(self):
        text = command.run("segment", "--help").stdout
        self.assertRegex(text, r"--resolution N [^\[]*\[32\]")
        self.assertRegex(text, r"--guard,[^\[]*\[on\]")

    def test_every_parameter_is_an_option(self):
        options = command.parameter_options()
        self.assertGreater(len(options), 30)
        help_of_segment = command.run("segment", "--help").stdout
        for option in options:
            self.assertRegex(help_of_segment, rf"{option}\b(?!-)")

    def test_version(self):
        process = command.run("--version")
        self.assertEqual(process.returncode, 0)
        self.assertRegex(process.stdout, r"\Aflipfree \d+\.\d+\.\d+\n\Z")

    def test_wrong_usage_points_to_the_help(self):
        for arguments in ([], ["transmogrify"], ["segment"], ["segment", "a", "--frobnicate"]):
            process = command.run(*arguments)
            self.assertEqual(process.returncode, 2, arguments)
            self.assertRegex(process.stderr, r"\Aflipfree: error: [^\n]*--help'\.\n\Z")

    @unittest.skipIf(command.IS_OF_PIP, "it is there")
    def test_cohort_is_elsewhere(self):
        process = command.run("cohort", "table.csv", "-o", "results")
        self.assertEqual(process.returncode, 2)
        self.assertRegex(process.stderr, r"'cohort' is a subcommand of the Python package only: [^\n]*pip install")


if __name__ == "__main__":
    unittest.main()
