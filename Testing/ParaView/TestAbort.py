"""Progress is seen, by the filter's observers and by ParaView, and an abort stops a segmentation at its next report,
with empty outputs and a reason. ParaView 5.11 has no abort of its own: the button beside its progress bar stays
disabled."""

import time

import session
from paraview import servermanager
from session import points


class Abort(session.SessionTest):
    def setUp(self):
        super().setUp()
        image = session.abdomen()
        image.UpdatePipeline()
        self.organ = session.segmentation(image, Resolution=32)
        self.organ.UpdateVTKObjects()
        self.filter = self.organ.GetClientSideObject()
        self.assertTrue(self.filter.IsA("vtkFlipFreeSegmentation"))
        self.reports = []
        self.observe(self.filter, lambda: self.reports.append(self.filter.GetProgress()))

    def observe(self, observed, call, priority=0.0):
        tag = observed.AddObserver("ProgressEvent", lambda *_: call(), priority)
        self.addCleanup(observed.RemoveObserver, tag)
        return tag

    def assert_aborted(self, reports):
        """Nothing came out, and hardly a report after so many; whenever ParaView asks again, VTK adds a 0 and a 1."""
        self.assertEqual(servermanager.Fetch(self.organ).GetNumberOfPoints(), 0)
        self.organ.UpdatePropertyInformation()
        self.assertEqual(self.organ.StopReason, "aborted")
        self.assertLessEqual(len([report for report in self.reports[reports:] if 0 < report < 1]), 1, self.reports)

    def assert_runs(self):
        self.filter.SetAbortExecute(0)
        self.organ.Resolution = 16
        self.organ.UpdatePipeline()
        self.assertEqual(len(points(servermanager.Fetch(self.organ))), 6 * 16 * 16)
        self.organ.UpdatePropertyInformation()
        self.assertEqual(self.organ.StopReason, "at rest")

    def test_progress_rises_to_the_end(self):
        self.organ.UpdatePipeline()
        self.assertGreater(len(self.reports), 20)
        self.assertEqual(self.reports, sorted(self.reports))
        self.assertEqual(self.reports[-1], 1)

    def test_abort(self):
        asked = []

        def abort():
            if self.filter.GetProgress() > 0.3 and not asked:
                asked.append(len(self.reports))
                self.filter.SetAbortExecute(1)

        tag = self.observe(self.filter, abort)
        self.organ.UpdatePipeline()
        self.assertEqual(len(asked), 1, self.reports)
        self.assert_aborted(asked[0])

        # And it can be run again.
        self.filter.RemoveObserver(tag)
        self.assert_runs()


class InParaView(Abort):
    """The same as ParaView's progress bar is told it, in percent."""

    def setUp(self):
        super().setUp()
        self.progress = session.Progress("vtkFlipFreeSegmentation")
        self.addCleanup(self.progress.remove)
        # ParaView passes over what comes within a hundredth of a second of the last one.
        self.observe(self.filter, lambda: time.sleep(0.02), 1.0)

    def test_progress_rises_to_the_end(self):
        self.organ.UpdatePipeline()
        told = self.progress.told
        self.assertGreater(len(told), 20)
        self.assertEqual(told, sorted(told))
        self.assertEqual(told[-1], 100)

    def test_abort(self):
        asked = []

        def abort():
            if self.progress.told and self.progress.told[-1] > 30 and not asked:
                asked.append(len(self.reports))
                self.filter.SetAbortExecute(1)

        tag = self.observe(self.progress.handler, abort)
        self.organ.UpdatePipeline()
        self.assertEqual(len(asked), 1, self.progress.told)
        self.assert_aborted(asked[0])
        self.progress.handler.RemoveObserver(tag)
        self.assert_runs()


if __name__ == "__main__":
    session.main()
