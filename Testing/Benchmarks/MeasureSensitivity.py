#!/usr/bin/env python3
"""How much each named number of the evidence matters: it is changed by a fifth either way, one at a time.
With --rules: how much each rule matters; it is switched off by the numbers that a table gives it.

    MeasureSensitivity.py FOLDER [--data DIR] [--cases FILE...] [--only TEXT] [--rooms ROOM...] [--files PATTERN]
                          [--rules FILE] [--jobs N] [--list]

FOLDER takes a copy of the sources in which each number of the rooms that has a name is read when the program starts,
MeasureCases built from it, and one table of results per change. What is there is not measured again, so a run can be
interrupted; empty the folder `tables` when results have changed. Printed as Markdown, the number that matters most
first: its value, the greatest change of the median of a group of organs, the change of the mean of all rows, how many
surfaces change at all, and how many rows are below 0.8. Of rules: what without them becomes of each group's mean.

A number here is a literal in the definition of a constant whose name begins with a capital, or the default of a member.
Counts change by one at least. Zeros and limits that only keep zeros out are left alone, and so is what the compiler has
to know (FIXED).
"""

import argparse
import concurrent.futures
import csv
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ["Evidence", "Intensity"]
FACTORS = (0.8, 1.2)
# The compiler has to know them: they count the members of arrays.
FIXED = {
    "SurfaceConfidence.cxx": ["FirstStep", "LastStep"],
    "VenaCavaCarving.cxx": ["Reach", "Margin", "RimEnd", "GridStep"],
}
VARIED = "Varied.h"
TYPES = r"(?:double|float|int|std::size_t|std::array<(?:double|float|int), \d+>|[A-Z]\w+)"
DEFINITION = re.compile(
    r"^(?P<indent> *)(?P<qualifiers>(?:static |inline )*)(?P<constant>constexpr |)"
    rf"(?P<type>{TYPES}) (?P<name>[A-Z]\w*)(?P<array>\[\])?(?P<begin> = |\{{)(?P<value>[^;]*);"
)
LITERAL = re.compile(r"(?<![\w.])(?P<sign>-?)(?P<number>\d+\.\d+(?:e-?\d+)?F?|\d+(?:e-?\d+)?F?)(?![\w.])")
CHANGE = re.compile(r"(?P<name>.+?)[*=]-?[\d.]+(?:e-?\d+)?")
# Each number as it is, unless the environment names it.
HEADER = """#pragma once
#include <cmath>
#include <cstdlib>
#include <cstring>

// What VARIED says of a number: a semicolon, its name, and the factor or value it gets.
template <typename T>
T Varied(const char* name, T value)
{
  const char* const all = std::getenv("VARIED");
  const std::size_t length = std::strlen(name);
  const char* at = all ? std::strstr(all, name) : nullptr;
  while (at && !(at > all && at[-1] == ';' && (at[length] == '*' || at[length] == '=')))
  {
    at = std::strstr(at + 1, name);
  }
  if (!at)
  {
    return value;
  }
  const double given = std::atof(at + length + 1);
  const bool isInteger = static_cast<T>(1.5) == static_cast<T>(1);
  if (at[length] == '=' || !isInteger)
  {
    return static_cast<T>(at[length] == '=' ? given : given * static_cast<double>(value));
  }
  const double rounded = std::round(given * static_cast<double>(value));
  return static_cast<T>(rounded != static_cast<double>(value) ? rounded
                        : given > 1                           ? rounded + 1
                                                              : rounded - 1);
}
"""


def is_a_guard(literal):
    """Whether the literal only keeps out zeros or stands for no value: nothing is to be learned by a fifth of it."""
    size = abs(float(literal.rstrip("F")))
    return size == 0 or size < 1e-4 or size >= 1e5


def varied(line, file, names):
    """The line with its numbers read by name; the names go to the list."""
    definition = DEFINITION.match(line)
    is_member = definition and not definition["constant"]
    if not definition or (is_member and not definition["indent"]):
        return line
    value = definition["value"]
    if definition["name"] in FIXED.get(file.split("/")[1], []):
        return line
    literals = [one for one in LITERAL.finditer(value) if not is_a_guard(one["number"])]
    if not literals:
        of_varied = any(re.search(rf"\b{re.split('[:[]', name)[1]}\b", value) for name in names)
        return line.replace("constexpr ", "const ", 1) if of_varied else line
    pieces, end = [], 0
    for count, one in enumerate(literals):
        name = f"{file}:{definition['name']}" + (f"[{count}]" if len(literals) > 1 else "")
        number = one["sign"] + one["number"]
        kind = definition["type"]
        if kind in ("double", "float", "std::size_t", "int"):
            number = f"static_cast<{kind}>({number})"
        if name in names:
            raise ValueError(f"two numbers are called {name}; give one another name")
        names[name] = one["sign"] + one["number"].rstrip("F")
        pieces += [value[end : one.start()], f'Varied("{name}", {number})']
        end = one.end()
    pieces.append(value[end:])
    changed = line[: definition.start("value")] + "".join(pieces) + line[definition.end("value") :]
    if definition["constant"]:
        is_inline = "static" in definition["qualifiers"] or (not definition["indent"] and file.endswith(".h"))
        is_inline = is_inline and "inline" not in definition["qualifiers"]
        changed = changed.replace("constexpr ", "inline const " if is_inline else "const ", 1)
    return changed


