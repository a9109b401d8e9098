"""Draws Figures 1 to 6 of the paper with FlipFree.

    python3 paper_figures.py figures                  # phantoms
    python3 paper_figures.py figures --data FOLDER    # real volumes where the folder has them
    python3 paper_figures.py figures --only 3 --only 4
    python3 paper_figures.py figures --methods build/dev/bin/RunMethod

With `--methods`, Figure 5 also shows what the methods find that FlipFree is compared with. They are no part of the
package: the program is built in the source folder, with the tests or the benchmarks.

The folder has a table cases.csv with the columns organ, role, image, labels, label_id, seed_x,
seed_y, seed_z and radius_mm, and the volumes that it names. Figure 5 takes the first liver of it;
Figure 6 the first spleen, and the first row of the role `tubular`.
"""

import argparse
import csv
import functools
import subprocess
import tempfile
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import flipfree
import inputs
import numpy as np
import scene
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData, vtkTable
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkWindowedSincPolyDataFilter
from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401
from vtkmodules.vtkRenderingContext2D import vtkContextActor
from vtkmodules.vtkRenderingCore import vtkRenderer

# Some surfaces intersect themselves on purpose.
warnings.simplefilter("ignore", flipfree.FlipFreeWarning)

SAND = (0.95, 0.90, 0.80)
PATTERN_BLUE = (0.25, 0.45, 0.68)
GREEN = (0.45, 0.75, 0.50)
FROM_ABOVE = (-2, -3, 3.5)  # into the cup


# What is segmented.

@dataclass
class Case:
    """An organ in a volume, its seed, and what is known about it."""

    name: str
    image: vtkImageData
    seed: list
    radius: float
    truth: vtkImageData
    label: int
    parameters: dict = field(default_factory=dict)


@functools.lru_cache(maxsize=None)  # several figures show the abdomen
def phantom_of(shape):
    source = flipfree.vtkPhantomSource()
    source.SetShape(shape)
    source.Update()
    return source


def phantom_case(name, shape, label, **parameters):
    source = phantom_of(shape)
    return Case(f"{name} (phantom)", source.GetOutput(), *inputs.seed_in(source, label),
                source.GetLabelMap(), label, parameters)


