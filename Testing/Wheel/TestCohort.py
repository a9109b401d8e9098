"""Cohorts on Dask: a real scheduler with two worker processes on the loopback, and one of them killed."""

import contextlib
import csv
import functools
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path
from unittest import mock

import flipfree
import numpy

try:
    import distributed
    import psutil
    import pyarrow.parquet
    import SimpleITK  # pylint: disable=unused-import
    from flipfree import _cluster, _cohort_table, _cohort_work
except ImportError as error:
    print(f"Skipped: {error}.")
    sys.exit(77)

sys.path.append(str(Path(__file__).resolve().parent.parent / "Support"))
import dicom  # pylint: disable=wrong-import-position
import lobed_ball  # pylint: disable=wrong-import-position

COMMAND = str(Path(sys.executable).parent / "flipfree")
GRID = {"dimensions": (48, 48, 32), "spacing": (1, 1, 1.6)}
COARSE = {"resolution": 8, "levels": 1}


def write_volume(path, random_seed):
    """A noisy ball; returns its seed."""
    ball = flipfree.phantom("sphere", random_seed=random_seed, **GRID)
    flipfree.write_image(ball.image, path)
    return ball


class CohortTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out"

    def rows(self, volumes, **more):
        """Two rows for each of some new volumes."""
        made = []
        for number in range(volumes):
            ball = write_volume(self.folder / f"ball{number}.nii.gz", number)
            flipfree.write_image(ball.label_map, self.folder / "truth.nii.gz")
            (x, y, z), radius = ball.seeds[1]
            for organ, part in (("whole", 1.0), ("small", 0.7)):
                made.append({"case": f"ball{number}", "organ": organ, "volume": self.folder / f"ball{number}.nii.gz",
                             "seed_x": x, "seed_y": y, "seed_z": z, "radius": radius * part, **COARSE, **more})
        return made

    def table(self, rows):
        path = self.folder / "table.csv"
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)))
            writer.writeheader()
            writer.writerows(rows)
        return path

    def records(self):
        """The rows that are done, and when."""
        return {path.parent.name: path.stat().st_mtime_ns for path in self.out.glob("rows/*/row.json")
                if json.loads(path.read_text())["status"] == "done"}


WORKERS = 2


