"""A window in which one drags a sphere into an organ and watches the surface grow.

    python3 live_window.py                         # the built-in phantom
    python3 live_window.py ct.nii.gz --seed 83 -154 321 --radius 26

Drag the sphere with the left button, size it with the right one; when it is let go, the surface
grows from it. Drag beside it to turn the view; q ends. With --picture, the surface grows from the
seed without anybody at the mouse, and the window is saved once it has converged.
"""

import flipfree
import inputs
import scene
from growth import Growth
from three_views import ThreeViews
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
        self.views = ThreeViews(image, self.surface, 0.66, 1.5)
        self.say("drag the sphere into an organ")

        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.views.window)
        self.interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        self.interactor.Initialize()
        self.widget = self._widget(seed, radius)
        self.show_slices()
        self.views.window.Render()

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
        widget.SetDefaultRenderer(self.views.space)
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
        if self.growth is None or self.growth.has_converged():
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
        self.views.window.Render()

    def say(self, words):
        """Below the view into space."""
        self.views.words.SetInput(words)

    def show_slices(self):
        """Moves all slices to the sphere's center."""
        self.views.show_slices(self.seed()[0])

    def run(self):
        """Until the window is closed."""
        self.begin()
        self.interactor.Start()

    def grow(self):
        """All iterations, one behind the other."""
        self.begin()
        while self.growth is not None and not self.growth.has_converged():
            self.step()


if __name__ == "__main__":
    arguments = inputs.parse(__doc__)
    live = LiveWindow(*inputs.image_and_seed(arguments))
    if arguments.picture:
        live.grow()
        live.views.save(arguments.picture)
        print(live.views.words.GetInput())
    else:
        live.run()
