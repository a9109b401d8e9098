"""What only the package without VTK has: threads of its own, and signals and forks among them."""

import importlib.metadata
import os
import re
import signal
import subprocess
import sys
import threading
import time
import unittest
from pathlib import Path

import flipfree
import numpy
from example import RADIUS, SEED, SPACING, coarse_liver, image, liver, truth
from flipfree._backend import SCORE_COLUMNS

ENDLESS = {"maximum_iterations": 100000, "change_tolerance": -1, "distance_tolerance": 0}


class Import(unittest.TestCase):
    def test_needs_numpy_alone(self):
        program = ("import sys; import flipfree; "
                   "print(sorted({name.partition('.')[0] for name in sys.modules} & "
                   "{'vtkmodules', 'vtk', 'SimpleITK', 'numpy'}))")
        output = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
        self.assertIn(output.stdout.strip(), ("[]", "['numpy']"))

    def test_takes_less_than_numpy(self):
        def seconds(module):
            program = f"import time; start = time.process_time(); import {module}; print(time.process_time() - start)"
            return min(float(subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                                            check=True).stdout) for _ in range(5))
        self.assertLess(seconds("flipfree"), seconds("numpy"))

    def test_package_is_small(self):
        folder = Path(flipfree.__file__).parent
        files = [path for path in folder.iterdir() if path.is_file()]
        module = next(path for path in files if path.suffix == ".so")
        limit = 5e6 if b"libstdc++.so" in module.read_bytes() else 6e6  # a release's wheel has a libstdc++ in it
        self.assertLess(sum(path.stat().st_size for path in files), limit)

    def test_scores_are_the_kernels(self):
        scores = flipfree.evaluate(liver().label_map, truth(), reference_label=6)
        self.assertEqual(list(vars(scores)), list(SCORE_COLUMNS))
        self.assertEqual(SCORE_COLUMNS["asd"], ("ASD", "mm"))
        self.assertEqual(SCORE_COLUMNS["overlap_of"], ("OverlapOf", ""))


class Threads(unittest.TestCase):
    def setUp(self):
        self.addCleanup(flipfree.set_threads, 0)

    def test_any_number_gives_the_same_bits(self):
        scores = flipfree.evaluate(liver(), truth(), reference_label=6)
        for number in (1, 2, 3, 7):
            flipfree.set_threads(number)
            self.assertEqual(flipfree.threads(), number)
            again = flipfree.segment(image(), SEED, RADIUS)
            numpy.testing.assert_array_equal(again.points, liver().points)
            numpy.testing.assert_array_equal(again.labels, liver().labels)
            self.assertEqual(flipfree.evaluate(again, truth(), reference_label=6), scores)

    @unittest.skipUnless(sys.platform == "linux", "limits threads as Linux does")
    def test_where_the_system_starts_no_more_of_them(self):
        """As in a container that limits processes; root is not limited, so that it becomes somebody else."""
        program = """
import os, resource, sys
import flipfree
volume = flipfree.phantom("sphere", dimensions=(48, 48, 48)).image
def points():
    return flipfree.segment(volume, (23.5, 23.5, 23.5), 6, resolution=8).points.tobytes()
flipfree.set_threads(1)
expected = points()
limit = int(sys.argv[1])
resource.setrlimit(resource.RLIMIT_NPROC, (limit, limit))
if os.getuid() == 0:
    os.setuid(65534)
flipfree.set_threads(8)
print([points() == expected for _ in range(3)])
"""
        for limit in (1, 3):
            process = subprocess.run([sys.executable, "-c", program, str(limit)], capture_output=True, text=True,
                                     timeout=200, check=False)
            with self.subTest(limit):
                self.assertEqual((process.returncode, process.stdout), (0, "[True, True, True]\n"), process.stderr)

    def test_number_is_checked(self):
        with self.assertRaisesRegex(ValueError, "^number: -1 is negative"):
            flipfree.set_threads(-1)

    def test_several_callers_at_once(self):
        flipfree.set_threads(3)
        coarse = coarse_liver()
        results = []
        threads = [threading.Thread(
            target=lambda: results.append(flipfree.segment(image(), SEED, RADIUS, resolution=8)))
            for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(results), 4)
        for result in results:
            numpy.testing.assert_array_equal(result.points, coarse.points)

    def test_other_threads_of_python_go_on(self):
        counted = []
        done = threading.Event()

        def count():
            while not done.is_set():
                counted.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        flipfree.segment(image(), SEED, RADIUS)
        done.set()
        thread.join()
        self.assertGreater(len(counted), 20)

    @unittest.skipUnless(hasattr(os, "fork"), "no fork here")
    def test_a_forked_process_has_threads_again(self):
        flipfree.set_threads(2)
        coarse = flipfree.segment(image(), SEED, RADIUS, resolution=8)
        child = os.fork()
        if child == 0:
            same = flipfree.segment(image(), SEED, RADIUS, resolution=8)
            os._exit(0 if numpy.array_equal(same.points, coarse.points) else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)


