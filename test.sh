#!/usr/bin/env bash
# ./test.sh           every check: formatting, warnings as errors, tests, static analysis, the tests again under the
#                     address, undefined-behaviour and thread sanitizers, and a short run of each fuzzer.
# ./test.sh --quick   only the build with warnings as errors and its tests.
# Installs the Debian packages that are missing (.ci/packages.run and .ci/packages.test), through sudo when not root,
# and says which. The last line is "N passed, N failed"; the exit status is 0 only when nothing failed.
set -uo pipefail
root=$(CDPATH='' cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" && pwd -P)
cd -- "$root" || exit 1
# shellcheck source=.ci/lib.sh
. .ci/lib.sh
exec </dev/null
# Tests bring their own display where they need one.
unset DISPLAY WAYLAND_DISPLAY

quick=no
case "${1:-}" in
  '') ;;
  --quick) quick=yes ;;
  *)
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0" >&2
    exit 2
    ;;
esac

# Tests that hold a stopwatch or bound what memory is taken: a sanitizer makes them say how slow it is, and sets aside
# memory of its own.
untimed='Responsiveness.*:EditorViews.FramesThat*:*.PrintsItsSpeed:*DoNotTakeQuadraticTime:*DoesNotTakeLong:Files.*Follows*:MillionTriangles.*'
# Long runs that are about figures: other tests make the same kinds of steps, on smaller meshes.
figures='LimitChoice.ThePolish*:LimitChoice.ASphere*:LimitChoice.ABump*:Baselines.ReachOnRandom*:SurfaceDistance.FindsPeaks*:BenchmarkCommand.PutsThePapersTable*:Polish.GoesAlong*:OneByOne.IsWhat*:BoundedRun.EndsNot*:BoundedRun.ThinShells*:Run.MakesEvery*:Untangle.SliversThat*:Solvers.ADirection*'
# Where the sanitizers find names.
symbolizer=external_symbolizer_path=/usr/lib/llvm-14/bin/llvm-symbolizer
# What computes on several threads, and the session with its worker.
parallel='*Threads*:SessionTest.*:TimelineTest.*:BoundedRun.*:Untangle.*'

passed=0
failed=0
failures=()

# stage NAME COMMAND...: runs it, says how long it took, and keeps the name when it fails. Counts one check.
stage() {
  local name=$1 start=$SECONDS
  shift
  printf '\n== %s\n' "$name"
  if "$@"; then
    passed=$((passed + 1))
    printf '== %s: ok, %d s\n' "$name" $((SECONDS - start))
  else
    failed=$((failed + 1))
    failures+=("$name")
    printf '== %s: FAILED, %d s\n' "$name" $((SECONDS - start))
    return 1
  fi
}

# tests NAME PRESET CTEST-ARGUMENTS...: runs the tests of a preset; counts each test case of each program.
tests() {
  local name=$1 preset=$2 start=$SECONDS status=0 counts
  shift 2
  printf '\n== %s\n' "$name"
  ctest --preset "$preset" -j "$(nproc)" --timeout 600 --no-tests=error "$@" || status=1
  read -r -a counts < <(.ci/count_tests "build/$preset/Testing/Temporary/LastTest.log")
  passed=$((passed + ${counts[0]:-0}))
  failed=$((failed + ${counts[1]:-0}))
  [ "$status" -ne 0 ] && [ "${counts[1]:-0}" -eq 0 ] && failed=$((failed + 1))
  if [ "$status" -eq 0 ]; then
    printf '== %s: ok, %d s\n' "$name" $((SECONDS - start))
  else
    failures+=("$name")
    printf '== %s: FAILED, %d s\n' "$name" $((SECONDS - start))
  fi
}

# build PRESET [TARGET...], in a shell of its own: a failure ends the stage and not the script.
build() { (build_preset "$root" "$@"); }

finish() {
  printf '\n%d s in total\n' "$SECONDS"
  [ ${#failures[@]} -eq 0 ] || printf 'FAILED: %s\n' "${failures[@]}"
  printf '%d passed, %d failed\n' "$passed" "$failed"
  [ "$failed" -eq 0 ]
  exit
}

check_format() {
  find core app tests \( -name '*.h' -o -name '*.cpp' \) -print0 | xargs -0 clang-format-14 --dry-run -Werror
}

(install_packages .ci/packages.run .ci/packages.test) || { failed=1 failures=(packages); finish; }

[ "$quick" = yes ] || stage 'formatting (clang-format)' check_format
stage 'build, warnings are errors' build ci || finish
tests 'tests' ci
[ "$quick" = yes ] && finish

# Static analysis wants the commands of single sources, which the preset debug has.
check_tidy() { cmake --fresh --preset debug >/dev/null && python3 .ci/tidy.py build/debug; }
stage 'static analysis (clang-tidy)' check_tidy

if stage 'build with address and undefined-behaviour sanitizers' build asan; then
  # The same run on one, two and five threads belongs to the thread sanitizer.
  # Some containers forbid what the leak detector does to its own process.
  leaks=1
  if build/asan/bin/isorelax --version 2>&1 | grep -q 'LeakSanitizer has encountered a fatal error'; then
    leaks=0
    say 'Leaks are not looked for: this system does not let a process trace itself.'
  fi
  ASAN_OPTIONS="$symbolizer:detect_leaks=$leaks:strict_string_checks=1:detect_stack_use_after_return=1" \
    LSAN_OPTIONS="suppressions='$root/.ci/leaks.supp':print_suppressions=0" \
    UBSAN_OPTIONS='print_stacktrace=1' GTEST_FILTER="-$untimed:$figures:*Threads*" \
    tests 'tests with address and undefined-behaviour sanitizers' asan -LE 'corpus|bench'
fi

threaded=(mesh quality surface smoothing motion model)
if stage 'build with thread sanitizer' build tsan "${threaded[@]/#/test_}"; then
  GTEST_FILTER="$parallel-$untimed:$figures" TSAN_OPTIONS="$symbolizer:halt_on_error=1:suppressions='$root/.ci/threads.supp'" \
    tests 'tests with thread sanitizer' tsan -R "^($(IFS='|'; echo "${threaded[*]}"))(_[0-9]+)?\$"
fi

if stage 'build of the fuzzers' build fuzz fuzzers; then
  tests 'fuzzers, briefly' fuzz
fi
finish
