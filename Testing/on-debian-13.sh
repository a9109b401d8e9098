#!/usr/bin/env bash
# Runs every check of run-all.sh, beside this script, on a clean Debian 13, which debootstrap makes in a folder. Checked
# is a clone of what is committed here. Wants root; run it before each release.
#
#   on-debian-13.sh [--root FOLDER] [OPTION...]
#
#   --root FOLDER  where the system is (default: build/debian-13 in the source folder); it is kept, and taken again if
#                  it is there
#   OPTION         of run-all.sh, such as --quick
#
# Proxies, and the package indices of pip and npm, are those of the environment.
set -euo pipefail

here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$here/../build/debian-13
case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
  --root)
    folder=${2:?--root wants a folder}
    shift 2
    ;;
esac
source "$here/Support/debian-root.sh"

make_root trixie "$folder"
# Whatever signs the connections here, by a certificate of its own, does so there.
inside apt-get install --quiet --yes --no-install-recommends ca-certificates ccache
if [[ -d /usr/local/share/ca-certificates ]]; then
  find /usr/local/share/ca-certificates -name '*.crt' -exec cp -t "$root/usr/local/share/ca-certificates" {} +
fi
inside update-ca-certificates

rm -rf --one-file-system "$root/root/flipfree"
git clone --quiet "$here/.." "$root/root/flipfree"
mapfile -t environment < <(env | grep -iE '^([a-z]+_proxy|pip_[a-z_]+|npm_config_[a-z_]+)=')
inside "${environment[@]}" /root/flipfree/Testing/run-all.sh "$@"
