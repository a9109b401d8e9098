"""What a session leaves behind gives the same result again: state files, Python states, and traces."""

import session
from paraview import servermanager, simple, smstate, smtrace
from session import points


# Parameters of each stage, which are properties of sub-proxies.
STAGES = {"DiffusionIterations": 4, "OpeningScale": 0.3, "EdgeWindow": 2, "Fairing": 0.1}


def small_segmentation():
    phantom = simple.SegmentationPhantom(registrationName="Phantom", Shape="Cube")
    return simple.FlipFreeSegmentation(registrationName="Organ", Input=phantom, SeedCenter=[47.5, 46, 49],
                                       SeedRadius=14, Resolution=16, Levels=2, KeepHistory=1, **STAGES)


class State(session.SessionTest):
    def check(self, expected):
        organ = simple.FindSource("Organ")
        self.assertIsNotNone(organ)
        self.assertEqual([list(organ.SeedCenter), organ.SeedRadius, organ.Resolution, organ.Levels, organ.KeepHistory],
                         [[47.5, 46, 49], 14, 16, 2, 1])
        self.assertEqual({name: getattr(organ, name) for name in STAGES}, STAGES)
        organ.UpdatePipeline(1000)  # later than the last iteration: the result
        self.assert_same(points(servermanager.Fetch(organ)), expected)

    def expected(self, organ):
        organ.UpdatePipeline(1000)
        return points(servermanager.Fetch(organ))

    def test_state_file(self):
        organ = small_segmentation()
        organ.StartSurface = simple.QuadSphere(Center=[47.5, 47.5, 47.5], Radius=13, Resolution=8)
        expected = self.expected(organ)
        organ.Fairing = 0.5  # makes the method run again
        self.assertGreater(abs(self.expected(organ) - expected).max(), 0.01)
        organ.Fairing = STAGES["Fairing"]
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