class CtrlC(unittest.TestCase):
    def test_is_heeded_within_a_tenth_of_a_second(self):
        """At moments over the first level and the later ones; the machine may be busy, so half of them count."""
        volume = image()
        seconds = []
        for delay in (0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8):
            sent = []

            def interrupt(sent=sent, delay=delay):
                time.sleep(delay)
                sent.append(time.monotonic())
                os.kill(os.getpid(), signal.SIGINT)

            thread = threading.Thread(target=interrupt)
            thread.start()
            with self.assertRaises(KeyboardInterrupt):
                flipfree.segment(volume, SEED, RADIUS, **ENDLESS)
            seconds.append(time.monotonic() - sent[0])
            thread.join()
        print("seconds until Ctrl-C:", *(f"{second:.3f}" for second in sorted(seconds)))
        self.assertLess(sorted(seconds)[len(seconds) // 2], 0.1)


class Voxels(unittest.TestCase):
    def test_types_and_layouts(self):
        array = flipfree.array_from_image(image())
        expected = flipfree.segment(array, SEED, RADIUS, spacing=SPACING, resolution=8).points
        for voxels in (array.astype("int32"), array.astype("int64"), array.astype("float32"),
                       array.astype("float64"), array.astype(">i2"), numpy.asfortranarray(array),
                       array[::1, ::-1][:, ::-1]):
            with self.subTest(dtype=voxels.dtype, strides=voxels.strides):
                organ = flipfree.segment(voxels, SEED, RADIUS, spacing=SPACING, resolution=8)
                numpy.testing.assert_array_equal(organ.points, expected)

    def test_improper_grids(self):
        array = flipfree.array_from_image(image())
        for geometry, message in (({"spacing": (1, 0, 1)}, "^No segmentation: the image has a spacing of"),
                                  ({"spacing": (1, 1, 1), "direction": numpy.zeros((3, 3))},
                                   "direction matrix that cannot be inverted")):
            with self.subTest(message), self.assertRaisesRegex(flipfree.SegmentationError, message):
                flipfree.segment(array, SEED, RADIUS, **geometry)


class Guide(unittest.TestCase):
    def test_python_without_vtk(self):
        source = Path(os.environ["FLIPFREE_PYTHON_SOURCE"]).parents[1]
        page = (source / "Examples" / "Guide" / "python.md").read_text(encoding="utf-8")
        section = page.partition("\n## Without VTK\n")[2].partition("\n## ")[0]
        [program] = re.findall("```python\n(.*?)```", section, re.DOTALL)
        output = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
        self.assertRegex(output, r"\Aconverged \(6144, 3\) \d+ voxels\n0\.94\d+\n\Z")


class Surface(unittest.TestCase):
    def test_vtks_needs_vtk(self):
        try:
            import vtkmodules  # pylint: disable=unused-import
        except ImportError:
            with self.assertRaisesRegex(flipfree.FlipFreeError, r"^surface: .*\.points, \.faces"):
                liver().surface
        else:
            self.assertEqual(liver().surface.GetNumberOfPoints(), 6144)
            self.assertEqual(liver().surface.GetNumberOfPolys(), 6146)


class Metadata(unittest.TestCase):
    def test_version_and_licenses(self):
        distribution = importlib.metadata.distribution("flipfree")
        self.assertEqual(distribution.version, flipfree.__version__)
        names = sorted(Path(name).name for name in distribution.metadata.get_all("License-File"))
        self.assertEqual(names, ["LICENSE", "cli11.txt", "eigen.txt", "nanobind.txt", "nlohmann_json.txt", "robin_map.txt"])


if __name__ == "__main__":
    unittest.main()