def real_case(folder, column, wanted):
    """The first row of the table with such a value; none without a folder."""
    if folder is None:
        return None
    with open(folder / "cases.csv", newline="", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            if row[column] == wanted:
                return Case(row["organ"], flipfree.read_image(folder / row["image"]),
                            [float(row[f"seed_{axis}"]) for axis in "xyz"], float(row["radius_mm"]),
                            flipfree.read_image(folder / row["labels"]), int(row["label_id"]))
    raise SystemExit(f"{folder / 'cases.csv'} has no row whose {column} is {wanted}")


def liver(folder=None):
    source = flipfree.vtkPhantomSource
    return real_case(folder, "organ", "liver") or phantom_case("liver", source.ABDOMEN,
                                                               source.LIVER)


def spleen(folder=None):
    source = flipfree.vtkPhantomSource
    return real_case(folder, "organ", "spleen") or phantom_case("spleen", source.ABDOMEN,
                                                                source.SPLEEN)


def tube(folder=None):
    """The phantom's vessel is thin: vertices must be free to spread unevenly along it."""
    source = flipfree.vtkPhantomSource
    return real_case(folder, "role", "tubular") or phantom_case(
        "vessel", source.VESSEL, source.OBJECT, reestimate_intensities=False, carving=False, leak_control=False,
        maximum_iterations=150, diffusion_iterations=0, resolution=64, levels=5,
        maximum_displacement=0, outlier_standard_deviations=0, position_weight=1, uniform_weight=0.01,
        fairing=0.2)


def segment(case, **parameters):
    return flipfree.segment(case.image, case.seed, case.radius, **{**case.parameters, **parameters})


def enclosed(shape, noise=True):
    """A plain shape, and the parameters that start from a sphere outside of it."""
    source = flipfree.vtkPhantomSource()
    source.SetShape(shape)
    source.GenerateSurfaceOn()
    if not noise:
        source.SetNoiseStandardDeviation(0)
        source.PartialVolumeOff()
    source.Update()
    seed, radius = inputs.seed_in(source, source.OBJECT)
    sphere = [0.0] * 4
    source.GetEnclosingSphere(sphere)
    start = {"start_center_offset": [a - b for a, b in zip(sphere, seed)],
             "start_scale": sphere[3] / radius, "search_distance": 2 * sphere[3],
             "reestimate_intensities": False, "leak_control": False, "maximum_iterations": 100}
    return source, seed, radius, start


def quad_sphere(resolution, center=(0, 0, 0), radius=1.0, cube=False):
    source = flipfree.vtkQuadSphereSource()
    source.SetResolution(resolution)
    source.SetCenter(center)
    source.SetRadius(radius)
    if cube:
        source.SetSpacingToCube()
    source.Update()
    return source.GetOutput()


# How it is drawn.

def with_checkerboard(surface, resolution, levels):
    """The surface with the fields of the sphere it was.

    Refinement numbers vertices anew, so that a sphere is refined in the same way, and each of its
    vertices takes the field of the nearest one on a sphere made fine.
    """
    fine = quad_sphere(resolution)
    sphere = quad_sphere(resolution >> (levels - 1))
    for _ in range(levels - 1):
        refine = flipfree.vtkFlipFreeRefinement()
        refine.SetInputData(sphere)
        flipfree.update(refine)
        sphere = refine.GetOutput()
    pattern = vtk_to_numpy(fine.GetPointData().GetArray("Checkerboard"))
    nearest = [fine.FindPoint(sphere.GetPoint(vertex))
               for vertex in range(sphere.GetNumberOfPoints())]
    return checkerboard_actors(surface, pattern[nearest])


def checkerboard_actors(surface, pattern):
    """Each face cut into one quad per corner in the corner's color, so that fields are sharp."""
    points = vtkPoints()
    quads = {0: vtkCellArray(), 1: vtkCellArray()}
    coordinates = vtk_to_numpy(surface.GetPoints().GetData())
    for face in range(surface.GetNumberOfCells()):
        ids = surface.GetCell(face).GetPointIds()
        corners = [ids.GetId(corner) for corner in range(ids.GetNumberOfIds())]
        places = coordinates[corners]
        middles = (places + np.roll(places, -1, axis=0)) / 2
        center = points.InsertNextPoint(places.mean(axis=0))
        at = [points.InsertNextPoint(place) for place in places]
        between = [points.InsertNextPoint(middle) for middle in middles]
        for corner, vertex in enumerate(corners):
            cells = quads[int(pattern[vertex] > 0)]
            cells.InsertNextCell(4)
            for point in (center, between[corner - 1], at[corner], between[corner]):
                cells.InsertCellPoint(point)
    actors = []
    for value, color in ((0, SAND), (1, PATTERN_BLUE)):
        fields = vtkPolyData()
        fields.SetPoints(points)
        fields.SetPolys(quads[value])
        actor = scene.surface_actor(fields, color)
        actor.GetProperty().SetSpecular(0)
        actors.append(actor)
    return [*actors, line_actor(surface)]


def line_actor(surface, color=(0.2, 0.2, 0.2)):
    actor = scene.surface_actor(surface, color)
    actor.GetMapper().SetResolveCoincidentTopologyToPolygonOffset()
    actor.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(-2, -8)
    actor.GetProperty().SetRepresentationToWireframe()
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetLineWidth(scene.FINER * 0.8)
    return actor


def defect_actor(surface):
    """A surface with its edges, and the faces that meet others in red."""
    validity = flipfree.vtkSurfaceValidity()
    validity.SetInputData(surface)
    flipfree.update(validity)
    return scene.defect_actor(validity.GetOutput(), SAND, validity.SELF_INTERSECTING)


def truth_of(case):
    """The reference's surface, smoothed by a fraction of a voxel, since it is made of them."""
    boundary = vtkDiscreteFlyingEdges3D()
    boundary.SetInputData(case.truth)
    boundary.SetValue(0, case.label)
    smooth = vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(boundary.GetOutputPort())
    smooth.SetNumberOfIterations(15)
    smooth.SetPassBand(0.1)
    smooth.NormalizeCoordinatesOn()
    smooth.Update()
    return smooth.GetOutput()


def window_of(image):
    """Gray values to show: the abdomen's for a CT, nearly all for other volumes."""
    values = vtk_to_numpy(image.GetPointData().GetScalars())
    if values.min() < -100:
        return -150, 250
    return tuple(np.percentile(values[::7], (1, 99.5)))


def slice_of(case, plane, surfaces, caption, around, margin=1.4):
    """A slice through the seed with contours, in their colors."""
    actors = [scene.slice_actor(case.image, case.seed, plane, window_of(case.image))]
    for surface, color, width in surfaces:
        actors.append(scene.contour_actor(surface, case.seed, plane, color, width))
    return scene.slice_view(actors, around, plane, caption, margin)


def draw(path, rows, size=480):
    scene.write_picture(path, rows, round(size * draw.scale))


draw.scale = 1


# The figures.

def figure_1(path, _):
    """The mesh, and what a sphere of it becomes from outside: a cup and a U-tube."""
    rows = [[], []]
    for name, cube, row in (("a  cubical mesh", True, 0), ("b  spherical mesh", False, 1)):
        mesh = quad_sphere(16, cube=cube)
        pattern = vtk_to_numpy(mesh.GetPointData().GetArray("Checkerboard"))
        rows[row].append(scene.space_view(checkerboard_actors(mesh, pattern), name, (-2, -3, 2),
                                          zoom=0.9))
    source = flipfree.vtkPhantomSource
    tube_settings = {"levels": 4, "diffusion_iterations": 0, "maximum_displacement": 0,
                     "uniform_weight": 0.1, "fairing": 1}
    for letters, name, shape, settings, toward, row in (
            ("cd", "cup", source.CUP, {"levels": 3}, FROM_ABOVE, 0),
            ("ef", "U-tube", source.U_TUBE, tube_settings, (-1, -3, 1), 1)):
        volume, seed, radius, start = enclosed(shape)
        organ = flipfree.segment(volume.GetOutput(), seed, radius, **{**start, **settings})
        rows[row] += [
            scene.space_view([scene.surface_actor(volume.GetSurface(), GREEN)],
                             f"{letters[0]}  {name}, the object", toward),
            scene.space_view(with_checkerboard(organ.surface, 32, settings["levels"]),
                             f"{letters[1]}  {name}, from the sphere: "
                             f"{organ.self_intersections} self-intersections", toward)]
    draw(path, rows)


def figure_2(path, _):
    """Why displacements are propagated to solitary vertices.

    Vertices around a cap of the sphere have targets under the cap, the cap's own have none.
    """
    sphere = quad_sphere(12, radius=30)
    points = vtk_to_numpy(sphere.GetPoints().GetData()).copy()
    angle = np.degrees(np.arccos(points[:, 2] / 30))
    solitary = angle < 38
    wanted = np.zeros_like(points, dtype=float)
    fall = np.clip((80 - angle) / 30, 0, 1)[:, None]
    wanted[:, :2] = -fall * points[:, :2]
    wanted[:, 2] = -12 * fall[:, 0]
    wanted[solitary] = 0

    def moved(factors):
        surface = vtkPolyData()
        surface.DeepCopy(sphere)
        surface.GetPoints().SetData(numpy_to_vtk(points + wanted * factors, deep=True))
        return surface

    start = vtkPolyData()
    start.DeepCopy(sphere)
    for name, values in (("Displacement", wanted * (0.75, 0.75, 1)),
                         ("Correspondence", np.where(solitary, 0, 1).astype(np.uint8))):
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        start.GetPointData().AddArray(array)
    deform = flipfree.vtkFlipFreeDeform()
    deform.SetInputData(start)
    flipfree.update(deform)

    plane = scene.CORONAL
    middle = [0, np.abs(points[:, 1]).min(), 0]  # through a row of vertices

    def view(surface, caption, arrows=False):
        actors = [scene.contour_actor(surface, middle, plane, scene.YELLOW, 1.6)]
        place = vtk_to_numpy(surface.GetPoints().GetData())
        row = (np.abs(points[:, 1] - middle[1]) < 0.5)
        for which, color in ((row & solitary, scene.BLUE), (row & ~solitary, scene.YELLOW)):
            actors.append(glyph_actor(place[which], vtkSphereSource(), color, 1.6))
        if arrows:
            which = row & (np.abs(wanted).max(axis=1) > 1)
            actors.append(glyph_actor(points[which], vtkArrowSource(), (0.6, 0.6, 0.6), 1,
                                      (wanted * (0.75, 0, 1))[which]))
        return scene.slice_view(actors, sphere, plane, caption, margin=1.5)

    draw(path, [[
        view(sphere, [("a  targets, and a cap without (solitary)", scene.BLUE)], arrows=True),
        view(moved((0.75, 0.75, 1)), "b  the cap stays: it folds"),
        view(moved((1.2, 1.2, 1)), "c  farther: the surface meets itself"),
        view(deform.GetOutput(), "d  targets of b, propagated")]], size=400)


def glyph_actor(places, shape, color, size, vectors=None):
    """Dots, or arrows where there are vectors."""
    data = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places, dtype=float), deep=True))
    data.SetPoints(points)
    glyphs = vtkGlyph3D()
    if vectors is None:
        glyphs.ScalingOff()
        shape.SetRadius(size / 2)
    else:
        array = numpy_to_vtk(np.ascontiguousarray(vectors), deep=True)
        array.SetName("Vectors")
        data.GetPointData().SetVectors(array)
        glyphs.SetVectorModeToUseVector()
        glyphs.SetScaleModeToScaleByVector()
    glyphs.SetInputData(data)
    glyphs.SetSourceConnection(shape.GetOutputPort())
    glyphs.SetScaleFactor(size)
    glyphs.Update()
    actor = scene.surface_actor(glyphs.GetOutput(), color)
    actor.GetProperty().LightingOff()
    actor.SetPosition(0, -1.5, 0)  # in front of the line
    return actor


