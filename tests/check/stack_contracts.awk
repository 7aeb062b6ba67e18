# From a header: `BYTES FUNCTION` for each declaration whose comment states a figure of stack. Of several figures the
# largest counts.
function figure(text,    rest, value, most) {
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
  return most
}
/^namespace / { space = $2; kind = ""; next }
/^(class|struct) [A-Za-z]+/ { kind = $2 "::" }
/^};/ { kind = "" }
/^ *\/\/\// { line = $0; sub(/^ *\/\/\/ ?/, "", line); comment = comment " " line; next }
/^ *(\[\[|template)/ { next }
{
  if (comment ~ /of stack/ && match($0, /[A-Za-z_]+\(/)) {
    name = space "::" ($0 ~ /^ / ? kind : "") substr($0, RSTART, RLENGTH - 1)
    sub(/.*Bounds:/, "", comment)
    sub(/\. (Result|Error|Pre).*/, "", comment)
    bytes = figure(comment)
    if (bytes > 0) print int(bytes), name
  }
  comment = ""
}
