"""Client and server as two processes: pvserver on the loopback, with the plugin on both sides."""

import os
import socket
import subprocess
import threading

import session
from paraview import servermanager, simple
from session import column, fetch, points, voxels

PVSERVER = os.path.join(os.environ["FLIPFREE_BUILD"] + "-prefix", "usr", "bin", "pvserver")

# The server tells a client of each report, of which it else passes over those within a tenth of a second of the last.
TELL_ALL = """
from paraview.servermanager import vtkProcessModule
handler = vtkProcessModule.GetProcessModule().GetSession().GetProgressHandler()
handler.SetProgressInterval(handler.GetProgressIntervalMinValue())
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Server:
    """A pvserver, of which a thread reads what it says, to its end."""

    def __init__(self):
        self.port = free_port()
        self.said = []
        self.turned = threading.Event()  # ready, or at its end
        self.process = subprocess.Popen([PVSERVER, f"--server-port={self.port}", "--force-offscreen-rendering"],
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                        text=True)
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        with self.process.stdout as output:
            for line in output:
                self.said.append(line)
                if "Accepting connection" in line:
                    self.turned.set()
        self.turned.set()

    def text(self):
        return "".join(self.said)


class ClientServer(session.SessionTest):
    @classmethod
    def setUpClass(cls):
        alone = session.segmentation(session.abdomen(), Resolution=16)
        cls.expected = [points(fetch(alone)), voxels(fetch(alone, 1)), column(fetch(alone, 2), "MeanDistance")]

        server = Server()
        server.turned.wait(120)
        if "Accepting connection" not in server.text():
            server.process.kill()
            raise AssertionError(f"pvserver does not answer; it said: {server.text()}")
        simple.Connect("127.0.0.1", server.port)
        # From here on it ends with this process, which would complain if it ended before.
        plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager()
        if not plugins.FulfillPluginRequirements(servermanager.ActiveConnection.Session, True):
            raise AssertionError(f"the server has another set of plugins; it said: {server.text()}")

    def setUp(self):
        super().setUp()
        self.assertTrue(servermanager.ActiveConnection.IsRemote())

    def test_same_surface_as_without_a_server(self):
        remote = session.segmentation(session.abdomen(), Resolution=16, KeepHistory=1)
        self.assertIsNone(remote.GetClientSideObject())  # it is the server's
        remote.UpdatePipeline(1000)
        self.assert_same(points(servermanager.Fetch(remote)), self.expected[0])
        self.assert_same(voxels(servermanager.Fetch(remote, idx=1)), self.expected[1])
        self.assert_same(column(servermanager.Fetch(remote, idx=2), "MeanDistance"), self.expected[2])
        remote.UpdatePipelineInformation()
        self.assertEqual(list(remote.TimestepValues), list(range(1, len(self.expected[2]) + 1)))
        remote.UpdatePropertyInformation()
        self.assertEqual([remote.StopReason, remote.NumberOfSelfIntersections], ["converged", 0])

    def test_progress_reaches_the_client(self):
        simple.ProgrammableSource(Script=TELL_ALL).UpdatePipeline()
        image = simple.SegmentationPhantom(Shape="Abdomen")  # of its own, finer voxels: ParaView leaves out quick reports
        image.UpdatePipeline()
        remote = session.segmentation(image, Resolution=16)
        progress = session.Progress("vtkFlipFreeSegmentation")
        self.addCleanup(progress.remove)
        remote.UpdatePipeline()
        self.assertGreater(len(progress.told), 10)
        self.assertEqual(progress.told, sorted(progress.told))
        self.assertEqual(progress.told[-1], 100)


if __name__ == "__main__":
    session.main()
