"""Readers and writer: found by their file names, with orientation, and without getting in the way of ParaView's own."""

import math
import os
import sys

import numpy
import session
from paraview import servermanager, simple
from session import fetch, voxels

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Support"))

import dicom  # pylint: disable=wrong-import-position

# Oblique and left-handed.
TURN = math.radians(25)
DIRECTION = [math.cos(TURN), -math.sin(TURN), 0, math.sin(TURN), math.cos(TURN), 0, 0, 0, -1]


def geometry(image):
    matrix = image.GetDirectionMatrix()
    direction = [matrix.GetElement(row, column) for row in range(3) for column in range(3)]
    return [*image.GetOrigin(), *image.GetSpacing(), *direction]


def readers():
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    if factory.GetNumberOfRegisteredPrototypes() == 0:
        factory.UpdateAvailableReaders()
    return factory


class Files(session.SessionTest):
    def setUp(self):
        super().setUp()
        self.phantom = simple.SegmentationPhantom(Shape="Sphere", Dimensions=[24, 20, 16], Spacing=[1, 1.25, 2],
                                                  Origin=[-10, 7, 30], Direction=DIRECTION)
        self.image = fetch(self.phantom)

    def test_orientation_survives(self):
        self.assertEqual(geometry(self.image)[6:], DIRECTION)
        for ending in ("nii", "nii.gz", "nrrd", "mha"):
            with self.subTest(ending=ending):
                name = self.file("volume." + ending)
                simple.SaveData(name, proxy=self.phantom)
                read = fetch(simple.MedicalImageReader(FileName=name))
                self.assert_same(voxels(read), voxels(self.image))
                for value, expected in zip(geometry(read), geometry(self.image)):
                    self.assertAlmostEqual(value, expected, 5 if "nii" in ending else 12)

    def test_label_map_is_written(self):
        name = self.file("labels.nii.gz")
        simple.SaveData(name, proxy=simple.OutputPort(self.phantom, 1))
        self.assertEqual(os.listdir(self.folder), ["labels.nii.gz"])
        read = fetch(simple.OpenDataFile(name))
        self.assertEqual(read.GetScalarTypeAsString(), "unsigned char")
        self.assert_same(voxels(read), voxels(fetch(self.phantom, 1)))

    def test_paraviews_own_readers_and_writers_stay_the_first(self):
        for ending, reader in (("nii", "OrientedImageReader"), ("mha", "MetaImageReader"), ("mhd", "MetaImageReader"),
                               ("nrrd", "NrrdReader")):
            name = self.file("volume." + ending)
            simple.SaveData(name, proxy=self.phantom)
            self.assertEqual(simple.OpenDataFile(name).GetXMLName(), reader)
        self.assertIn("volume.zraw", os.listdir(self.folder))  # ParaView's, beside the mhd

    def test_file_dialogs_offer_them(self):
        offered = readers().GetSupportedFileTypes(servermanager.ActiveConnection.Session)
        self.assertIn("Medical Images with Orientation (FlipFree) (*.nii *.nii.gz *.nrrd *.nhdr *.mha *.mhd)", offered)
        self.assertIn("Meta Image Files", offered)
        writers = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
        writers.UpdateAvailableWriters()
        self.assertIn("Medical Image with Orientation (FlipFree)",
                      writers.GetSupportedFileTypes(self.phantom.SMProxy, 0))

    def test_a_folder_is_a_dicom_series(self):
        volume = numpy.arange(5 * 6 * 8).reshape(5, 6, 8) - 100
        uid = "1.2.826.0.1.3680043.2.1143.78"
        dicom.write_series(self.folder, volume, (0.75, 0.5, 3), (-20, 12, 40), uid)
        self.assertTrue(readers().CanReadFile(self.folder, servermanager.ActiveConnection.Session))
        reader = simple.OpenDataFile(self.folder)
        self.assertEqual(reader.GetXMLName(), "FlipFreeDicomSeriesReader")
        read = fetch(reader)
        self.assert_same(voxels(read), volume.ravel())
        self.assertEqual(geometry(read)[:6], [-20, 12, 40, 0.75, 0.5, 3])
        reader.UpdatePropertyInformation()
        self.assertEqual(reader.ChosenSeriesUID, uid)

    def test_a_file_of_no_kind_is_nobodys(self):
        with open(self.file("volume.unknown"), "wb"):
            pass
        self.assertFalse(readers().CanReadFile(self.file("volume.unknown"), servermanager.ActiveConnection.Session))


if __name__ == "__main__":
    session.main()
