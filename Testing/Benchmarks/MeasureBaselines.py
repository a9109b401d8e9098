"""For tuning: runs the methods that FlipFree is compared with over the livers, spleens and kidneys of cases.csv, one
setting for all, and prints a table: Dice, mean distance, iterations and seconds. `table1` is the comparison itself.

    MeasureBaselines.py --data DIR [--only TEXT] [--method CLASS ...] [--set Name=value ...]
"""

import argparse
import csv
import os
import statistics
import time

import flipfree

# The GVF snake has but one slice: table1 knows how to score that.
METHODS = ("vtkRegionGrowing", "vtkLevelSetSegmentation", "vtkGraphCutSegmentation", "vtkSimplexMeshSegmentation")
ORGANS = ("liver", "spleen", "kidney")


def segment(name, image, row, parameters):
    """One row by one method: its scores, iterations and seconds, reading aside."""
    method = getattr(flipfree, name)()
    for parameter in parameters:
        key, value = parameter.split("=")
        number = float(value)
        getattr(method, "Set" + key)(int(number) if number.is_integer() and "." not in value else number)
    method.SetInputData(image)
    method.SetSeedCenter(*(float(row["seed_" + axis]) for axis in "xyz"))
    method.SetSeedRadius(float(row["radius_mm"]))
    begin = time.perf_counter()
    flipfree.update(method)
    return method, time.perf_counter() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--data", required=True, help="folder with cases.csv")
    parser.add_argument("--only", default="", help="rows whose name contains this text")
    parser.add_argument("--method", nargs="+", default=METHODS, choices=METHODS)
    parser.add_argument("--set", nargs="*", default=[], help="Name=value of a property")
    options = parser.parse_args()
    with open(os.path.join(options.data, "cases.csv"), encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["organ"] in ORGANS and options.only in row["case"]]
    print("| method | case | Dice | ASD mm | iterations | seconds |\n|---|---|---|---|---|---|")
    scores = {}
    for row in rows:
        image = flipfree.read_image(os.path.join(options.data, row["image"]))
        reference = flipfree.read_image(os.path.join(options.data, row["labels"]))
        for name in options.method:
            method, seconds = segment(name, image, row, options.set)
            result = flipfree.evaluate(method.GetLabelMap(), reference, reference_label=int(row["label_id"]))
            scores.setdefault((name, row["organ"]), []).append((result.dice, result.asd, seconds))
            print(f"| {name[3:]} | {row['case']} | {result.dice:.3f} | {result.asd:.2f} | "
                  f"{method.GetNumberOfIterations()} | {seconds:.1f} |", flush=True)
    for (name, organ), values in scores.items():
        dice, asd, seconds = (statistics.median(column) for column in zip(*values))
        print(f"| {name[3:]} | median of {len(values)}, {organ} | {dice:.3f} | {asd:.2f} | | {seconds:.1f} |")


if __name__ == "__main__":
    main()
