"""Surfaces into files and from them. Coordinates are LPS millimeters in every format."""

from __future__ import annotations

import base64
import os
import struct
from typing import Any

from . import _kernels
from ._atomic import replacing
from ._errors import FileError
from ._extras import needed
from ._messages import listed
from ._segmentation import Segmentation, Surface, Vessel
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
    if ending != ".vtp":
        _require_single_precision(mesh, name)
    writers = {".vtp": _vtp, ".stl": _stl, ".ply": _ply, ".obj": _obj}
    with replacing(name) as temporary:
        with open(temporary, "wb") as file:
            file.write(writers[ending](mesh))


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


def _vtp(mesh: Surface) -> bytes:
    import numpy

    corners, ends = mesh.corners.astype("int64"), mesh.offsets[1:].astype("int64")
    numbers = [_number("Certified", float(mesh.certified))]
    confidence = ""
    if mesh.vertex_confidence is not None:
        numbers.append(_number("Confidence", mesh.confidence))
        confidence = _array("Confidence", mesh.vertex_confidence, "Float32")
    if mesh.provenance:
        numbers.append(_text("Provenance", mesh.provenance))
    return _vtp_file(
        f"<FieldData>{''.join(numbers)}</FieldData>\n"
        f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfPolys="{len(ends)}">\n'
        f"<PointData>\n{_array('Displacement', mesh.displacements, 'Float64', 3)}"
        f"{_array('Correspondence', mesh.correspondence, 'UInt8')}{confidence}</PointData>\n"
        f"<Points>\n{_array('Points', mesh.points, 'Float64', 3)}</Points>\n"
        f"<Polys>\n{_array('connectivity', corners, 'Int64')}{_array('offsets', ends, 'Int64')}"
        "</Polys>\n</Piece>\n"
    )


def _number(name: str, value: float) -> str:
    import numpy

    return (
        f'<DataArray type="Float64" Name="{name}" NumberOfTuples="1" format="binary">'
        f"{_encoded(numpy.array([value]))}</DataArray>"
    )


def _text(name: str, text: str) -> str:
    """As numbers of its bytes, and 0 at its end."""
    codes = " ".join(str(code) for code in (*text.encode(), 0))
    return f'<Array type="String" Name="{name}" NumberOfTuples="1" format="ascii">{codes}</Array>'


def _comments(mesh: Surface) -> list[str]:
    """What files say of the surface before it."""
    comments: list[str] = _kernels.comments_on(mesh.provenance)
    return comments


def _vtp_lines(vessel: Vessel) -> bytes:
    import numpy

    points, radii, lengths = (
        numpy.concatenate([branch[name] for branch in vessel.branches])
        for name in ("points", "radius", "length")
    )
    ends = numpy.cumsum([len(branch["points"]) for branch in vessel.branches]).astype("int64")
    parents = numpy.array([branch["parent"] for branch in vessel.branches], "int32")
    corners = numpy.arange(len(points), dtype="int64")
    return _vtp_file(
        f'<Piece NumberOfPoints="{len(points)}" NumberOfLines="{len(ends)}">\n'
        f"<PointData>\n{_array('Radius', radii, 'Float64')}{_array('ArcLength', lengths, 'Float64')}"
        f"</PointData>\n<CellData>\n{_array('Parent', parents, 'Int32')}</CellData>\n"
        f"<Points>\n{_array('Points', points, 'Float64', 3)}</Points>\n"
        f"<Lines>\n{_array('connectivity', corners, 'Int64')}{_array('offsets', ends, 'Int64')}"
        "</Lines>\n</Piece>\n"
    )


def _vtp_file(content: str) -> bytes:
    text = (
        '<?xml version="1.0"?>\n'
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f"<PolyData>\n{content}</PolyData>\n</VTKFile>\n"
    )
    return text.encode()


def _array(name: str, values: Any, kind: str, width: int = 1) -> str:
    return (
        f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" '
        f'format="binary">{_encoded(values)}</DataArray>\n'
    )


def _encoded(values: Any) -> str:
    import numpy

    data = numpy.ascontiguousarray(values).astype(f"<{values.dtype.kind}{values.dtype.itemsize}")
    return base64.b64encode(struct.pack("<Q", data.nbytes) + data.tobytes()).decode()


def _stl(mesh: Surface) -> bytes:
    import numpy

    corners = mesh.points[mesh.triangles]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
    facets = numpy.zeros(len(corners), [("vectors", "<f4", (4, 3)), ("attribute", "<u2")])
    facets["vectors"][:, 0] = normals / numpy.where(lengths > 0, lengths, 1)
    facets["vectors"][:, 1:] = corners
    header = _comments(mesh)[0].encode().ljust(80)
    return header + struct.pack("<I", len(facets)) + facets.tobytes()


def _ply(mesh: Surface) -> bytes:
    import numpy

    header = (
        "ply\nformat binary_little_endian 1.0\n"
        + "".join(f"comment {line}\n" for line in _comments(mesh))
        + f"element vertex {len(mesh.points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = numpy.zeros(len(mesh.triangles), [("size", "u1"), ("corners", "<i4", 3)])
    faces["size"] = 3
    faces["corners"] = mesh.triangles
    return header.encode() + mesh.points.astype("<f4").tobytes() + faces.tobytes()


def _obj(mesh: Surface) -> bytes:
    lines = [f"# {line}" for line in _comments(mesh)]
    lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in mesh.points.tolist()]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in _faces(mesh)]
    return ("\n".join(lines) + "\n").encode()


def _faces(mesh: Surface) -> list[list[int]]:
    corners, offsets = mesh.corners.tolist(), mesh.offsets.tolist()
    return [corners[start:end] for start, end in zip(offsets, offsets[1:])]
