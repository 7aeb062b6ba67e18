# Names functions of more than 80 lines, from their first line to their closing brace. Reads sources laid out by
# clang-format: a block closes with a brace below the first letter of the statement that opened it. Read by layout.sh.
FNR == 1 { depth = 0; fresh = 1 }
/^ *(\/\/.*)?$/ || /^#/ { next }
fresh { start = FNR; text = ""; match($0, /^ */); indent = RLENGTH }
{ text = text " " $0; fresh = /[;{}]( *\/\/.*)?$/ || /^ *(public|private|protected|case [^?]*|default):$/ }
/^ *}/ {
  match($0, /^ */)
  while (depth > 0 && indents[depth] >= RLENGTH) {
    lines = FNR - starts[depth] + 1
    if (indents[depth] == RLENGTH && is_function[depth] && lines > 80) {
      print FILENAME ":" starts[depth] ": a function of " lines " lines; 80 is the most: what are its steps called?"
      bad = 1
    }
    depth--
  }
}
/{( *\/\/.*)?$/ {
  ++depth
  indents[depth] = indent
  starts[depth] = start
  sub(/^ *template <[^{(]*> /, "", text)
  is_function[depth] = text ~ /\(/ && text !~ /^ *(\[\[[^]]*\]\] *)?(namespace|struct|class|enum|union|if|for|while|switch|else|do|case|}|extern "C" {)/ && text !~ / = {/
}
END { exit bad }
