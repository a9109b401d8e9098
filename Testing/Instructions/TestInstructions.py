"""Counts the instructions of a fixed run by callgrind, stage by stage, and compares the counts with
those that are on record. Counts hardly vary from run to run, so that a kernel that has become slower
shows on any machine, however busy; the margin is for what compilers and mathematical libraries do
differently.

    TestInstructions.py PROGRAM REFERENCE.csv            fails where a stage needs a quarter more
    TestInstructions.py PROGRAM REFERENCE.csv --renew    writes down what is counted
"""

import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
MARGIN = 1.25

# Stage, and the function whose calls it is, with all that is called from there.
STAGES = {
    "prefilter": "SmoothRegion::Make",
    "mixture": "FitToSeed",
    "foreground": "OrganForeground::Update",
    "intensities again": "RefitToSurface",
    "carving": "CarveOrgan",
    "normals": "VertexNormals",
    "correspondences": "FindCorrespondences",
    "outliers": "RejectOutliers",
    "flips": "AvoidFlips",
    "propagation": "DiffuseDisplacements",
    "solve": "DeformationSolver::Solve",
    "guard": "EmbeddingGuard::Limit",
    "refinement": "RefineSurface",
    "last check": "CountSelfIntersections",
    "voxels of the surface": "VoxelizeSurface",
    "overlap": "MeasureOverlap",
    "surface distance": "MeasureSurfaceDistance",
}
# Stages that choose their vectors' width by the machine.
VECTORIZED = {"prefilter"}


def has_avx2() -> bool:
    """Whether this machine has the vectors with which the record was made."""
    return " avx2 " in Path("/proc/cpuinfo").read_text()


def count(program: str) -> dict[str, int]:
    """Instructions by stage."""
    with tempfile.TemporaryDirectory() as folder:
        profile = Path(folder) / "profile"
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}", program],
            capture_output=True,
            text=True,
        )
        if run.returncode != 0:
            sys.exit(f"valgrind could not run {program}:\n{run.stderr}")
        print(run.stdout.strip())
        report = subprocess.run(
            ["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(profile)],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
    counts: dict[str, int] = {}
    for stage, function in STAGES.items():
        # Of what is cloned or called by itself the greatest counts: the entry from outside.
        found = re.findall(
            rf"^ *([\d,]+) .*?:FlipFree::{re.escape(function)}(?:\(|\[|'| )", report, re.MULTILINE
        )
        if not found:
            sys.exit(f"{function} is not in the profile; is it called, and not inlined?")
        counts[stage] = max(int(number.replace(",", "")) for number in found)
    return counts


def main() -> int:
    program, reference = sys.argv[1], Path(sys.argv[2])
    try:
        subprocess.run(["valgrind", "--version"], capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        print("Skipped: valgrind is not installed")
        return SKIPPED
    counts = count(program)
    if "--renew" in sys.argv:
        with reference.open("w", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(["stage", "thousand instructions"])
            writer.writerows([stage, round(number / 1000)] for stage, number in counts.items())
        return 0
    with reference.open(newline="") as stream:
        expected = {
            row["stage"]: 1000 * int(row["thousand instructions"]) for row in csv.DictReader(stream)
        }
    failed = []
    print(f"{'stage':24}{'million':>12}{'on record':>12}{'ratio':>8}")
    for stage, number in counts.items():
        if stage in VECTORIZED and not has_avx2():
            print(f"{stage:24}{number / 1e6:12.1f}  not compared: this machine has no AVX2")
            continue
        if stage not in expected:
            sys.exit(f"{stage} is not on record in {reference}; renew it: --renew")
        ratio = number / expected[stage]
        print(f"{stage:24}{number / 1e6:12.1f}{expected[stage] / 1e6:12.1f}{ratio:8.2f}")
        if ratio > MARGIN:
            failed.append(stage)
        elif ratio < 1 / MARGIN:
            print("  better than on record; renew it, so that this is kept")
    if failed:
        print(
            f"{', '.join(failed)}: more than {MARGIN} times the instructions on record. If what they "
            f"bring is worth them, renew the record: {' '.join(sys.argv[:3])} --renew"
        )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
