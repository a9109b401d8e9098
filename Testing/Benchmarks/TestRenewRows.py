"""What RenewRows takes of a measurement, and what it changes in a document."""

import unittest

import RenewRows

MEASURED = """
| case | Dice | Jaccard | ASD mm | HD95 mm | volume | iterations | read s | run s | stages s | search s | self-intersections | guarded | stop reason | confidence | offset mm |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
| btcv06-liver   | 0.945 | 0.895 |  2.06 |  10.99 | +0.01 | 141 | 0.10 | 1.20 | 1 1 1 1 | 1 1 1 1 | 0 | 12 | converged | 0.91 | +0.40 |
| chaos01-spleen | 0.700 | 0.600 |  4.06 |  20.00 | -0.20 |  90 | 0.10 | 0.40 | 1 1 1 1 | 1 1 1 1 | 0 | 12 | converged | 0.42 | -0.40 |
| btcv07-liver   | no surface |
"""

PAGE = """| case | half | Dice | seconds |
|---|---|---|---|
| btcv06-liver | A | 0.111 | 3.0 |
| heart | B | 0.222 | 4.0 |

| vessel | Dice |
|---|---|
| btcv06-liver | 0.333 |"""


class TestRenewRows(unittest.TestCase):
    def test_measured_rows(self):
        rows = RenewRows.read_measured(MEASURED)
        self.assertEqual(list(rows), ["btcv06-liver", "chaos01-spleen"])
        self.assertEqual(rows["chaos01-spleen"]["confidence"], "0.42")
        self.assertEqual(rows["btcv06-liver"]["self-intersections"], "0")

    def test_only_known_cells_of_tables_of_cases_change(self):
        changed = RenewRows.renewed(PAGE, RenewRows.read_measured(MEASURED), "case")
        self.assertEqual(changed, PAGE.replace("0.111", "0.945"))

    def test_groups(self):
        groups = RenewRows.summaries(RenewRows.read_measured(MEASURED))
        self.assertEqual(sorted(groups), ["CT liver", "MR spleen", "all"])
        self.assertEqual(groups["all"]["rows below a Dice of 0.8"], "1")
        self.assertEqual(groups["MR spleen"]["median ASD, mm"], "4.06")

    def test_halves_stand_side_by_side(self):
        page = """| organ | half A: rows | median Dice | median ASD, mm | below 0.8 | half B: rows | median Dice | median ASD, mm | below 0.8 |
|---|---|---|---|---|---|---|---|---|
| CT liver | 0 | 0 | 0 | 0 | 0 | 0 | 0 | 0 |"""
        rows = RenewRows.read_measured(MEASURED)
        rows["btcv07-liver"] = dict(rows["btcv06-liver"], Dice="0.600")
        changed = RenewRows.renewed(page, {}, "case", RenewRows.halves_of(rows))
        self.assertTrue(changed.endswith("\n| CT liver | 1 | 0.945 | 2.06 | 0 | 1 | 0.600 | 2.06 | 1 |"), changed)

    def test_confidence_ranks(self):
        rows = list(RenewRows.read_measured(MEASURED).values())
        self.assertEqual(RenewRows.area_under_roc(rows), 1)


if __name__ == "__main__":
    unittest.main()
