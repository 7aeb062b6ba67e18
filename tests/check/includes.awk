# Reads file names, and the includes of each file; prints those that run the wrong way (tests/check/includes.sh).
BEGIN {
  modules = split(arrows, entry, ";") - 1
  for (i = 1; i <= modules; ++i) {
    split(entry[i], part, ":")
    module = part[1]
    known[module] = 1
    n = split(part[2], link, " ")
    for (k = 1; k <= n; ++k) may[module, link[k]] = 1
  }
  if (modules < 3) complain("firmware/CMakeLists.txt: no list of modules found")
  # A circle shows as a module that reaches itself.
  for (a in known) for (b in known) reach[a, b] = ((a, b) in may)
  for (k in known) for (a in known) for (b in known) if (reach[a, k] && reach[k, b]) reach[a, b] = 1
  for (a in known) if (reach[a, a]) complain("firmware/CMakeLists.txt: " a " links itself through what it links")
}

function complain(text) {
  print text
  bad = 1
}

function freestanding(file, header) {
  if (header ~ /^(stdint|stddef|float|limits)\.h$/) return 1
  return file ~ /^firmware\/firmtouch\/arch\// && header ~ /^(arm_acle|arm_mve|immintrin)\.h$/
}

# Of the firmware and of hal: which folder of `firmtouch/...` a file may take.
function room_may(file, module, header,    of) {
  of = header
  sub(/^firmtouch\//, "", of)
  sub(/\/.*/, "", of)
  if (of == "arch" && module == "math") return 1
  if (module == "app") return 1
  if (module == "hal") return (of == "hal" || of == "core") ? 1 : of
  if (of == module || (module, of) in may) return 1
  if (module == "scene" && header == "firmtouch/servo/local_model.hpp") return 1
  return of
}

function check_include(file, line, header, quoted,    where, top, module, answer) {
  where = file ":" line ": "
  split(file, folder, "/")
  top = folder[1]
  if (header ~ /^Eigen\// || header ~ /^unsupported\/Eigen\//) {
    if (file !~ /^tests\/.*_host_test\.cpp$/) complain(where "Eigen is for tests/*_host_test.cpp alone")
    return
  }
  if (top == "firmware" || (top == "hal" && folder[2] != "posix")) {
    if (!quoted) {
      if (!freestanding(file, header)) complain(where "<" header "> is not freestanding: stdint.h, stddef.h, float.h and limits.h are")
      return
    }
  }
  if (!quoted && top != "tests") return
  if (top == "firmware") {
    module = folder[2] == "app" ? "app" : folder[3] == "arch" ? "math" : folder[3]  # arch: primitives of math
    if (header !~ /^firmtouch\// || header ~ /\.\./) {
      # The program may take headers of its own folder, and the one that the build makes.
      if (module == "app" && header !~ /\.\./ && header !~ /^(host_sim|tests|tools|harness|bake|surface|cli)\//) return
      complain(where "firmware may not include \"" header "\"")
    } else {
      if (module != "app" && !(module in known)) complain(where module " is no module of firmware/CMakeLists.txt")
      answer = room_may(file, module, header)
      if (answer != 1) complain(where module " may not include " answer)
    }
  } else if (top == "hal") {
    if (header ~ /^firmtouch\//) {
      answer = room_may(file, "hal", header)
      if (answer != 1) complain(where "hal may not include " answer)
    } else if (header ~ /\.\./ || header ~ /^(host_sim|tests|tools|harness|bake|surface|cli)\//) {
      complain(where "hal may not include \"" header "\"")
    }
  } else if (top == "tests") {
    include_of[file] = include_of[file] (quoted ? "\"" : "<") header "|" line " "
  } else if (top == "tools" && header ~ /^(\.\.\/.*)?(tests|harness|host_sim)\//) {
    complain(where "tools may not include \"" header "\"")
  } else if (top == "host_sim" && header ~ /^(\.\.\/.*)?(tests|harness)\//) {
    complain(where "host_sim may not include \"" header "\"")
  }
}

# What runs on a controller: the tests that are not *_host_test.cpp, the harness, and the headers of tests that they reach.
function walk_tests(    queue, head, tail, file, n, part, i, header, line, place) {
  for (file in include_of)
    if (file ~ /^tests\/[a-z_]+\/[a-z0-9_]*_test\.cpp$/ && file !~ /_host_test\.cpp$/ || file == "tests/harness/test.cpp") queue[tail++] = file
  for (head = 0; head < tail; ++head) {
    file = queue[head]
    n = split(include_of[file], part, " ")
    for (i = 1; i <= n; ++i) {
      split(substr(part[i], 2), place, "|")
      header = place[1]
      if (substr(part[i], 1, 1) == "<") {
        if (header !~ /^(stdint|stddef|float|limits)\.h$/) complain(file ":" place[2] ": <" header "> is not freestanding, and this runs on the controller")
        continue
      }
      header = "tests/" header
      if (!(header in include_of)) header = file_beside(file, place[1])
      if (header in include_of && !(header in reached)) {
        reached[header] = 1
        queue[tail++] = header
      }
    }
  }
  if (tail < 10) complain("only " tail + 0 " tests that run on the controller were found: this check looks in the wrong place")
}
function file_beside(file, header) {
  sub(/[^\/]*$/, "", file)
  return file header
}

{
  file = $0
  line = 0
  if (file ~ /^tests\//) include_of[file] = ""
  while ((getline text < file) > 0) {
    ++line
    if (text !~ /^[ \t]*#[ \t]*include[ \t]*[<"]/) continue
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", text)
    quoted = substr(text, 1, 1) == "\""
    text = substr(text, 2)
    sub(/[>"].*/, "", text)
    check_include(file, line, text, quoted)
    ++seen
  }
  close(file)
}

END {
  walk_tests()
  if (seen < 20) complain("only " seen + 0 " includes were found: this check looks in the wrong place")
  exit bad
}
