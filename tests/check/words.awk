# Reads file names; prints the words of each file that freestanding code must not say (tests/check/words.sh).
function complain(text) {
  print file ":" line ": " text
  bad = 1
}

# The line without its comments, strings and character literals.
function code(text,    out, at, rest) {
  out = ""
  while (text != "") {
    if (in_comment) {
      at = index(text, "*/")
      if (!at) return out
      text = substr(text, at + 2)
      in_comment = 0
    } else if (match(text, /"([^"\\]|\\.)*"|'([^'\\]|\\.)+'|\/\/.*|\/\*/)) {
      rest = substr(text, RSTART, RLENGTH)
      # 1'000'000: digit separators are not characters
      if (substr(rest, 1, 1) == "'" && RSTART > 1 && substr(text, RSTART - 1, 1) ~ /[0-9a-fA-F]/) {
        out = out substr(text, 1, RSTART - 1)
        text = substr(text, RSTART + 1)
        continue
      }
      out = out substr(text, 1, RSTART - 1) " "
      text = substr(text, RSTART + RLENGTH)
      if (rest == "/*") in_comment = 1
    } else {
      return out text
    }
  }
  return out
}

BEGIN {
  n = split("new delete malloc calloc realloc free throw try catch virtual dynamic_cast typeid double thread_local", list, " ")
  for (i = 1; i <= n; ++i) banned[list[i]] = 1
}

{
  file = $0
  line = 0
  in_comment = 0
  ++files
  while ((getline text < file) > 0) {
    ++line
    text = code(text)
    if (text ~ /^[ \t]*#[ \t]*include/) continue
    if (text ~ /std::/) complain("std::")
    if (text ~ /= *delete *;/) sub(/= *delete *;/, ";", text)  # a deleted function is no heap
    # Placement into memory that is there is no heap.
    gsub(/operator (new|delete)/, "", text)
    gsub(/new \(static_cast<void\*>/, "(", text)
    words = text
    while (match(words, /[A-Za-z_][A-Za-z0-9_]*|[0-9.][0-9A-Za-z_.]*([eE][-+][0-9]+[fFlL]?)?/)) {
      word = substr(words, RSTART, RLENGTH)
      words = substr(words, RSTART + RLENGTH)
      if (word in banned) complain(word)
      if (word ~ /^([0-9]+\.[0-9]*|\.[0-9]+|[0-9]+)([eE][-+]?[0-9]+)?[lL]?$/ && word ~ /[.eE]/) complain(word " is a double: write " word "f")
    }
  }
  close(file)
}

END {
  cmake = "find . \\( -name build -o -name tests \\) -prune -o \\( -name CMakeLists.txt -o -name '*.cmake' -o -name CMakePresets.json \\) -print"
  while ((cmake | getline file) > 0) {
    sub(/^\.\//, "", file)
    line = 0
    while ((getline text < file) > 0) {
      ++line
      sub(/#.*/, "", text)
      if (match(text, /-ffast-math|-Ofast|-funsafe-math-optimizations|-ffp-contract=(fast|on)/)) complain(substr(text, RSTART, RLENGTH))
    }
    close(file)
  }
  if (files < 20) {
    print "only " files + 0 " files were found: this check looks in the wrong place"
    bad = 1
  }
  exit bad
}
