# For scripts of checks: steps with their times, of which a table is printed at the end.
table=$(mktemp -d)
processor=0  # s, of all processes that have ended
ask_processor_time() {  # of this shell, so not in a subshell
  times > "$table/times"
  processor=$(awk 'NR == 2 {for (i = 1; i <= 2; ++i) {split($i, part, "[ms]"); s += 60 * part[1] + part[2]}
                            printf "%d", s}' "$table/times")
}
end_step() {
  ask_processor_time
  [ -z "${this_step:-}" ] ||
    printf '%5d %5d  %s\n' $((SECONDS - begin)) $((processor - used)) "$this_step" >> "$table/steps"
}
step() {
  end_step
  this_step=$*
  begin=$SECONDS
  used=$processor
  printf '\n== %s (after %d min %02d s)\n' "$this_step" $((SECONDS / 60)) $((SECONDS % 60))
}
# Also where a step failed.
finish() {
  end_step
  printf '\n  wall   CPU  in s\n'
  cat "$table/steps"
  printf '%5d %5d  all\n' "$SECONDS" "$processor"
  rm -r "$table"
}
trap finish EXIT
