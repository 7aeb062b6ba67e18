#!/bin/sh
# Sees to it that commands are there, and installs the Debian or Ubuntu packages of those that are not.
#     sh tools/install_packages.sh COMMAND=PACKAGE...
# COMMAND is a command, or `/path/a|/path/b`: a file that one of these paths must name. Never prompts. Exit codes: 0
# everything is there; 1 something is missing and could not be installed (what and how is printed).
set -eu

present() {  # present COMMAND-OR-PATHS
  case $1 in
    /*)
      old_ifs=$IFS
      IFS='|'
      for path in $1; do
        IFS=$old_ifs
        if [ -e "$path" ]; then return 0; fi
      done
      IFS=$old_ifs
      return 1
      ;;
    *) command -v "$1" >/dev/null 2>&1 ;;
  esac
}

missing=
packages=
for pair in "$@"; do
  if ! present "${pair%=*}"; then
    missing="$missing ${pair%=*}"
    packages="$packages ${pair##*=}"
  fi
done
[ -n "$missing" ] || exit 0

fail() {
  printf '%s\n' "missing:$missing" "$1" >&2
  exit 1
}
as_root=
if [ "$(id -u)" != 0 ]; then as_root=sudo; fi
command -v apt-get >/dev/null 2>&1 ||
  fail "Install these with your system's package manager (on Debian:$packages), then run this again."
# On a terminal sudo may prompt for the password; elsewhere there is no prompt.
if [ -n "$as_root" ] && ! sudo -n true 2>/dev/null && ! { [ -t 0 ] && sudo -v; }; then
  fail "Run as root:  apt-get install$packages  and then run this again."
fi

# shellcheck disable=SC2086  # lists of words
quietly() {
  $as_root env DEBIAN_FRONTEND=noninteractive "$@" >"$log" 2>&1 </dev/null
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "installing:$packages" >&2
for attempt in 1 2 3; do  # a mirror's hiccup is not the user's problem
  # shellcheck disable=SC2086
  if quietly apt-get update -q &&
    quietly apt-get install -q -y --no-install-recommends $packages; then
    break
  fi
  if [ "$attempt" = 3 ]; then
    tail -n 15 "$log" >&2
    fail "apt-get could not install$packages: see the lines above, mend that, then run this again."
  fi
  sleep 3
done

for pair in "$@"; do
  present "${pair%=*}" || fail "${pair##*=} is installed, and still there is no ${pair%=*}."
done
