#!/usr/bin/env bash
# Makes a virtual environment with what `pip install .` builds FlipFree's wheel by, from the package index that pip
# is configured for: scikit-build-core and nanobind, and numpy, which the package needs. Does nothing where they are
# there already. With them at hand, the wheel is built without any access to the index:
#
#   install-wheel-tools.sh [FOLDER [PYTHON]]
#   FOLDER/bin/pip install --no-build-isolation .
#
#   FOLDER  of the virtual environment; by default build/wheel-env
#   PYTHON  the interpreter; by default python3
#
# Ends with 77 where the packages cannot be had.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
esac
folder=${1:-$(dirname "${BASH_SOURCE[0]}")/../../build/wheel-env}
python=${2:-python3}
packages=(nanobind numpy scikit-build-core)

if [[ ! -x $folder/bin/pip ]] && ! "$python" -m venv "$folder"; then
  echo "No virtual environment: $python lacks the module venv (on Debian: python3-venv)." >&2
  rm -rf "$folder"
  exit 77
fi
if "$folder/bin/python" -c 'import nanobind, numpy, scikit_build_core' 2>/dev/null; then
  echo "Nothing to install: all ${#packages[@]} packages are there."
  exit 0
fi
if ! "$folder/bin/pip" install --quiet --retries 1 --timeout 30 "${packages[@]}"; then
  echo "The package index is out of reach, so the wheel cannot be built here." >&2
  exit 77
fi
