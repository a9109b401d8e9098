"""The example runs on a given volume, draws it, and saves a state that can be loaded, as the state beside it can."""

import os
import re
import subprocess

import session
from paraview import simple
from session import fetch

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "ParaView")
PVBATCH = os.path.join(os.environ["FLIPFREE_BUILD"] + "-prefix", "usr", "bin", "pvbatch")


class Example(session.SessionTest):
    def run_example(self, *arguments):
        script = os.path.join(EXAMPLES, "segment-organ.py")
        return subprocess.run([PVBATCH, script, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=200)

    def test_on_a_volume(self):
        volume, picture, state = (self.file(name) for name in ("ct.nii.gz", "organ.png", "organ.pvsm"))
        simple.SaveData(volume, proxy=session.abdomen())
        result = self.run_example(volume, *session.SEED, session.RADIUS, "-o", picture, "--state", state)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("6144 vertices, 0 self-intersections; stopped: converged", result.stdout)
        self.assertNotIn("ERR|", result.stdout)
        pixels = fetch(simple.PNGSeriesReader(FileNames=[picture]))
        self.assertEqual(pixels.GetDimensions(), (1400, 700, 1))

        organ = self.load(state)
        self.assertEqual([*organ.SeedCenter, organ.SeedRadius], [*session.SEED, session.RADIUS])
        self.assertEqual(fetch(organ).GetNumberOfPoints(), 6144)

    def load(self, state):
        """The segmentation in it."""
        simple.ResetSession()
        simple.LoadState(state)
        self.addCleanup(lambda: [simple.Delete(view) for view in simple.GetViews()])
        self.assertIsNotNone(simple.FindSource("Axial"))
        return simple.FindSource("Organ")

    def test_ready_state(self):
        state = os.path.join(EXAMPLES, "segment-organ.pvsm")
        organ = self.load(state)
        # Made once, since it takes seconds: a phantom with the same properties has the same voxels.
        phantom, fresh = simple.FindSource("CT"), simple.SegmentationPhantom(Shape="Abdomen")
        values = [{name: str(source.GetProperty(name)) for name in source.ListProperties()} for source in (phantom, fresh)]
        self.assertEqual(*values)
        self.assertEqual(phantom.Shape, "Abdomen")
        by_hand = simple.FlipFreeSegmentation(Input=phantom, SeedCenter=[99.75, 83.75, 167], SeedRadius=28)
        self.assert_same(session.points(fetch(organ)), session.points(fetch(by_hand)))
        views = {view.GetXMLName(): view for view in simple.GetViews()}
        for view in views.values():
            simple.Render(view)
        self.assertEqual(sorted(views), ["RenderView", "XYChartView"])
        shown = simple.GetDisplayProperties(simple.OutputPort(organ, 0), views["RenderView"])
        self.assertEqual([shown.Visibility, shown.Representation], [1, "Surface With Edges"])

    def test_ready_state_names_no_file(self):
        with open(os.path.join(EXAMPLES, "segment-organ.pvsm"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn('version="5.11.0"', text[:200])
        self.assertEqual(re.findall(r'value="(?:/[^"/]|file:)[^"]*"', text), [])

    def test_says_what_is_missing(self):
        result = self.run_example("ct.nii.gz")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("after the volume, give its seed", result.stdout)

    def test_says_what_is_wrong_in_one_line(self):
        broken, volume = self.file("broken.nii.gz"), self.file("ct.nii.gz")
        with open(broken, "w", encoding="utf-8") as file:
            file.write("no image")
        simple.SaveData(volume, proxy=session.abdomen())
        for name, seed, words in ((self.file("none.nii.gz"), session.SEED, "none.nii.gz"),
                                  (broken, session.SEED, "broken.nii.gz"),
                                  (volume, (9999, 0, 0), "outside the image")):
            with self.subTest(name=name):
                result = self.run_example(name, *seed, session.RADIUS)
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertRegex(result.stdout, r"\Asegment-organ.py: .*\n\Z")
                self.assertIn(words, result.stdout)


if __name__ == "__main__":
    session.main()
