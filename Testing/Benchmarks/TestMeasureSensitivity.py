"""Which numbers MeasureSensitivity finds in a line, and how it has them read by name."""

import pathlib
import tempfile
import unittest

import MeasureSensitivity as sensitivity


class TestMeasureSensitivity(unittest.TestCase):
    def varied(self, line, file="Evidence/Cut.cxx", names=None):
        return sensitivity.varied(line, file, {} if names is None else names)

    def test_constants_members_and_arrays(self):
        names = {}
        self.assertEqual(
            self.varied("constexpr double Least = 0.5; // mm", names=names),
            'const double Least = Varied("Evidence/Cut.cxx:Least", static_cast<double>(0.5)); // mm',
        )
        self.assertEqual(
            self.varied("  float Floor = -2.5F;", "Evidence/Cut.h", names),
            '  float Floor = Varied("Evidence/Cut.h:Floor", static_cast<float>(-2.5F));',
        )
        self.assertEqual(
            self.varied("constexpr std::array<double, 2> Parts{ { 0.7, 0.8 } };", names=names),
            'const std::array<double, 2> Parts{ { Varied("Evidence/Cut.cxx:Parts[0]", 0.7), '
            'Varied("Evidence/Cut.cxx:Parts[1]", 0.8) } };',
        )
        self.assertEqual(
            names,
            {
                "Evidence/Cut.cxx:Least": "0.5",
                "Evidence/Cut.h:Floor": "-2.5",
                "Evidence/Cut.cxx:Parts[0]": "0.7",
                "Evidence/Cut.cxx:Parts[1]": "0.8",
            },
        )

    def test_constants_of_headers_and_classes_are_inline(self):
        self.assertTrue(self.varied("constexpr int Most = 5;", "Evidence/Cut.h").startswith("inline const int Most"))
        self.assertTrue(self.varied("  static constexpr double Scale = 2;").startswith("  static inline const double"))

    def test_what_is_no_number_of_the_method_stays(self):
        for line in (
            "constexpr double Guard = 1e-9;",
            "  double Sum = 0;",
            "  double sum = 2;",
            "double Free = 2;",
            "  return Depth = 2;",
            "constexpr double None = std::numeric_limits<double>::infinity();",
        ):
            self.assertEqual(self.varied(line), line)
        reach = "constexpr int Reach = 2;"
        self.assertEqual(self.varied(reach, "Evidence/VenaCavaCarving.cxx"), reach)

    def test_what_depends_on_a_number_is_no_constant_either(self):
        names = {}
        self.varied("constexpr double Least = 0.5;", names=names)
        self.assertEqual(self.varied("constexpr double Most = Least;", names=names), "const double Most = Least;")

    def test_two_numbers_of_one_name_are_refused(self):
        names = {}
        self.varied("constexpr double Least = 0.5;", names=names)
        with self.assertRaisesRegex(ValueError, "two numbers are called Evidence/Cut.cxx:Least"):
            self.varied("constexpr double Least = 0.6;", names=names)

    def test_summary(self):
        rows = {"a": ("kidney-left", 0.9, "1"), "b": ("kidney-right", 0.7, "2"), "c": ("liver", 0.95, "3")}
        medians, mean, low = sensitivity.summary(rows)
        self.assertEqual((medians, low), ({"kidney": 0.8, "liver": 0.95}, 1))
        self.assertAlmostEqual(mean, 0.85)

    def test_every_rule_is_switched_off_by_numbers_that_there_are(self):
        names, _ = sensitivity.varied_sources(sensitivity.ROOMS)
        table = pathlib.Path(sensitivity.__file__).with_name("rules.csv")
        self.assertGreater(len(sensitivity.read_rules(table, names)), 10)
        with self.assertRaisesRegex(ValueError, "there is no number Intensity/"):
            sensitivity.read_rules(table, {})
        with tempfile.TemporaryDirectory() as folder:
            wrong = pathlib.Path(folder, "rules.csv")
            wrong.write_text("rule,without\ncut,Evidence/Cut.h:Least\n")
            with self.assertRaisesRegex(ValueError, "cut: 'Evidence/Cut.h:Least' is neither NAME=VALUE nor NAME"):
                sensitivity.read_rules(wrong, names)

    def test_tables(self):
        before = {"a": ("kidney-left", 0.9, "1"), "b": ("liver", 0.7, "2")}
        after = {"a": ("kidney-left", 0.7, "3"), "b": ("liver", 0.7, "2")}
        self.assertEqual(
            list(sensitivity.table_of_rules(before, {"cut": after}))[2:],
            [
                "| (nothing) | 0.9000 | 0.7000 | 0.8000 | 1 | 0 |",
                "| cut | -0.2000 | +0.0000 | -0.1000 | 2 | 1 |",
            ],
        )
        lines = list(sensitivity.table_of_numbers({"One": "1", "Two": "2"}, before, {"Two*0.8": after, "Two*1.2": before}))
        self.assertEqual(lines[2], "| One | 1 | fails |  |  |  | fails |  |  |  |")
        self.assertEqual(lines[3], "| Two | 2 | -0.200 kidney | -0.1000 | 1 | 2 | 0 | +0.0000 | 0 | 1 |")


if __name__ == "__main__":
    unittest.main()
