#!/usr/bin/env bash
# Gives a wheel the tag that says which C library it needs, and makes sure that it needs nothing else of a system.
#
#   audit-wheel.sh WHEEL GLIBC FOLDER
#
#   GLIBC   version of the newest C library that it may need, such as 2.28
#   FOLDER  for the wheel with its tag
#
# auditwheel, patchelf and abi3audit have to be on PATH (install-wheel-tools.sh --release).
set -euo pipefail

if [[ $# != 3 ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  [[ ${1:-} == -h || ${1:-} == --help ]] && exit 0 || exit 2
fi
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

auditwheel repair --plat "manylinux_${2/./_}_$(uname -m)" --wheel-dir "$work" "$1"
wheel=$(find "$work" -name '*.whl')
auditwheel show "$wheel"
if [[ $wheel == *-abi3-* ]]; then
  abi3audit --strict --verbose "$wheel"
fi

# Nothing has been added to it.
python3 -m zipfile --extract "$wheel" "$work/unpacked"
libraries=$(find "$work/unpacked" -name '*.so*' -printf '%P\n')
if [[ ! $libraries =~ ^flipfree/_kernels\.[^/]*\.so$ ]]; then
  echo "It has other libraries than its own: $libraries"
  exit 1
fi
# auditwheel passes over functions without a version, which an older C library need not have.
unknown=$(nm --dynamic --undefined-only "$work/unpacked/$libraries" | grep -E '^ +U ' | grep -vE '@| U _?Py' || true)
if [[ $unknown ]]; then
  echo "Nobody knows which C library has these: $unknown"
  exit 1
fi

mv "$wheel" "$3"
