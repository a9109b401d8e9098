"""Points with handles correct a segmentation: connected to the filters, any number of them, moved, switched off and on,
and kept in a state; and the macro that makes them."""

import importlib.machinery
import os

import session
from paraview import servermanager, simple
from session import RADIUS, SEED, fetch, points

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "ParaView")
# Two places in the phantom's ball, of a radius of 30 mm: one to become its boundary, the other to be given up.
WITHIN, BESIDE = [47.5, 47.5, 70], [70, 47.5, 47.5]
# And one in the abdomen's liver.
IN_LIVER = [60, 83, 168]


def macro():
    path = os.path.join(EXAMPLES, "correct-organ.py")
    return importlib.machinery.SourceFileLoader("correct_organ", path).load_module()


def label_at(organ, place):
    labels = fetch(organ, 1)
    return labels.GetPointData().GetScalars().GetTuple1(labels.FindPoint(place))


class ConstraintPoints(session.SessionTest):
    def organ(self, **properties):
        phantom = simple.SegmentationPhantom(Shape="Sphere")
        return simple.FlipFreeSegmentation(Input=phantom, SeedCenter=[47.5, 47.5, 47.5], SeedRadius=13, Resolution=8,
                                           Levels=2, **properties)

    def test_each_is_obeyed_in_any_order(self):
        organ = self.organ()
        free = points(fetch(organ))
        self.assertEqual([label_at(organ, place) for place in (WITHIN, BESIDE)], [1, 1])
        outside = simple.ConstraintPoint(Position=BESIDE)
        boundary = simple.ConstraintPoint(Position=WITHIN, Kind="Boundary")
        organ.Corrections = [outside, boundary]
        corrected = points(fetch(organ))
        self.assertEqual(label_at(organ, BESIDE), 0)
        self.assertGreater(abs(corrected - free).max(), 5)
        organ.Corrections = [boundary, outside]
        self.assert_same(points(fetch(organ)), corrected)
        organ.Corrections = [boundary]
        self.assertEqual(label_at(organ, BESIDE), 1)
        organ.Corrections = []
        self.assert_same(points(fetch(organ)), free)

    def test_kinds_are_values_of_the_array(self):
        point = simple.ConstraintPoint(Position=[1, 2, 3], Radius=7, Organ=2)
        for value, kind in enumerate(("Outside", "Inside", "Boundary", "Seed")):
            point.Kind = kind
            data = fetch(point)
            self.assertEqual(data.GetPoint(0), (1, 2, 3))
            arrays = [session.point_array(data, name)[0] for name in ("Constraint", "Radius", "Organ")]
            self.assertEqual(arrays, [value, 7 if kind == "Seed" else 0, 2])

    def test_handle_moves_the_point(self):
        organ = self.organ()
        point = simple.ConstraintPoint(Position=[10, 10, 10], Enabled=0)
        organ.Corrections = [point]
        free = points(fetch(organ))
        # The panel's widget, linked as the panel links it: dragged, it sets the property.
        handle = servermanager.ProxyManager().NewProxy("representations", "HandleWidgetRepresentation")
        view = self.view()
        view.SMProxy.GetProperty("HiddenRepresentations").AddProxy(handle)
        view.SMProxy.UpdateVTKObjects()
        link = servermanager.vtkSMPropertyLink()
        link.AddLinkedProperty(handle, "WorldPosition", servermanager.vtkSMLink.INPUT)
        link.AddLinkedProperty(point.SMProxy, "Position", servermanager.vtkSMLink.OUTPUT)
        for index, value in enumerate(BESIDE):
            handle.GetProperty("WorldPosition").SetElement(index, value)
        handle.UpdateVTKObjects()
        point.SMProxy.UpdateVTKObjects()
        self.assertEqual(list(point.Position), BESIDE)
        self.assert_same(points(fetch(organ)), free)
        point.Enabled = 1
        self.assertEqual(label_at(organ, BESIDE), 0)
        point.Enabled = 0
        self.assert_same(points(fetch(organ)), free)

    def test_group_takes_its_organs_from_points(self):
        def ball(organ, place, radius):
            return simple.ConstraintPoint(Kind="Seed", Organ=organ, Position=place, Radius=radius)

        # The spleen as `flipfree phantom abdomen` prints it for these voxels.
        liver, spleen = ball(1, SEED, RADIUS), ball(2, [253, 142.5, 137.5], 13.8)
        outside = simple.ConstraintPoint(Position=IN_LIVER)
        group = simple.FlipFreeOrganGroup(Input=session.abdomen(), Corrections=[outside, spleen, liver])
        self.assertEqual(session.column(fetch(group, 2), "Label").tolist(), [1, 2])
        self.assertEqual([label_at(group, place) for place in (SEED, spleen.Position, IN_LIVER)], [1, 2, 0])

    def test_vessel_is_corrected(self):
        vessel = simple.FlipFreeVesselSegmentation(Input=simple.SegmentationPhantom(Shape="Vessel"),
                                                   Points=[13.3, 44.6, 44.5, 82, 50.4, 37.6])
        line = fetch(vessel, 2)
        middle = line.GetNumberOfPoints() // 2
        reach = 0.8 * session.point_array(line, "Radius")[middle]
        place = (points(line)[middle] + [0, reach, 0]).tolist()  # beside the centerline, near the wall
        self.assertEqual(label_at(vessel, place), 1)
        vessel.Corrections = [simple.ConstraintPoint(Position=place)]
        self.assertEqual(label_at(vessel, place), 0)

    def test_state_keeps_points(self):
        organ = self.organ(registrationName="Organ")
        organ.Corrections = [simple.ConstraintPoint(Position=BESIDE),
                             simple.ConstraintPoint(Position=WITHIN, Kind="Inside")]
        expected = points(fetch(organ))
        simple.SaveState(self.file("state.pvsm"))
        simple.ResetSession()
        simple.LoadState(self.file("state.pvsm"))
        organ = simple.FindSource("Organ")
        self.assertEqual(len(organ.Corrections), 2)
        self.assert_same(points(fetch(organ)), expected)

    def test_macro_adds_a_point_to_the_selected_filter(self):
        example = macro()
        with self.assertRaisesRegex(RuntimeError, "select the segmentation .* there is none"):
            example.main()
        organ = self.organ()
        free = points(fetch(organ))
        view = self.view()
        view.CameraFocalPoint = BESIDE
        simple.SetActiveView(view)
        simple.SetActiveSource(organ)
        example.main()
        (point,) = organ.Corrections
        self.assertEqual(simple.GetActiveSource(), point)
        self.assertEqual(list(point.Position), BESIDE)
        self.assert_same(points(fetch(organ)), free)
        point.Enabled = 1
        self.assertEqual(label_at(organ, BESIDE), 0)
        example.add_point(organ, WITHIN, Kind="Inside")
        self.assertEqual(len(organ.Corrections), 2)
        other = self.organ()
        simple.SetActiveSource(None)
        with self.assertRaisesRegex(RuntimeError, "there are 2"):
            example.main()
        simple.Delete(other)

    def test_picture(self):
        """For the eye: the surface before and after, and the point."""
        folder = os.environ.get("FLIPFREE_GUI_PICTURES", self.folder)
        os.makedirs(folder, exist_ok=True)
        phantom = session.abdomen()
        liver = session.segmentation(phantom, Corrections=[simple.ConstraintPoint(Position=IN_LIVER)])
        free = session.segmentation(phantom)
        view = self.view()
        view.ViewSize = [700, 600]
        for source, color in ((free, [0.35, 0.65, 1]), (liver, [1, 0.76, 0.2])):
            cut = simple.Slice(Input=source)
            cut.SliceType.Origin = IN_LIVER
            cut.SliceType.Normal = [0, 0, 1]
            shown = simple.Show(cut, view)
            simple.ColorBy(shown, ("POINTS", ""))
            shown.AmbientColor = shown.DiffuseColor = color
            shown.LineWidth = 3
        cut = simple.Slice(Input=phantom)
        cut.SliceType.Origin = IN_LIVER
        cut.SliceType.Normal = [0, 0, 1]
        shown = simple.Show(cut, view)
        simple.ColorBy(shown, ("POINTS", "Intensity"))
        colors = simple.GetColorTransferFunction("Intensity")
        colors.ApplyPreset("Grayscale", True)
        colors.RescaleTransferFunction(-110, 240)
        handle = servermanager.ProxyManager().NewProxy("representations", "HandleWidgetRepresentation")
        for index, value in enumerate(IN_LIVER):
            handle.GetProperty("WorldPosition").SetElement(index, value)
        handle.GetProperty("Visibility").SetElement(0, 1)
        handle.UpdateVTKObjects()
        view.SMProxy.GetProperty("HiddenRepresentations").AddProxy(handle)
        view.SMProxy.UpdateVTKObjects()
        view.CameraParallelProjection = 1
        view.CameraViewUp = [0, -1, 0]
        view.CameraPosition = [IN_LIVER[0] + 40, IN_LIVER[1], IN_LIVER[2] - 500]
        view.CameraFocalPoint = [IN_LIVER[0] + 40, IN_LIVER[1], IN_LIVER[2]]
        view.CameraParallelScale = 110
        picture = os.path.join(folder, "constraint-point.png")
        simple.SaveScreenshot(picture, view)
        self.assertGreater(os.path.getsize(picture), 20000)
        self.assertEqual([label_at(organ, IN_LIVER) for organ in (free, liver)], [1, 0])


if __name__ == "__main__":
    session.main()