def figure_3(path, _):
    """The naive method beside the flip-free one, on a binary volume."""
    volume, seed, radius, start = enclosed(flipfree.vtkPhantomSource.CUP, noise=False)
    # Off the grid's symmetry, where the last digit decides between two voxels.
    start["start_center_offset"] = [part + extra for part, extra in
                                    zip(start["start_center_offset"], (0.3, 0.2, 0.1))]
    center = [a + b for a, b in zip(seed, start["start_center_offset"])]
    sphere = scene.surface_actor(quad_sphere(32, center, radius * start["start_scale"]),
                                 scene.BLUE, 0.35, edges=True)
    views = [scene.space_view([scene.surface_actor(volume.GetSurface(), GREEN), sphere],
                              "a  the volume and the sphere", FROM_ABOVE)]
    naive = {**start, "preset": "naive", "search_inward": True, "distance_tolerance": 0,
             "change_tolerance": -1}
    for caption, parameters in (
            ("b  naive, 4 iterations", {**naive, "maximum_iterations": 4}),
            ("c  naive, steps of 1 mm, 100 iterations",
             {**naive, "maximum_displacement": 1 / max(volume.GetOutput().GetSpacing())}),
            ("d  FlipFree", start)):
        organ = flipfree.segment(volume.GetOutput(), seed, radius, **parameters)
        count = organ.self_intersections
        print(f"{caption}: {count} self-intersections")
        views.append(scene.space_view([defect_actor(organ.surface)],
                                      [(f"{count} self-intersections", scene.RED if count else GREEN),
                                       (caption, (0.92, 0.92, 0.92))], FROM_ABOVE))
    draw(path, [views], size=420)


