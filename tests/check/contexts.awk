# The headers of hal, then call graphs (.ci): whether each function of hal is called only from the contexts that its header
# states. A root and what it reaches are one context.
function complain(text) { print text; bad = 1 }

FILENAME ~ /\.hpp$/ && /^ *\/\/\// { comment = comment " " substr($0, index($0, "///") + 3); next }
FILENAME ~ /\.hpp$/ {
  if (comment != "" && match($0, /[a-z_0-9A-Z]+\(/)) {
    name = substr($0, RSTART, RLENGTH - 1)
    gsub(/  +/, " ", comment)
    if (!match(comment, / Context: /)) complain(FILENAME ": " name "() states no context")
    context[name] = substr(comment, RSTART + RLENGTH)
    header[name] = FILENAME
    sub(/never the servo interrupt/, "", context[name])
  }
  if ($0 !~ /^ *\[\[/ || match($0, /\(/)) comment = ""
  next
}

# Local and weak functions are titled `file:name`.
/^edge:/ {
  split($0, part, "\"")
  sub(/.*:/, "", part[2])
  sub(/.*:/, "", part[4])
  calls[part[2]] = calls[part[2]] " " part[4]
}

# Follows the calls of `root`; every function of hal on the way must allow `allowed`.
function follow(root, allowed, what,    todo, title, name, count, i, callee, seen) {
  if (!(root in calls)) complain("there is no call graph of " root)
  count = split(root, todo, " ")
  seen[root] = 1
  while (count > 0) {
    title = todo[count--]
    if (match(title, /^_ZN9firmtouch3hal[0-9]+/)) {
      name = substr(title, RSTART + RLENGTH, substr(title, 18, RLENGTH - 17))
      if (name in context && ++found[what] && context[name] !~ allowed)
        complain(header[name] ": " name "() is called from the " what ", and its context is" context[name])
    }
    split(calls[title], callee, " ")
    for (i = 1; i in callee; ++i) {
      if (callee[i] in seen) continue
      seen[callee[i]] = 1
      todo[++count] = callee[i]
    }
    split("", callee)
  }
  if (found[what] < 2) complain("the " what " calls next to nothing of hal: this check looks in the wrong place")
}

END {
  follow("_ZN9firmtouch3app15servo_interruptEv", "servo interrupt|any", "servo interrupt")
  follow("hard_fault", "fault handler|any", "fault handler")
  follow("main", "main loop|start-up|any", "main loop")
  exit bad
}
