"""What the tests of the command share: running it, and a small phantom to run it on."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Support"))
import forked_command  # pylint: disable=wrong-import-position

PROGRAM = os.environ["FLIPFREE_COMMAND"]
# The command that pip installs draws without a display and has a subcommand more.
IS_OF_PIP = bool(os.environ.get("FLIPFREE_COMMAND_IS_OF_PIP"))
FILTERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Filters", "Segmentation")
# How much longer things take than in the build that users have: more than 1 with sanitizers.
SLOWNESS = float(os.environ.get("FLIPFREE_SLOWNESS", "1"))


def run(*arguments, **options):
    """Runs `flipfree` with the arguments; gives its status, output and error text."""
    if IS_OF_PIP and not options:
        return forked_command.run(PROGRAM, list(map(str, arguments)))
    options = {"timeout": 120 * SLOWNESS, "stdout": subprocess.PIPE, **options}
    return subprocess.run([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          **options)


def without_leak_check():
    """An environment for runs in which other people's libraries leak."""
    return {**os.environ, "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":detect_leaks=0"}


def with_display(*arguments):
    """The same, with a display where the machine has none."""
    display = [] if os.environ.get("DISPLAY") else ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]
    # Graphics drivers leak, and are unloaded before their leaks could be told from ours.
    return subprocess.run([*display, PROGRAM, *map(str, arguments)], timeout=120, env=without_leak_check(),
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


HAS_DISPLAY = bool(os.environ.get("DISPLAY") or shutil.which("xvfb-run"))


def make_phantom(folder, name, *options):
    """Makes a phantom; gives the arguments of its seeds by their names."""
    result = run("phantom", name, "-o", folder, *options)
    if result.returncode != 0:
        raise AssertionError(result.stderr)
    return {line.split(":")[0]: line.split(":")[1].split() for line in result.stdout.splitlines()}


def make_small_abdomen(folder):
    """A coarse abdomen: its file, and of each organ the seed's coordinates and radius as words."""
    seeds = make_phantom(folder, "abdomen", "--size", 110, 86, 46, "--spacing", 3, 3, 6)
    organs = {}
    for name, words in seeds.items():
        seed = words[words.index("--seed") + 1:][:3] + [words[words.index("--radius") + 1]]
        organs[name.split(" (")[0].lower()] = seed
    return os.path.join(folder, "abdomen.nii.gz"), organs


def dice_of(text):
    return float(re.search(r"^Dice +([0-9.]+)$", text, re.MULTILINE).group(1))


def parameter_options():
    """The options that the properties of the segmentation and of its stages must have."""
    properties = set()
    for name in ("FlipFreeSegmentation", "GMMFeatureFilter", "CorrespondenceSearch", "FlipFreeDeform"):
        with open(os.path.join(FILTERS, "vtk" + name + ".h"), encoding="utf-8") as file:
            properties.update(re.findall(r"(?:vtkSet\w*Macro\(|void Set)(\w+)(?:,|\((?:double|int|bool) )", file.read()))
    # The seed is --seed or --seed-voxel and --radius; the history and what is kept are for pipelines; the feature has the threshold.
    properties -= {"SeedCenter", "SeedRadius", "KeepHistory", "KeepForCorrections", "Threshold"}
    return sorted("-" + re.sub("([A-Z])", r"-\1", name).lower() for name in properties)


class CommandTest(unittest.TestCase):
    """Each class has a folder with a small sphere, each test an empty one for its results."""

    @classmethod
    def setUpClass(cls):
        cls.inputs = tempfile.mkdtemp(prefix="flipfree-test-")
        cls.addClassCleanup(shutil.rmtree, cls.inputs)
        seeds = make_phantom(cls.inputs, "sphere", "--size", 64, 64, 40, "--spacing", 1, 1, 1.6)
        cls.seed = seeds["object (label 1)"]
        cls.volume = os.path.join(cls.inputs, "sphere.nii.gz")
        cls.truth = os.path.join(cls.inputs, "sphere-truth.nii.gz")

    def setUp(self):
        self.results = tempfile.mkdtemp(prefix="flipfree-test-")
        self.addCleanup(shutil.rmtree, self.results)

    def result(self, name):
        return os.path.join(self.results, name)

    def assert_succeeds(self, process, may_be_doubtful=False):
        """Without a word of complaint, but for that of a low confidence if it may be."""
        self.assertEqual(process.returncode, 0, process.stderr)
        doubt = r"(flipfree: warning: ('\w+': )?The result is doubtful: its confidence is 0\.\d\d, [^\n]+\n)*"
        self.assertRegex(process.stderr, rf"\A{doubt if may_be_doubtful else ''}\Z")

    def assert_refused(self, process, status, *patterns):
        """One line that says what is wrong, the status, and no file."""
        self.assertEqual(process.returncode, status, f"{process.stdout}{process.stderr}")
        self.assertRegex(process.stderr, r"\Aflipfree: error: [^\n]+\n\Z")
        for trace in (r"0x[0-9a-f]{6}", r"\.cxx", r"\bvtk[A-Z]", r"\bitk::", r"\bport \d"):
            self.assertNotRegex(process.stderr, trace)
        for pattern in patterns:
            self.assertRegex(process.stderr, pattern)
        self.assertEqual(os.listdir(self.results), [])
