# Shell functions shared by scripts/demo, scripts/test and scripts/format. To be sourced by bash.
# shellcheck shell=bash

set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
venv=$root/.venv
python=$venv/bin/python
logs=$root/out/logs
mkdir -p "$logs"

# stop STATUS LINE...: print the lines to stderr and exit.
stop() {
  local status=$1
  shift
  printf '%s\n' "$@" >&2
  exit "$status"
}

# stage TITLE COMMAND...: run a command with its output in a log file, which is shown when the command fails.
# One line tells what runs and how long it took.
stage() {
  local title=$1 log status=0 start=$SECONDS
  shift
  log=$(printf '%s' "$title" | tr -cs 'A-Za-z0-9' '_')
  log=$logs/${log:0:80}.log # a list of packages is longer than a file's name may be
  printf '%-60s' "$title ..."
  # The subshell switches -e off by being tested, so the command is expected to be one command or to chain with &&.
  ("$@") >"$log" 2>&1 || status=$?
  if ((status == 0)); then
    printf ' %d s\n' "$((SECONDS - start))"
  else
    printf ' FAILED (status %d)\n' "$status"
    cat "$log"
    printf '%s\n' "The whole log: $log"
  fi
  return "$status"
}

# The names in packages.txt, one per line.
required_packages() {
  sed -e 's/#.*//' -e 's/[[:space:]]*$//' -e '/^$/d' "$root/scripts/packages.txt"
}

# Those of the names on standard input that dpkg does not know as installed.
missing_packages() {
  local package
  while read -r package; do
    [[ $(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null) == ii* ]] || printf '%s\n' "$package"
  done
}

# Install what packages.txt asks for and is missing; exit 2 when that is not possible.
ensure_packages() {
  if [[ -n ${HYPOFAB_SKIP_PACKAGES:-} ]] || ! command -v apt-get >/dev/null; then
    check_tools
    return
  fi
  local -a missing admin=()
  mapfile -t missing < <(required_packages | missing_packages)
  ((${#missing[@]} > 0)) || return 0
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null || ! { sudo -n true 2>/dev/null || { [[ -t 0 ]] && sudo -v; }; }; then
      stop 2 "These system packages are missing, and neither root nor sudo is at hand to install them:" \
        "  ${missing[*]}" \
        "Ask an administrator to run:" \
        "  apt-get install --no-install-recommends ${missing[*]}" \
        "or set HYPOFAB_SKIP_PACKAGES=1 if you have the same software from elsewhere."
    fi
    admin=(sudo)
  fi
  stage "Updating the package lists" "${admin[@]}" apt-get update ||
    stop 2 "apt-get update failed; needed are: ${missing[*]}"
  stage "Installing ${missing[*]}" "${admin[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends "${missing[@]}" ||
    stop 2 "apt-get could not install: ${missing[*]}"
}

# Without apt-get: name what is needed and go on if the tools are there; CMake then names a missing library.
check_tools() {
  local tool
  local -a absent=()
  for tool in gcc gfortran cmake ninja pkg-config python3; do
    command -v "$tool" >/dev/null || absent+=("$tool")
  done
  ((${#absent[@]} > 0)) || return 0
  stop 2 "Not found: ${absent[*]}" "Install the following (names as in Debian) by the means of this system:" \
    "$(sed -e '/^#/d' "$root/scripts/packages.txt")"
}

# ensure_python REQUIREMENTS...: the virtual environment with the packages of these files; quick when up to date.
ensure_python() {
  python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
    stop 2 "Python 3.11 or later is needed; found: $(command -v python3), $(python3 --version)"
  # A virtual environment holds its own path and that of its Python: made anew when either changes.
  local identity file stamp
  identity=$(python3 -c 'import sys; print(sys.version, sys.base_prefix)')$venv
  if [[ ! -x $python || $(cat "$venv/identity" 2>/dev/null) != "$identity" ]]; then
    stage "Creating the virtual environment .venv" python3 -m venv --clear "$venv" ||
      stop 2 "python3 -m venv failed; on Debian it needs the package python3-venv"
    printf '%s\n' "$identity" >"$venv/identity"
  fi
  for file in "$@"; do
    stamp=$venv/$(basename "$file")
    cmp --silent "$file" "$stamp" && continue
    stage "Installing $(basename "$file")" "$python" -m pip install --disable-pip-version-check --requirement "$file" ||
      stop 2 "pip could not install $file"
    cp "$file" "$stamp"
  done
}

# ensure_python_alone REQUIREMENTS: packages without those that they depend on, into the same environment.
ensure_python_alone() {
  local stamp
  stamp=$venv/$(basename "$1")
  if cmp --silent "$1" "$stamp"; then return; fi
  stage "Installing $(basename "$1") alone" "$python" -m pip install --disable-pip-version-check --no-deps \
    --requirement "$1" || stop 2 "pip could not install $1"
  cp "$1" "$stamp"
}

# build FOLDER TITLE OPTION... [-- TARGET...]: configure and build; all targets when none is named. The variable generator
# may name another than Ninja.
build() {
  local folder=$1 title=$2
  local -a options=() target=()
  shift 2
  while (($# > 0)) && [[ $1 != -- ]]; do
    options+=("$1")
    shift
  done
  (($# < 2)) || target=(--target "${@:2}")
  stage "Configuring $title" cmake -G "${generator:-Ninja}" -S "$root" -B "$folder" "${options[@]}" &&
    stage "Building $title" cmake --build "$folder" --parallel "$(nproc)" "${target[@]}"
}
