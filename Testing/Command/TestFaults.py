"""Full disks, folders that vanish, and kill -9: every file is the former one or the new one, whole.

As a test it takes a few moments of each kind. `TestFaults.py --table 200` takes 200 and all formats, and prints a table.
"""

import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

import command

SURFACES = (".vtp", ".stl", ".ply", ".obj")
VOLUMES = (".nii", ".nii.gz", ".nrrd", ".mha")
QUICK = ("--levels", 1, "--iterations", 3)
FORMER = ("--resolution", 6, "--label-value", 1)
NEW = ("--resolution", 8, "--label-value", 2)


def limit_file_size(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def contents(folder):
    """Of the files by their names; what a killed process leaves is in a folder of its own."""
    found = {}
    for name in os.listdir(folder):
        if not name.startswith(".flipfree-"):
            with open(os.path.join(folder, name), "rb") as file:
                found[name] = file.read()
    return found


class Faults(command.CommandTest):
    display = []

    def options(self, surface, volume):
        """Writes a file of each kind."""
        options = ["-o", self.result("out" + surface), "--labels", self.result("out" + volume),
                   "--convergence", self.result("out.csv")]
        return options + (["--snapshot", self.result("out.png")] if self.display else [])

    def start(self, *arguments, **options):
        return subprocess.Popen([*self.display, command.PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                env=command.without_leak_check(), **options)

    def segment(self, *arguments, **options):
        return self.start("segment", self.volume, *self.seed, *QUICK, *arguments, **options)

    def results_of(self, files, options):
        """What a run leaves; its times differ from run to run, so that tables are compared by their iterations."""
        process = self.segment(*files, *options)
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, errors)
        return contents(self.results)

    def versions(self, surface, volume):
        self.restore({})
        files = self.options(surface, volume)
        new = self.results_of(files, NEW)
        former = self.results_of(files, FORMER)
        for name in former:
            self.assertTrue(former[name] != new[name], name)
        return files, former, new

    def restore(self, former):
        shutil.rmtree(self.results)
        os.mkdir(self.results)
        for name, data in former.items():
            with open(self.result(name), "wb") as file:
                file.write(data)

    def is_whole(self, name, data, version):
        if not name.endswith(".csv"):
            return data == version
        # The seconds of a run are its own.
        return ([line.split(b",")[0] for line in data.splitlines()] ==
                [line.split(b",")[0] for line in version.splitlines()] and data.endswith(b"\n"))

    def assert_whole(self, former, new):
        """Gives how many files are new, of those that tell: tables of both runs have the same iterations."""
        found = contents(self.results)
        self.assertEqual(set(found), set(former))
        count = 0
        for name, data in found.items():
            is_new = self.is_whole(name, data, new[name])
            self.assertTrue(is_new or self.is_whole(name, data, former[name]), f"{name} is neither")
            count += is_new and not name.endswith(".csv")
        return count

    def fill_disk(self, surface, volume, limits):
        """The greatest size of a file, from nothing to all that is written."""
        _, former, new = self.versions(surface, volume)
        options = {"out" + surface: ("-o", self.result("out" + surface)),
                   "out" + volume: ("--labels", self.result("out" + volume)),
                   "out.csv": ("--convergence", self.result("out.csv"))}
        if self.display:
            options["out.png"] = ("--snapshot", self.result("out.png"))
        counts = {}
        for name, option in options.items():
            sizes = range(0, len(new[name]), max(1, len(new[name]) // limits))
            for size in sorted({*sizes, 1, len(new[name]) - 1}):
                self.restore(former)
                process = self.segment(*option, *NEW, preexec_fn=limit_file_size(size))
                _, errors = process.communicate(timeout=120)
                with self.subTest(name=name, size=size, errors=errors):
                    fits = process.returncode == 0
                    # Tables of other runs have other sizes.
                    self.assertTrue(not fits or name.endswith(".csv"))
                    if not fits:
                        self.assertEqual(process.returncode, 1)
                        self.assertRegex(errors, rf"\Aflipfree: error: '{self.result(name)}[^\n]*disk[^\n]*\n\Z")
                        self.assertEqual(contents(self.results), former)
                    self.assertFalse([left for left in os.listdir(self.results) if left.startswith(".")])
                    counts[name] = counts.get(name, 0) + 1
        return counts

    def kill(self, surface, volume, times, generator):
        """At moments of the whole run, and of its end, where the files are written and get their names."""
        files, former, new = self.versions(surface, volume)
        begin = time.monotonic()
        self.results_of(files, NEW)
        duration = time.monotonic() - begin
        replaced = partly = 0
        for index in range(times):
            self.restore(former)
            process = self.segment(*files, *NEW)
            delay = generator.uniform(0, duration)
            if index % 4:
                while process.poll() is None and not self.writes():
                    time.sleep(0.001)
                delay = generator.uniform(0, duration / (2 if index % 4 == 1 else 8))
            time.sleep(delay)
            process.kill()  # nothing, where it has ended before
            process.communicate(timeout=120)
            count = self.assert_whole(former, new)
            replaced += count == len(former) - 1
            partly += 0 < count < len(former) - 1
        return times, replaced, partly

    def writes(self):
        """Is a file in a temporary folder?"""
        try:
            return any(files for name in os.listdir(self.results) if name.startswith(".flipfree-")
                       for _, _, files in os.walk(self.result(name)))
        except OSError:
            return False

    def vanish(self, surface, volume, times, generator):
        """The folder is removed with all that is in it."""
        files, former, _ = self.versions(surface, volume)
        refused = 0
        for index in range(times):
            self.restore(former)
            process = self.segment(*files, *NEW)
            if index % 2:
                while process.poll() is None and not self.writes():
                    time.sleep(0.001)
            time.sleep(generator.uniform(0, 0.1))
            while os.path.exists(self.results):  # a file may just have been added
                shutil.rmtree(self.results, ignore_errors=True)
            _, errors = process.communicate(timeout=120)
            refused += process.returncode == 1
            if process.returncode == 1:
                self.assertRegex(errors, r"\Aflipfree: error: '[^\n]*\n\Z")
            else:
                self.assertEqual(process.returncode, 0, errors)
            self.assertFalse(os.path.exists(self.results))
            os.mkdir(self.results)
        return times, refused


class TestFaults(Faults):
    def test_full_disk(self):
        for surface, volume in zip(SURFACES, VOLUMES):
            self.fill_disk(surface, volume, 2)

    def test_folder_that_vanishes(self):
        _, refused = self.vanish(".vtp", ".nii.gz", 4, random.Random(1))
        self.assertGreater(refused, 0)

    def test_kill(self):
        for surface, volume in zip(SURFACES, VOLUMES):
            self.kill(surface, volume, 4, random.Random(2))


class Table(Faults):
    times = 200

    def test_table(self):
        if not os.environ.get("DISPLAY"):
            print("without a display, so without pictures")
        type(self).display = ["env"] if os.environ.get("DISPLAY") else []
        generator = random.Random(2026)
        print("| fault | files | times | outcome |\n|---|---|---|---|", flush=True)
        pairs = list(zip(SURFACES, VOLUMES))
        for surface, volume in pairs:
            for name, count in self.fill_disk(surface, volume, self.times // 8).items():
                print(f"| full disk | {name} | {count} | the former file and a message, each time |", flush=True)
        for surface, volume in pairs:
            times, refused = self.vanish(surface, volume, self.times // 8, generator)
            print(f"| folder removed | {surface} {volume} | {times} | a message {refused} times, else done before |", flush=True)
        for surface, volume in pairs:
            times, replaced, partly = self.kill(surface, volume, self.times // len(pairs), generator)
            print(f"| kill -9 | {surface} {volume} .csv{' .png' if self.display else ''} | {times} | {replaced} times all new, "
                  f"{partly} some, else all former; each whole |", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--table"]:
        Table.times = int(sys.argv[2])
        unittest.main(argv=[sys.argv[0], "Table"])
    unittest.main(argv=[sys.argv[0], "TestFaults", *sys.argv[1:]])
