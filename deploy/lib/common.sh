# shellcheck shell=bash
# Shared by the scripts of deploy/. Source it: it sets PELAGOS_ROOT, the top folder of the project, and defines functions.

PELAGOS_ROOT=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)

say() { printf '%s: %s\n' "${0##*/}" "$*"; }

fail() {
  printf '%s: error: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# The lines of comment at the head of the script that is running, as its help.
print_help() { sed -n '2,/^[^#]/{/^#/s/^# \{0,1\}//p}' "$0"; }

wrong_usage() {
  printf '%s: error: %s; see %s --help\n' "${0##*/}" "$*" "$0" >&2
  exit 2
}

# unknown_argument WORD KNOWN...: ends the script, naming the word, the nearest of the known ones, and all of these.
unknown_argument() {
  local word=$1 nearest
  shift
  nearest=$(printf '%s\n' "$@" | awk -v word="${word%%=*}" '
    function least(a, b) { return a < b ? a : b }
    function distance(a, b,   i, j, row, left) {  # Levenshtein'"'"'s
      for (j = 0; j <= length(b); ++j) row[j] = j
      for (i = 1; i <= length(a); ++i) {
        diagonal = row[0]; row[0] = i
        for (j = 1; j <= length(b); ++j) {
          left = row[j]
          row[j] = least(least(row[j], row[j - 1]) + 1, diagonal + (substr(a, i, 1) != substr(b, j, 1)))
          diagonal = left
        }
      }
      return row[length(b)]
    }
    BEGIN { best = 3 }
    { d = distance(word, $0); if (d < best) { best = d; name = $0 } }
    END { print name }')
  wrong_usage "unknown argument $word${nearest:+; did you mean $nearest?}; allowed: $*"
}

# try_folder OPTION DIR: makes a folder for results before the work begins, or ends the script.
try_folder() {
  mkdir -p "$2" 2>/dev/null && [[ -w $2 ]] || fail "$1 is $2; no folder can be made or written there"
}

# take_lock FD FILE WHAT: waits for the lock and holds it until this shell and all that inherit FD have ended.
take_lock() {
  local fd=$1 file=$2 what=$3
  if ! flock --nonblock "$fd"; then
    say "waiting for another run to finish $what"
    flock "$fd" || fail "cannot lock $file"
  fi
}

# How many compilers at once: one for each core, but each with 1.5 GB of memory to itself.
build_jobs() {
  local cores kilobytes by_memory
  cores=$(nproc)
  kilobytes=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo)
  by_memory=$((kilobytes / 1500000))
  ((by_memory >= 1)) || by_memory=1
  ((cores < by_memory)) && echo "$cores" || echo "$by_memory"
}
