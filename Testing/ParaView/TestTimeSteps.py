"""With the history kept, iterations are time steps: the animation plays them, and the last one is the result."""

import numpy
import session
from paraview import servermanager, simple
from session import column, fetch, points


class TimeSteps(session.SessionTest):
    def setUp(self):
        super().setUp()
        phantom = simple.SegmentationPhantom(Shape="Sphere")
        self.sphere = simple.FlipFreeSegmentation(Input=phantom, SeedCenter=[47.5, 47.5, 47.5], SeedRadius=15,
                                                  Resolution=16, Levels=1, MaximumIterations=6, ChangeTolerance=-1,
                                                  Carving=0)

    def radius_at(self, time):
        self.sphere.UpdatePipeline(time)
        distances = numpy.linalg.norm(points(servermanager.Fetch(self.sphere)) - 47.5, axis=1)
        return distances.mean()

    def test_each_iteration_is_one_if_the_history_is_kept(self):
        result = points(fetch(self.sphere))
        self.sphere.UpdatePipelineInformation()
        self.assertEqual(len(self.sphere.TimestepValues), 0)
        self.sphere.KeepHistory = 1
        rows = column(fetch(self.sphere, 2), "Iteration")
        self.sphere.UpdatePipelineInformation()
        times = list(self.sphere.TimestepValues)
        self.assertEqual(times, list(rows))
        self.assertEqual(len(times), 6)
        radii = [self.radius_at(time) for time in times]
        self.assertGreater(numpy.diff(radii[:3]).min(), 0.2)  # it grows
        self.assertAlmostEqual(radii[-1], 30, delta=0.5)
        self.sphere.UpdatePipeline(times[-1])
        self.assert_same(points(servermanager.Fetch(self.sphere)), result)

    def test_going_to_and_fro_does_not_run_again(self):
        self.sphere.KeepHistory = 1
        self.sphere.UpdatePipeline(1)
        self.sphere.UpdatePropertyInformation()
        seconds = list(self.sphere.StageSeconds)
        self.assertGreater(sum(seconds), 0)
        for time in (6, 3, 1, 5):
            self.sphere.UpdatePipeline(time)
        self.sphere.UpdatePropertyInformation()
        self.assertEqual(list(self.sphere.StageSeconds), seconds)

    def test_the_animation_plays_them(self):
        self.sphere.KeepHistory = 1
        view = self.view()
        simple.Show(self.sphere, view)
        simple.Render(view)
        scene = simple.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        self.assertEqual([scene.StartTime, scene.EndTime], [1, 6])
        scene.GoToFirst()
        first = self.radius_at(view.ViewTime)
        scene.GoToLast()
        self.assertEqual(view.ViewTime, 6)
        self.assertGreater(self.radius_at(view.ViewTime), first + 2)


if __name__ == "__main__":
    session.main()
