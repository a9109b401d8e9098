"""ParaView gives the toolkit's numbers: those of the flipfree command on the same files, value for value; and the
stages chained by hand give the composite's surface."""

import os
import re
import subprocess
import tempfile

import numpy
import session
from paraview import simple
from session import column, fetch, points, voxels


def command(*arguments):
    environment = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
    result = subprocess.run([os.environ["FLIPFREE_COMMAND"], *map(str, arguments)], check=True, timeout=300,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, env=environment)
    return result.stdout


class AgainstTheCommand(session.SessionTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="flipfree-test-")
        cls.addClassCleanup(folder.cleanup)
        seeds = command("phantom", "abdomen", "-o", folder.name, "--size", *session.SIZE, "--spacing", *session.SPACING)
        cls.liver = [float(value) for value in re.search(r"^liver.*--seed (\S+) (\S+) (\S+) --radius (\S+)", seeds,
                                                         re.M).groups()]
        cls.volume, cls.truth = (os.path.join(folder.name, name) for name in ("abdomen.nii.gz", "abdomen-truth.nii.gz"))

    def test_phantom(self):
        self.assertEqual(self.liver, [*session.SEED, session.RADIUS])
        phantom = session.abdomen()
        for port, file in enumerate((self.volume, self.truth)):
            self.assert_same(voxels(fetch(phantom, port)), voxels(fetch(simple.MedicalImageReader(FileName=file))))

    def test_phantom_of_its_own_voxels(self):
        for shape in ("abdomen", "vessel"):
            command("phantom", shape, "-o", self.folder)
            phantom = simple.SegmentationPhantom(Shape=shape.capitalize())
            for port, name in enumerate((shape, shape + "-truth")):
                read = fetch(simple.MedicalImageReader(FileName=self.file(name + ".nii.gz")))
                self.assert_same(voxels(fetch(phantom, port)), voxels(read))

    def test_segmentation(self):
        volume = self.volume
        surface, labels, table = self.file("liver.vtp"), self.file("liver.nii.gz"), self.file("liver.csv")
        command("segment", volume, "--seed", *session.SEED, "--radius", session.RADIUS, "-o", surface,
                "--labels", labels, "--convergence", table)
        liver = session.segmentation(simple.MedicalImageReader(FileName=volume))
        result = fetch(liver)
        self.assertEqual(result.GetNumberOfPoints(), 6144)
        expected = fetch(simple.XMLPolyDataReader(FileName=[surface]))
        self.assert_same(points(result), points(expected))
        for array in ("Displacement", "Correspondence"):
            self.assert_same(session.point_array(result, array), session.point_array(expected, array))
        self.assert_same(voxels(fetch(liver, 1)), voxels(fetch(simple.MedicalImageReader(FileName=labels))))
        convergence = fetch(liver, 2)
        with open(table, encoding="utf-8") as file:
            self.assertEqual(convergence.GetNumberOfRows(), len(file.readlines()) - 1)
        liver.UpdatePropertyInformation()
        self.assertEqual(liver.NumberOfSelfIntersections, 0)
        self.assertEqual(liver.StopReason, "converged")

    def test_corrections(self):
        volume, surface, table = self.volume, self.file("corrected.vtp"), self.file("points.csv")
        command("segment", volume, "--seed", *session.SEED, "--radius", session.RADIUS, "--resolution", 16,
                "--outside", 60, 83, 167, "--inside", 150, 100, 170, "-o", surface)
        with open(table, "w", encoding="utf-8") as file:
            file.write("x,y,z,Constraint,Radius\n150,100,170,1,0\n60,83,167,0,0\n")
        corrections = simple.TableToPoints(Input=simple.CSVReader(FileName=[table]), XColumn="x", YColumn="y",
                                           ZColumn="z")
        liver = session.segmentation(simple.MedicalImageReader(FileName=volume), Resolution=16,
                                     Corrections=corrections)
        self.assert_same(points(fetch(liver)), points(fetch(simple.XMLPolyDataReader(FileName=[surface]))))

    def test_metrics(self):
        truth = simple.MedicalImageReader(FileName=self.truth)
        other = self.file("other.nii.gz")
        made = session.segmentation(simple.MedicalImageReader(FileName=self.volume), Resolution=16)
        simple.SaveData(other, proxy=simple.OutputPort(made, 1))
        printed = command("evaluate", other, self.truth, "--reference-label", 6)
        metrics = simple.SegmentationMetrics(Input=simple.OutputPort(made, 1), Reference=truth, ReferenceLabel=6)
        table = fetch(metrics)
        dice = column(table, "Dice")[0]
        self.assertGreater(dice, 0.9)
        self.assertAlmostEqual(dice, float(re.search(r"^Dice +(\S+)", printed, re.M).group(1)), 3)
        metrics.UpdatePropertyInformation()
        self.assertEqual([metrics.Dice, metrics.ASD, metrics.HD95],
                         [column(table, name)[0] for name in ("Dice", "ASD", "HD95")])


