#!/usr/bin/env bash
# Installs what FlipFree is built on, on Debian 12, Debian 13 and their descendants: only what is missing, only from
# the package sources that the machine already has.
#
#   install-dependencies.sh [build|test|paraview|browser]
#
#   build     what the toolkit, its Python package and the flipfree command need (default)
#   test      in addition, what the tests, the style checks and the benchmarks need
#   paraview  what the ParaView plugin needs, ParaView itself aside: that is what install-paraview.sh,
#             beside this script, is for
#   browser   what the page for the browser is built with, npm's packages aside: they are what
#             install-browser-tools.sh is for
set -euo pipefail

build_packages=(
  cmake
  # For the Debian package.
  dpkg-dev
  file
  g++
  libcli11-dev
  libeigen3-dev
  # Only keeps ITK's configuration from complaining at length.
  libgdcm-tools
  libinsighttoolkit5-dev
  libvtk9-dev
  ninja-build
  nlohmann-json3-dev
  python3
  python3-numpy
  python3-vtk9
  # A display for pictures, on machines without one.
  xauth
  xvfb
)

test_packages=(
  # Compiles nothing a second time.
  ccache
  # In which the page is tested.
  chromium
  # Builds what runs under the sanitizers.
  clang
  clang-format
  clang-tidy
  doxygen
  groff-base
  # Maximum flows, to compare with.
  libboost-dev
  libcgal-dev
  libclang-rt-dev
  libgtest-dev
  # Names functions and lines in what the sanitizers report.
  llvm
  mypy
  # For the wheel, which is built and tested in a virtual environment.
  python3-dev
  # For the benchmarks' charts alone.
  python3-matplotlib
  python3-venv
  tetgen
  valgrind
  zsh
)

# The VTK that ParaView brings along wants the same libraries' development files as Debian's own, whose
# package depends on them.
paraview_packages=(
  cmake
  g++
  libeigen3-dev
  libgdcm-tools
  libgl1-mesa-dri
  libinsighttoolkit5-dev
  libvtk9-dev
  libxtst6
  ninja-build
  python3
  python3-numpy
  python3-pil
  xauth
  xvfb
)

# The page for the browser. Node may be of another source than Debian, with its own npm.
browser_packages=(
  cmake
  emscripten
  libeigen3-dev
  ninja-build
  python3
)
if ! command -v npm >/dev/null; then
  browser_packages+=(nodejs npm)
fi

usage()
{
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
}

case "${1:-build}" in
  build) wanted=("${build_packages[@]}") ;;
  test) wanted=("${build_packages[@]}" "${test_packages[@]}" "${browser_packages[@]}") ;;
  paraview) wanted=("${paraview_packages[@]}") ;;
  browser) wanted=("${browser_packages[@]}") ;;
  -h | --help)
    usage
    exit 0
    ;;
  *)
    usage >&2
    exit 2
    ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  cat >&2 <<MESSAGE
This machine has no apt-get, so nothing was installed. Install the equivalents of these Debian
packages with your system's package manager, then use the presets of CMakePresets.json:
  ${wanted[*]}
MESSAGE
  exit 1
fi

as_root=()
if ((EUID != 0)); then
  as_root=(sudo)
fi

install_missing()
{
  local package status missing=()
  for package in "$@"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    if [[ $status != installed ]]; then
      missing+=("$package")
    fi
  done
  if ((${#missing[@]} == 0)); then
    return
  fi
  if ((EUID != 0)) && ! command -v sudo >/dev/null; then
    echo "Missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
    exit 1
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update --quiet
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --quiet --yes --no-install-recommends "${missing[@]}"
}

install_missing "${wanted[@]}"
# ITK 5.4 is linked with FFTW by whoever links its filters, but Debian's package does not depend on it.
itk=$(dpkg-query --show --showformat='${Version}' libinsighttoolkit5-dev 2>/dev/null || true)
if dpkg --compare-versions "$itk" ge 5.4; then
  install_missing libfftw3-dev
fi
echo "All packages are there."
