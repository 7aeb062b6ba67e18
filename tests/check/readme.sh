# README.md shows no code that is not in the tree: a block under a line `<!-- PATH -->` is that file, word for word, and
# compiles; every C++ block has such a line. Commands that it names exist, and so do its links and pictures.
# Read by tests/check/run.

check() {
  bad=0
  work=$(mktemp -d) || return 1
  awk -v work="$work" '
    /^<!-- [A-Za-z0-9_.\/-]+ -->$/ { path = $2; next }
    /^```/ && !inside {
      inside = 1
      language = substr($0, 4)
      if (path == "" && language ~ /^(cpp|c\+\+|cmake|c)$/) {
        print "README.md:" FNR ": a block of " language " without a line `<!-- PATH -->` above it"; bad = 1
      }
      if (path != "") { out = work "/" ++n; printf "" >out; print path >(work "/" n ".path") }
      next
    }
    /^```$/ { inside = 0; if (out != "") close(out); out = ""; path = ""; next }
    inside { if (out != "") print >out; next }
    /./ { path = "" }
    END { exit bad }' README.md || bad=1
  # A block of the controller program sees a composition as CMake makes it.
  printf '#pragma once\n#include "firmtouch/controller/full_controller.hpp"\nnamespace firmtouch::app { using AppController = FullController; }\n' >"$work/composition.hpp"
  for list in "$work"/*.path; do
    [ -e "$list" ] || { echo 'README.md: no block is extracted from a source'; bad=1; break; }
    path=$(cat "$list")
    if [ ! -f "$path" ]; then
      echo "README.md: there is no $path"
      bad=1
      continue
    fi
    diff "$path" "${list%.path}" >"$work/difference" || {
      echo "README.md: the block of $path is not what the file says:"
      head -n 6 "$work/difference"
      bad=1
    }
    case $path in
      *.cpp)
        ${CXX:-g++} -std=c++17 -ffreestanding -fno-exceptions -fno-rtti -Wall -Wextra -Werror -Ifirmware -Ihal \
          -I"$(dirname "$path")" -I"$work" -x c++ -fsyntax-only "${list%.path}" ||
          { echo "README.md: the block of $path does not compile"; bad=1; }
        ;;
    esac
  done
  # Links and pictures of every page, from the page's folder.
  for page in *.md $(find firmware tools hal -name '*.md'); do
    for target in $(grep -oE '\]\([^)#]+\)' "$page" | sed 's/.*](\(.*\))/\1/' | grep -vE '^(https?|mailto):' | sort -u); do
      [ -e "$(dirname "$page")/$target" ] || { echo "$page: the link to $target leads nowhere"; bad=1; }
    done
  done
  # Commands: the scripts exist, and the two of the README come before all others.
  for command in $(grep -oE '(^|[ `(])(\./)?(tools|hal|tests)/[A-Za-z0-9_/.-]+' README.md | tr -d ' `(' | sed 's/[.,:]*$//' | sort -u); do
    [ -e "$command" ] || { echo "README.md: there is no $command"; bad=1; }
  done
  first=$(awk '/^```/ { if (inside) exit; inside = 1; next } inside' README.md | grep -oE 'tools/[a-z]+' | tr '\n' ' ')
  [ "$first" = 'tools/demo tools/test ' ] || { echo "README.md: the first block is the two commands, not: $first"; bad=1; }
  rm -rf "$work"
  return $bad
}

edits() {
  cat <<'END'
changed_block @ README.md @ s/hal::board_begin();/hal::board_begin(1);/ @ the block of .*minimal/main.cpp is not what the file says
interface_that_moved_on @ hal/firmtouch/hal/clock.hpp @ s/clock_us()/clock_microseconds()/ @ the block of .*minimal/main.cpp does not compile
END
}
plant_changed_source() {
  echo '// one more line' >>tests/consumer/minimal/main.cpp
  expect='the block of .*minimal/main.cpp is not what the file says'
}
plant_loose_code() {
  printf '\n```cpp\nint nobody_compiles_this;\n```\n' >>README.md
  expect='a block of cpp without a line'
}
plant_dead_link() {
  echo 'See [there](tools/nowhere.md).' >>README.md
  expect='the link to tools/nowhere.md leads nowhere'
}
plant_missing_command() {
  echo 'Run `tools/nothing`.' >>README.md
  expect='there is no tools/nothing'
}
