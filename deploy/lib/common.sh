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
