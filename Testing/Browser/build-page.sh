#!/usr/bin/env bash
# Builds the package and the page for the browser.
#
#   build-page.sh FOLDER
#
# Ends with 77, which CTest takes for skipped, where the tools cannot be had.
set -euo pipefail

rm -f "$1/built"
for tool in emcc node npm; do
  if ! command -v "$tool" >/dev/null; then
    echo "Skipped: there is no $tool here (Wrapping/Setup/install-dependencies.sh test installs it)."
    exit 77
  fi
done
"$(dirname "${BASH_SOURCE[0]}")/../../Wrapping/Browser/build.sh" "$1"
touch "$1/built"