@functools.lru_cache(maxsize=None)
def scheduler():
    """The address of one for the whole file, with workers, each minded by a process that starts it again."""
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    address = Path(folder.name) / "scheduler.json"

    def start(module, *arguments):
        process = subprocess.Popen([sys.executable, "-m", f"distributed.cli.{module}", "--scheduler-file", address,
                                    *arguments], cwd=folder.name, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        unittest.addModuleCleanup(process.wait)
        unittest.addModuleCleanup(process.terminate)

    start("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    for _ in range(WORKERS):
        start("dask_worker", "--host", "127.0.0.1", "--nthreads", "1", "--no-dashboard", "--local-directory",
              folder.name)
    found, end = None, time.monotonic() + 120
    while not found and time.monotonic() < end:
        time.sleep(0.1)
        # The scheduler creates its file first, and fills it later.
        with contextlib.suppress(FileNotFoundError, json.JSONDecodeError):
            found = json.loads(address.read_text())["address"]
    if not found:
        raise TimeoutError("the scheduler has written no address")
    with distributed.Client(found, set_as_default=False) as client:
        client.wait_for_workers(WORKERS, timeout=120)
    return found


class SchedulerTest(CohortTest):
    """On a scheduler that exists."""

    @classmethod
    def setUpClass(cls):
        cls.address = scheduler()


class Cluster(SchedulerTest):
    def test_killed_worker(self):
        """Nothing is lost, and nothing that was done is done again."""
        rows = self.rows(4)
        killed = {}

        def kill_the_first():
            while not killed:
                time.sleep(0.01)
                for name in self.records():
                    record = json.loads((self.out / "rows" / name / "row.json").read_text())
                    pid = int(record["worker"].partition(":")[2])
                    if psutil.Process(pid).ppid() != 1:
                        killed.update(pid=pid, done=self.records())
                        os.kill(pid, signal.SIGKILL)
                        return

        killer = threading.Thread(target=kill_the_first, daemon=True)
        killer.start()
        cohort = flipfree.cohort(self.table(rows), self.out, scheduler=self.address)
        killer.join(timeout=10)
        self.assertEqual([row["message"] for row in cohort.failed], [])
        self.assertEqual(len(self.records()), 8)
        before, after = killed["done"], self.records()
        self.assertGreaterEqual(len(before), 1)
        self.assertEqual({name: after[name] for name in before}, before)
        with distributed.Client(self.address, set_as_default=False) as client:
            client.wait_for_workers(WORKERS, timeout=60)
            self.assertNotIn(killed["pid"], client.run(os.getpid).values())

    def test_only_what_has_changed_is_done_again(self):
        rows = self.rows(3)
        first = flipfree.cohort(rows, self.out, scheduler=self.address)
        self.assertEqual((len(first.failed), first.kept), (0, 0))
        before = self.records()
        write_volume(self.folder / "ball0.nii.gz", 99)                # another content
        os.utime(self.folder / "ball1.nii.gz")                        # the same content, another time
        (self.out / "rows" / "ball1-small" / "surface.vtp").unlink()  # a result is gone
        rows[5]["resolution"] = 9                                     # another parameter
        told = []
        again = flipfree.cohort(rows, self.out, scheduler=self.address, progress=told.append)
        after = self.records()
        self.assertEqual(again.kept, 2)
        self.assertEqual({name for name in after if after[name] == before[name]}, {"ball1-whole", "ball2-whole"})
        self.assertEqual((told, told[-1]), (sorted(told), 1.0))
        self.assertEqual(again.rows[2], first.rows[2])
        self.assertNotEqual(again.rows[0]["segmented_ml"], first.rows[0]["segmented_ml"])
        self.assertRegex(str(again), r"^6 rows: 4 segmented, 2 kept, 0 failed; .*report\.html$")
        self.assertEqual(flipfree.cohort(rows, self.out, scheduler="tcp://nobody:1").kept, 6)  # there is nothing to do


class Columns(SchedulerTest):
    """What columns ask for, and what columns say."""

    def test_series(self):
        """The column chooses; a result says what was read, and a series of several volumes is refused."""
        folder = self.folder / "dicom"
        folder.mkdir()
        ball = flipfree.phantom("sphere", **GRID)
        first, second = "1.2.826.0.1.3680043.2.1143.81.1", "1.2.826.0.1.3680043.2.1143.81.2"
        dicom.write_series(folder, ball.image.voxels, ball.image.spacing, ball.image.origin, first, "a")
        dicom.write_series(folder, ball.image.voxels[1:-1] + 300, ball.image.spacing, ball.image.origin, second, "b")
        twice = self.folder / "twice"
        twice.mkdir()
        for rows, prefix in ((-1, "a"), (-2, "b")):
            dicom.write_series(twice, ball.image.voxels[:, :rows], ball.image.spacing, ball.image.origin, first, prefix)
        (x, y, z), radius = ball.seeds[1]
        row = {"volume": folder, "seed_x": x, "seed_y": y, "seed_z": z, "radius": radius, **COARSE}
        rows = [{**row, "organ": "a"}, {**row, "organ": "b", "series": second}, {**row, "organ": "c", "series": "9.9"},
                {**row, "organ": "d", "volume": twice}, {**row, "organ": "e", "volume": twice, "series": first + "#2"}]
        cohort = flipfree.cohort(self.table(rows), self.out, scheduler=self.address)
        self.assertEqual([row["series_read"] for row in cohort.rows], [first, second, None, None, first + "#2"])
        self.assertRegex(cohort.rows[2]["message"], "^row 3, columns volume and series: .*holds no series '9.9'")
        self.assertRegex(cohort.rows[3]["message"], f"^row 4, column volume: .*2 volumes: .*as the series, for instance {first}#1")
        self.assertEqual(len(cohort.failed), 2)
        self.assertEqual(flipfree.cohort(self.table(rows), self.out, scheduler=self.address).kept, 3)
        record = json.loads((self.out / cohort.rows[1]["surface"]).parent.joinpath("row.json").read_text())
        self.assertEqual(record["request"]["series"], second)
        self.assertIn(f'"series":"{second}"'.encode(), (self.out / cohort.rows[1]["surface"]).read_bytes())

    def test_questions(self):
        """Their number, and the place of the first as the columns of points take it."""
        voxels = numpy.frombuffer(lobed_ball.lobed_ball(6), numpy.int16).reshape(lobed_ball.SIZE[::-1])
        flipfree.write_image(flipfree.image_from_array(voxels, lobed_ball.SPACING), self.folder / "lobed.nii.gz")
        x, y, z = lobed_ball.SEED
        row = {"case": "a", "volume": self.folder / "lobed.nii.gz", "seed_x": x, "seed_y": y, "seed_z": z,
               "radius": lobed_ball.RADIUS, "resolution": 16}
        asked = flipfree.cohort([row], self.out, workers=1).rows[0]
        self.assertEqual((asked["status"], asked["questions"]), ("done", 1), asked["message"])
        place = [float(word) for word in asked["first_question"].split()]
        self.assertLess(numpy.abs(numpy.subtract(place, lobed_ball.LOBE)).max(), 8)
        report = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn(f"<dt>questions</dt><dd>1, the first at {asked['first_question']} mm</dd>", report)
        self.assertRegex(report, "(?s)a cohort of 1 row</title>.*<h1>1 row, 0 failed</h1>")
        answered = flipfree.cohort([{**row, "inside": asked["first_question"]}], self.out, workers=1).rows[0]
        self.assertEqual((answered["questions"], answered["first_question"]), (0, None))
        self.assertGreater(answered["segmented_ml"], asked["segmented_ml"] + 20)


class LabelMaps(SchedulerTest):
    """Rows with a label map get the surfaces of its labels."""

    NAMES = {1: "liver", 2: "spleen", 3: "stomach"}
    FILES = ["1-liver.stl", "2-spleen.stl", "3-stomach.stl", "row.json", "surfaces.csv"]

    def write(self, labels):
        voxels = numpy.zeros((20, 24, 24), numpy.uint8)
        for label in labels:
            voxels[4 * label:4 * label + 4, 6:18, 6:18] = label
        image = flipfree.image_from_array(voxels, spacing=(1, 1, 2))
        flipfree.write_image(image, self.folder / "labels.seg.nrrd", names={label: self.NAMES[label] for label in labels})
        return image

    def run_rows(self, *rows):
        rows = [{"label_map": self.folder / "labels.seg.nrrd", "case": "a", "organ": "", **row} for row in rows]
        return flipfree.cohort(rows, self.out, scheduler=self.address).rows

    def files(self):
        return sorted(path.name for path in (self.out / "rows" / "a").iterdir())

    def test_surfaces(self):
        """Beside organs, in one table."""
        image = self.write([1, 2, 3])
        organs = self.rows(1)
        rows = self.run_rows({"exact": True}, *({"label_map": "", **organ} for organ in organs))
        self.assertEqual([(row["status"], row["message"]) for row in rows], 3 * [("done", "")])
        self.assertEqual([bool(row["surfaces"]) for row in rows], [True, False, False])
        self.assertEqual(self.files(), self.FILES)
        found = flipfree.surfaces(image, exact=True)
        self.assertAlmostEqual(rows[0]["segmented_ml"], sum(one.volume for one in found.labels.values()), 2)
        self.assertEqual((rows[0]["confidence"], rows[0]["picture"], rows[0]["surfaces"]),
                         (None, None, "rows/a/surfaces.csv"))
        with open(self.out / rows[0]["surfaces"], newline="", encoding="utf-8") as file:
            table = list(csv.DictReader(file))
        self.assertEqual([(row["Name"], row["File"], row["WrongVoxels"]) for row in table],
                         [(name, f"{label}-{name}.stl", "0") for label, name in self.NAMES.items()])
        self.assertIn(f"<dd>{rows[0]['segmented_ml']:.1f} ml</dd>", (self.out / "report.html").read_text())
        names = re.findall(r"<h2>[0-9]+\. (.*)</h2>", (self.out / "report.html").read_text())
        self.assertEqual(names[-1], "a")  # it has no confidence

    def test_what_is_done_is_kept(self):
        """Until its file or a result is another; what is gone from the label map loses its file."""
        self.write([1, 2, 3])
        self.run_rows({"exact": True})
        before = self.records()
        self.run_rows({"exact": True})
        self.assertEqual(self.records(), before)
        (self.out / "rows" / "a" / "3-stomach.stl").unlink()
        self.run_rows({"exact": True})
        self.assertNotEqual(self.records(), before)
        self.assertEqual(self.files(), self.FILES)
        self.write([])
        self.assertEqual(self.run_rows({"exact": True})[0]["status"], "failed")
        self.write([2])
        self.run_rows({"exact": True})
        self.assertEqual(self.files(), ["2-spleen.stl", "row.json", "surfaces.csv"])
        [organ, _] = self.rows(1)
        self.run_rows({"label_map": "", **organ, "case": "a", "organ": ""})
        self.assertEqual(self.files(), ["labels.nii.gz", "picture.jpg", "row.json", "surface.vtp"])

    def test_other_tables_may_have_columns_of_such_names(self):
        [organ, _] = self.rows(1)
        cohort = flipfree.cohort([{**organ, "exact": "as drawn", "Distance": "2,5"}], self.out, scheduler=self.address)
        self.assertEqual((cohort.failed, cohort.rows[0]["exact"], cohort.rows[0]["Distance"]), ([], "as drawn", "2,5"))

    def test_bad_rows(self):
        self.write([])
        for more, message in (
                ({}, r"^row 1, column label_map: .*no labels"),
                ({"exact": True}, r"^row 1, column label_map: .*no labels"),
                ({"label_map": self.folder / "none.seg.nrrd"}, r"^row 1, column label_map: .*none"),
                ({"volume": "ct.nii.gz"}, r"^row 1, column volume: a row with a label map .*empty this cell"),
                ({"seed_x": 1}, r"^row 1, column seed_x: a row with a label map "),
                ({"levels": 2}, r"^row 1, column levels: a label map has no such parameter; empty the cell$"),
                ({"edge_length": "long"}, r"^row 1, column edge_length: a number is needed, not 'long'$"),
                ({"edge_length": -1}, r"^row 1, column edge_length: ")):
            with self.subTest(more):
                [row] = self.run_rows(more)
                self.assertEqual((row["status"], row["surfaces"]), ("failed", None))
                self.assertRegex(row["message"], message)


class Local(CohortTest):
    def test_command(self):
        """Workers of its own; each kind of row that fails; all the files there are."""
        good = self.rows(1, reference="truth.nii.gz", reference_label=1, comment="kept, as it is")
        bad = {
            "gone": ({"volume": "gone.nii.gz"}, r"^row 3, column volume: '.*gone\.nii\.gz' does not exist"),
            "text": ({"volume": "table.csv"}, r"^row 4, column volume: The format of '.*table\.csv' is unknown"),
            "away": ({"seed_x": 900}, r"^row 5, columns seed_x, seed_y, seed_z and radius: No segmentation: the seed's center \(900, .*lies outside"),
            "word": ({"radius": "big"}, "radius: a number is needed, not 'big'"),
            "none": ({"seed_y": ""}, "seed_y: the cell is empty"),
            "many": ({"levels": 99}, "^row 8, column levels: 99 is out of range"),
            "half": ({"levels": 1.5}, "levels: a whole number is needed, not '1.5'"),
            "odd": ({"preset": "fast"}, "preset: 'fast' does not exist"),
            "label": ({"reference_label": 7}, r"^row 11, columns reference and reference_label: .*\b7\b"),
        }
        rows = [*good, *({**good[0], "organ": name, **change} for name, (change, _) in bad.items())]
        process = subprocess.run([COMMAND, "cohort", self.table(rows), "-o", self.out, "--workers", "1"],
                                 capture_output=True, text=True, timeout=300, check=False)
        self.assertRegex(process.stdout, r"\A11 rows: 2 segmented, 0 kept, 9 failed; \d+\.\d s; see .*report\.html\n\Z")
        self.assertRegex(process.stderr, r"\Aflipfree: error: row 3: column volume: '.*gone\.nii\.gz' does not exist.*\n"
                         r"flipfree: error: row 4: column volume: The format of .*\n"
                         r"flipfree: error: row 5: columns seed_x, seed_y, seed_z and radius: No segmentation: .*\n"
                         r"flipfree: error: 9 of 11 rows failed\. Their messages are in .*csv'.*\.\n\Z")
        self.assertEqual(process.returncode, 1)
        found = list(csv.DictReader((self.out / "cohort.csv").read_text(encoding="utf-8").splitlines()))
        self.assertEqual([row["status"] for row in found], ["done"] * 2 + ["failed"] * 9)
        for row, (name, (_, message)) in zip(found[2:], bad.items()):
            with self.subTest(name):
                self.assertRegex(row["message"], message)
        self.check_files(found, good)
        self.check_report(found)

    def test_the_table_is_not_overwritten(self):
        self.out.mkdir(parents=True, exist_ok=True)
        table = self.out / "cohort.csv"
        table.write_text("volume\n", encoding="utf-8")
        process = subprocess.run([COMMAND, "cohort", table, "-o", self.out], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(process.returncode, 2)
        self.assertRegex(process.stderr, r"\Aflipfree: error: '.*cohort\.csv' is an input, which would be overwritten.*\n\Z")
        self.assertEqual(table.read_text(encoding="utf-8"), "volume\n")

    def check_files(self, found, good):
        """A row's surface and label map are those of segment()."""
        ball = flipfree.read_image(good[0]["volume"])
        seed = [good[0][name] for name in ("seed_x", "seed_y", "seed_z")]
        organ = flipfree.segment(ball, seed, good[0]["radius"], **COARSE)
        labels = flipfree.read_image(self.out / found[0]["labels"])
        numpy.testing.assert_array_equal(labels.voxels, organ.labels)
        scores = flipfree.evaluate(organ, self.folder / "truth.nii.gz", reference_label=1)
        self.assertAlmostEqual(float(found[0]["dice"]), scores.dice, places=5)
        self.assertAlmostEqual(float(found[0]["asd_mm"]), scores.asd, places=3)
        self.assertAlmostEqual(float(found[0]["segmented_ml"]), organ.volume, places=2)
        self.assertTrue((self.out / found[0]["surface"]).read_bytes().startswith(b"<?xml"))
        self.assertGreater(float(found[0]["confidence"]), 0.9)
        self.assertEqual(found[0]["comment"], "kept, as it is")
        table = pyarrow.parquet.read_table(self.out / "cohort.parquet").to_pylist()
        self.assertEqual([row["status"] for row in table], [row["status"] for row in found])
        self.assertEqual(table[0]["dice"], float(found[0]["dice"]))
        self.assertIsNone(table[2]["dice"])

    def check_report(self, found):
        """Failed rows come first, messages are text, and pictures are in the file."""
        report = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertEqual(report.count("<article"), 11)
        self.assertRegex(report, "(?s)a cohort of 11 rows</title>.*<h1>11 rows, 9 failed</h1>")
        self.assertEqual(len(re.findall(r'src="data:image/jpeg;base64,[\w+/=]{10000,}"', report)), 2)
        kinds = re.findall(r'<article class="(\w+)"', report)
        self.assertEqual(kinds, ["failed"] * 9 + ["done"] * 2)
        values = [float(value) for value in re.findall(r"<dt>confidence</dt><dd>(.*?)</dd>", report)]
        self.assertEqual(values, sorted(values))
        self.assertIn(f"Dice</dt><dd>{float(found[0]['dice']):.3f}", report)
        self.assertIn("not &#x27;big&#x27;", report)
        self.assertNotIn("http", report)

    def test_a_volume_is_read_once(self):
        rows = [_cohort_table._row({key: str(value) for key, value in row.items()}, "")
                for row in self.rows(1)]
        with mock.patch.object(_cohort_work, "read_image", wraps=flipfree.read_image) as read:
            records = _cohort_work.segment_rows(rows, str(self.out), 1)
        self.assertEqual([record["status"] for record in records], ["done", "done"])
        self.assertEqual(read.call_count, 1)

    def test_workers_fit_the_memory(self):
        memory = mock.Mock(available=4e9)
        with mock.patch.object(psutil, "virtual_memory", return_value=memory), \
             mock.patch.object(os, "cpu_count", return_value=16):
            self.assertEqual(_cluster.workers_for(1, 1e6, 100), 9)
            self.assertEqual(_cluster.workers_for(4, 1e6, 100), 4)
            self.assertEqual(_cluster.workers_for(1, 1e6, 2), 2)
            self.assertEqual(_cluster.workers_for(1, 512 * 512 * 275, 100), 1)


class Points(SchedulerTest):
    """Rows between points, and rows that points correct."""

    ENDS = [(13.3, 44.6, 44.5), (82.0, 50.4, 37.6)]

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.inputs = Path(folder.name)
        tube = flipfree.phantom("vessel")
        flipfree.write_image(tube.image, cls.inputs / "tube.nii.gz")
        flipfree.write_image(tube.label_map, cls.inputs / "tube-truth.nii.gz")
        cls.ball = write_volume(cls.inputs / "ball.nii.gz", 0)

    def organ(self, name, **more):
        (x, y, z), radius = self.ball.seeds[1]
        return {"case": name, "volume": self.inputs / "ball.nii.gz", "seed_x": x, "seed_y": y, "seed_z": z,
                "radius": radius, **COARSE, **more}

    def vessel(self, name, points, **more):
        return {"case": name, "volume": self.inputs / "tube.nii.gz", "points": points, **more}

    def around(self, *offsets):
        """Points at distances from the ball's center."""
        return [tuple(a + b for a, b in zip(self.ball.seeds[1][0], offset)) for offset in offsets]

    def done(self, rows):
        result = flipfree.cohort(rows, self.out, scheduler=self.address)
        self.assertEqual([row["message"] for row in result.failed], [])
        return result

    def labels(self, name):
        return flipfree.read_image(self.out / "rows" / name / "labels.nii.gz").voxels

    def test_vessels_and_corrected_organs(self):
        """The results are those of trace() and segment(), however the points are given."""
        (self.folder / "ends.csv").write_text("x,y,z\n13.3,44.6,44.5\n82,50.4,37.6\n")
        controls = [{"label": f"P-{i}", "position": [-x, -y, z]} for i, (x, y, z) in enumerate(self.ENDS)]
        (self.folder / "ends.mrk.json").write_text(
            json.dumps({"markups": [{"coordinateSystem": "RAS", "controlPoints": controls}]}))
        inside, outside, boundary = self.around((0, 2, 0), (11, 0, 0), (0, 0, 14))
        (self.folder / "points.csv").write_text("kind,x,y,z\n" + "".join(
            f"{kind},{','.join(map(repr, place))}\n" for kind, place in (("inside", inside), ("outside", outside))))
        text = "; ".join(" ".join(map(repr, point)) for point in self.ENDS)
        vessels = [
            self.vessel("list", self.ENDS, reference=self.inputs / "tube-truth.nii.gz"),
            self.vessel("text", text), self.vessel("printed", str(self.ENDS)), self.vessel("array", numpy.array(self.ENDS)),
            self.vessel("file", self.folder / "ends.csv"), self.vessel("markups", self.folder / "ends.mrk.json"),
            self.vessel("thick", self.ENDS, wall_thickness=1.5, radius=4),
        ]
        organs = [
            self.organ("free"),
            self.organ("cells", inside=[inside], outside=outside, boundary=" ".join(map(repr, boundary))),
            self.organ("corrected", corrections=self.folder / "points.csv", boundary=[boundary]),
        ]
        result = self.done(vessels + organs)
        vessel = flipfree.trace(self.inputs / "tube.nii.gz", self.ENDS)
        for row in vessels[:6]:
            numpy.testing.assert_array_equal(self.labels(row["case"]), vessel.labels)
        thick = flipfree.trace(self.inputs / "tube.nii.gz", self.ENDS, wall_thickness=1.5, radius=4)
        numpy.testing.assert_array_equal(self.labels("thick"), thick.labels)
        (x, y, z), radius = self.ball.seeds[1]
        organ = flipfree.segment(self.inputs / "ball.nii.gz", (x, y, z), radius, inside=[inside], outside=[outside],
                                 boundary=[boundary], **COARSE)
        for name in ("cells", "corrected"):
            numpy.testing.assert_array_equal(self.labels(name), organ.labels)
        self.assertTrue((self.labels("free") != organ.labels).any())
        first = result.rows[0]
        self.assertEqual(first["centerline"], "rows/list/centerline.vtp")
        self.assertIn(b"ArcLength", (self.out / first["centerline"]).read_bytes())
        self.assertGreater(first["dice"], 0.9)
        self.assertEqual((first["confidence"], result.rows[7]["centerline"]), (None, None))
        report = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertEqual(report.count('<article class="done"'), 10)

    def test_done_rows_are_known_by_their_points(self):
        (ends, points) = (self.folder / "ends.csv", self.folder / "points.csv")
        ends.write_text("13.3,44.6,44.5\n82,50.4,37.6\n")
        points.write_text("inside,{},{},{}\n".format(*self.around((0, 2, 0))[0]))
        rows = [self.vessel("file", ends, levels=1), self.vessel("list", self.ENDS, levels=1),
                self.organ("file-organ", corrections=points), self.organ("cells", outside=self.around((17, 0, 0)))]
        self.assertEqual(self.done(rows).kept, 0)
        self.assertEqual(self.done(rows).kept, 4)
        for path in (ends, points):  # the same content, another time
            os.utime(path, (1, 1))
        self.assertEqual(self.done(rows).kept, 4)
        changes = {
            "file": lambda: ends.write_text("13.3,44.6,44.5\n82,50.4,37.5\n"),
            "list": lambda: rows[1].update(points=[*self.ENDS[:1], (82.0, 50.4, 37.5)]),
            "file-organ": lambda: points.write_text("inside,{},{},{}\n".format(*self.around((0, 3, 0))[0])),
            "cells": lambda: rows[3].update(outside=self.around((17, 1, 0))),
        }
        for name, change in changes.items():
            before = self.records()
            change()
            self.assertEqual(self.done(rows).kept, 3)
            after = self.records()
            self.assertEqual({one for one in after if after[one] != before[one]}, {name})
        for column in ("outside", "corrections"):
            for row in rows:
                row.pop(column, None)
            self.assertEqual(self.done(rows).kept, 3, column)

    def test_bad_entries_name_row_column_and_remedy(self):
        (self.folder / "bad.csv").write_text("x,y,z\n1,2,3mm\n")
        (self.folder / "one.csv").write_text("1,2,3\n")
        (self.folder / "kind.csv").write_text("above,1,2,3\n")
        bad = {
            "column points: 'somewhere' is not a list of points; give x y z of each.*or a file of points": self.vessel("a", "somewhere"),
            "column points: '1 2; 3 4 5' is not a list": self.vessel("b", "1 2; 3 4 5"),
            "column points: '1 2 nan; 3 4 5' is not a list": self.vessel("c", "1 2 nan; 3 4 5"),
            "column points: a vessel needs at least two points, not 1; give": self.vessel("d", [(1, 2, 3)]),
            r"column points: '.*bad.csv', line 2: '3mm' is not a number\. Correct the file": self.vessel("e", self.folder / "bad.csv"),
            "column points: '.*one.csv' holds 1 points, and a vessel needs": self.vessel("f", self.folder / "one.csv"),
            "column points: There is no file '.*gone.mrk.json'. Check": self.vessel("g", self.folder / "gone.mrk.json"),
            "column seed_x: a row with points is a vessel, which has none; empty": self.vessel("h", self.ENDS, seed_x=1),
            "column inside: a row with points is a vessel, which has none; empty": self.vessel("i", self.ENDS, inside="1 2 3"),
            "column resolution: a vessel has no such parameter; empty": self.vessel("j", self.ENDS, resolution=8),
            "column wall_thickness: an organ has no such parameter; empty": self.organ("k", wall_thickness=1),
            "column seed_x: the cell is empty; a row needs a seed, or points": {"case": "l", "volume": "a.nii"},
            "column inside: '1 2' is not a list of points.*corrections takes a file": self.organ("m", inside="1 2"),
            "column outside: '.*' is not a list of points": self.organ("n", outside="[(1, 2, 3)] and (4, 5, 6)"),
            "column corrections: a file of points .* is needed, not '1 2 3'": self.organ("o", corrections="1 2 3"),
            "column corrections: '.*kind.csv', line 1: the kind is 'above'.*Correct": self.organ("p", corrections=self.folder / "kind.csv"),
            r"the inside point \(900, 0, 0\) mm lies outside": self.organ("q", inside="900 0 0"),
            r"\(900, 0, 0\) mm lies outside": self.vessel("r", "900 0 0; 1 2 3"),
            "levels: 9 is out of range": self.vessel("s", self.ENDS, levels=9),
            "column radius: a number is needed, not 'big'": self.vessel("t", self.ENDS, radius="big"),
        }
        result = flipfree.cohort(list(bad.values()), self.out, workers=1)
        self.assertEqual(len(result.failed), len(bad))
        for number, (row, message) in enumerate(zip(result.rows, bad), 1):
            with self.subTest(message):
                place = f"^row {number}, " if message.startswith("column") else ""
                self.assertRegex(row["message"], place + message)


class WrongInput(CohortTest):
    ROW = {"volume": "a.nii", "seed_x": 1, "seed_y": 2, "seed_z": 3, "radius": 4}

    def refuses(self, message, table, output=None, **options):
        with self.assertRaisesRegex(flipfree.FlipFreeError, message):
            flipfree.cohort(table, output or self.out, **options)
        self.assertFalse(self.out.exists() and any(self.out.glob("*.*")))

    def test_workers_and_threads_are_checked_first(self):
        """Before the table is read, and each by its own name."""
        for name, number, least in (("workers", -1, 0), ("threads", 0, 1), ("threads", -3, 1)):
            with self.subTest(name, number=number):
                with self.assertRaisesRegex(ValueError, f"^{name}: {number} is out of range; the least value is {least}$"):
                    flipfree.cohort("nowhere.csv", self.out, **{name: number})
                self.assertFalse(self.out.exists())

    def test_tables(self):
        for message, table in (
                ("'table' lacks the columns volume, seed_x.* Vessels have points in their place", [{"radius": 3}]),
                ("'table' lacks the column volume; it has points.$", [{"points": "1 2 3; 4 5 6"}]),
                ("'table' lacks the column radius; it has", [{name: 1 for name in self.ROW if name != "radius"}]),
                ("'levles' is nearly 'levels'", [{**self.ROW, "levles": 2}]),
                ("'levals' is nearly 'levels'", [{**self.ROW, "levals": 2}]),
                ("'serie' is nearly 'series'", [{**self.ROW, "serie": "1.2"}]),
                ("'correction' is nearly 'corrections'", [{**self.ROW, "correction": "a.csv"}]),
                ("rows 1 and 2 are all called", [{"volume": "a.nii", "points": "1 2 3; 4 5 6"}] * 2),
                ("has the name of a result", [{**self.ROW, "Dice": 1}]),
                ("there are two columns 'volume'", [{**self.ROW, "Volume": "b"}]),
                ("has the name of a result", [{**self.ROW, "dice": 1}]),
                ("'resolutoin' is nearly 'resolution'", [{**self.ROW, "resolutoin": 1}]),
                ("rows 2, 3 and 4 are all called 'a-b'. Give each", [
                    {**self.ROW, "case": "c"}, *[{**self.ROW, "case": "a", "organ": name} for name in ("b", "B", "b")]]),
                ("has no rows|lacks", []),
        ):
            with self.subTest(message):
                self.refuses(message, table)

    def test_files(self):
        path = self.folder / "table.csv"
        self.refuses("There is no file '.*table.csv'. Check the name", path)
        head = ",".join(self.ROW)
        for message, data in (
                ("is not UTF-8 text", b"\xff\xfe\x00v"),
                ("'.*' lacks the columns", b""),
                ("has no rows", head.encode()),
                ("row 2 has more cells", f"{head}\na,1,2,3,4\n\na,1,2,3,4,5\n".encode()),
                ("row 1 has more cells", f"{head},\na,1,2,3,4,5\n".encode()),
                ("row 1 has more cells", f"{head}\na,1,5,2,3,4\n".encode()),
                ("there are two columns 'radius'", f"{head},radius\n".encode()),
                ("lacks the columns.*Separate cells by commas, semicolons or tabs", head.replace(",", "|").encode()),
                (r"decimal point \(3.5\), and others a comma \(1,234\)",
                 f"{head}\na,'1,234',2,3.5,4\n".replace(",", ";").replace("'1;234'", "1,234").encode()),
        ):
            with self.subTest(message):
                path.write_bytes(data)
                self.refuses(message, path)

    def test_forms_of_files(self):
        """As spreadsheet programs write them: all hold the same rows."""
        plain = ("volume,seed_x,seed_y,seed_z,radius,inside,case,note\n"
                 "a.nii,1.5,-2,3,4,1.5 2 3; 4 5 6,a,x\n"
                 "b.nii,.5,2e1,3,4.25,,b,\"1,5\"\n")
        quoted = plain.replace("1.5 2 3; 4 5 6", '"1.5 2 3; 4 5 6"')
        semicolons = quoted.replace('"1,5"', "1~5").replace(",", ";").replace("1~5", "1,5")
        commas = semicolons.replace("1.5", "1,5").replace(".5", ",5").replace("4.25", "4,25")
        path = self.folder / "table.csv"
        path.write_text(plain)
        expected = _cohort_table.rows_of(path)
        self.assertEqual([row.problem for row in expected], ["", ""])
        self.assertEqual(expected[0].points, {"inside": [(1.5, 2, 3), (4, 5, 6)]})
        for name, text in {
            "mark": "\ufeff" + plain,
            "windows": plain.replace("\n", "\r\n"),
            "capitals": plain.replace("volume", "Volume").replace("seed_x", "SEED_X").replace("case", "Case"),
            "spaces": plain.replace("seed_y", " seed_y "),
            "empty rows": plain.replace("\n", "\n,,,,,,,\n\n") + ",\n  \n",
            "empty columns": plain.replace("\n", ",,\n").replace("radius,", "radius,,").replace(",4,", ",4,,").replace("4.25,", "4.25,,"),
            "sep": "sep=,\r\n" + plain,
            "semicolons": semicolons,
            "decimal commas": commas,
            "sep and decimal commas": "SEP=;\n" + commas,
            "tabs": semicolons.replace("1.5 2 3; 4", "1.5 2 3~ 4").replace(";", "\t").replace("~", ";"),
            "bars": "sep=|\n" + semicolons.replace("1.5 2 3; 4", "1.5 2 3~ 4").replace(";", "|").replace("~", ";"),
        }.items():
            with self.subTest(name):
                path.write_bytes(text.encode())
                self.assertEqual(_cohort_table.rows_of(path), expected)

    def test_forms_of_records(self):
        expected = _cohort_table.rows_of([self.ROW])
        for row in ({name.upper(): value for name, value in self.ROW.items()}, {**self.ROW, "": "", "Unnamed: 6": float("nan")}):
            with self.subTest(row):
                self.assertEqual(_cohort_table.rows_of([{}, row, {"volume": float("nan")}]), expected)

    def test_folder(self):
        path = self.folder / "file"
        path.write_text("")
        self.refuses("is not a folder. Choose another name.", [self.ROW], path)

    def test_scheduler_that_does_not_answer(self):
        with mock.patch.object(_cluster, "PATIENCE", 1.0):
            for address in ("tcp://127.0.0.1:9", "127.0.0.1:99999", "what://is.this"):
                self.refuses(f"^scheduler: no Dask scheduler answers at '{address}'.*dask scheduler",
                             [self.ROW], scheduler=address)

    def test_missing_extra(self):
        for module in ("distributed", "pyarrow", "matplotlib"):
            with self.subTest(module), mock.patch.dict(sys.modules, {module: None}):
                self.refuses(f"a cohort needs {module}, which is not installed: pip install '.\\[cohort\\]' in FlipFree's source "
                             "folder, or pip install .*dask distributed pyarrow$",
                             [self.ROW])


if __name__ == "__main__":
    unittest.main()
