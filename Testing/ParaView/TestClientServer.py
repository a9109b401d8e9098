"""Client and server as two processes: pvserver on the loopback, with the plugin on both sides."""

import os
import socket
import subprocess

import session
from paraview import servermanager, simple
from session import column, fetch, points, voxels

PVSERVER = os.path.join(os.environ["FLIPFREE_BUILD"] + "-prefix", "usr", "bin", "pvserver")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class ClientServer(session.SessionTest):
    def setUp(self):
        super().setUp()
        self.port = free_port()
        self.server = subprocess.Popen([PVSERVER, f"--server-port={self.port}", "--force-offscreen-rendering"],
                                       stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                       text=True)
        self.addCleanup(self.stop_server)
        for line in self.server.stdout:
            if "Accepting connection" in line:
                break

    def stop_server(self):
        """Connected, it ends with this process, which would complain if it ended before."""
        if not servermanager.ActiveConnection.IsRemote():
            self.server.terminate()
            self.server.wait(20)
        self.server.stdout.close()

    def test_same_surface_as_without_a_server(self):
        alone = session.segmentation(session.abdomen(), Resolution=16)
        expected = [points(fetch(alone)), voxels(fetch(alone, 1)), column(fetch(alone, 2), "MeanDistance")]

        simple.Connect("127.0.0.1", self.port)
        self.assertTrue(servermanager.ActiveConnection.IsRemote())
        plugins = servermanager.vtkSMProxyManager.GetProxyManager().GetPluginManager()
        self.assertTrue(plugins.FulfillPluginRequirements(servermanager.ActiveConnection.Session, True))
        remote = session.segmentation(session.abdomen(), Resolution=16, KeepHistory=1)
        self.assertIsNone(remote.GetClientSideObject())  # it is the server's
        remote.UpdatePipeline(1000)
        self.assert_same(points(servermanager.Fetch(remote)), expected[0])
        self.assert_same(voxels(servermanager.Fetch(remote, idx=1)), expected[1])
        self.assert_same(column(servermanager.Fetch(remote, idx=2), "MeanDistance"), expected[2])
        remote.UpdatePipelineInformation()
        self.assertEqual(list(remote.TimestepValues), list(range(1, len(expected[2]) + 1)))
        remote.UpdatePropertyInformation()
        self.assertEqual([remote.StopReason, remote.NumberOfSelfIntersections], ["at rest", 0])


if __name__ == "__main__":
    session.main()
