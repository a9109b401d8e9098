#!/usr/bin/env bash
# Installs the Debian package on a clean Debian 12, in a folder made for it by debootstrap, and works with
# it there: the command, its manual page, and Python. Wants root and a Debian mirror.
#
#   install-in-chroot.sh PACKAGE.deb [FOLDER]
#
# FOLDER, by default a temporary one that is removed at the end, is made where it is absent; where it is a
# clean system already, that is taken.
set -euo pipefail

if (($# < 1)) || [[ $1 == -* ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  [[ ${1:-} == -h || ${1:-} == --help ]] && exit 0 || exit 2
fi
package=$1
if (($# > 1)); then
  root=$2
else
  root=$(mktemp -d)
  trap 'rm -rf --one-file-system "$root"' EXIT
fi
if [[ ! -e $root/usr/bin/apt-get ]]; then
  debootstrap --variant=minbase bookworm "$root"
fi
cp "$package" "$root/tmp/flipfree.deb"
cp /etc/resolv.conf "$root/etc/resolv.conf"

inside()
{
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
    DEBIAN_FRONTEND=noninteractive "$@"
}

inside apt-get update --quiet
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
