# What is made from --help: man pages and completions. Read by tests/cli/run.

completed() {  # completed PROGRAM COMMAND BEFORE WORD: what bash offers
  bash -c '. "$1"; COMP_WORDS=("$2" "$3" "$4" "$5") COMP_CWORD=3; "_${2//-/_}"; printf "%s\n" "${COMPREPLY[@]}"' \
    sh "data/bash-completion/completions/$1" "$@"
}
EveryOptionOfHelpIsCompletedAndOnItsManPage() {
  bin=${firmtouch%/*}
  sh "$here/../../tools/cli/help_pages.sh" "$bin" data || fail 'no pages are made'
  count=0
  for program in firmtouch firmtouch-sim; do
    for command in $("$bin/$program" --help | sed -n 's/^  \([a-z][a-z-]*\)  *[^ ].*/\1/p'); do
      sed 's/\\-/-/g' "data/man/man1/$program-$command.1" >page || fail "no man page of $program $command"
      for option in $("$bin/$program" "$command" --help | grep -oE '^  --?[a-z-]+') --help; do
        count=$((count + 1))
        [ "$option" = --help ] || grep -qE -- "^\.B $option( |\$)" page || fail "$program $command: $option is on no man page"
        ! command -v bash >/dev/null || completed $program "$command" x "$option" | grep -qx -- "$option" ||
          fail "$program $command: $option is not completed"
      done
    done
  done
  [ $count -ge 100 ] || fail "only $count options"
  ! command -v bash >/dev/null || same "$(completed firmtouch bake --unit '' | tr '\n' ' ')" 'm mm cm in '
}
