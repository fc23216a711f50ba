#!/usr/bin/env bash
# Lists the C++ files that clang-format 14 would change; exit code 1 if there is any.
cd "$(dirname "$0")/.." || exit 1
format=$(command -v clang-format-14 || command -v clang-format) || { echo "no clang-format"; exit 1; }
bad=$(find src apps tests bench python -name '*.[ch]pp' -print0 |
  xargs -0 -n 1 -P "$(nproc)" sh -c '"$0" --dry-run -Werror "$1" >/dev/null 2>&1 || echo "$1"' "$format")
[ -z "$bad" ] && echo "every file is formatted" && exit 0
printf 'not formatted: %s\n' $bad
exit 1
