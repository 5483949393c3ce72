#!/usr/bin/env bash
# Compiles every header of the product on its own: a header states all it needs. The headers that a
# source file includes before anything else are left out, since the build has shown it for them.
#   check_headers.sh ROOT COMPILER INCLUDE_DIRECTORY...
set -euo pipefail
export LC_ALL=C # one order for sort and comm

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
folders=(base grammar ir frontend backend runtime)
proven=$(find "${folders[@]}" -name '*.cpp' -exec grep -hm1 '^#include' {} + |
  sed -n 's/^#include "\(.*\)".*/\1/p' | sort -u)
find "${folders[@]}" -name '*.hpp' | sort | comm -23 - <(printf '%s\n' "$proven") |
  tr '\n' '\0' |
  xargs -0 -P "$(nproc)" -I{} bash -c 'check "$@"' check {} "$compiler" "${flags[@]}"