def figure_4(path, folder):
    """The mean distance to the targets, iteration by iteration."""
    case = liver(folder)
    table = segment(case).convergence
    chart = vtkChartXY()
    ink = (0.85, 0.85, 0.85)
    for place, title in ((vtkAxis.BOTTOM, "iteration"),
                         (vtkAxis.LEFT, "mean distance to the targets, mm")):
        axis = chart.GetAxis(place)
        axis.SetTitle(title)
        axis.SetMinimumLimit(0)
        axis.GetPen().SetColorF(ink)
        axis.GetGridPen().SetColorF(0.2, 0.2, 0.22)
        for text in (axis.GetTitleProperties(), axis.GetLabelProperties()):
            text.SetFontSize(14 * scene.FINER)
            text.SetColor(ink)
            text.BoldOff()
    levels = vtk_to_numpy(table.GetColumnByName("Level"))
    per_run = (levels.max() + 1) // 2
    colors = (scene.BLUE, scene.YELLOW, scene.LIVER, GREEN)
    for level in np.unique(levels):
        rows = vtkTable()
        for name in ("Iteration", "MeanDistance"):
            values = vtk_to_numpy(table.GetColumnByName(name))[levels == level].astype(float)
            column = numpy_to_vtk(values, deep=True)
            column.SetName(name)
            rows.AddColumn(column)
        curve = chart.AddPlot(vtkChart.LINE)
        curve.SetInputData(rows, 0, 1)
        curve.GetPen().SetColorF(*colors[level % per_run % len(colors)])
        curve.SetWidth(2.5 * scene.FINER)
        carved = level >= per_run  # the second run
        curve.SetLabel(f"level {level % per_run + 1}" + (", carved" if carved else ""))
    chart.SetShowLegend(True)
    legend = chart.GetLegend()
    legend.SetLabelSize(14 * scene.FINER)
    legend.GetLabelProperties().SetColor(ink)
    legend.GetBrush().SetColorF(*scene.INK)
    legend.GetPen().SetColorF(*scene.INK)
    actor = vtkContextActor()
    actor.GetScene().AddItem(chart)
    view = vtkRenderer()
    view.SetBackground(scene.INK)
    view.AddActor(actor)
    actor.GetScene().SetRenderer(view)
    print(f"{case.name}: {table.GetNumberOfRows()} iterations")
    draw(path, [[view]], size=560)


