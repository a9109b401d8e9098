"""A window of three views: space with a surface, and two slices with its contour."""

import scene
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkCellPicker, vtkPolyDataMapper

BALL_RADIUS = 4  # mm


class ThreeViews:
    """The view into space has that share of the window's width."""

    def __init__(self, image, surface, share, zoom):
        self.image = image
        self.surface = surface
        self.place = image.GetCenter()  # that the slices go through
        self.surface_shown = scene.surface_actor(surface, edges=True)
        self.space = scene.space_view([self.surface_shown], bounds=image.GetBounds(), zoom=zoom)
        self.words = scene.text_actor("")
        self.space.AddViewProp(self.words)
        self.planes = {plane: scene.slice_view([], image, plane, margin=1.05)
                       for plane in (scene.AXIAL, scene.CORONAL)}
        self.pictures = {}  # the slices' gray values
        self.marks = []
        self.shown = {"slices": [], "marks": [], "mask": []}
        self.window = scene.open_window(self.space, self.planes.values(), share)

    def show_slices(self, place):
        """Moves both slices to a place."""
        self.place = tuple(place)
        shown = []
        for plane, renderer in self.planes.items():
            self.pictures[plane] = scene.slice_actor(self.image, self.place, plane, samples=200)
            contour = scene.contour_actor(self.surface, self.place, plane, width=1)
            shown += [(renderer, self.pictures[plane]), (self.space, self.pictures[plane]),
                      (renderer, contour)]
        self._show("slices", shown)
        self._show("mask", [])
        self.show_marks(self.marks)

    def move_slice(self, plane, voxels):
        """Moves one slice by so many voxels."""
        axis = _axis(plane)
        low, high = self.image.GetBounds()[2 * axis:2 * axis + 2]
        place = list(self.place)
        place[axis] = min(max(place[axis] + voxels * self.image.GetSpacing()[axis], low), high)
        self.show_slices(place)

    def show_marks(self, marks):
        """Tuples of a place, a color, a letter or None for a ball, and the reach in mm.

        Slices that are farther from the place do not show it.
        """
        self.marks = marks
        shown = []
        for place, color, letter, reach in marks:
            views = [self.space]
            for plane, renderer in self.planes.items():
                distance = abs(place[_axis(plane)] - self.place[_axis(plane)])
                views += [renderer] if distance < max(reach, BALL_RADIUS) else []
            # A letter knows only one view's coordinates.
            shown += [(view, letter_at(place, letter, color) if letter else _ball(place, color))
                      for view in views]
        self._show("marks", shown)

    def show_mask(self, mask, color):
        """Voxels in the slices, in place of those shown before; None for none."""
        planes = self.planes.items() if mask else ()
        self._show("mask", [(renderer, scene.mask_actor(mask, self.place, plane, color))
                            for plane, renderer in planes])

    def slice_at(self, pixel):
        """The slice that a pixel is in, if any."""
        return next((plane for plane, renderer in self.planes.items()
                     if renderer.IsInViewport(*pixel)), None)

    def pick(self, pixel):
        """The place on a slice or, in space, on the surface that a pixel shows; None for none."""
        plane = self.slice_at(pixel)
        picker = vtkCellPicker()
        picker.SetTolerance(0)
        picker.PickFromListOn()
        for actor in [self.pictures[plane]] if plane else [self.surface_shown,
                                                           *self.pictures.values()]:
            picker.AddPickList(actor)
        renderer = self.planes[plane] if plane else self.space
        return picker.GetPickPosition() if picker.Pick(*pixel, 0, renderer) else None

    def save(self, picture):
        """What the window shows, as PNG."""
        scene.save_window(self.window, picture)

    def _show(self, kind, shown):
        for renderer, prop in self.shown[kind]:
            renderer.RemoveViewProp(prop)
        self.shown[kind] = shown
        for renderer, prop in shown:
            renderer.AddViewProp(prop)
            renderer.ResetCameraClippingRange()


def _axis(plane):
    """Across a slice."""
    return 2 if plane == scene.AXIAL else 1


def _ball(place, color):
    source = vtkSphereSource()
    source.SetCenter(place)
    source.SetRadius(BALL_RADIUS)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(color)
    return actor


def letter_at(place, letter, color):
    """Nothing hides it."""
    actor = scene.text_actor(letter, color, 26)
    actor.GetPositionCoordinate().SetCoordinateSystemToWorld()
    actor.GetPositionCoordinate().SetValue(place)
    look = actor.GetTextProperty()
    look.SetJustificationToCentered()
    look.SetVerticalJustificationToCentered()
    look.BoldOn()
    look.ShadowOn()
    look.SetBackgroundOpacity(0)  # the tissue there is what one judges
    return actor
