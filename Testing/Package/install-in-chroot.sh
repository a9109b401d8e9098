#!/usr/bin/env bash
# Installs the Debian package on a clean Debian, in a folder made for it by debootstrap, and works with it there: the
# command, its manual page, and Python. Wants root.
#
#   install-in-chroot.sh PACKAGE.deb [RELEASE [FOLDER]]
#
# RELEASE, by default this machine's, is the one that the package was built on. FOLDER, by default a temporary one that
# is removed at the end, is made where it is absent; where it is a clean system already, that is taken.
set -euo pipefail

if (($# < 1)) || [[ $1 == -* ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  [[ ${1:-} == -h || ${1:-} == --help ]] && exit 0 || exit 2
fi
source "$(dirname "${BASH_SOURCE[0]}")/../Support/debian-root.sh"

make_root "${2:-$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)}" "${3:-}"
cp "$1" "$root/tmp/flipfree.deb"

inside apt-get install --quiet --yes --no-install-recommends /tmp/flipfree.deb
inside flipfree --version
inside flipfree phantom sphere -o /tmp/try --quiet
inside /bin/sh -ec '
  cd /tmp
  python3 -c "
import flipfree
source = flipfree.vtkPhantomSource()
source.Update()
seed = [0.0] * 4
source.GetSeed(source.OBJECT, seed)
ball = flipfree.segment(\"try/sphere.nii.gz\", seed[:3], seed[3])
flipfree.write_image(ball.label_map, \"ball.nii.gz\")
assert ball.self_intersections == 0, ball
"
  flipfree evaluate ball.nii.gz try/sphere-truth.nii.gz | tee scores
  grep -Eq "^Dice +0\.9[5-9]" scores
  test -s /usr/share/man/man1/flipfree.1.gz
'
inside apt-get purge --quiet --yes flipfree
inside /bin/sh -c '! test -e /usr/bin/flipfree && ! test -e /usr/lib/cmake/FlipFree &&
  ! test -e /usr/share/doc/flipfree && ! ls -d /usr/lib/python3*/dist-packages/flipfree 2>/dev/null'
echo "Installed, used and removed, as it should be."
