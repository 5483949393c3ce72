#!/usr/bin/env bash
# Compiles every header of the product on its own: a header states all it needs.
#   check_headers.sh ROOT COMPILER INCLUDE_DIRECTORY...
set -euo pipefail

root=$1
compiler=$2
shift 2

flags=(-std=c++20 -fsyntax-only -w "-I$root")
for directory in "$@"; do
  # The compiler's own /usr/include must keep its place in the search order.
  case $directory in
    "" | "$root" | /usr/include) ;;
    *) flags+=(-isystem "$directory") ;;
  esac
done

check() {
  local header=$1
  shift
  local messages
  if ! messages=$(printf '#include "%s"\n#include "%s"\n' "$header" "$header" | "$@" -x c++ - 2>&1); then
    printf 'does not compile alone: %s\n%s\n' "$header" "$(head -n 8 <<<"$messages")"
    return 1
  fi
}
export -f check

cd "$root"
find base grammar ir frontend backend runtime -name '*.hpp' -print0 | sort -z |
  xargs -0 -P "$(nproc)" -I{} bash -c 'check "$@"' check {} "$compiler" "${flags[@]}"
