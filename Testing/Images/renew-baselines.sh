#!/usr/bin/env bash
# Replaces the baselines of the image tests that fail, or have none yet, by the pictures they draw now,
# and lists them. Look at each before you commit it.
#
#   renew-baselines.sh [build folder] [regular expression]
#
#   build folder        default build/dev; configured before, built here
#   regular expression  the tests in question, such as 'Cup|UTube'; default all image tests
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
esac

root=$(cd -P "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$(cd -P "${1:-$root/build/dev}" && pwd)
pictures=$build/Testing/Temporary
baselines=$root/Testing/Data/Baseline

cmake --build "$build" --target TestImages
# What an earlier run left would pass for a new picture.
rm -f "$pictures"/Test*.png
tests="^Images\\..*(${2:-})"
if ctest --test-dir "$build" -R "$tests" -N | grep -q '^Total Tests: 0'; then
  echo "There is no image test of the name '${2:-}' in $build." >&2
  exit 1
fi
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run --auto-servernum --server-args="-screen 0 1280x1024x24 -noreset" \
  ctest --test-dir "$build" -R "$tests" || true

shopt -s nullglob
renewed=0
for picture in "$pictures"/Test*.png; do
  case "$picture" in
    *.diff.png) continue ;;
  esac
  install -m 644 "$picture" "$baselines/"
  echo "renewed: Testing/Data/Baseline/$(basename "$picture")"
  renewed=$((renewed + 1))
done
if ((renewed)); then
  echo "Look at them; then commit them, and say what is to be seen on them."
else
  echo "All baselines are up to date."
fi
