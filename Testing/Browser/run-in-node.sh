#!/usr/bin/env bash
# Runs a test of what build-page.sh has built.
#
#   run-in-node.sh FOLDER TEST.mjs
set -euo pipefail

if [[ ! -e $1/built ]]; then
  echo "Skipped: the page could not be built here (see the test Browser.Build)."
  exit 77
fi
export FLIPFREE_BROWSER_PACKAGE=$1/package FLIPFREE_BROWSER_PAGE=$1/page
if [[ $2 == *TestPage.mjs ]]; then
  if ! FLIPFREE_CHROMIUM=$(command -v chromium); then
    echo "Skipped: there is no chromium here (Wrapping/Setup/install-dependencies.sh test installs it)."
    exit 77
  fi
  export FLIPFREE_CHROMIUM
fi
exec node --test --test-reporter=spec "$2"
