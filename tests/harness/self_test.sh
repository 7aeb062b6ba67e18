#!/bin/sh
# What the harness says about planted failures:  self_test.sh PLANTED-PROGRAM EMPTY-PROGRAM
set -u
planted=$1
empty=$2
source=$(cd "$(dirname "$0")" && pwd)/planted.cpp
failed=0
expect() {  # expect WHAT ACTUAL EXPECTED
  if [ "$2" != "$3" ]; then
    printf '%s\n  said:     %s\n  expected: %s\n' "$1" "$2" "$3"
    failed=1
  fi
}
run() {  # run [NAME]: its output in $text, its exit status in $status
  text=$("$planted" "$@")
  status=$?
}
line_of() { grep -nF -- "$1" "$source" | head -n 1 | cut -d: -f1; }
says() {  # says CASE TEXT-OF-THE-SOURCE-LINE MESSAGE: file, line, name, the condition and both values
  run "$1"
  expect "$1: exit status" "$status" 1
  message=": $1: $3"
  place="planted.cpp:$(line_of "$2")"
  printf '%s\n' "$text" | grep -qF "$place$message" ||
    expect "$1: place and values" "$text" "...$place$message"
  printf '%s\n' "$text" | grep -qx "FAIL  $1" || expect "$1: verdict" "$text" "FAIL  $1"
  expect "$1: last line" "$(printf '%s\n' "$text" | tail -n 1)" "0 passed, 1 failed"
}

says FalseConditionFails 'CHECK(1 + 1 == 3)' '1 + 1 == 3'
says BothFloatsAreShown 'CHECK_LE(0.1f' '0.1f <= -2.5e-3f   (1.00000001e-1, -2.49999994e-3)'
says IntegersAreShownInFull '18446744073709551614u' 'uint64_t{18446744073709551615u} == uint64_t{18446744073709551614u}   (18446744073709551615, 18446744073709551614)'
says IntegersAreShownInFull '-9223372036854775807' 'int64_t{-9223372036854775807} == int64_t{7}   (-9223372036854775807, 7)'
says IntegersAreShownInFull 'CHECK_EQ(Colour' 'Colour::kRed == Colour::kBlue   (3, 250)'
says NaNFailsEveryComparison 'CHECK_LE(nan' 'nan <= 1.0f   (nan, 1.00000000)'
says NaNFailsEveryComparison 'CHECK_GE(nan' 'nan >= 1.0f   (nan, 1.00000000)'
says NaNFailsEveryComparison 'CHECK_LT(nan' 'nan < 1.0f   (nan, 1.00000000)'
says NaNFailsEveryComparison 'CHECK_GT(nan' 'nan > 1.0f   (nan, 1.00000000)'
says NaNFailsEveryComparison 'CHECK_EQ(nan' 'nan == nan   (nan, nan)'
says InfinityAndLimitsAreShown 'CHECK_LT(__builtin_inff' '__builtin_inff() < -__builtin_inff()   (inf, -inf)'
says InfinityAndLimitsAreShown '1.17549435e-38f' '1.17549435e-38f == 3.40282347e38f   (1.17549435e-38, 3.40282347e38)'
says InfinityAndLimitsAreShown '9.9999999999' '9.9999999999 == 0.0   (1.00000000e1, 0.00000000)'
says ManyFailuresAreCountedNotListed 'CHECK_EQ(i, -1)' 'i == -1   (4, -1)   [seed 42]'
expect 'the rest is counted' "$(printf '%s\n' "$text" | grep -c 'and 7 more')" 1
says SkipDoesNotHideAFailure 'CHECK(false)' 'false'

run MissingModelIsSkipped
expect 'a skipped test: exit status' "$status" 77
expect 'a skipped test' "$(printf '%s\n' "$text" | head -n 1)" 'skip  MissingModelIsSkipped: no model'
run TrueConditionsPass
expect 'a passing test: exit status' "$status" 0
expect 'a passing test' "$text" "ok    TrueConditionsPass
1 passed, 0 failed"
run NoSuchTest
expect 'no test of that name: exit status' "$status" 1
run
expect 'all: exit status' "$status" 1
cases=$(grep -c '^TEST(' "$source")
expect 'all: last line' "$(printf '%s\n' "$text" | tail -n 1)" "1 passed, $((cases - 2)) failed"
expect 'the list names every case' "$("$planted" --list | wc -l | tr -d ' ')" "$cases"

text=$("$empty")
status=$?
expect 'no test at all: exit status' "$status" 1
expect 'no test at all' "$text" '0 passed, 0 failed'
exit $failed
