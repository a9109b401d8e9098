# Clean Debian systems in folders, for the scripts that try FlipFree there; they source this. Wants root.

# make_root RELEASE [FOLDER]: makes it by debootstrap in FOLDER, by default a temporary one that is removed at the end;
# where it is a clean system already, that is taken. From then on, $root is the folder. Packages come from where this
# machine's apt gets its own.
make_root()
{
  if ((EUID != 0)); then
    echo "Only root can make a Debian system in a folder." >&2
    return 1
  fi
  if [[ -n ${2:-} ]]; then
    mkdir -p "$2"
    root=$(cd -P "$2" && pwd)
  else
    root=$(mktemp -d)
    chmod 755 "$root" # apt downloads as a user of its own
    trap 'rm -rf --one-file-system "$root"' EXIT
  fi
  if [[ ! -e $root/usr/bin/apt-get || -e $root/debootstrap ]]; then
    if ! command -v debootstrap >/dev/null; then
      DEBIAN_FRONTEND=noninteractive apt-get install --quiet --yes --no-install-recommends debootstrap
    fi
    local mirror
    # shellcheck disable=SC2016 # the variable is apt's
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' | sed -n 1p)
    debootstrap --variant=minbase "$1" "$root" ${mirror:+"$mirror"}
  fi
  # The system is thrown away: its packages need not be written to the disk one by one.
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
  apt-config dump Acquire | grep -v '^Acquire::IndexTargets' >"$root/etc/apt/apt.conf.d/acquire"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  inside apt-get update --quiet
}

# inside COMMAND...: runs it there, on devices and processes of its own, which go when it ends. The shell stays as the
# first of these processes, which gets no signal that it has no handler for: xvfb-run waits for one.
inside()
{
  # shellcheck disable=SC2016 # the variables are the inner shell's
  unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" /bin/sh -ec '
    mount --rbind /dev "$1/dev"
    mount --rbind /sys "$1/sys"
    chroot "$@" || exit
  ' sh "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"
}
