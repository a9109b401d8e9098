"""Progress is reported to the filter's observers and to ParaView, and an abort stops a segmentation at its next report,
with empty outputs and a reason. ParaView 5.11 cannot abort itself: the button beside its progress bar stays disabled."""

import time

import session
from paraview import servermanager


class Abort(session.SessionTest):
    def setUp(self):
        super().setUp()
        image = session.abdomen()
        image.UpdatePipeline()
        self.organ = session.segmentation(image, Resolution=16)
        self.organ.UpdateVTKObjects()
        self.filter = self.organ.GetClientSideObject()
        self.assertTrue(self.filter.IsA("vtkFlipFreeSegmentation"))
        self.reports = []
        self.observe(lambda: self.reports.append(self.filter.GetProgress()))

    def observe(self, call):
        tag = self.filter.AddObserver("ProgressEvent", lambda *_: call())
        self.addCleanup(self.filter.RemoveObserver, tag)
        return tag

    def assert_ended(self, vertices, reason):
        self.assertEqual(servermanager.Fetch(self.organ).GetNumberOfPoints(), vertices)
        self.organ.UpdatePropertyInformation()
        self.assertEqual(self.organ.StopReason, reason)

    def test_progress_rises_to_the_end(self):
        progress = session.Progress("vtkFlipFreeSegmentation")
        self.addCleanup(progress.remove)
        # ParaView passes over reports within a hundredth of a second.
        self.observe(lambda: time.sleep(0.02))
        self.organ.UpdatePipeline()
        for told, end in ((self.reports, 1), (progress.told, 100)):
            self.assertGreater(len(told), 20)
            self.assertEqual(told, sorted(told))
            self.assertEqual(told[-1], end)

    def test_abort_and_run_again(self):
        asked = []

        def abort():
            if self.filter.GetProgress() > 0.3 and not asked:
                asked.append(len(self.reports))
                self.filter.SetAbortExecute(1)

        tag = self.observe(abort)
        self.organ.UpdatePipeline()
        self.assertEqual(len(asked), 1, self.reports)
        self.assert_ended(0, "aborted")
        # Hardly a report follows; whenever ParaView asks again, VTK adds a 0 and a 1.
        self.assertLessEqual(len([report for report in self.reports[asked[0]:] if 0 < report < 1]), 1, self.reports)

        self.filter.RemoveObserver(tag)
        self.filter.SetAbortExecute(0)
        self.organ.Resolution = 8
        self.organ.UpdatePipeline()
        self.assert_ended(6 * 8 * 8, "converged")


if __name__ == "__main__":
    session.main()
