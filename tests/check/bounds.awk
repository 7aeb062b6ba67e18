# From headers: `HEADER INSTRUCTIONS` for each figure of instructions that a `Bounds:` states, in their order; HEADER as
# in an #include.
function finish(    value) {
  sub(/\. (Result|Error|Pre|Pose).*/, "", bounds)
  while (match(bounds, /[0-9,]+ instructions/)) {
    value = substr(bounds, RSTART, RLENGTH)
    bounds = substr(bounds, RSTART + RLENGTH)
    gsub(/[^0-9]/, "", value)
    print header, value
  }
  bounds = ""
}
FNR == 1 { finish(); header = FILENAME; sub(/.*\/firmtouch\//, "", header) }
!/^ *\/\/\// { finish(); next }
{
  line = $0
  sub(/^ *\/\/\/ */, "", line)
  if (line ~ /^(Result|Error|Pre|Source):/) finish()
  if (bounds != "") bounds = bounds " " line
  else if (sub(/.*Bounds:/, "", line)) bounds = line
}
END { finish() }
