"""Seeds and corrections that are placed with the mouse in PyVista's plotter: clicks and keys, off screen."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy

try:
    import pyvista
    from flipfree import pyvista as ours

    pyvista.register_plotter_component
except (ImportError, AttributeError) as error:
    print(f"Skipped: {error}.")
    sys.exit(77)

FRESH = """
import pyvista, sys
plotter = pyvista.Plotter(off_screen=True)
print("flipfree" in sys.modules, plotter.flipfree.open.__doc__, flush=True)
plotter.screenshot()
"""
fresh = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=False)
if fresh.returncode < 0:  # where the display has no OpenGL, VTK ends the program
    print("Skipped: nothing can be drawn here.")
    sys.exit(77)

AXIAL, SAGITTAL, CORONAL = range(3)
MIDDLE = (19.5, 19.5, 19.5)


class Placing(unittest.TestCase):
    def setUp(self):
        self.phantom = flipfree.phantom("sphere", dimensions=(40, 40, 40))
        self.plotter = pyvista.Plotter(shape=(2, 2), off_screen=True, window_size=(400, 400))
        self.addCleanup(self.plotter.close)
        self.tool = self.plotter.flipfree.open(ours.imagedata(self.phantom.image), resolution=8)
        self.plotter.show(auto_close=False, interactive=False)

    def key(self, name):
        self.plotter.iren.interactor.SetKeySym(name)
        self.plotter.iren.interactor.KeyPressEvent()

    def click(self, place, view, drag=0):
        renderer = self.plotter.renderers[view]
        renderer.SetWorldPoint(*place, 1)
        renderer.WorldToDisplay()
        x, y = (round(value) for value in renderer.GetDisplayPoint()[:2])
        self.plotter.iren._mouse_right_button_press(x, y)
        self.plotter.iren._mouse_move(x + drag, y)
        self.plotter.iren._mouse_right_button_release()

    def seed(self):
        self.click(MIDDLE, AXIAL)
        self.click((26, 19.5, 19.5), CORONAL)

    def test_seed_and_its_rim(self):
        self.assertIsNone(self.tool.organ)
        self.click(MIDDLE, AXIAL)
        self.assertIsNone(self.tool.surface)
        self.click((26, 19.5, 19.5), CORONAL)
        dice = flipfree.evaluate(self.tool.organ, self.phantom.label_map).dice
        self.assertGreater(dice, 0.95)
        self.assertEqual(self.tool.surface.n_points, 384)
        self.assertIs(self.plotter.flipfree, self.tool)

    def test_slices_go_where_one_looks(self):
        self.key("l")
        self.click((12, 30, 19.5), AXIAL)
        self.click((12, 30, 8), SAGITTAL)
        numpy.testing.assert_allclose(self.tool._place, (12, 30, 8), atol=0.4)
        self.assertEqual(self.tool._steps, [])

    def test_corrections_undo_and_redo(self):
        self.seed()
        found = self.tool.organ
        self.key("i")
        self.click((34, 19.5, 19.5), CORONAL)
        more = self.tool.organ
        self.assertGreater(more.volume, found.volume)
        self.key("o")
        self.click((19.5, 8, 19.5), SAGITTAL)
        [inside, outside] = self.tool.organ.constraints[::-1] if self.tool.organ.constraints[0].kind == 0 \
            else self.tool.organ.constraints
        numpy.testing.assert_allclose(inside.place, (34, 19.5, 19.5), atol=0.4)
        numpy.testing.assert_allclose(outside.place, (19.5, 8, 19.5), atol=0.4)
        self.key("u")
        self.assertIs(self.tool.organ, more)
        self.key("u")
        self.assertIs(self.tool.organ, found)
        self.key("a")
        self.assertIs(self.tool.organ, more)
        for _ in range(9):
            self.key("u")
        self.assertIsNone(self.tool.organ)

    def test_what_moves_the_mouse_or_misses_places_nothing(self):
        self.click(MIDDLE, AXIAL, drag=20)
        self.click((-60, 19.5, 19.5), CORONAL)
        self.click(MIDDLE, 3)
        self.assertEqual(self.tool._steps, [])

    def test_refused_steps_are_taken_back_with_the_reason(self):
        self.seed()
        found = self.tool.organ
        self.tool.place("inside", (-50, 0, 0))
        self.assertIn("(-50, 0, 0) mm", self.tool._words)
        self.assertIs(self.tool.organ, found)
        with self.assertRaisesRegex(ValueError, "^meaning: 'in' is none of look, seed, inside"):
            self.tool.place("in", MIDDLE)

    def test_a_refused_step_keeps_what_was_undone(self):
        self.seed()
        self.tool.place("inside", (34, 19.5, 19.5))
        more = self.tool.organ
        self.tool.undo()
        self.tool.place("inside", (-50, 0, 0))
        self.tool.redo()
        self.assertIs(self.tool.organ, more)

    def test_a_refused_rim_can_be_placed_again(self):
        self.tool.place("seed", MIDDLE)
        self.tool.place("seed", MIDDLE)
        self.assertIn("radius", self.tool._words)
        self.assertEqual(len(self.tool._steps), 1)
        self.tool.place("seed", (26, 19.5, 19.5))
        self.assertEqual(self.tool._words, "")
        self.assertIsNotNone(self.tool.organ)

    def test_opened_again(self):
        """A click is one step still; the seed is that of the new image."""
        image = ours.imagedata(self.phantom.image)
        self.assertIs(self.tool.open(image, MIDDLE, 6.5, resolution=8), self.tool)
        self.key("i")
        self.click((34, 19.5, 19.5), CORONAL)
        self.assertEqual([meaning for meaning, _ in self.tool._steps], ["seed", "seed", "inside"])
        organ = self.tool.organ
        for seed, radius, message in ((MIDDLE, None, "^seed, radius: give both"), (None, 6.5, "^seed, radius: give both"),
                                      ((-50, 0, 0), 6.5, r"\(-50, 0, 0\)"), (MIDDLE, -1, "^radius: -1 is not positive")):
            with self.subTest(message), self.assertRaisesRegex((flipfree.FlipFreeError, ValueError), message):
                self.tool.open(image, seed, radius, resolution=8)
            self.assertIs(self.tool.organ, organ)
        self.tool.undo()
        self.tool.undo()
        self.assertIsNone(self.tool.organ)

    def test_corrections_and_seeds_are_those_of_one_run(self):
        """Whatever their order; what no step reaches any more is let go."""
        inside, outside, second = (34, 19.5, 19.5), (19.5, 8, 19.5), (19.5, 24, 19.5)
        self.seed()
        self.tool.place("inside", inside)
        self.tool.place("seed", second)
        before = self.tool.organ
        self.tool.place("seed", (19.5, 26, 19.5))
        self.assertIsNot(self.tool.organ, before)
        self.tool.place("outside", outside)
        (middle, rim), organ = (place for _, place in self.tool._steps[:2]), self.tool.organ
        expected = flipfree.segment(self.phantom.image, middle, numpy.linalg.norm(numpy.subtract(rim, middle)),
                                    seeds=[(second, 2)], inside=[inside], outside=[outside], resolution=8)
        self.assertEqual({(one.kind, one.place) for one in organ.constraints},
                         {(one.kind, one.place) for one in expected.constraints})
        numpy.testing.assert_allclose(organ.volume, expected.volume, rtol=0.01)
        self.assertEqual(len(self.tool._known), 1 + len(self.tool._steps))
        for _ in range(4):
            self.tool.undo()
        self.assertEqual(len(self.tool._known), 7)  # it can be made again
        self.tool.place("outside", outside)
        self.assertEqual(len(self.tool._known), 4)

    def test_answers(self):
        self.seed()
        asked = flipfree.Question((34.0, 19.5, 19.5), 3.4, included=False, margin=1.0)
        object.__setattr__(self.tool.organ, "questions", (asked,))  # the ball itself raises none
        self.key("y")
        self.assertEqual(self.tool._steps[-1], ("inside", asked.place))

    def test_needs_four_views(self):
        with self.assertRaisesRegex(ValueError, r"^plotter: 2 x 2 views are needed.*shape=\(2, 2\)"):
            pyvista.Plotter(off_screen=True).flipfree.open(ours.imagedata(self.phantom.image))


class Plugin(unittest.TestCase):
    def test_is_there_without_an_import(self):
        self.assertEqual(fresh.returncode, 0, fresh.stderr)
        self.assertRegex(fresh.stdout, "^False Shows an image on three slices, and, if a seed is given, the organ around it")

    def test_reader_keeps_the_direction(self):
        direction = (0, -1, 0, 1, 0, 0, 0, 0, 1)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cube.nii"
            flipfree.write_image(flipfree.phantom("cube", dimensions=(20, 24, 28), direction=direction).image, path)
            image = ours.read(path)
        numpy.testing.assert_array_equal(numpy.ravel(image.direction_matrix), direction)
        self.assertEqual(image.dimensions, (20, 24, 28))


if __name__ == "__main__":
    unittest.main()
