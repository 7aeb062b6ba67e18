# Finds retired terms:  awk -f vocabulary.awk LIST <FILES      (tests/check/vocabulary.sh; FILES: a path a line)
# LIST has a row a term, its cells separated by tabs: pattern, scopes, what to write instead, and optionally `where` (a
# regular expression of paths), `except` (phrases that contain the term and are fine).
# A pattern consists of lower-case words with one blank between them, and matches whole words. Scopes: name (identifiers
# and file names, cut at _ and at capitals), comment, message (string literals), page (Markdown, without code).
function words_of(text) {
  gsub(/--[a-z][a-z-]*/, " ", text)  # options keep their names
  gsub(/`[^`]*`/, " ", text)         # quoted code is checked where it stands
  text = tolower(" " text " ")
  gsub(/[^a-z0-9]+/, " ", text)
  return text
}

function names_of(text) {
  gsub(/[^A-Za-z0-9_]+/, "|", text)
  gsub(/[A-Z]/, " &", text)
  gsub(/_/, " ", text)
  gsub(/\|/, " | ", text)
  text = tolower(" " text " ")
  gsub(/ +/, " ", text)
  return text
}

# Reports every retired term of `text` that ends behind its first `carried` characters.
function look(scope, text, carried,    i, rest, at) {
  if (text !~ any[scope]) return
  for (i = 1; i <= terms; ++i) {
    if (!((i, scope) in applies) || (where[i] != "" && file !~ where[i])) continue
    rest = text
    if (except[i] != "") gsub(" (" except[i] ") ", " . ", rest)
    at = 0
    while (match(substr(rest, at + 1), " (" pattern[i] ") ")) {
      if (rest != text || at + RSTART + RLENGTH - 2 > carried) {
        print file ":" line ": " scope ": " substr(rest, at + RSTART + 1, RLENGTH - 2) ": write " instead[i]
        bad = 1
        break
      }
      at += RSTART
    }
  }
}

# Comments and paragraphs go on from line to line: the end of the line before is looked at with each line.
function look_on(scope, text,    all) {
  text = words_of(text)
  if (text == " ") return
  all = (line == last_line[scope] + 1 ? tail[scope] : "") text
  look(scope, all, length(all) - length(text))
  tail[scope] = length(text) > 24 ? substr(text, length(text) - 24) : text
  sub(/^[^ ]* /, " ", tail[scope])
  sub(/ $/, "", tail[scope])
  last_line[scope] = line
}

function cut_c(text,    at, piece) {
  code = ""; comment = ""; message = ""
  while (text != "") {
    if (in_comment) {
      at = index(text, "*/")
      comment = comment " " (at ? substr(text, 1, at - 1) : text)
      if (!at) return
      text = substr(text, at + 2)
      in_comment = 0
    } else if (in_raw) {
      at = index(text, ")\"")
      message = message " " (at ? substr(text, 1, at - 1) : text)
      if (!at) return
      text = substr(text, at + 2)
      in_raw = 0
    } else if (match(text, is_js ? js_literal : cpp_literal)) {
      piece = substr(text, RSTART, RLENGTH)
      code = code substr(text, 1, RSTART - 1) " "
      text = substr(text, RSTART + RLENGTH)
      if (piece == "/*") in_comment = 1
      else if (piece == "R\"(") in_raw = 1
      else if (piece ~ /^\/\//) comment = comment " " piece
      else if (piece ~ /^"/ || is_js) message = message " " piece
    } else {
      code = code text
      return
    }
  }
}

BEGIN {
  FS = "\t"
  string = "\"([^\"\\\\]|\\\\.)*\""
  cpp_literal = "R\"\\(|" string "|'([^'\\\\]|\\\\.)'|//.*|/\\*"
  js_literal = string "|'([^'\\\\]|\\\\.)*'|`([^`\\\\]|\\\\.)*`|//.*|/\\*"
  while ((getline row < list) > 0) {
    if (row ~ /^#/ || row == "") continue
    count = split(row, cell, "\t")
    if (count < 3) { print list ": a row has at least three cells: " row; bad = 1; continue }
    pattern[++terms] = cell[1]
    instead[terms] = cell[3]
    where[terms] = count > 3 ? cell[4] : ""
    except[terms] = count > 4 ? cell[5] : ""
    scopes = split(cell[2], scope, ",")
    for (k = 1; k <= scopes; ++k) {
      applies[terms, scope[k]] = 1
      any[scope[k]] = any[scope[k]] (any[scope[k]] == "" ? " (" : "|") cell[1]
    }
  }
  for (s in any) any[s] = any[s] ") "
}

{
  file = $0
  line = 0
  in_comment = in_block = in_raw = 0
  for (s in last_line) last_line[s] = -1
  ++files
  is_js = file ~ /\.js$/
  kind = file ~ /\.(hpp|cpp|h|c|html|js)$/ ? "c" : file ~ /\.md$/ ? "page" : "script"
  base = file
  sub(/.*\//, "", base)
  sub(/\..*/, "", base)
  look("name", names_of(" " base " "), 0)
  while ((getline text < file) > 0) {
    ++line
    if (text ~ /former name/) continue  # an old option or parameter that is still taken
    if (kind == "c") {
      if (text ~ /^[ \t]*#[ \t]*include/) continue
      cut_c(text)
      look("name", names_of(code), 0)
      if (comment != "") look_on("comment", comment)
      if (message != "") look_on("message", message)
    } else if (kind == "page") {
      if (text ~ /^ *```/) in_block = !in_block
      if (in_block || text ~ /^    /) continue
      look_on("page", text)
    } else if (match(text, /(^|[ \t])#[^!].*/)) {
      look_on("comment", substr(text, RSTART))
    }
  }
  close(file)
}

END {
  if (files < 50) { print "only " files + 0 " files were found: this check looks in the wrong place"; bad = 1 }
  if (terms < 20) { print list ": only " terms + 0 " terms"; bad = 1 }
  exit bad
}
