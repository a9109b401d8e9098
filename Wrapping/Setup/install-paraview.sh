#!/usr/bin/env bash
# Gets ParaView of Debian 12 or 13, to build the plugin with and to run it in, and what both need.
#
#   install-paraview.sh [FOLDER]
#
#   FOLDER  where ParaView goes (default: build/paraview-prefix in the source folder)
#
# Debian's python3-paraview and python3-vtk9 exclude each other, and the toolkit stands on the latter. So
# ParaView's own packages are not installed but unpacked into the folder, which can be removed again;
# what they depend on is installed, from the package sources that the machine already has.
# Wrapping/ParaView/with-paraview.sh runs the programs in the folder.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
  -*)
    "$0" --help >&2
    exit 2
    ;;
esac

here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=${1:-$here/../../build/paraview-prefix}
packages=(paraview paraview-dev python3-paraview)

"$here/install-dependencies.sh" paraview

mkdir -p "$folder"
folder=$(cd -P "$folder" && pwd)
as_root=()
if ((EUID != 0)); then
  as_root=(sudo)
fi

# What ParaView's programs depend on, as its package says. Where all of it is there, nothing is asked of the network.
satisfy() {
  local plan
  if plan=$(apt-get satisfy --simulate --no-install-recommends "$1" 2>&1) && ! grep --quiet '^Inst ' <<<"$plan"; then
    return
  fi
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get satisfy --quiet --yes --no-install-recommends -o DPkg::Lock::Timeout=600 "$1"
}

# A folder that was kept elsewhere, as a cache, may be on a machine without what ParaView needs.
if [[ -f $folder/complete && -f $folder/depends ]]; then
  satisfy "$(<"$folder/depends")"
  echo "ParaView is there: $(cat "$folder/complete"), in $folder."
  exit 0
fi

if ! apt-cache show "${packages[@]}" >/dev/null 2>&1; then
  echo "The package sources of this machine have no package ${packages[*]}; the plugin is made for" \
    "ParaView 5.11 and 5.13 as in Debian 12 and 13." >&2
  exit 1
fi

downloads=$(mktemp -d)
trap 'rm -rf "$downloads"' EXIT
echo "Downloading: ${packages[*]}"
# As the user who asks: apt's own would not get into a private folder.
(cd "$downloads" && apt-get --quiet=2 -o APT::Sandbox::User="$(id -un)" download "${packages[@]}")

dpkg-deb --field "$downloads"/paraview_*.deb Depends >"$folder/depends"
satisfy "$(<"$folder/depends")"

for archive in "$downloads"/*.deb; do
  dpkg-deb --extract "$archive" "$folder"
done
# In Debian 13, ParaView's CMake files know Python's extensions by the names that they had before they were packaged.
find "$folder/usr/lib/python3" -name '*.cpython-*.so' -exec sh -c '
  for extension; do
    ln --symbolic --force "${extension##*/}" "${extension%%.cpython-*}.so"
  done' sh {} +
# Written last, so that an interrupted download is taken up again.
# shellcheck disable=SC2016 # the variables are dpkg-deb's
dpkg-deb --show --showformat='${Package} ${Version}\n' "$downloads"/paraview_*.deb >"$folder/complete"
echo "ParaView is there: $(cat "$folder/complete"), in $folder."
