"""A window in which one drags a sphere into an organ and watches the surface grow.

    python3 live_window.py                         # the built-in phantom
    python3 live_window.py ct.nii.gz --seed 83 -154 321 --radius 26

Drag the sphere with the left button, size it with the right one; when it is let go, the surface
grows from it. Drag beside it to turn the view; q ends. With --picture, the surface grows from the
seed without anybody at the mouse, and the window is saved once it is at rest.
"""

import flipfree
import inputs
import scene
from growth import Growth
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkInteractionWidgets import vtkSphereRepresentation, vtkSphereWidget2
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor

MILLISECONDS = 30  # between two iterations, in which the window listens to the mouse


class LiveWindow:
    """Three views: space with the sphere, and two slices through its center."""

    def __init__(self, image, seed, radius):
        self.image = image
        self.growth = None
        # All views show this one object; a new iterate gets to them by being copied into it.
        self.surface = vtkPolyData()
        self.slices = []

        self.space = scene.space_view([scene.surface_actor(self.surface, edges=True)])
        self.words = scene.text_actor("drag the sphere into an organ")
        self.space.AddViewProp(self.words)
        self.planes = {scene.AXIAL: scene.slice_view([], image, scene.AXIAL, margin=1.05),
                       scene.CORONAL: scene.slice_view([], image, scene.CORONAL, margin=1.05)}
        self.window = scene.open_window(self.space, self.planes.values(), 0.66)

        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        self.interactor.Initialize()
        self.widget = self._widget(seed, radius)
        self.show_slices()
        self.space.ResetCamera(image.GetBounds())
        self.space.GetActiveCamera().Zoom(1.5)
        self.window.Render()

        self.widget.AddObserver("StartInteractionEvent", lambda *_: self.stop())
        self.widget.AddObserver("EndInteractionEvent", lambda *_: self.begin())
        self.interactor.AddObserver("TimerEvent", lambda *_: self.step())
        self.interactor.CreateRepeatingTimer(MILLISECONDS)

    def _widget(self, seed, radius):
        sphere = vtkSphereRepresentation()
        sphere.SetPlaceFactor(1)
        sphere.PlaceWidget([seed[0] - radius, seed[0] + radius, seed[1] - radius, seed[1] + radius,
                            seed[2] - radius, seed[2] + radius])
        sphere.SetRepresentationToWireframe()
        sphere.GetSphereProperty().SetColor(scene.YELLOW)
        sphere.GetSphereProperty().SetOpacity(0.5)
        sphere.HandleVisibilityOff()
        sphere.HandleTextOff()
        sphere.RadialLineOff()
        widget = vtkSphereWidget2()
        widget.SetInteractor(self.interactor)
        widget.SetDefaultRenderer(self.space)
        widget.SetRepresentation(sphere)
        widget.On()
        return widget

    def seed(self):
        """Center and radius of the sphere, where it is now."""
        center = [0.0] * 3
        sphere = self.widget.GetRepresentation()
        sphere.GetCenter(center)
        return center, sphere.GetRadius()

    def stop(self):
        """Nothing grows while the sphere is dragged."""
        self.growth = None
        self.surface.Initialize()

    def begin(self):
        """Starts from where the sphere has been let go."""
        self.show_slices()
        self.growth = Growth(self.image, *self.seed())

    def step(self):
        """One iteration, each time the timer rings."""
        if self.growth is None or self.growth.is_at_rest():
            return
        try:
            done = self.growth.step()
        except flipfree.FlipFreeError as error:  # a sphere outside the image, say
            self.stop()
            self.say(str(error))
        else:
            self.surface.ShallowCopy(self.growth.surface)
            self.say(f"{self.surface.GetNumberOfPoints()} vertices, on average "
                     f"{done.mean_distance:.1f} mm from their targets")
        self.window.Render()

    def say(self, words):
        """Below the view into space."""
        self.words.SetInput(words)

    def show_slices(self):
        """Moves all slices to the sphere's center."""
        for renderer, actor in self.slices:
            renderer.RemoveActor(actor)
        self.slices = []
        center, _ = self.seed()
        for plane, renderer in self.planes.items():
            picture = scene.slice_actor(self.image, center, plane, samples=200)
            contour = scene.contour_actor(self.surface, center, plane, width=1)
            for view, actor in ((renderer, picture), (self.space, picture), (renderer, contour)):
                view.AddActor(actor)
                self.slices.append((view, actor))
            renderer.ResetCameraClippingRange()

    def run(self):
        """Until the window is closed."""
        self.begin()
        self.interactor.Start()

    def grow(self):
        """All iterations, one behind the other."""
        self.begin()
        while self.growth is not None and not self.growth.is_at_rest():
            self.step()

    def save(self, picture):
        """What the window shows, as PNG."""
        scene.save_window(self.window, picture)


if __name__ == "__main__":
    arguments = inputs.parse(__doc__)
    live = LiveWindow(*inputs.image_and_seed(arguments))
    if arguments.picture:
        live.grow()
        live.save(arguments.picture)
        print(live.words.GetInput())
    else:
        live.run()
