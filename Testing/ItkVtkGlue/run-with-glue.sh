#!/usr/bin/env bash
# Builds the module Imaging on ITK's own bridge to VTK, the module ITKVtkGlue, and runs its tests.
#
#   run-with-glue.sh [FOLDER]
#
#   FOLDER  where sources and build go, and stay; without it, a temporary folder that is removed
#
# Debian's ITK lacks ITKVtkGlue, so an ordinary build uses our stand-ins for its two classes. They are
# templates, which need no library: this script takes the headers from Debian's source package of the
# very ITK that is installed, some 280 MB of download, and builds with them. The package sources of the
# machine are used, with source packages switched on in a private copy of them; nothing is installed
# and the machine's own configuration stays as it is.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
esac

root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if [[ -n ${1:-} ]]; then
  mkdir -p "$1"
  work=$(cd -P "$1" && pwd)
else
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
headers=$work/include

# Copies the machine's package sources, asking for source packages instead of built ones.
copy_sources()
{
  local from
  mkdir -p "$work/apt/sources" "$work/apt/state/lists/partial" "$work/apt/cache/archives/partial"
  for from in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ -f $from ]] || continue
    sed -n 's/^deb\(-src\)\{0,1\}[[:space:]]/deb-src /p' "$from" \
      >"$work/apt/sources/$(basename "$from" .list).list"
  done
  for from in /etc/apt/sources.list.d/*.sources; do
    [[ -f $from ]] || continue
    sed 's/^Types:.*/Types: deb-src/' "$from" >"$work/apt/sources/$(basename "$from")"
  done
}

private_apt()
{
  apt-get --quiet=2 \
    -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/apt/sources" \
    -o Dir::State="$work/apt/state" -o Dir::State::status=/var/lib/dpkg/status \
    -o Dir::Cache="$work/apt/cache" -o Debug::NoLocking=1 \
    -o APT::Sandbox::User=root "$@"
}

fetch_headers()
{
  local source archive
  # shellcheck disable=SC2016 # the variables are dpkg-query's
  source=$(dpkg-query --show --showformat='${source:Package}=${source:Version}' \
    libinsighttoolkit5-dev)
  echo "Source package: $source"
  copy_sources
  private_apt update || echo "Some package sources have no source packages; going on with the rest."
  (cd "$work" && private_apt source --download-only "$source")
  archive=$(find "$work" -maxdepth 1 -name '*.orig.tar.*' ! -name '*.asc' -print -quit)
  mkdir -p "$headers"
  # As in DIRECTORY/Modules/Bridge/VtkGlue/include/FILE.
  tar --extract --file "$archive" --directory "$headers" --strip-components=5 --wildcards \
    '*/Modules/Bridge/VtkGlue/include/*'
}

if [[ ! -f $headers/itkVTKImageToImageFilter.h ]]; then
  fetch_headers
fi
echo "Headers of ITKVtkGlue:"
(cd "$headers" && sha256sum itkVTKImageToImageFilter.h itkVTKImageToImageFilter.hxx \
  itkImageToVTKImageFilter.h itkImageToVTKImageFilter.hxx)

cmake -S "$root" -B "$work/build" -G Ninja \
  -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON \
  -DFLIPFREE_USE_ITK=ON -DFLIPFREE_WRAP_PYTHON=OFF -DFLIPFREE_BUILD_COMMAND=OFF \
  -DFLIPFREE_ITKVTKGLUE_INCLUDE_DIR="$headers" | grep 'ITKVtkGlue'
cmake --build "$work/build" --target TestImaging
"$work/build/bin/TestImaging" --gtest_brief=1 \
  --gtest_filter='*ItkVtkBridge*:*Diffusion*:*RoundTrip*:*Dicom*' | tee "$work/tests.log"
grep --quiet "The bridge is ITK's" "$work/tests.log"
