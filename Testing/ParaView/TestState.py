"""What a session leaves behind gives the same result again: state files, Python states, and traces."""

import session
from paraview import servermanager, simple, smstate, smtrace
from session import points


def small_segmentation():
    phantom = simple.SegmentationPhantom(registrationName="Phantom", Shape="Cube")
    return simple.FlipFreeSegmentation(registrationName="Organ", Input=phantom, SeedCenter=[47.5, 46, 49],
                                       SeedRadius=14, Resolution=16, Levels=2, OpeningScale=0.3, KeepHistory=1)


class State(session.SessionTest):
    def check(self, expected):
        organ = simple.FindSource("Organ")
        self.assertIsNotNone(organ)
        self.assertEqual([list(organ.SeedCenter), organ.SeedRadius, organ.Resolution, organ.Levels,
                          organ.OpeningScale, organ.KeepHistory], [[47.5, 46, 49], 14, 16, 2, 0.3, 1])
        organ.UpdatePipeline(1000)  # later than the last iteration: the result
        self.assert_same(points(servermanager.Fetch(organ)), expected)

    def expected(self, organ):
        organ.UpdatePipeline(1000)
        return points(servermanager.Fetch(organ))

    def test_state_file(self):
        organ = small_segmentation()
        organ.StartSurface = simple.QuadSphere(Center=[47.5, 47.5, 47.5], Radius=13, Resolution=8)
        expected = self.expected(organ)
        simple.SaveState(self.file("state.pvsm"))
        simple.ResetSession()
        self.assertIsNone(simple.FindSource("Organ"))
        simple.LoadState(self.file("state.pvsm"))
        self.check(expected)

    def test_python_state(self):
        expected = self.expected(small_segmentation())
        state = smstate.get_state()
        self.assertIn("FlipFreeSegmentation(", state)
        simple.ResetSession()
        exec(compile(state, "state", "exec"), {})
        self.check(expected)

    def test_trace(self):
        smtrace.start_trace()
        organ = small_segmentation()
        trace = smtrace.get_current_trace_output()
        smtrace.stop_trace()
        self.assertIn("FlipFreeSegmentation(registrationName='Organ'", trace)
        expected = self.expected(organ)
        simple.ResetSession()
        exec(compile(trace, "trace", "exec"), {})
        self.check(expected)


if __name__ == "__main__":
    session.main()
