"""flipfree.segment: what it takes, what it gives, and that it is the filter's own result."""

import copy
import os
import pickle
import tempfile
import unittest
from pathlib import Path

import flipfree
import numpy
from example import (HAS_VTK, RADIUS, SEED, SIZE, SPACING, axes_of, image, liver, needs_files, needs_vtk, needs_wheel,
                     points_of, spacing_of, surface_of, truth)

if HAS_VTK:
    from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkTable
    from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter


def filter_with_seed():
    segmentation = flipfree.vtkFlipFreeSegmentation()
    segmentation.SetInputData(image())
    segmentation.SetSeedCenter(*SEED)
    segmentation.SetSeedRadius(RADIUS)
    return segmentation


def oblique():
    """Left-handed, and in no plane of the scanner's."""
    x, z = numpy.radians(20), numpy.radians(35)
    about_x = [[1, 0, 0], [0, numpy.cos(x), -numpy.sin(x)], [0, numpy.sin(x), numpy.cos(x)]]
    about_z = [[numpy.cos(z), -numpy.sin(z), 0], [numpy.sin(z), numpy.cos(z), 0], [0, 0, 1]]
    return numpy.array(about_x) @ about_z @ numpy.diag([1, 1, -1])


class Output(unittest.TestCase):
    @needs_vtk
    def test_is_the_filters(self):
        segmentation = filter_with_seed()
        segmentation.Update()
        numpy.testing.assert_array_equal(liver().points, points_of(segmentation.GetSurface()))
        self.assertEqual(liver().stop_reason, segmentation.GetStopReasonAsString())
        self.assertEqual(liver().self_intersections, 0)
        for data, kind in ((liver().surface, vtkPolyData), (liver().label_map, vtkImageData),
                           (liver().convergence, vtkTable)):
            self.assertIsInstance(data, kind)

    @needs_vtk
    def test_faces_are_those_of_the_surface(self):
        surface = liver().surface
        self.assertEqual(liver().faces.shape, (surface.GetNumberOfCells(), 4))
        for cell, face in enumerate(liver().faces):
            ids = surface.GetCell(cell).GetPointIds()
            corners = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
            self.assertEqual(list(face), (corners + corners[-1:])[:4])  # a triangle repeats its last corner
        self.assertEqual(sum(face[2] == face[3] for face in liver().faces), 8)

    @needs_vtk
    def test_triangles_enclose_the_volume_of_the_surface(self):
        a, b, c = (liver().points[liver().triangles[:, corner]] for corner in range(3))
        triangulated = vtkTriangleFilter()
        triangulated.SetInputData(liver().surface)
        properties = vtkMassProperties()
        properties.SetInputConnection(triangulated.GetOutputPort())
        volume = numpy.einsum("ij,ij", a, numpy.cross(b, c)) / 6
        self.assertAlmostEqual(volume / properties.GetVolume(), 1, delta=1e-3)
        self.assertEqual(len(a), 12 * 32 * 32 - 4)

    def test_labels_are_the_voxels_within(self):
        labels = liver().labels
        self.assertEqual(labels.shape, SIZE[::-1])
        self.assertEqual(set(numpy.unique(labels)), {0, 1})
        i, j, k = (numpy.array(SEED) / SPACING).round().astype(int)
        self.assertEqual(labels[k, j, i], 1)
        self.assertEqual(labels[0, 0, 0], 0)

    @needs_vtk
    def test_points_and_labels_are_views(self):
        result = flipfree.segment(image(), SEED, RADIUS, levels=1, maximum_iterations=1)
        result.points[5] = (1, 2, 3)
        self.assertEqual(result.surface.GetPoint(5), (1, 2, 3))
        result.labels[3, 2, 1] = 9
        self.assertEqual(result.label_map.GetScalarComponentAsDouble(1, 2, 3, 0), 9)

    def test_iterations_are_the_columns_of_the_convergence(self):
        iterations = liver().iterations
        rows = len(iterations["MeanDistance"])
        self.assertEqual(list(iterations["Iteration"]), list(range(1, rows + 1)))
        self.assertLess(iterations["MeanDistance"][-1], iterations["MeanDistance"][0])

    def test_history_ends_with_the_surface(self):
        result = flipfree.segment(image(), SEED, RADIUS, keep_history=True)
        self.assertEqual(len(result.history), len(result.iterations["Iteration"]))
        numpy.testing.assert_array_equal(result.points, liver().points)
        numpy.testing.assert_array_equal(points_of(result.history[-1]), result.points)
        vertices = [len(points_of(surface)) for surface in result.history]
        self.assertEqual(vertices, list(result.iterations["Vertices"]))
        self.assertEqual(liver().history, ())

    def test_repr_tells_what_one_wants_to_know(self):
        self.assertRegex(repr(liver()), rf"^<Segmentation: {liver().volume:.1f} ml, confidence (0[.]\d\d|1[.]00), 6144 vertices, 0 self-intersections, ")