def sources_of(rooms):
    """Headers first: what depends on their numbers is no constant for the compiler either."""
    kernels = SOURCE / "Filters" / "Kernels"
    paths = [path for room in rooms for path in (kernels / room).glob("*") if path.suffix in (".h", ".cxx")]
    return sorted(paths, key=lambda path: (path.suffix != ".h", path))


def varied_sources(rooms):
    """Each number by its name, and by path the sources with numbers read by name."""
    names, texts = {}, {}
    for path in sources_of(rooms):
        file = f"{path.parent.name}/{path.name}"
        text = "\n".join(varied(line, file, names) for line in path.read_text().split("\n"))
        if "Varied(" in text:
            text = text.replace("\n#include", f'\n#include "{VARIED}"\n#include', 1)
        texts[path] = text
    return names, texts


def make_copy(build, rooms):
    """Copies the sources; returns each number by its name."""
    copy = build / "source"
    copy.mkdir(parents=True, exist_ok=True)
    names, texts = varied_sources(rooms)
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, check=True, capture_output=True, text=True)
    for path in filter(None, tracked.stdout.split("\0")):
        source, target = SOURCE / path, copy / path
        if not source.is_file():
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        text = texts.get(source)
        if text is None:
            if not target.exists() or target.stat().st_mtime < source.stat().st_mtime:
                shutil.copy(source, target)
        elif not target.exists() or target.read_text() != text:
            target.write_text(text)
    header = copy / "Filters" / "Kernels" / VARIED
    if not header.exists() or header.read_text() != HEADER:
        header.write_text(HEADER)
    return names


def make_program(build):
    """Builds MeasureCases of the copy."""
    folder = build / "build"
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DFLIPFREE_BUILD_BENCHMARKS=ON", "-DCMAKE_UNITY_BUILD=ON", "-GNinja"]
    subprocess.run(["cmake", "-S", build / "source", "-B", folder, *options], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "--target", "MeasureCases"], check=True, stdout=sys.stderr)
    return folder / "bin" / "MeasureCases"


def measure(program, table, options, changes=""):
    """The rows of one run: (organ, Dice, hash) by the name of the case. The changes are NAME*FACTOR or NAME=VALUE."""
    if not table.exists():
        part = table.with_suffix(".part")
        command = [program, "--data", options.data, "--threads", "1", "--write-gate", part, "--only", options.only]
        for cases in options.cases:
            command += ["--cases", cases]
        environment = dict(os.environ, VARIED="".join(f";{change}" for change in changes.split()))
        run = subprocess.run(command, env=environment, capture_output=True, text=True)
        if run.returncode != 0:
            raise RuntimeError(f"{changes}: {run.stderr.strip()}")
        part.rename(table)
    with open(table, newline="") as file:
        return {row["case"]: (row["organ"], float(row["dice"]), row["hash"]) for row in csv.DictReader(file)}


def group(organ):
    """Left and right are one group."""
    return organ.replace("-left", "").replace("-right", "")


def scores_by_group(rows):
    """The Dice scores of each group of organs."""
    groups = {}
    for organ, dice, _ in rows.values():
        groups.setdefault(group(organ), []).append(dice)
    return groups


def summary(rows):
    """Medians by group, mean, and the number of rows below 0.8."""
    medians = {organ: statistics.median(scores) for organ, scores in scores_by_group(rows).items()}
    scores = [dice for _, dice, _ in rows.values()]
    return medians, statistics.fmean(scores), sum(dice < 0.8 for dice in scores)


def number_of_changed_surfaces(before, after):
    return sum(after[case][2] != before[case][2] for case in before)


def read_rules(file, names):
    """The changes that switch each rule off, by its name."""
    with open(file, newline="") as table:
        rules = {row["rule"]: row["without"] for row in csv.DictReader(table)}
    for rule, changes in rules.items():
        for change in changes.split():
            parts = CHANGE.fullmatch(change)
            if not parts:
                raise ValueError(f"{file}: {rule}: '{change}' is neither NAME=VALUE nor NAME*FACTOR")
            if parts["name"] not in names:
                raise ValueError(f"{file}: {rule}: there is no number {parts['name']}; --list shows all")
    return rules