def method_view(case, plane, truth, surface, caption):
    """What a method found, on the slice through the seed, against the reference."""
    return slice_of(case, plane, [(truth, scene.BLUE, 3.5), (surface, scene.YELLOW, 1.8)],
                    [("the reference", scene.BLUE), (caption, scene.YELLOW)], truth, 1.25)


def found_by(program, method, case):
    """Surface and label map that one of the methods finds that FlipFree is compared with."""
    with tempfile.TemporaryDirectory() as folder:
        image, surface, labels = (str(Path(folder, name)) for name in ("image.mha", "surface.vtp", "labels.mha"))
        flipfree.write_image(case.image, image)
        subprocess.run([program, method, image, "--seed", *map(str, case.seed), "--radius", str(case.radius),
                        "--surface", surface, "--labels", labels], stdout=subprocess.DEVNULL, check=True)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(surface)
        reader.Update()
        return reader.GetOutput(), flipfree.read_image(labels)


def in_seed_slice(case, labels):
    """Dice where a method looked at one slice alone."""
    index = [0.0] * 3
    labels.TransformPhysicalPointToContinuousIndex(case.seed, index)
    found, truth = (vtk_to_numpy(image.GetPointData().GetScalars()).reshape(
        image.GetDimensions()[::-1])[round(index[2])] for image in (labels, case.truth))
    found, truth = found != 0, truth == case.label
    return 2 * (found & truth).sum() / (found.sum() + truth.sum())