class Pickles(unittest.TestCase):
    """Results go into files and to other processes."""

    def assert_same(self, one, two):
        numpy.testing.assert_array_equal(points_of(surface_of(one)), points_of(surface_of(two)))
        numpy.testing.assert_array_equal(one.faces, two.faces)
        numpy.testing.assert_array_equal(one.labels, two.labels)
        numpy.testing.assert_array_equal(axes_of(one.label_map), axes_of(two.label_map))
        self.assertEqual(one.iterations.keys(), two.iterations.keys())
        for name, column in one.iterations.items():
            numpy.testing.assert_array_equal(column, two.iterations[name])
        for name in ("stop_reason", "self_intersections", "constraints", "provenance"):
            self.assertEqual(getattr(one, name), getattr(two, name))

    def test_an_organ_comes_back_as_it_was(self):
        array = flipfree.array_from_image(image())[::2, ::2, ::2]
        origin, spacing = numpy.array((1 / 7, -20, 3.5)), numpy.array((3, 10 / 3, 6.1))
        turned = flipfree.image_from_array(array, spacing, origin, oblique())
        liver_in_it = origin + oblique() @ (numpy.array(SEED) / 2 / spacing_of(image()) * spacing)
        organ = flipfree.segment(turned, liver_in_it, 20, resolution=8, levels=1, keep_history=True,
                                 maximum_iterations=3)
        for again in (pickle.loads(pickle.dumps(organ)), copy.deepcopy(organ)):
            self.assert_same(again, organ)
            numpy.testing.assert_array_equal(again.vertex_confidence, organ.vertex_confidence)
            self.assertEqual(again.confidence, organ.confidence)
            self.assertEqual(len(again.history), len(organ.history))
            with self.assertRaisesRegex(flipfree.FlipFreeError, "not a copy of it"):
                again.corrected(inside=[(1, 2, 3)])

    def test_a_phantom_and_a_vessel(self):
        phantom = pickle.loads(pickle.dumps(flipfree.phantom("cup")))
        self.assertEqual(phantom.seeds, flipfree.phantom("cup").seeds)
        self.assertEqual(phantom.image.__class__, image().__class__)
        tube = flipfree.phantom("vessel")
        vessel = flipfree.trace(tube.image, tube.ends)
        again = pickle.loads(pickle.dumps(vessel))
        self.assert_same(again, vessel)
        self.assertEqual(len(again.branches), 1)
        numpy.testing.assert_array_equal(again.branches[0].radius, vessel.branches[0].radius)

    def test_an_image_keeps_its_geometry(self):
        volume = flipfree.image_from_array(numpy.arange(24, dtype="int16").reshape(2, 3, 4), (0.1, 1 / 3, 3),
                                           (1 / 7, 2, 3), oblique())
        again = pickle.loads(pickle.dumps(volume))
        self.assertEqual(tuple(spacing_of(again)), (0.1, 1 / 3, 3))
        numpy.testing.assert_array_equal(flipfree.array_from_image(again), flipfree.array_from_image(volume))
        numpy.testing.assert_array_equal(axes_of(again), axes_of(volume))


