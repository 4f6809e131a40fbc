#!/usr/bin/env bash
# What ./run and ./test share (cmake/prepare.sh): the line of a build's progress, and work on every core.
set -euo pipefail
# shellcheck source=../../cmake/prepare.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../cmake/prepare.sh"

expect() {
    [[ $2 == "$3" ]] || { printf '%s: expected "%s", got "%s"\n' "$1" "$3" "$2" && exit 1; }
}

shown=$(printf '%s\n' '@0/1@Re-running CMake...' '@1/2@a.o' 'a.cpp:1: warning: b' '@2/2@b.o' | show_build_progress 2>&1 |
    sed -E 's/[0-9]+:[0-9]{2}/T/g')
expect "a build in which CMake runs again" "$shown" \
    $'weft: step 1 of 2, T gone, about T left\na.cpp:1: warning: b\nweft: step 2 of 2, T gone, about T left'

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
note() { touch "$work/$1"; }
(on_each_core note a b c d e)
expect "all are called" "$(cd "$work" && echo *)" "a b c d e"

fail_at_b() { [[ $1 != b ]]; }
status=0
(on_each_core fail_at_b a b c) || status=$?
expect "the status of one that fails" "$status" 1
