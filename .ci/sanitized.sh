# For scripts of checks: what build-sanitize/ holds, beside its tests. The options are those of the
# tests' preset; tests/leaks.supp says why.
export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=intercept_tls_get_addr=0
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0"

# The program, on few points and periods.
sanitized() {
  GEARSWEEP=build-sanitize/gearsweep tests/cli/small/gearsweep "$@"
}

fuzz() {  # target, seconds, more seeds
  mkdir -p "build-sanitize/corpus/$1"
  # What stays in memory is for the sanitized tests to find: asked after each input, it takes most of
  # the time.
  TMPDIR=/dev/shm "build-sanitize/tests/fuzz_$1" -max_total_time="$2" -timeout=120 -rss_limit_mb=2048 \
    -max_len=2048 -detect_leaks=0 -print_final_stats=1 -verbosity=0 -len_control=0 \
    -artifact_prefix="build-sanitize/corpus/$1-" "build-sanitize/corpus/$1" "tests/fuzz/corpus/$1" \
    "${@:3}"
}