class Input(unittest.TestCase):
    def test_array_with_its_geometry(self):
        array = flipfree.array_from_image(image())
        result = flipfree.segment(array, numpy.array(SEED), RADIUS, spacing=SPACING)
        numpy.testing.assert_array_equal(result.points, liver().points)

    def test_array_that_is_turned_moved_and_not_contiguous(self):
        array = numpy.asfortranarray(flipfree.array_from_image(image()))
        direction, origin = oblique(), numpy.array([10, -200, 1000])
        result = flipfree.segment(array, direction @ SEED + origin, RADIUS, spacing=SPACING,
                                  origin=origin, direction=direction)
        numpy.testing.assert_allclose(axes_of(result.label_map), direction, atol=1e-15)
        overlap = numpy.count_nonzero(result.labels & liver().labels)
        self.assertGreater(2 * overlap / (result.labels.sum() + liver().labels.sum()), 0.97)

    @needs_files
    def test_voxels_without_data(self):
        voxels = flipfree.array_from_image(image())
        columns = numpy.arange(voxels.shape[2]) * SPACING[0]
        rows = numpy.arange(voxels.shape[1])[:, None] * SPACING[1]
        outside = numpy.broadcast_to(numpy.hypot(columns - SEED[0], rows - SEED[1]) > 95, voxels.shape)
        masked = numpy.ma.array(voxels, mask=outside)
        result = flipfree.segment(masked, SEED, RADIUS, spacing=SPACING)
        # Up to what the surface rounds.
        self.assertLess(numpy.count_nonzero(result.labels[outside]), 1e-3 * numpy.count_nonzero(result.labels))
        self.assertAlmostEqual(flipfree.evaluate(result, truth(), reference_label=flipfree.Organ.LIVER).dice,
                               flipfree.evaluate(liver(), truth(), reference_label=flipfree.Organ.LIVER).dice, delta=0.03)
        numbers = numpy.where(outside, numpy.inf, voxels.astype(numpy.float64))
        same = flipfree.segment(numbers, SEED, RADIUS, spacing=SPACING)
        numpy.testing.assert_array_equal(same.points, result.points)

    def test_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / ("abdomen.mha" if HAS_VTK else "abdomen.nii.gz")  # without any other package
            flipfree.write_image(image(), path)
            for name in (path, str(path)):
                result = flipfree.segment(name, SEED, RADIUS)
                numpy.testing.assert_array_equal(result.points, liver().points)
            os.remove(path)

    @needs_vtk
    def test_start_from_another_surface(self):
        cube = flipfree.vtkQuadSphereSource()
        cube.SetSpacingToCube()
        cube.SetCenter(*SEED)
        cube.SetRadius(20)
        cube.SetResolution(8)
        cube.Update()
        result = flipfree.segment(image(), SEED, RADIUS, start=cube.GetOutput(), levels=1,
                                  maximum_iterations=0)
        numpy.testing.assert_array_equal(result.points, points_of(cube.GetOutput()))
        again = flipfree.segment(image(), SEED, RADIUS, start=result, levels=1,
                                 maximum_iterations=1)
        self.assertEqual(again.points.shape, result.points.shape)
        self.assertGreater(abs(again.points - result.points).max(), 1)


    def test_start_from_a_segmentation(self):
        coarse = flipfree.segment(image(), SEED, RADIUS, resolution=8, levels=1)
        same = flipfree.segment(image(), SEED, RADIUS, start=coarse, levels=1, maximum_iterations=0)
        numpy.testing.assert_array_equal(same.points, coarse.points)
        numpy.testing.assert_array_equal(same.faces, coarse.faces)

    @needs_wheel
    def test_start_from_a_surface_of_a_history(self):
        coarse = flipfree.segment(image(), SEED, RADIUS, resolution=8, levels=1, keep_history=True)
        first = coarse.history[0]
        same = flipfree.segment(image(), SEED, RADIUS, start=first, levels=1, maximum_iterations=0)
        numpy.testing.assert_array_equal(same.points, first.points)