def table_of_rules(before, after):
    """Lines of Markdown: what becomes of the mean of each group, and of all rows, without each rule."""
    organs = sorted(scores_by_group(before))

    def means(rows):
        groups = scores_by_group(rows)
        return [statistics.fmean(groups[organ]) for organ in organs] + [summary(rows)[1]]

    yield "| without | " + " | ".join([*organs, "all", "below 0.8", "surfaces"]) + " |"
    yield "|---" * (len(organs) + 4) + "|"
    yield f"| (nothing) | {' | '.join(f'{mean:.4f}' for mean in means(before))} | {summary(before)[2]} | 0 |"
    for rule, rows in after.items():
        shifts = " | ".join(f"{mean - of_before:+.4f}" for mean, of_before in zip(means(rows), means(before)))
        yield f"| {rule} | {shifts} | {summary(rows)[2]} | {number_of_changed_surfaces(before, rows)} |"


def table_of_numbers(names, before, after):
    """Lines of Markdown: what becomes of the medians, the mean and the rows below 0.8 when a number is changed."""
    medians, mean, _ = summary(before)
    lines = []
    for name, value in names.items():
        worst, cells = (0, 0, 0), []
        for factor in FACTORS:
            rows = after.get(f"{name}*{factor}")
            if not rows:
                worst, cells = (math.inf, 0, 0), cells + ["fails", "", "", ""]
                continue
            medians_after, mean_after, low_after = summary(rows)
            shift, organ = max((abs(medians_after[organ] - medians[organ]), organ) for organ in medians)
            count = number_of_changed_surfaces(before, rows)
            worst = max(worst, (shift, abs(mean_after - mean), count))
            moved = f"{medians_after[organ] - medians[organ]:+.3f} {organ}" if shift >= 5e-4 else "0"
            cells += [moved, f"{mean_after - mean:+.4f}", f"{count}", f"{low_after}"]
        lines.append((worst, f"| {name} | {value} | " + " | ".join(cells) + " |"))
    heads = ["median", "mean", "surfaces", "below 0.8"]
    columns = ["number", "value"] + [f"x {factor}: {head}" for factor in FACTORS for head in heads]
    yield "| " + " | ".join(columns) + " |"
    yield "|---" * len(columns) + "|"
    for _, line in sorted(lines, key=lambda line: line[0], reverse=True):
        yield line


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--data", default=str(SOURCE.parent / "shared" / "data"))
    parser.add_argument("--cases", nargs="+", default=["development.csv"])
    parser.add_argument("--only", default="", help="rows whose name contains this text")
    parser.add_argument("--rooms", nargs="+", default=ROOMS)
    parser.add_argument("--files", default="", help="regular expression: which numbers, as Room/File:Name")
    parser.add_argument("--rules", type=pathlib.Path, help="table of rules and of the numbers that switch them off")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--list", action="store_true", help="only names and values")
    options = parser.parse_args()
    build = options.folder.resolve()
    names = make_copy(build, options.rooms)
    try:
        rules = read_rules(options.rules, names) if options.rules else {}
    except (OSError, ValueError) as error:
        sys.exit(f"MeasureSensitivity.py: {error}.")
    names = {name: value for name, value in names.items() if re.search(options.files, name)}
    if options.list:
        for name, value in names.items():
            print(name, value)
        return
    program = make_program(build)
    selection = " ".join([options.data, *options.cases, options.only]).strip()
    tables = build / "tables" / re.sub(r"[^\w.]+", "-", selection)
    tables.mkdir(parents=True, exist_ok=True)
    before = measure(program, tables / "unchanged.csv", options)
    if not before:
        sys.exit(f"MeasureSensitivity.py: no row has '{options.only}' in its name. Change --only or --cases.")
    medians, mean, low = summary(before)
    print(f"{len(before)} rows, mean {mean:.4f}, {low} below 0.8; medians:")
    print(", ".join(f"{organ} {median:.3f}" for organ, median in sorted(medians.items())), "\n")

    changes = rules or {f"{name}*{factor}": f"{name}*{factor}" for name in names for factor in FACTORS}
    pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
    runs = {}
    for label, change in changes.items():
        table = tables / (re.sub(r"[^\w.*=-]+", "-", change) + ".csv")
        runs[label] = pool.submit(measure, program, table, options, change)
    try:
        concurrent.futures.wait(runs.values())
    except KeyboardInterrupt:
        pool.shutdown(cancel_futures=True)
        sys.exit(130)
    after = {}
    for label, run in runs.items():
        if run.exception():
            print(run.exception(), file=sys.stderr)
        else:
            after[label] = run.result()
    for line in table_of_rules(before, after) if options.rules else table_of_numbers(names, before, after):
        print(line)


if __name__ == "__main__":
    main()
