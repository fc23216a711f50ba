# Shared by ./demo and ./test: packages, configure, build. Sourced with bash, from the repository root.
set -u -o pipefail
export LC_ALL=C.UTF-8

say() { printf '\n== %s\n' "$*"; }

# Installs what tools/packages.txt names and the machine lacks; silent where all is there.
need_packages() {
  local missing=() package run=()
  while read -r package; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' ||
      missing+=("$package")
  done < <(grep -v '^#' tools/packages.txt)
  if [ ${#missing[@]} -eq 0 ]; then
    say "packages: all there"
    return 0
  fi
  say "packages: installing ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "run as root, or install sudo"; return 1; }
    run=(sudo)
  fi
  "${run[@]}" apt-get update -q &&
    "${run[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# configure_and_build PRESET [TARGET...]: build/PRESET, with as many jobs as cores and memory allow.
configure_and_build() {
  local preset=$1 jobs gigabytes new=()
  shift
  jobs=$(nproc)
  gigabytes=$(awk '/MemAvailable/ {print int($2 / 1048576)}' /proc/meminfo)
  [ "$gigabytes" -lt $((2 * jobs)) ] && jobs=$((gigabytes / 2 > 0 ? gigabytes / 2 : 1))
  say "build: $preset, $jobs jobs"
  # A folder that is already configured keeps what it was configured for.
  [ -f "build/$preset/CMakeCache.txt" ] || new=(-DCAMBER_ONE_BUILD=ON)
  cmake --preset "$preset" ${new[@]+"${new[@]}"} >"build/$preset.configure.log" 2>&1 ||
    { cat "build/$preset.configure.log"; return 1; }
  cmake --build --preset "$preset" --parallel "$jobs" ${@:+--target "$@"}
}
