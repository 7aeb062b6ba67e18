#!/bin/sh
# Every test that a program holds is one that CTest runs:  registered.sh CTEST BUILD-FOLDER
set -eu
known=$(mktemp)
trap 'rm -f "$known"' EXIT
"$1" --test-dir "$2" -N | sed -n 's/^ *Test *#[0-9]*: //p' >"$known"
failed=0
programs=0
for program in "$2"/tests/test_*; do
  [ -x "$program" ] && [ -f "$program" ] || continue
  programs=$((programs + 1))
  module=${program##*/test_}
  for name in $("$program" --list); do
    if ! grep -q "\.$name\$" "$known"; then
      echo "$module.$name is in the program but not in CTest: write TEST($name) at the start of a line"
      failed=1
    fi
  done
done
[ "$programs" -gt 0 ] || { echo "no test program in $2/tests"; exit 1; }
exit $failed
