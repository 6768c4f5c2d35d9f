# shellcheck shell=bash
# A DDS domain and a TCP port that nothing else on this machine uses. Needs common.sh.

readonly FIRST_DOMAIN=1 LAST_DOMAIN=100  # above 100 the domain's ports reach the range of ephemeral ones
readonly FIRST_PORT=17400                # of the control link: this plus the domain

# ports_in_use PROTOCOL: local port numbers, one a line. /proc holds them in hexadecimal.
ports_in_use() {
  local address
  cat "/proc/net/$1" "/proc/net/${1}6" 2>/dev/null | awk '$2 ~ /:/ {print $2}' | while IFS= read -r address; do
    echo $((16#${address##*:}))
  done
}

# any_port_in_use PROTOCOL FIRST COUNT
any_port_in_use() {
  ports_in_use "$1" | awk -v first="$2" -v count="$3" '$1 >= first && $1 < first + count {found = 1} END {exit !found}'
}

# DDS gives domain N the 250 UDP ports from 7400 + 250 N on.
domain_is_quiet() {
  ! any_port_in_use udp $((7400 + 250 * $1)) 250 && ! any_port_in_use tcp $((FIRST_PORT + $1)) 1
}

# Sets DOMAIN and PORT. A file that stays locked while this shell lives keeps other demos, of any user, out of the
# domain; where its file belongs to somebody else, the domain does too.
claim_domain() {
  local count=$((LAST_DOMAIN - FIRST_DOMAIN + 1)) i lock
  for ((i = 0; i < count; ++i)); do
    DOMAIN=$((FIRST_DOMAIN + ($$ + i) % count))
    lock=/tmp/pelagos-demo-domain-$DOMAIN.lock
    { exec 7>>"$lock"; } 2>/dev/null && flock --nonblock 7 || continue
    if domain_is_quiet "$DOMAIN"; then
      PORT=$((FIRST_PORT + DOMAIN))
      return 0
    fi
  done
  fail "no free DDS domain from $FIRST_DOMAIN to $LAST_DOMAIN; end demos or servers that are still running"
}
