#!/usr/bin/env python3
"""Puts what MeasureCases has printed into the documents: the rows of rows.md, and the tables of organs of measures.md
and README.md.

    RenewRows.py MEASURED [--root DIR] [--data DIR]

MEASURED is what `MeasureCases --cases cases.csv --cases development.csv` has printed. Only cells of its columns change: a
case or a group that a document does not name is left out. By hand have to be renewed what a sentence says, and which
scores are the ten lowest. Printed for that: the number of rows and their mean, and how the confidence ranks them.
"""

import argparse
import csv
import pathlib
import re
import statistics

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = "development.csv"
DOUBTFUL = 0.85  # a confidence below it is warned of, and a Dice below it is a bad one


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def line_of(cells):
    return "| " + " | ".join(cells) + " |"


def read_measured(text):
    """Each row's numbers as texts, by the case and the column that a document has for them."""
    heads, rows = [], {}
    for line in text.splitlines():
        cells = cells_of(line)
        if cells[0] == "case":
            heads = [head.replace(" mm", ", mm") for head in cells]
        elif len(cells) == len(heads) and re.fullmatch(r"[01]\.\d+", cells[1]):
            rows[cells[0]] = dict(zip(heads, cells))
    return rows


def group_of(case):
    """As tables name it: CT liver. The only MR in the list are those of CHAOS."""
    organ = next(organ for organ in ("liver", "spleen", "kidney") if organ in case)
    return f"{'MR' if case.startswith('chaos') else 'CT'} {organ}"


def summaries(rows):
    """Of each group of organs, and of all: cells by column."""
    groups = {}
    for case, row in rows.items():
        for name in (group_of(case), "all"):
            groups.setdefault(name, []).append(row)
    return {
        name: {
            "rows": str(len(of)),
            "median Dice": f"{statistics.median(float(row['Dice']) for row in of):.3f}",
            "median ASD, mm": f"{statistics.median(float(row['ASD, mm']) for row in of):.2f}",
            "rows below a Dice of 0.8": str(sum(float(row["Dice"]) < 0.8 for row in of)),
            "self-intersecting surfaces": str(sum(row["self-intersections"] != "0" for row in of)),
        }
        for name, of in groups.items()
    }


def halves_of(rows):
    """Of each group: the cells of a table with half A beside half B."""
    with open(pathlib.Path(__file__).with_name("halves.csv"), newline="", encoding="utf-8") as file:
        halves = {row["volume"]: row["half"] for row in csv.DictReader(file)}
    columns = ("rows", "median Dice", "median ASD, mm", "rows below a Dice of 0.8")
    cells = {}
    for half in "AB":
        of_half = {case: row for case, row in rows.items() if halves[case.split("-")[0]] == half}
        for name, group in summaries(of_half).items():
            cells.setdefault(name, []).extend(group[column] for column in columns)
    return cells


def renewed(text, named, first, halves=None):
    """The document with new cells in the tables whose first column is called so."""
    columns = []
    lines = []
    for line in text.split("\n"):
        name = cells_of(line)[0]
        if not line.startswith("|"):
            columns = []
        elif not columns:
            columns = cells_of(line)
        elif columns[0] == first and name in named:
            new = named[name]
            line = line_of([new.get(column, cell) for column, cell in zip(columns, cells_of(line))])
        elif "half A: rows" in columns and name in (halves or {}):
            line = line_of([name, *halves[name]])
        lines.append(line)
    return "\n".join(lines)


def area_under_roc(rows):
    """The chance that a bad row has less confidence than a good one."""
    bad = [float(row["confidence"]) for row in rows if float(row["Dice"]) < DOUBTFUL]
    good = [float(row["confidence"]) for row in rows if float(row["Dice"]) >= DOUBTFUL]
    pairs = [(a < b) + (a == b) / 2 for a in bad for b in good]
    return statistics.fmean(pairs) if pairs else float("nan")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("measured", type=pathlib.Path)
    parser.add_argument("--root", type=pathlib.Path, default=ROOT)
    parser.add_argument("--data", type=pathlib.Path, default=ROOT.parent / "shared" / "data")
    options = parser.parse_args()
    rows = read_measured(options.measured.read_text(encoding="utf-8"))
    if not rows:
        raise SystemExit(f"RenewRows.py: '{options.measured}' holds no row of MeasureCases.")
    listed = [line.split(",")[0] for line in (options.data / LIST).read_text(encoding="utf-8").split("\n")[1:] if line]
    missing = [case for case in listed if case not in rows]
    if missing:
        raise SystemExit(f"RenewRows.py: '{options.measured}' has no row for {missing[0]} of {LIST}.")
    developed = {case: rows[case] for case in listed}
    groups, halves = summaries(developed), halves_of(developed)
    for page, named, first in (
        ("Examples/Comparison/rows.md", rows, "case"),
        ("Examples/Guide/measures.md", groups, "organ"),
        ("README.md", groups, "organ"),
    ):
        path = options.root / page
        path.write_text(renewed(path.read_text(encoding="utf-8"), named, first, halves), encoding="utf-8")
    for title, chosen in ((LIST, list(developed.values())), ("all", list(rows.values()))):
        doubtful = [row for row in chosen if float(row["confidence"]) < DOUBTFUL]
        bad = [row for row in chosen if float(row["Dice"]) < DOUBTFUL]
        both = sum(row in doubtful for row in bad)
        print(
            f"{title}: {len(chosen)} rows, mean Dice {statistics.fmean(float(row['Dice']) for row in chosen):.4f}; "
            f"a confidence below {DOUBTFUL} flags {both} of the {len(bad)} rows with a Dice below it, and "
            f"{len(doubtful) - both} of the others; area under the ROC curve {area_under_roc(chosen):.3f}"
        )


if __name__ == "__main__":
    main()