class Stages(session.SessionTest):
    def test_chain_by_hand_gives_the_composites_surface(self):
        phantom = simple.SegmentationPhantom(Shape="Sphere")
        seed = {"SeedCenter": [47.5, 47.5, 47.5], "SeedRadius": 15}
        whole = simple.FlipFreeSegmentation(Input=phantom, Resolution=16, Levels=1, MaximumIterations=2, **seed)
        expected = points(fetch(whole))

        smooth = simple.FlipFreeStage1Diffusion(Input=phantom, **seed)
        feature = simple.FlipFreeStage2Feature(Input=smooth, **seed)
        surface = start = simple.QuadSphere(Center=seed["SeedCenter"], Radius=seed["SeedRadius"], Resolution=16)
        for _ in range(2):
            targets = simple.FlipFreeStage3Correspondence(Input=surface, Feature=feature, EdgeImage=smooth)
            surface = simple.FlipFreeStage4Deformation(Input=targets)
        carved = simple.FlipFreeStage2Feature(Input=smooth, Surface=surface, **seed)
        surface = start
        for _ in range(2):
            targets = simple.FlipFreeStage3Correspondence(Input=surface, Feature=carved)
            surface = simple.FlipFreeStage4Deformation(Input=targets)
        self.assert_same(points(fetch(surface)), expected)
        self.assertGreater(numpy.linalg.norm(expected - seed["SeedCenter"], axis=1).min(), 20)

    def test_start_surface_is_optional_and_takes_the_spheres_place(self):
        phantom = simple.SegmentationPhantom(Shape="Sphere")
        seed = {"SeedCenter": [47.5, 47.5, 47.5], "SeedRadius": 15}
        whole = simple.FlipFreeSegmentation(Input=phantom, Resolution=16, Levels=1, MaximumIterations=1, **seed)
        by_sphere = points(fetch(whole))
        whole.StartSurface = simple.QuadSphere(Center=seed["SeedCenter"], Radius=seed["SeedRadius"], Resolution=16)
        self.assert_same(points(fetch(whole)), by_sphere)
        whole.StartSurface = simple.QuadSphere(Center=seed["SeedCenter"], Radius=18, Resolution=8)
        self.assertEqual(len(points(fetch(whole))), 6 * 8 * 8)
        whole.StartSurface = None
        self.assert_same(points(fetch(whole)), by_sphere)

    def test_refinement_label_map_and_validity(self):
        sphere = simple.QuadSphere(Center=[47.5, 47.5, 47.5], Radius=30, Resolution=16)
        fine = simple.FlipFreeStage5Refinement(Input=sphere)
        self.assertEqual(fetch(fine).GetNumberOfPoints(), 6 * 32 * 32)
        phantom = simple.SegmentationPhantom(Shape="Sphere")
        inside = voxels(fetch(simple.SurfaceToLabelMap(Input=fine, ReferenceImage=phantom, LabelValue=7)))
        self.assertEqual(set(numpy.unique(inside)), {0, 7})
        self.assertAlmostEqual(numpy.count_nonzero(inside) / numpy.count_nonzero(voxels(fetch(phantom, 1))), 1, delta=0.03)
        validity = simple.SurfaceValidity(Input=fine)
        measures = fetch(validity, 1)
        found = [column(measures, name)[0] for name in ("Valid", "SelfIntersections", "EulerNumber")]
        validity.UpdatePropertyInformation()
        self.assertEqual([*found, validity.IsValid], [1, 0, 2, 1])

    def test_itk_diffusion_smooths(self):
        phantom = simple.SegmentationPhantom(Shape="Sphere")
        smooth = simple.ITKAnisotropicDiffusion(Input=phantom)
        middle = (slice(40, 56),) * 3
        noisy, quiet = (voxels(fetch(proxy)).reshape(96, 96, 96)[middle] for proxy in (phantom, smooth))
        self.assertAlmostEqual(quiet.mean(), noisy.mean(), delta=1)
        self.assertLess(quiet.std(), 0.6 * noisy.std())


if __name__ == "__main__":
    session.main()
