#!/bin/sh
# Man pages and bash completions of both programs, made from what their --help prints:
#     tools/cli/help_pages.sh BIN DATA
# BIN: the folder of `firmtouch` and `firmtouch-sim`. Writes DATA/man/man1/*.1 and DATA/bash-completion/completions/*;
# `cmake --install` runs it.
set -eu
[ $# = 2 ] || { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2; }
bin=$1
man=$2/man/man1
completions=$2/bash-completion/completions
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd -P)
mkdir -p "$man" "$completions"

# page NAME TEXT [SEE ALSO]
page() { printf '%s\n' "$2" | awk -v name="$1" -v version="$version" -v also="${3-}" -f "$here/man_page.awk" >"$man/$1.1"; }

for program in firmtouch firmtouch-sim; do
  version=$("$bin/$program" --version)
  help=$("$bin/$program" --help)
  commands=$(printf '%s\n' "$help" | awk '/^  [a-z]/ { print $1 }')
  page $program "$help" "$(for command in $commands; do printf '%s-%s(1) ' $program "$command"; done)"
  function=_$(echo $program | tr - _)
  {
    echo "# bash completion of $program, made from its --help (tools/cli/help_pages.sh)"
    echo "$function() {"
    echo '  local command=${COMP_WORDS[1]} before=${COMP_WORDS[COMP_CWORD-1]} word=${COMP_WORDS[COMP_CWORD]} words='
    echo '  case $COMP_CWORD:$command:$before in'
    echo "    1:*) words='$(echo $commands) --help --version' ;;"
    for command in $commands; do
      text=$("$bin/$program" "$command" --help)
      page "$program-$command" "$text"
      # Values that are words to choose from, such as m|mm|cm|in; then the options.
      printf '%s\n' "$text" | awk -v command="$command" '
        !/^  -/ { next }
        { options = options (options == "" ? "" : " ") $1 }
        $2 ~ /^[a-z0-9]+(\|[a-z0-9]+)+$/ { values = $2; gsub(/\|/, " ", values); print "    *:" command ":" $1 ") words=\047" values "\047 ;;" }
        END { print "    *:" command ":*) [ \"${word#-}\" = \"$word\" ] || words=\047" options "\047 ;;" }'
    done
    echo '  esac'
    echo '  COMPREPLY=($(compgen -W "$words" -- "$word"))  # nothing: files'
    echo '}'
    echo "complete -o default -F $function $program"
  } >"$completions/$program"
done
