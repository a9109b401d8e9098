"""The notebook of the examples runs from the first cell to the last, and draws its pictures; so do the
guide's lines for PyVista.

  TestNotebook.py [--renew]

With --renew, what the cells print and draw is written into the notebook; look at it afterward.
"""

import io
import os
import pickle
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import flipfree

try:
    import distributed  # pylint: disable=unused-import
    import ipykernel  # pylint: disable=unused-import
    import nbclient
    import nbformat
    import numpy
    import PIL.Image
    import pyvista  # pylint: disable=unused-import
    import SimpleITK  # pylint: disable=unused-import
except ImportError as error:
    print(f"Skipped: {error}.")
    sys.exit(77)

SOURCE = Path(os.environ["FLIPFREE_PYTHON_SOURCE"]).parents[1]
NOTEBOOK = SOURCE / "Examples" / "Notebook" / "flipfree.ipynb"


def without_copies(notebook):
    """A picture once is enough, of those that come in several formats."""
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            if "image/png" in output.get("data", {}):
                output["data"].pop("image/jpeg", None)
    return notebook


def executed():
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    # The kernel of this interpreter, whatever others are installed.
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": folder}}).execute()
    return notebook


class Notebook(unittest.TestCase):
    def test_all_cells(self):
        outputs = [output for cell in executed().cells for output in cell.get("outputs", [])]
        text = "".join(output.get("text", "") for output in outputs)
        self.assertEqual([output for output in outputs if output.get("name") == "stderr"], [])
        shown = "".join(output.get("data", {}).get("text/plain", "") for output in outputs)
        self.assertRegex(shown, r"<Segmentation: [\d.]+ ml, confidence [01][.]\d\d, 6144 vertices, 0 self-intersections, 'converged' after \d+ iterations>")
        self.assertRegex(text, r"Dice 0\.9\d\d, mean distance \d\.\d\d mm")
        self.assertRegex(text, r"spleen +done, Dice 0\.9.*\n *left_kidney +done, Dice 0\.9")
        data = [output.get("data", {}) for output in outputs]
        pictures = [kinds.get("image/png") or kinds["image/jpeg"] for kinds in data
                    if "image/png" in kinds or "image/jpeg" in kinds]
        self.assertEqual(len(pictures), 4)
        self.assertTrue(all(len(picture) > 10000 for picture in pictures))


class Display(unittest.TestCase):
    """What a notebook shows of a result."""

    def test_picture(self):
        phantom = flipfree.phantom("sphere", dimensions=(40, 40, 40))
        ball = flipfree.segment(phantom.image, *phantom.seeds[1], resolution=8)
        for result, least in ((ball, 60), (pickle.loads(pickle.dumps(ball)), 2)):
            picture = PIL.Image.open(io.BytesIO(result._repr_png_()))
            self.assertEqual(picture.size, (600, 600))
            pixels = numpy.asarray(picture.convert("RGB")).astype(int).reshape(-1, 3)
            contour = numpy.abs(pixels - (255, 194, 51)).max(axis=1) < 20
            body = (pixels[:, 0] > 1.5 * pixels[:, 2]) & (pixels[:, 0] > 80) & ~contour
            grays = numpy.unique(pixels[(pixels == pixels[:, :1]).all(axis=1)][:, 0])  # of the volume, or of two labels
            self.assertGreater(contour.sum(), 1000)
            self.assertGreater(body.sum(), 5000)
            self.assertGreater(len(grays), least)
        self.assertLess(len(pickle.dumps(ball)), 3 * ball.labels.nbytes)

    def test_without_matplotlib(self):
        program = ("import sys; sys.modules['matplotlib'] = None; import flipfree; p = flipfree.phantom('sphere'); "
                   "print(flipfree.segment(p.image, *p.seeds[1], resolution=8)._repr_png_())")
        output = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
        self.assertEqual(output, "None\n")


class Guide(unittest.TestCase):
    def test_pyvista(self):
        text = (SOURCE / "Examples" / "Guide" / "python.md").read_text(encoding="utf-8")
        program = "\n".join(re.findall(r"(?s)```python\n(.*?)```", text.partition("\n## PyVista\n")[2].partition("\n## ")[0]))
        program = program.replace("Plotter(shape=(2, 2))", "Plotter(shape=(2, 2), off_screen=True)")
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True,
                                     timeout=300, check=False)
            self.assertEqual((process.returncode, process.stdout, process.stderr), (0, "", ""))
            self.assertGreater((Path(folder) / "liver-slices.png").stat().st_size, 50000)


if __name__ == "__main__":
    if "--renew" in sys.argv:
        nbformat.write(without_copies(executed()), NOTEBOOK)
    else:
        unittest.main()
