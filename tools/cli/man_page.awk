# One man page from what --help prints (help_pages.sh): usage, summary, lines of text, `options`, further text.
function plain(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  if (text ~ /^[.']/) text = "\\&" text
  return text
}
function literal(title) {
  if (!in_text) print ".SH " title "\n.nf"
  in_text = 1
}
NR == 1 { sub(/^usage: /, ""); usage = $0; next }
NR == 2 {
  print ".TH " toupper(name) " 1 \"\" \"" version "\"\n.SH NAME\n" plain(name) " \\- " plain($0)
  print ".SH SYNOPSIS\n" plain(usage)
  next
}
/^options$/ {
  if (in_text) print ".fi"
  print ".SH OPTIONS"
  in_options = 1
  in_text = 0
  next
}
in_options && /^  -/ {
  line = substr($0, 3)
  at = match(line, /  +/)
  print ".TP\n.B " plain(substr(line, 1, at - 1)) "\n" plain(substr(line, at + RLENGTH))
  next
}
in_options && /^        / { sub(/^ +/, ""); print plain($0); next }
/^$/ && !in_text { next }
{
  literal(in_options || has_options ? "NOTES" : "DESCRIPTION")
  has_options = has_options || in_options
  in_options = 0
  print plain($0)
}
END {
  if (in_text) print ".fi"
  if (also != "") print ".SH SEE ALSO\n" plain(also)
}
