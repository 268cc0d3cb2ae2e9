# Steps of a check, timed; sourced by scripts/check and scripts/test, in bash, at the root of the repository.
#
#   step NAME COMMAND...     runs a command; the whole script ends when it fails
#   beside NAME COMMAND...   starts a command that runs beside the steps that follow
#   finish NAME              waits for it, prints what it said, and ends as it ended
#
# When the script ends, however it ends, a table shows the seconds of each step: by the clock, and of processors.
set -euo pipefail

steps_table="$(mktemp)"
steps_times="$(mktemp)"
steps_beside="$(mktemp -d)"
trap 'code=$?; end_beside; print_steps "$code"; rm -rf "$steps_table" "$steps_times" "$steps_beside"; exit "$code"' EXIT

# Sets processor_seconds to what the commands of this shell have taken so far. (In a pipeline `times` would speak of another shell.)
read_processor_time() {
  times >"$steps_times"
  processor_seconds="$(awk 'NR == 2 { for (i = 1; i <= 2; i++) { split($i, t, /[ms]/); sum += 60 * t[1] + t[2] } print sum }' "$steps_times")"
}

step() {
  local name="$1" begin before code=0
  shift
  printf '\n== %s: %s\n' "$name" "$*"
  begin="$EPOCHREALTIME"
  read_processor_time
  before="$processor_seconds"
  "$@" || code=$?
  read_processor_time
  awk -v name="$name" -v begin="$begin" -v end="$EPOCHREALTIME" -v before="$before" -v after="$processor_seconds" -v code="$code" \
    'BEGIN { printf "%s\t%.1f\t%.1f\t%s\n", name, end - begin, after - before, code == 0 ? "" : "failed" }' >>"$steps_table"
  return "$code"
}

declare -A steps_running=()
beside() {
  local name="$1"
  shift
  "$@" >"$steps_beside/$name" 2>&1 &
  steps_running["$name"]=$!
}

finish() {
  local code=0
  wait "${steps_running["$1"]}" || code=$?
  unset "steps_running[$1]"
  cat "$steps_beside/$1"
  return "$code"
}

# A step that fails leaves nothing running.
end_beside() {
  [ "${#steps_running[@]}" = 0 ] || kill "${steps_running[@]}" 2>/dev/null || true
}

# Told to stop, the script ends as failed: without these the table would say that everything holds.
trap 'exit 130' INT
trap 'exit 143' TERM

print_steps() { # EXIT_CODE
  [ -s "$steps_table" ] || return 0
  printf '\n'
  awk -F '\t' '
    BEGIN { printf "%-34s %10s %12s\n", "step", "seconds", "processor" }
    { printf "%-34s %10.1f %12.1f %s\n", $1, $2, $3, $4; seconds += $2; processor += $3 }
    END { printf "%-34s %10.1f %12.1f\n", "all", seconds, processor }' "$steps_table"
  [ "$1" = 0 ] && echo "everything holds" || echo "failed (exit code $1)"
}
