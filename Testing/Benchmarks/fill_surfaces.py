"""How many closed surfaces TetGen and gmsh do not fill with tetrahedra, for MeasureLabelSurfaces.

    pip install tetgen gmsh pyvista
    python fill_surfaces.py FOLDER

prints two numbers, of the STL files in the folder. Each file is filled by a process of its own,
which may crash or hang.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

SECONDS = 120


def by_tetgen(name):
    import pyvista
    import tetgen

    surface = pyvista.read(name)
    return len(tetgen.TetGen(surface).tetrahedralize(switches="pYQ")[1])


def by_gmsh(name):
    import gmsh

    gmsh.initialize(["gmsh", "-v", "1"])
    gmsh.merge(name)
    (surface,) = gmsh.model.getEntities(2)
    gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop([surface[1]])])
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    return sum(len(elements) for elements in gmsh.model.mesh.getElements(3)[1])


MESHERS = {"tetgen": by_tetgen, "gmsh": by_gmsh}


def is_filled(mesher, name):
    try:
        with tempfile.TemporaryDirectory() as scratch:  # where TetGen leaves what it refuses
            command = [sys.executable, os.path.abspath(__file__), mesher, name]
            done = subprocess.run(command, cwd=scratch, timeout=SECONDS, capture_output=True, check=False)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def main():
    if sys.argv[1] in MESHERS:
        sys.exit(0 if MESHERS[sys.argv[1]](sys.argv[2]) > 0 else 1)
    files = sorted(map(str, pathlib.Path(sys.argv[1]).resolve().glob("*.stl")))
    print(*(sum(not is_filled(mesher, name) for name in files) for mesher in MESHERS))


if __name__ == "__main__":
    main()
