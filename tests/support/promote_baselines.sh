#!/bin/sh
# Accepts the pictures of failed image tests as the new baselines. Look at them first.
# Usage: tests/support/promote_baselines.sh [BUILD_FOLDER] [NAME...]   (default: build/ci, all failed ones)
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${1:-$root/build/ci}
[ $# -gt 0 ] && shift
failures=$build/image_failures
if [ $# -eq 0 ]; then
  set -- $(find "$failures" -name '*.actual.png' -exec basename {} .actual.png \; 2>/dev/null | sort)
fi
[ $# -gt 0 ] || { echo "no failed pictures under $failures"; exit 0; }
mkdir -p "$root/tests/baselines"
for name; do
  cp "$failures/$name.actual.png" "$root/tests/baselines/$name.png"
  rm -f "$failures/$name.actual.png" "$failures/$name.expected.png" "$failures/$name.difference.png"
  echo "accepted $name"
done
