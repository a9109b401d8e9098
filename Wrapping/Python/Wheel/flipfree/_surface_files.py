"""Surfaces into files and from them. Coordinates are LPS millimeters in every format."""

from __future__ import annotations

import os
from typing import Any

from . import _kernels
from ._atomic import replacing
from ._errors import FileError
from ._extras import needed
from ._messages import listed
from ._segmentation import Segmentation, Surface, Vessel, joined
from ._types import PathName

ENDINGS = (".vtp", ".stl", ".ply", ".obj")


def write_surface(surface: Surface | Segmentation, path: PathName) -> None:
    """Writes a surface as .vtp (in double precision, with all arrays), .stl, .ply or .obj.

    Where it comes from (see Segmentation.provenance) is in .vtp as field data, in .ply and .obj as
    comments.

    There is either the whole file afterward or, after an error, none of it. What was certified is
    in the file, bit for bit; STL and PLY, of which many programs read nothing else, have triangles in
    place of the faces.
    """
    mesh = surface.mesh if isinstance(surface, Segmentation) else surface
    if not isinstance(mesh, Surface):
        raise TypeError(f"surface: a flipfree.Surface or Segmentation is needed, not {surface!r:.80}")
    name = os.fspath(path)
    ending = ending_of(name)
    if ending in (".stl", ".ply"):
        _require_single_precision(mesh, name)
    with replacing(name) as temporary:
        with open(temporary, "wb") as file:
            file.write(_bytes_of(mesh, ending))


def write_centerline(vessel: Vessel, path: PathName) -> None:
    """Writes the centerline of what trace() has returned as a .vtp file, in double precision.

    A poly line per branch, with the point arrays `Radius` and `ArcLength` (mm) and the cell array `Parent`.
    There is either the whole file afterward or, after an error, none of it.
    """
    if not isinstance(vessel, Vessel):
        raise TypeError(f"vessel: what trace() has returned is needed, not {vessel!r:.80}")
    name = os.fspath(path)
    if not name.lower().endswith(".vtp"):
        raise FileError(f"The file extension of '{name}' is not supported. Use .vtp.")
    with replacing(name) as temporary:
        with open(temporary, "wb") as file:
            file.write(_vtp_lines(vessel))


def read_surface(path: PathName) -> Surface:
    """Reads a surface from a .vtp, .stl, .ply or .obj file; .vtp by VTK (`pip install vtk`)."""
    name = os.fspath(path)
    ending = ending_of(name)
    if os.path.exists(name) and not os.path.isfile(name):
        raise FileError(f"'{name}' is not a regular file. Give the file of a surface.")
    if not os.access(name, os.R_OK):
        raise FileError(f"'{name}' does not exist or cannot be read. Check its name and permissions.")
    with open(name, "rb") as file:
        content = file.read()
    try:
        surface = (_read_vtp if ending == ".vtp" else _read_polygons)(name, content)
    except _kernels.FileProblem as problem:
        raise FileError(str(problem)) from None
    if len(surface.offsets) < 2:
        raise FileError(f"'{name}' has no faces. Check its extension, or create it again.")
    return surface


def _read_vtp(name: str, content: bytes) -> Surface:
    _kernels.validate_vtp(name, content)
    reader: Any = needed("vtkmodules.vtkIOXML", "reading .vtp files", "pyvista").vtkXMLPolyDataReader()
    from ._vtk_objects import surface_of_vtk

    errors: list[str] = []
    for algorithm in (reader, reader.GetExecutive()):  # which would write to standard error
        algorithm.AddObserver("ErrorEvent", lambda *_: errors.append(name))
    reader.SetFileName(name)
    log: Any = needed("vtkmodules.vtkCommonCore", "reading .vtp files", "pyvista").vtkLogger
    verbosity = log.GetCurrentVerbosityCutoff()
    log.SetStderrVerbosity(log.VERBOSITY_OFF)  # of the reader's parser, which repeats it
    try:
        reader.Update()
    finally:
        log.SetStderrVerbosity(verbosity)
    if errors or reader.GetErrorCode():
        raise FileError(f"'{name}' cannot be read: it is damaged. Create it again.")
    surface: Surface = surface_of_vtk(reader.GetOutput())
    return surface


def _read_polygons(name: str, content: bytes) -> Surface:
    import numpy

    points, corners, offsets = _kernels.read_polygons(name, content)
    return Surface(
        points=points,
        corners=corners,
        offsets=offsets,
        displacements=numpy.zeros(points.shape),
        correspondence=numpy.zeros(len(points), numpy.uint8),
    )


def ending_of(name: str) -> str:
    """Of a surface file; raises FileError for others."""
    ending = os.path.splitext(name)[1].lower()
    if ending not in ENDINGS:
        raise FileError(
            f"The file extension of '{name}' is not supported. Use {listed(ENDINGS, 'or')}."
        )
    return ending


def _require_single_precision(mesh: Surface, name: str) -> None:
    """Vertices of a certified surface are single-precision numbers, unless somebody moved them."""
    import numpy

    if mesh.certified and (mesh.points.astype(numpy.float32) != mesh.points).any():
        raise FileError(
            f"'{name}' cannot hold this surface: the format rounds positions, so the file would "
            "not hold the certified surface. Write a .vtp file, which holds positions in double precision."
        )


def _bytes_of(mesh: Surface, ending: str) -> bytes:
    comments = _kernels.comments_on(mesh.provenance)
    written: bytes
    if ending == ".vtp":
        written = _vtp(mesh)
    elif ending == ".obj":
        written = _kernels.obj_bytes(mesh.points, mesh.corners, mesh.offsets, comments)
    else:
        write = {".stl": _kernels.stl_bytes, ".ply": _kernels.ply_bytes}[ending]
        written = write(mesh.points, mesh.triangles, comments)
    return written


def _vtp(mesh: Surface) -> bytes:
    fields: dict[str, Any] = {"Certified": float(mesh.certified)}
    arrays = {"Displacement": mesh.displacements, "Correspondence": mesh.correspondence}
    if mesh.vertex_confidence is not None:
        fields["Confidence"] = float(mesh.confidence)
        arrays["Confidence"] = mesh.vertex_confidence
    if mesh.provenance:
        fields["Provenance"] = mesh.provenance
    written: bytes = _kernels.vtp_bytes(mesh.points, mesh.corners, mesh.offsets, fields, arrays)
    return written


def _vtp_lines(vessel: Vessel) -> bytes:
    import numpy

    line = joined(vessel.branches)
    written: bytes = _kernels.vtp_bytes(
        line["points"],
        numpy.arange(len(line["points"]), dtype=numpy.int32),
        line["ends"].astype(numpy.int32),
        fields={},
        point_data={"Radius": line["radius"], "ArcLength": line["length"]},
        cell_data={"Parent": line["parent"]},
        are_lines=True,
    )
    return written
