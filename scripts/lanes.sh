# Sourced by .ci/run: lanes, i.e. checks that run one after the other.

lane_seconds=()  # "SECONDS NAME" of each lane that passed

# lane NAME COMMAND...: runs the command, and ends the whole run if it fails.
lane() {
  local name=$1
  shift
  printf '\n==== %s: %s\n' "$name" "$*"
  local start=$SECONDS
  "$@" || { printf '==== %s: FAILED after %d s\n' "$name" "$((SECONDS - start))"; exit 1; }
  printf '==== %s: passed after %d s\n' "$name" "$((SECONDS - start))"
  lane_seconds+=("$((SECONDS - start)) $name")
}

# build_in_gaps PRESET...: builds while the next lanes wait for clocks, sockets and a browser. The scheduler gives it only
# what nothing else wants (SCHED_IDLE). A failure shows in the lane of the preset.
build_in_gaps() {
  mkdir -p build
  setsid chrt --idle 0 bash -c 'for preset in "$@"; do ./scripts/build --with tests "$preset"; done' - "$@" \
    >build/gaps.log 2>&1 &
  gaps=$!
  trap end_of_gaps EXIT
}

# The lanes that come now need the processors: they build what is not yet built.
end_of_gaps() {
  kill -- "-$gaps" 2>/dev/null || true
  wait "$gaps" || true
}

# What the run has cost: the seconds of each lane, the slowest objects and tests.
report_lanes() {
  printf '\n==== lanes\n'
  printf '%6d s  %s\n' $(printf '%s\n' "${lane_seconds[@]}")
  ./scripts/slowest
  printf '\n==== all lanes passed after %d s\n' "$SECONDS"
}
