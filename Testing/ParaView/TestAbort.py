"""Progress is seen, and an abort stops a segmentation within a moment, with empty outputs and a reason."""

import time

import session
from paraview import servermanager
from session import points


class Abort(session.SessionTest):
    def setUp(self):
        super().setUp()
        image = session.abdomen()
        image.UpdatePipeline()
        self.organ = session.segmentation(image, Resolution=64)
        self.organ.UpdateVTKObjects()
        self.filter = self.organ.GetClientSideObject()
        self.assertTrue(self.filter.IsA("vtkFlipFreeSegmentation"))

    def test_progress_rises_to_the_end(self):
        seen = []
        self.filter.AddObserver("ProgressEvent", lambda *_: seen.append(self.filter.GetProgress()))
        self.organ.UpdatePipeline()
        self.assertGreater(len(seen), 20)
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(seen[-1], 1)

    def test_abort(self):
        asked = []

        def abort(*_):
            if self.filter.GetProgress() > 0.3 and not asked:
                asked.append(time.monotonic())
                self.filter.SetAbortExecute(1)

        observer = self.filter.AddObserver("ProgressEvent", abort)
        self.organ.UpdatePipeline()
        seconds = time.monotonic() - asked[0]
        self.organ.UpdatePropertyInformation()
        self.assertEqual(self.organ.StopReason, "aborted")
        self.assertLess(seconds, 1)
        self.assertEqual(servermanager.Fetch(self.organ).GetNumberOfPoints(), 0)

        # And it can be run again.
        self.filter.RemoveObserver(observer)
        self.filter.SetAbortExecute(0)
        self.organ.Resolution = 16
        self.organ.UpdatePipeline()
        self.assertEqual(len(points(servermanager.Fetch(self.organ))), 6 * 16 * 16)
        self.organ.UpdatePropertyInformation()
        self.assertEqual(self.organ.StopReason, "at rest")


if __name__ == "__main__":
    session.main()
