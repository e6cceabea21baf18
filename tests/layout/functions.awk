# SPDX-License-Identifier: GPL-3.0-or-later
# awk -f functions.awk SOURCE...
# Prints each function of more than 50 lines, from its first line to its closing brace. The sources are
# formatted, so a function's header and its closing brace have the same indentation: none, or two
# spaces in a class. Tables (an initialiser, or a switch over the cases of an enumeration) may be longer.
FNR == 1 { for (indent = 0; indent <= 2; indent += 2) open[indent] = header[indent] = "" }
{
  for (indent = 0; indent <= 2; indent += 2) {
    text = substr($0, indent + 1)
    if (indent > 0 && open[0] == "function") { open[indent] = header[indent] = ""; continue }
    if (indent > 0 && substr($0, 1, indent) !~ /^ +$/) { header[indent] = ""; if (!open[indent]) continue }
    if (open[indent]) {
      if (text ~ /^ +(case|default)/) cases[indent]++
      if (substr($0, 1, indent) ~ /^ *$/ && text ~ /^}/) {
        length_of = FNR - first[indent] + 1
        if (open[indent] == "function" && length_of > 50 && cases[indent] < 10)
          print FILENAME ":" first[indent] ": " length_of " lines: " name[indent]
        open[indent] = header[indent] = ""
      }
    } else if (text ~ /^[A-Za-z_~\[:]/ || (header[indent] != "" && text ~ /^ /)) {
      if (header[indent] == "") { header[indent] = text; first[indent] = FNR } else header[indent] = header[indent] " " text
      if (text ~ /{$/) {
        open[indent] = header[indent] ~ /\(/ && header[indent] !~ /^(namespace|struct|class|enum|union|extern "C")|= *{$/ ? "function" : ""
        if (header[indent] ~ /= *{$/) open[indent] = "table"
        name[indent] = substr(header[indent], 1, 70)
        cases[indent] = 0
        header[indent] = ""
      } else if (text ~ /[;}:]$/) header[indent] = ""
    } else header[indent] = ""
  }
}
