#!/usr/bin/env bash
# Makes a C++ compiler whose programs run with an older C library than this system's. It is the system's GCC, so results
# have the bits of the toolkit; Clang's differ in the last digits. It links the stubs of that C library, which the
# package ziglang of the package index makes, and makes libstdc++ part of what it links.
#
#   make-compiler.sh PYTHON GLIBC COMPILER
#
#   PYTHON    of an environment with ziglang
#   GLIBC     version of the C library, such as 2.28
#   COMPILER  the file to write; what it needs goes into a folder beside it, COMPILER-files
set -euo pipefail

if [[ $# != 3 ]]; then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  [[ ${1:-} == -h || ${1:-} == --help ]] && exit 0 || exit 2
fi
files=$(realpath "$3")-files
if ! command -v g++ >/dev/null; then
  echo "There is no g++, which the wheels are compiled by (on Debian: apt install g++)." >&2
  exit 1
fi
mkdir -p "$files"

# Zig links stubs of the system's libraries, each with the symbols of that version, and keeps them in its cache.
stubs=$files/glibc-$2
if [[ ! -d $stubs ]]; then
  rm -rf "$stubs.part"
  mkdir "$stubs.part"
  echo 'int nothing;' >"$files/nothing.c"
  ZIG_GLOBAL_CACHE_DIR=$files/cache ZIG_LOCAL_CACHE_DIR=$files/cache \
    "$1" -m ziglang cc -target "$(uname -m)-linux-gnu.$2" -shared -o "$files/nothing.so" "$files/nothing.c"
  made=$(find "$files/cache" -name libc.so.6 -printf '%h\n' -quit)
  for library in "${made:?Zig has kept no stubs in $files/cache}"/lib*.so.*; do
    name=${library##*/}
    cp "$library" "$stubs.part/${name%%.so*}.so"
  done
  mv "$stubs.part" "$stubs"
  rm -rf "$files/cache" "$files"/nothing.*
fi

g++ -x c -D_GNU_SOURCE -O2 -fPIC -c "$(dirname "${BASH_SOURCE[0]}")/OlderGlibc.c" -o "$files/older.o"

# Other modules of the same process may have another libstdc++, so ours is hidden.
cat >"$3" <<COMPILER
#!/bin/sh
case " \$* " in
  *" -shared "*)
    exec g++ -static-libstdc++ -Wl,--exclude-libs,libstdc++.a -L'$stubs' "\$@" '$files/older.o' -lpthread -ldl -lld
    ;;
  *) exec g++ "\$@" ;;
esac
COMPILER
chmod +x "$3"
