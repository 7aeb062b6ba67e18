# Compares figures of pages with tools/bench/RESULTS.md:  awk -v list=figures.txt -f results.awk tools/bench/RESULTS.md
# A row of figures.txt names a page, a row of RESULTS.md and words of the page: the table row or paragraph that holds the
# words must hold every number of that row's figure.
function numbers(text, set,    n, number) {
  n = 0
  while (match(text, /[0-9]+(,[0-9][0-9][0-9])*(\.[0-9]+)?/)) {
    number = substr(text, RSTART, RLENGTH)
    set[number] = 1
    order[++n] = number
    text = substr(text, RSTART + RLENGTH)
  }
  return n
}
function compare(page, words, row, figure,    text, unit, found, has, n, i, wanted, unused) {
  unit = ""
  while ((getline text < page) > 0) {
    if (text ~ /^\|/ || text == "") {
      if (index(unit, words)) { found = unit; break }
      unit = text
    } else unit = unit " " text
  }
  close(page)
  if (found == "" && index(unit, words)) found = unit
  if (found == "") { print page ": nothing says " words; bad = 1; return }
  n = numbers(figure, unused)
  for (i = 1; i <= n; ++i) wanted[i] = order[i]
  numbers(found, has)
  for (i = 1; i <= n; ++i) if (!(wanted[i] in has)) {
    print page ": " words ": " wanted[i] " is missing; tools/bench/RESULTS.md says " figure " of " row
    bad = 1
  }
}

/^\|/ { count = split($0, cell, "|"); if (count > 4) { what[++rows] = substr(cell[2], 2); figure_of[rows] = cell[3] } }
END {
  while ((getline text < list) > 0) {
    if (text ~ /^#/ || text == "") continue
    split(text, cell, "\t")
    row = 0
    for (i = 1; i <= rows && !row; ++i) if (index(what[i], cell[2]) == 1) row = i
    if (!row) { print "tools/bench/RESULTS.md: there is no row of " cell[2]; bad = 1; continue }
    ++compared
    compare(cell[1], cell[3], cell[2], figure_of[row])
  }
  if (compared < 5) { print list ": only " compared + 0 " figures were compared"; bad = 1 }
  exit bad
}