class Confidence(unittest.TestCase):
    def test_is_high_where_the_boundary_is_clear(self):
        self.assertGreater(liver().confidence, 0.85)
        self.assertLessEqual(liver().confidence, 1)
        self.assertEqual(liver().vertex_confidence.shape, (len(liver().points),))
        self.assertEqual(liver().vertex_confidence.dtype, numpy.float32)
        self.assertTrue(((liver().vertex_confidence >= 0) & (liver().vertex_confidence <= 1)).all())

    def test_is_low_and_said_where_noise_hides_it(self):
        place = 2 * numpy.indices((48, 48, 48)) - 47
        noise = numpy.random.default_rng(1).normal(0, 25, (48, 48, 48))
        ball = (100 + 60 * ((place ** 2).sum(axis=0) < 28 ** 2) + noise).astype(numpy.int16)
        with self.assertWarnsRegex(flipfree.FlipFreeWarning, "doubtful: its confidence is 0"):
            found = flipfree.segment(ball, (47, 47, 47), 15, spacing=(2, 2, 2), resolution=16)
        self.assertLess(found.confidence, 0.85)

    def test_of_a_vessel_is_one_number(self):
        vessel = flipfree.trace(flipfree.phantom("vessel").image, [(13.3, 44.6, 44.5), (82, 50.4, 37.6)])
        self.assertGreater(vessel.confidence, 0.45)
        self.assertLessEqual(vessel.confidence, 1)
        self.assertIsNone(vessel.vertex_confidence)


class Parameters(unittest.TestCase):
    @needs_vtk
    def test_are_those_of_the_filter_and_its_stages(self):
        segmentation = flipfree.vtkFlipFreeSegmentation()
        owners = [segmentation, segmentation.GetFeature(), segmentation.GetSearch(), segmentation.GetDeform()]
        names = {name[3:] for owner in owners for name in vars(type(owner))
                 if name.startswith("Set") and hasattr(owner, "Get" + name[3:])}
        # The seed, the start labels and the stages have arguments of their own or none; the feature has the threshold; corrected() keeps.
        names -= {"SeedCenter", "SeedRadius", "StartLabel", "Diffusion", "Feature", "Search", "Deform", "Threshold",
                  "KeepForCorrections"}
        defaults = flipfree.default_parameters()
        self.assertEqual({name.replace("_", "") for name in defaults}, {name.lower() for name in names})
        self.assertEqual([defaults[name] for name in ("levels", "minimum_component_weight", "run_length", "fairing")],
                         [4, 0.15, 2, 0])

    @needs_vtk
    def test_reach_the_filter_and_its_stages(self):
        result = flipfree.segment(image(), SEED, RADIUS, resolution=8, levels=1, label_value=7)
        self.assertEqual(len(result.points), 6 * 8 * 8)
        self.assertEqual(result.labels.max(), 7)
        segmentation = filter_with_seed()
        segmentation.SetMaximumIterations(2)
        segmentation.GetFeature().SetNoiseWidening(3)
        segmentation.GetSearch().SetMaximumDisplacement(2)
        segmentation.GetDeform().SetFairing(0.5)
        segmentation.Update()
        result = flipfree.segment(image(), SEED, RADIUS, maximum_iterations=2, noise_widening=3,
                                  maximum_displacement=2, fairing=0.5)
        numpy.testing.assert_array_equal(result.points, points_of(segmentation.GetSurface()))

    def test_reach_the_method(self):
        result = flipfree.segment(image(), SEED, RADIUS, resolution=8, levels=1, label_value=7,
                                  start_center_offset=(3, 0, 0), start_scale=0.5, maximum_iterations=0)
        self.assertEqual(len(result.points), 6 * 8 * 8)
        self.assertEqual(result.labels.max(), 7)
        numpy.testing.assert_allclose(result.points.mean(axis=0), numpy.add(SEED, (3, 0, 0)))
        numpy.testing.assert_allclose(numpy.linalg.norm(result.points - numpy.add(SEED, (3, 0, 0)), axis=1),
                                      RADIUS / 2)

    def test_presets(self):
        published, naive = (flipfree.default_parameters(preset) for preset in ("published", "naive"))
        self.assertEqual([(preset["guard"], preset["avoid_flips"]) for preset in (published, naive)],
                         [(False, True), (False, False)])
        result = flipfree.segment(image(), SEED, RADIUS, preset="naive", maximum_iterations=5,
                                  resolution=16)
        self.assertEqual(len(result.iterations["Iteration"]), 5)
        self.assertEqual(len(result.points), 6 * 16 * 16)

    def test_are_in_the_help(self):
        self.assertRegex(flipfree.segment.__doc__, "minimum_component_weight\n        Components of ")


if __name__ == "__main__":
    unittest.main()