def figure_5(path, folder, methods=None):
    """A liver: the seed, FlipFree by defaults and as published, and the methods of the paper, if they are at hand."""
    case = liver(folder)
    truth = truth_of(case)
    seed = quad_sphere(16, case.seed, case.radius)
    views = [slice_of(case, scene.AXIAL, [(seed, scene.YELLOW, 2.2)], f"a  {case.name}: the seed",
                      truth, 1.25)]
    surfaces = []
    for letter, name, parameters in (("b", "defaults", {}), ("c", "published",
                                                             {"preset": "published"})):
        organ = segment(case, **parameters)
        scores = flipfree.evaluate(organ.label_map, case.truth, reference_label=case.label)
        print(f"{case.name}, {name}: Dice {scores.dice:.3f}, mean distance {scores.asd:.2f} mm, "
              f"{organ.self_intersections} self-intersections")
        views.append(method_view(case, scene.AXIAL, truth, organ.surface,
                                 f"{letter}  FlipFree, {name}: Dice {scores.dice:.2f}"))
        surfaces.append(scene.space_view(
            [defect_actor(organ.surface)],
            f"{('gh' if methods else 'de')[len(surfaces)]}  {name}: {organ.self_intersections} self-intersections",
            zoom=1.1, bounds=None if surfaces else truth.GetBounds()))
    for letter, method, title in (("d", "level-set-threshold", "level set"),
                                  ("e", "graph-cut-slices", "graph cut"),
                                  ("f", "gvf-snake", "GVF snake")) if methods else ():
        surface, labels = found_by(methods, method, case)
        dice = (in_seed_slice(case, labels) if method == "gvf-snake" else
                flipfree.evaluate(labels, case.truth, reference_label=case.label).dice)
        print(f"{case.name}, {title}: Dice {dice:.3f}")
        views.append(method_view(case, scene.AXIAL, truth, surface,
                                 f"{letter}  {title}: Dice {dice:.2f}"))
    views += surfaces
    draw(path, [views[:4], views[4:]], size=400)


def figure_6(path, folder):
    """A spleen and a tube: the seed, the segmentation on a slice, its surface, the reference's."""
    rows = []
    for letters, case, plane in (("abcd", spleen(folder), scene.CORONAL),
                                 ("efgh", tube(folder), scene.AXIAL)):
        truth = truth_of(case)
        organ = segment(case)
        scores = flipfree.evaluate(organ.label_map, case.truth, reference_label=case.label)
        print(f"{case.name}: Dice {scores.dice:.3f}, mean distance {scores.asd:.2f} mm, "
              f"{organ.self_intersections} self-intersections")
        seed = quad_sphere(16, case.seed, case.radius)
        bounds = truth.GetBounds()
        rows.append([
            slice_of(case, plane, [(seed, scene.YELLOW, 2.2)],
                     f"{letters[0]}  {case.name}: the seed", truth),
            slice_of(case, plane,
                     [(truth, scene.BLUE, 3.5), (organ.surface, scene.YELLOW, 1.8)],
                     [("the reference", scene.BLUE), (f"{letters[1]}  FlipFree", scene.YELLOW)],
                     truth),
            scene.space_view([scene.surface_actor(organ.surface, edges=True)],
                             f"{letters[2]}  FlipFree: Dice {scores.dice:.2f}", zoom=1,
                             bounds=bounds),
            scene.space_view([scene.surface_actor(truth, scene.BLUE)],
                             f"{letters[3]}  the reference", zoom=1, bounds=bounds)])
    draw(path, rows, size=420)


FIGURES = {1: figure_1, 2: figure_2, 3: figure_3, 4: figure_4, 5: figure_5, 6: figure_6}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="where the pictures go")
    parser.add_argument("--data", type=Path, help="folder with cases.csv and its volumes")
    parser.add_argument("--only", type=int, choices=FIGURES, action="append", help="a figure")
    parser.add_argument("--methods", metavar="PROGRAM", help="RunMethod of a build folder, for Figure 5")
    parser.add_argument("--scale", type=float, default=1, help="size of the pictures, 0.5 to 2")
    arguments = parser.parse_args()
    draw.scale = arguments.scale
    if arguments.data and not (arguments.data / "cases.csv").is_file():
        parser.error(f"there is no cases.csv in {arguments.data}")
    arguments.folder.mkdir(parents=True, exist_ok=True)
    figures = {**FIGURES, 5: functools.partial(figure_5, methods=arguments.methods)}
    for number in arguments.only or figures:
        figures[number](arguments.folder / f"figure-{number}.png", arguments.data)


if __name__ == "__main__":
    main()
