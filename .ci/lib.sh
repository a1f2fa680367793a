# shellcheck shell=bash
# What run.sh and test.sh share; sourced by both. Everything it says goes to standard error.

say() { printf '%s\n' "$*" >&2; }
fail() {
  say "isorelax: $*"
  exit 1
}

# A process without an environment has no PATH to hand on, and dpkg wants the sbin folders.
export PATH="${PATH:+$PATH:}/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"

# packages_in FILE...: the names in package lists, without comments.
packages_in() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$@"; }

# missing_packages NAME...: those that are not installed, one per line.
missing_packages() {
  local installed
  # dpkg-query fails when it does not know one of the names, and still lists the others.
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' || true)
  comm -23 <(printf '%s\n' "$@" | sort -u) <(sort -u <<<"$installed")
}

distribution() {
  local ID='' VERSION_ID='' PRETTY_NAME='an unknown system'
  # shellcheck disable=SC1091
  [ -r /etc/os-release ] && . /etc/os-release
  printf '%s %s|%s' "$ID" "$VERSION_ID" "$PRETTY_NAME"
}

# install_packages FILE...: installs what the lists name and the system lacks. Says nothing when nothing is missing.
install_packages() {
  local names missing system log
  mapfile -t names < <(packages_in "$@")
  system=$(distribution)
  command -v dpkg-query >/dev/null 2>&1 && command -v apt-get >/dev/null 2>&1 || fail \
    "this is ${system#*|}; the script installs packages on Debian 12 only. What the program needs stands in .ci/packages.run."
  mapfile -t missing < <(missing_packages "${names[@]}")
  [ ${#missing[@]} -eq 0 ] && return
  [ "${system%%|*}" = 'debian 12' ] || fail \
    "this is ${system#*|}; the script installs packages on Debian 12 only. Missing here: ${missing[*]}"

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null 2>&1 || fail \
      "these packages are missing, and installing them needs root or sudo. As root: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  say "Installing with ${as_root[*]:+${as_root[*]} }apt-get: ${missing[*]}"
  log=$(mktemp)
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get -q -y -o DPkg::Lock::Timeout=600)
  # One source that does not answer need not matter: whether the packages can be had decides.
  "${apt[@]}" update </dev/null >"$log" 2>&1 || true
  if ! "${apt[@]}" install --no-install-recommends "${missing[@]}" </dev/null >>"$log" 2>&1; then
    tail -n 15 "$log" >&2
    say "isorelax: apt-get could not install ${missing[*]}; its last lines stand above, all of them in $log."
    grep -qiE 'could not resolve|failed to fetch|unable to locate|no installation candidate|connection' "$log" &&
      say "isorelax: is there a way to the network, and does /etc/apt name Debian 12 (bookworm) main?"
    exit 1
  fi
  rm -f "$log"
}

# As many compilers at once as there are processors and gigabytes of free memory.
build_jobs() {
  local processors gigabytes
  processors=$(nproc)
  gigabytes=$(awk '/^MemAvailable/ {print int($2 / 1048576)}' /proc/meminfo 2>/dev/null)
  [ -n "$gigabytes" ] && [ "$gigabytes" -lt "$processors" ] && processors=$((gigabytes > 0 ? gigabytes : 1))
  echo "$processors"
}

# show_progress WHAT: reads ninja's lines; on a terminal keeps one line up to date, elsewhere says each quarter.
# Whatever is not a progress line (an error) is shown by the caller from the log.
show_progress() {
  local line last=0 built total
  while IFS= read -r line; do
    [[ $line =~ ^@([0-9]+)/([0-9]+)@ ]] || continue
    built=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
    if [ -t 2 ]; then
      printf '\r%s: %d of %d' "$1" "$built" "$total" >&2
    elif [ $((4 * built / total)) -gt "$last" ]; then
      last=$((4 * built / total))
      say "  $built of $total"
    fi
  done
  [ -t 2 ] && printf '\r\033[K' >&2
  return 0
}

# build_preset ROOT PRESET [TARGET...]: configures where needed and builds; quiet unless there is something to do.
build_preset() {
  local root=$1 preset=$2 folder="$1/build/$2" log status=0 pending
  shift 2
  mkdir -p "$folder" 2>/dev/null || fail "cannot write to $folder"
  log="$folder/build.log"
  exec 9>"$folder/.lock"
  flock 9
  # A build folder remembers where its sources were; one that was moved or copied starts afresh.
  if [ -f "$folder/CMakeCache.txt" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    find "$folder" -mindepth 1 -maxdepth 1 ! -name .lock -exec rm -rf {} +
  fi
  if [ ! -f "$folder/build.ninja" ] || [ "$root/CMakePresets.json" -nt "$folder/build.ninja" ]; then
    say "Configuring ($preset)"
    if ! (cd -- "$root" && cmake --preset "$preset") </dev/null >"$log" 2>&1; then
      grep -v '^-- ' "$log" | tail -n 40 >&2
      fail "configuring failed; all of it stands in $log"
    fi
  fi
  pending=$(ninja -C "$folder" -n "$@" 2>/dev/null | tail -n 1)
  if [[ $pending != *'no work to do'* ]]; then
    say "Building ($preset)"
    NINJA_STATUS='@%f/%t@ ' ninja -C "$folder" -j "$(build_jobs)" "$@" </dev/null 2>&1 | tee "$log" |
      show_progress "Building ($preset)" || status=$?
    if [ "$status" -ne 0 ]; then
      awk '/^FAILED: / {shown = 1} shown' "$log" | grep -v '^@' | head -n 80 >&2
      fail "building failed; all of it stands in $log"
    fi
  fi
  exec 9>&-
}
