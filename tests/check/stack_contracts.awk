# From headers: `FILE BYTES ROOT` for each declaration whose comment states a figure of stack. ROOT is what firmtouch-stack
# looks for: a function, or a pattern of a class's functions; `?` if the figure belongs to neither. Of several figures the
# largest counts.
function figure(text,    rest, value, most) {
  sub(/.*Bounds:/, "", text)
  sub(/\. (Result|Error|Pre).*/, "", text)
  most = 0
  while (match(text, /[0-9.,]+ [kK]?B( of stack)?/)) {
    rest = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    value = rest
    sub(/ .*/, "", value)
    gsub(/,/, "", value)
    if (rest ~ / [kK]B/) value *= 1024
    if (value > most) most = value
  }
  return int(most)
}
# The linker's names of a class's functions.
function members_of(class,    word, count, i, pattern) {
  count = split(class, word, "::")
  for (i = 1; i <= count; ++i) pattern = pattern length(word[i]) word[i]
  return "_ZN*" pattern "*"
}
function state(root) {
  print FILENAME, figure(comment), root
  comment = ""
}
FNR == 1 { kind = comment = "" }
/^namespace / { space = $2 }
/^};/ { kind = "" }
/^ *\/\/\// {
  line = $0
  sub(/^ *\/\/\/ */, "", line)
  comment = comment " " line
  next
}
/^ *(\[\[|template)/ { next }
/^(class|struct) [A-Za-z0-9]+/ {
  kind = $2
  if (comment ~ /[0-9] [kK]?B of stack/) state(members_of(space "::" kind))
}
comment ~ /[0-9] [kK]?B of stack/ {
  if (match($0, /[A-Za-z0-9_]+\(/)) {
    state(space "::" ($0 ~ /^ / && kind != "" ? kind "::" : "") substr($0, RSTART, RLENGTH - 1))
  } else if (/[;{}]|^$/) {
    state("?")
  } else {
    next  # a declaration over several lines
  }
}
{ comment = "" }
