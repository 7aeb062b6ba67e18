# Compares the figures of README.md with those measured:
#     awk -f figures.awk TABLE README.md hull/README.md servo/README.md asset/README.md
# TABLE: what tools/bench/cortex-m7, tools/check/image and the closed loop printed, one after the other. A row that differs
# is printed as it should be.
function commas(number,    text, out) {
  text = sprintf("%.0f", number)
  while (length(text) > 3) {
    out = "," substr(text, length(text) - 2) out
    text = substr(text, 1, length(text) - 3)
  }
  return text out
}

function trusted() { return flash["mps2-an500 mesh;guide;trusted)"] " instead of " flash["mps2-an500 mesh;guide)"] }

FNR == 1 { ++files }
files == 1 {
  if (/warm queries/) model = /^the demo part:/ ? "demo part" : /rocker-arm/ ? "rocker-arm" : "other"
  if (/the whole controller program/) {
    board = $1
    sub(/,$/, "", board)
    if (!/: all\)/) board = board " " $NF  # of another composition than the full one
  }
  if ($1 == "instructions" && $4 == "p99.9") measured[model] = "mean " commas($3) ", worst " commas($7)
  if ($1 == "tick" && $2 == "servo") servo = commas($3) " and worst " commas($4)
  if ($1 == "tick") measured["tick " $2] = "mean " commas($3) ", worst " commas($4)
  if ($1 == "shell" && hull == "") hull = "mean " commas($6) " and worst " commas($10)  # of the demo part, first
  if ($1 == "flash") { measured[board] = commas($2) " B, "; flash[board] = commas($2) }
  if ($1 == "RAM") measured[board] = measured[board] commas($2) " B, "
  if ($1 == "worst" && $2 == "stack") measured[board] = measured[board] commas($3) " B"
  next
}

files == 5 { if (index($0, "takes " trusted() " bytes")) is_trusted = 1; next }
files == 4 { if (index($0, "mean " servo " instructions")) is_servo = 1; next }
files == 3 { if (hull != "" && index($0, hull)) is_hull = 1; next }

!/^\|/ { next }
{
  key = ""
  if (/`tools\/bench\/cortex-m7`/) key = "demo part"
  if (/`tools\/bench\/cortex-m7 MODEL`/ && /rocker-arm/) key = "rocker-arm"
  if (/^\| a whole tick/) key = "tick mps2-an500"
  if (match($0, /`tools\/check\/image [a-z0-9-]+`/)) key = substr($0, RSTART + 19, RLENGTH - 20) (/\(`mesh`\)/ ? " mesh)" : "")
  if (key == "") next
  seen[key] = 1
  if (!(key in measured)) next
  split($0, cell, "|")
  if (cell[3] == " " measured[key] " ") next
  print "README.md:" FNR ": the figures are not what was measured; paste this line:"
  print "|" cell[2] "| " measured[key] " |" cell[4] "|"
  bad = 1
}

END {
  if (!is_hull) { print "firmware/firmtouch/hull/README.md: the base hull of the demo part was measured with " hull; bad = 1 }
  if (!is_servo) { print "firmware/firmtouch/servo/README.md: the servo at two rates was measured with mean " servo; bad = 1 }
  if (!is_trusted) { print "firmware/firmtouch/asset/README.md: `mesh;guide` takes " trusted() " bytes of flash"; bad = 1 }
  split("demo part,tick mps2-an500,mps2-an500,netduinoplus2 mesh)", wanted, ",")
  for (i = 1; i in wanted; ++i) {
    if (!(wanted[i] in measured)) { print "the table holds no figures of " wanted[i]; bad = 1 }
    if (!(wanted[i] in seen)) { print "README.md: there is no row of " wanted[i]; bad = 1 }
  }
  exit bad
}
