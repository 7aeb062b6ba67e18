# Checks the promise table of VERIFICATION.md (tests/check/promises.sh): `test NAME`, `word WORD` and `file PATH` say what
# exists, `text ...` are the lines of VERIFICATION.md, `page PATH ...` those of the other pages.
function complain(what) {
  print "VERIFICATION.md: " promise ": " what
  bad = 1
}

function report(what) {
  print page ": " what
  bad = 1
}

function has_file(path,    f) {
  if (path in file) return 1
  sub(/\/$/, "", path)
  return path in folder || ("firmware/firmtouch/" path) in file
}

function check_name(token) {
  if (token ~ /^[a-z_]+\.[A-Za-z0-9_.]+$/ && token !~ /\.(cpp|hpp|md|sh|cmake|awk|txt|ld)$/) {
    if (!(token in test)) complain("there is no test " token)
  } else if (token ~ /^[A-Za-z0-9_.\/-]+$/ && token ~ /[\/.]/) {
    if (!has_file(token)) complain("there is no " token)
  } else {
    complain("`" token "` is neither a file nor a test")
  }
}

function check_command(token,    part) {
  split(token, part, " ")
  if (token ~ / (--help|-h)( |$)/) { complain("`" token "` prints no figure"); return }
  # Without its rows a query waits for them.
  if (part[2] == "query" && token !~ /[|<]/) { complain("`" token "` waits on standard input"); return }
  if (part[1] ~ /^build\/[a-z0-9-]+\/bin\/firmtouch(-sim)?$/) {
    if (part[2] !~ /^--/ && !(part[2] in word)) complain("no command " part[2] " of " part[1])
  } else if (part[1] ~ /^[A-Z_]+=/ || part[1] == "ctest" || part[1] == "sh") {
    return
  } else if (!has_file(part[1])) {
    complain("there is no " part[1])
  }
}

# Every backquoted word of a cell; returns how many.
function check_cell(cell, kind,    count, token) {
  while (match(cell, /`[^`]+`/)) {
    token = substr(cell, RSTART + 1, RLENGTH - 2)
    cell = substr(cell, RSTART + RLENGTH)
    ++count
    if (kind == "command") check_command(token)
    else check_name(token)
  }
  return count + 0
}

$1 == "test" { test[$2] = 1; next }
$1 == "word" { word[$2] = 1; next }
$1 == "file" {
  path = substr($0, 6)
  file[path] = 1
  while (sub(/\/[^\/]*$/, "", path)) folder[path] = 1
  next
}

# A line of another page: a test or a file that it names in backquotes exists.
$1 == "page" {
  page = $2
  folder_of = page
  if (!sub(/[^\/]*$/, "", folder_of)) folder_of = ""
  rest = substr($0, length($1) + length($2) + 3)
  while (match(rest, /`[^`]+`/)) {
    token = substr(rest, RSTART + 1, RLENGTH - 2)
    rest = substr(rest, RSTART + RLENGTH)
    sub(/ .*/, "", token)
    if (token ~ /^[a-z_]+\.[A-Z][A-Za-z0-9_]*$/ && !(token in test)) report("there is no test " token)
    if (token ~ /^[A-Za-z0-9_.\/-]+\.(hpp|cpp|sh|md|awk|cmake|ld|svg|pml|obj|igs)$/ || token ~ /^(firmware|hal|tools|tests|host_sim)\//) {
      if (!has_file(token) && !has_file(folder_of token)) report("there is no " token)
    }
  }
  next
}

{ line = substr($0, 6) }
line !~ /^\|/ { in_table = 0; next }
line ~ /^\| *[Pp]romise *\| *[Mm]echanism/ { in_table = 1; next }
!in_table || line ~ /^\|[-:| ]+$/ { next }
{
  cells = split(line, cell, "|")
  promise = cell[2]
  gsub(/^ +| +$/, "", promise)
  if (cells != 6) { complain("a row has four cells"); next }
  ++rows
  if (!check_cell(cell[3], "name")) complain("names no mechanism")
  if (!check_cell(cell[4], "name")) complain("names no attack")
  if (!check_cell(cell[5], "command")) complain("names no command for its figure")
}

END {
  if (rows < 5) {
    print "VERIFICATION.md: no promise table"
    bad = 1
  }
  exit bad
}
