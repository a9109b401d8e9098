"""Surfaces into files and from them. Coordinates are LPS millimeters in every format."""

from __future__ import annotations

import base64
import os
import struct
from typing import Any

from ._atomic import replacing
from ._errors import FileError
from ._extras import needed
from ._segmentation import Segmentation, Surface
from ._types import PathName

ENDINGS = (".vtp", ".stl", ".ply", ".obj")


def write_surface(surface: Surface | Segmentation, path: PathName) -> None:
    """Writes a surface as .vtp (in double precision, with all arrays), .stl, .ply or .obj.

    There is either the whole file afterwards or, after an error, none of it. What was certified is
    in the file, bit for bit; only STL has triangles in place of the faces.
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


def read_surface(path: PathName) -> Surface:
    """Reads a surface from a .vtp, .stl, .ply or .obj file, by VTK (`pip install vtk`)."""
    name = os.fspath(path)
    ending = ending_of(name)
    if not os.path.isfile(name) or not os.access(name, os.R_OK):
        raise FileError(f"'{name}' does not exist or may not be read. Check its name and permissions.")
    module, kind = {
        ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
        ".stl": ("vtkIOGeometry", "vtkSTLReader"),
        ".ply": ("vtkIOPLY", "vtkPLYReader"),
        ".obj": ("vtkIOGeometry", "vtkOBJReader"),
    }[ending]
    reader: Any = getattr(needed(f"vtkmodules.{module}", "to read surface files", "pyvista"), kind)()
    from ._vtk_objects import surface_of_vtk

    errors: list[str] = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(name))
    reader.SetFileName(name)
    reader.Update()
    if errors or reader.GetErrorCode() or not reader.GetOutput().GetNumberOfPolys():
        raise FileError(f"'{name}' cannot be read: it is damaged, or has no faces. Create it again.")
    return surface_of_vtk(reader.GetOutput())


def ending_of(name: str) -> str:
    """Of a surface file; raises FileError for others."""
    ending = os.path.splitext(name)[1].lower()
    if ending not in ENDINGS:
        raise FileError(
            f"The ending of '{name}' stands for no format known here. Use .vtp, .stl, .ply or .obj."
        )
    return ending


def _require_single_precision(mesh: Surface, name: str) -> None:
    """Vertices of a certified surface are single-precision numbers, unless somebody moved them."""
    import numpy

    if mesh.certified and (mesh.points.astype(numpy.float32) != mesh.points).any():
        raise FileError(
            f"'{name}' cannot hold this surface: the format rounds positions, and what was certified "
            "are others. Write a .vtp file, which holds positions in double precision."
        )


def _vtp(mesh: Surface) -> bytes:
    import numpy

    def array(name: str, values: Any, kind: str, width: int = 1) -> str:
        data = numpy.ascontiguousarray(values).astype(f"<{values.dtype.kind}{values.dtype.itemsize}")
        encoded = base64.b64encode(struct.pack("<Q", data.nbytes) + data.tobytes()).decode()
        return (
            f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" '
            f'format="binary">{encoded}</DataArray>\n'
        )

    def number(name: str, value: float) -> str:
        encoded = base64.b64encode(struct.pack("<Qd", 8, value)).decode()
        return f'<DataArray type="Float64" Name="{name}" NumberOfTuples="1" format="binary">{encoded}</DataArray>'

    corners, ends = mesh.corners.astype("int64"), mesh.offsets[1:].astype("int64")
    numbers = [number("Certified", float(mesh.certified))]
    confidence = ""
    if mesh.vertex_confidence is not None:
        numbers.append(number("Confidence", mesh.confidence))
        confidence = array("Confidence", mesh.vertex_confidence, "Float32")
    text = (
        '<?xml version="1.0"?>\n'
        '<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        "<PolyData>\n"
        f"<FieldData>{''.join(numbers)}</FieldData>\n"
        f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfPolys="{len(ends)}">\n'
        f"<PointData>\n{array('Displacement', mesh.displacements, 'Float64', 3)}"
        f"{array('Correspondence', mesh.correspondence, 'UInt8')}{confidence}</PointData>\n"
        f"<Points>\n{array('Points', mesh.points, 'Float64', 3)}</Points>\n"
        f"<Polys>\n{array('connectivity', corners, 'Int64')}{array('offsets', ends, 'Int64')}"
        "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n"
    )
    return text.encode()


def _stl(mesh: Surface) -> bytes:
    import numpy

    corners = mesh.points[mesh.triangles]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
    facets = numpy.zeros(len(corners), [("vectors", "<f4", (4, 3)), ("attribute", "<u2")])
    facets["vectors"][:, 0] = normals / numpy.where(lengths > 0, lengths, 1)
    facets["vectors"][:, 1:] = corners
    header = b"FlipFree, LPS millimeters".ljust(80)
    return header + struct.pack("<I", len(facets)) + facets.tobytes()


def _ply(mesh: Surface) -> bytes:
    header = (
        "ply\nformat binary_little_endian 1.0\ncomment FlipFree, LPS millimeters\n"
        f"element vertex {len(mesh.points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(mesh.offsets) - 1}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = (struct.pack(f"<B{len(face)}i", len(face), *face) for face in _faces(mesh))
    return header.encode() + mesh.points.astype("<f4").tobytes() + b"".join(faces)


def _obj(mesh: Surface) -> bytes:
    lines = ["# FlipFree, LPS millimeters"]
    lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in mesh.points.tolist()]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in _faces(mesh)]
    return ("\n".join(lines) + "\n").encode()


def _faces(mesh: Surface) -> list[list[int]]:
    corners, offsets = mesh.corners.tolist(), mesh.offsets.tolist()
    return [corners[start:end] for start, end in zip(offsets, offsets[1:])]
