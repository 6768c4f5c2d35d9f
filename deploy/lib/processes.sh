# shellcheck shell=bash
# Child processes by name: start, watch, stop. Needs common.sh, and LOGS, the folder for their output.
# Only processes started here are ever signalled, by their id.

declare -A PIDS=()     # name -> id of a process that has not been waited for
declare -A MAY_END=()  # names of those that end by themselves
STARTED=()             # names in order

# start NAME COMMAND...: in the background, output to LOGS/NAME.log.
start() {
  local name=$1
  shift
  "$@" >"$LOGS/$name.log" 2>&1 </dev/null &
  PIDS[$name]=$!
  STARTED+=("$name")
}

may_end() { MAY_END[$1]=yes; }

is_running() { [[ -n ${PIDS[$1]-} ]] && kill -0 "${PIDS[$1]}" 2>/dev/null; }

show_log() {
  printf '%s: last lines of %s:\n' "${0##*/}" "$LOGS/$1.log" >&2
  tail -n 15 "$LOGS/$1.log" | sed 's/^/    /' >&2
}

# collect NAME: the exit status of a process that has ended; anything but 0 ends the script with what it said.
collect() {
  local name=$1 status=0
  wait "${PIDS[$name]}" || status=$?
  unset "PIDS[$name]"
  ((status == 0)) && return 0
  show_log "$name"
  if ((status > 128)); then
    fail "$name was ended by signal $((status - 128))"
  fi
  fail "$name failed with exit code $status"
}

require_running() {
  is_running "$1" && return 0
  collect "$1"
  [[ -n ${MAY_END[$1]-} ]] && return 0
  show_log "$1"
  fail "$1 ended early, with exit code 0"
}

require_all_running() {
  local name
  for name in "${STARTED[@]}"; do
    [[ -z ${PIDS[$name]-} ]] || require_running "$name"
  done
}

request_stop() { kill -TERM "${PIDS[$1]}" 2>/dev/null || true; }

# await NAME SECONDS: until it has ended with exit status 0.
await() {
  local name=$1 tenths=$(($2 * 10))
  [[ -n ${PIDS[$name]-} ]] || return 0
  while is_running "$name"; do
    ((tenths-- > 0)) || {
      show_log "$name"
      fail "$name did not end within $2 s"
    }
    sleep 0.1
  done
  collect "$name"
}

# For the exit trap: whatever still runs is asked to end, and killed after 3 s.
stop_everything() {
  local name tenths=30
  for name in "${!PIDS[@]}"; do request_stop "$name"; done
  for name in "${!PIDS[@]}"; do
    while is_running "$name" && ((tenths-- > 0)); do sleep 0.1; done
    is_running "$name" && kill -KILL "${PIDS[$name]}" 2>/dev/null
    wait "${PIDS[$name]}" 2>/dev/null || true
  done
  PIDS=()
}
