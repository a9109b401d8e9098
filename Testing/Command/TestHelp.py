"""The help teaches: purpose, units, defaults, examples; and the version is printed."""

import os
import re
import unittest

import command

HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Filters", "Segmentation",
                      "vtkFlipFreeSegmentation.h")


class TestHelp(unittest.TestCase):
    def help_of(self, *subcommand):
        process = command.run(*subcommand, "--help")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        return process.stdout

    def test_program(self):
        text = self.help_of()
        for word in ("segment", "evaluate", "phantom", "LPS", "Examples:", "Exit status"):
            self.assertIn(word, text)

    def test_segment(self):
        text = self.help_of("segment")
        for word in ("--seed ", "--seed-voxel", "--radius", "LPS", "millimeters", ".vtp", ".nii.gz",
                     "--preset", "published", "naive", "--threads", "--series", "Examples:"):
            self.assertIn(word, text)
        self.assertRegex(text, r"--resolution N [^\[]*\[32\]")  # the filter's own default

    def test_every_property_of_the_filter_is_an_option(self):
        with open(HEADER, encoding="utf-8") as file:
            properties = re.findall(r"vtkSet\w*Macro\((\w+)", file.read())
        options = {re.sub(r"(?<!^)(?=[A-Z])", "-", name).lower() for name in properties}
        # The seed is --seed or --seed-voxel and --radius; iterates are for pipelines.
        options -= {"seed-center", "seed-radius", "keep-history"}
        self.assertGreater(len(options), 30)
        help_of_segment = self.help_of("segment")
        self.assertEqual([option for option in sorted(options)
                          if not re.search(rf"--{option}\b(?!-)", help_of_segment)], [])

    def test_evaluate(self):
        text = self.help_of("evaluate")
        for word in ("SEGMENTATION", "REFERENCE", "--label", "--csv", "Examples:"):
            self.assertIn(word, text)

    def test_phantom(self):
        text = self.help_of("phantom")
        for word in ("sphere", "cube", "cup", "u-tube", "vessel", "abdomen", "Examples:"):
            self.assertIn(word, text)

    def test_version(self):
        process = command.run("--version")
        self.assertEqual(process.returncode, 0)
        self.assertRegex(process.stdout, r"\Aflipfree \d+\.\d+\.\d+\n\Z")

    def test_wrong_usage_points_to_the_help(self):
        for arguments in ([], ["transmogrify"], ["segment"], ["segment", "a", "--frobnicate"]):
            process = command.run(*arguments)
            self.assertEqual(process.returncode, 2, arguments)
            self.assertRegex(process.stderr, r"\Aflipfree: error: [^\n]*--help'\.\n\Z")


if __name__ == "__main__":
    unittest.main()
