#!/usr/bin/env bash
# Builds FlipFree's page for the browser and serves it on this machine alone:
#
#   serve.sh [PORT]
#
#   PORT  by default 8080
#
# What is missing is installed first, see build.sh. Ctrl-C ends it.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
    exit 0
    ;;
esac
port=${1:-8080}
here=$(cd -P "$(dirname "${BASH_SOURCE[0]}")" && pwd)
"$here/build.sh"
echo "Open http://127.0.0.1:$port in a browser."
exec python3 -m http.server "$port" --bind 127.0.0.1 --directory "$here/../../build/browser/page"
