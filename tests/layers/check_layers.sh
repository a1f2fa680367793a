#!/usr/bin/env bash
# check_layers.sh ROOT: fails, naming file, line and rule, when a source below ROOT/core or ROOT/app includes what
# rooms.txt does not allow it.
set -euo pipefail
cd -- "$1"
grep -rnE '^[[:space:]]*#[[:space:]]*include' core app --include='*.h' --include='*.cpp' |
  awk -v rules="$(dirname -- "$(readlink -f -- "$0")")/rooms.txt" '
    function report(what) { printf "%s:%s: %s\n", file, line, what; broken++ }
    # A shell pattern as a regular expression.
    function matches(name, pattern) { gsub(/\./, "\\.", pattern); gsub(/\*/, ".*", pattern); return name ~ "^" pattern "$" }
    BEGIN {
      while ((getline text < rules) > 0) {
        if (split(text, half, / *: */) < 1 || text ~ /^#/) continue
        if (text ~ /^room /) { known[substr(half[1], 6)] = 1; allowed[substr(half[1], 6)] = " " half[2] " " }
        if (text ~ /^only /) { library[++libraries] = "^" substr(half[1], 6); places[libraries] = half[2] }
      }
    }
    {
      split($0, part, ":"); file = part[1]; line = part[2]
      split(file, folder, "/"); room = (folder[3] == "" ? "." : folder[2])
      checked++
      if (!(room in known)) { report("the room " room " has no rule in rooms.txt"); next }
      if (match($0, /include[ \t]*"[^"]*"/)) {
        name = substr($0, RSTART, RLENGTH); sub(/^[^"]*"/, "", name); sub(/"$/, "", name)
        if (name !~ /\//) { report("\"" name "\" does not name its room"); next }
        split(name, target, "/")
        if (target[1] != room && index(allowed[room], " " target[1] " ") == 0)
          report(room " may not include " name)
      } else if (match($0, /<[^>]*>/)) {
        name = substr($0, RSTART + 1, RLENGTH - 2)
        for (i = 1; i <= libraries; i++) {
          if (name !~ library[i]) continue
          fine = 0; count = split(places[i], place, " ")
          for (k = 1; k <= count; k++) if (matches(file, place[k])) fine = 1
          if (!fine) report("<" name "> is not for this file")
        }
      }
    }
    END {
      printf "%d includes looked at, %d not allowed\n", checked, broken
      exit (broken > 0 || checked == 0)
    }'
