# Shell functions shared by the run scripts of the hosts. To be sourced by bash.
# shellcheck shell=bash

# shellcheck source=scripts/lib.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../scripts/lib.sh"
hosts=$root/tests/hosts
skip_hint="HYPOFAB_SKIP_HOSTS=1 skips the tests inside finite element codes"

# start_host NAME: say so and end when hosts are to be skipped; else make sure of a build and of the Python of the tests.
# HYPOFAB_BUILD: folder of a build with the program and libhypofab_umat; default: build.
start_host() {
  if [[ -n ${HYPOFAB_SKIP_HOSTS:-} ]]; then
    printf 'SKIPPED: %s, because HYPOFAB_SKIP_HOSTS is set\n' "$1"
    exit 0
  fi
  export HYPOFAB_BUILD=${HYPOFAB_BUILD:-$root/build}
  [[ -x $HYPOFAB_BUILD/cli/hypofab ]] || build "$HYPOFAB_BUILD" "Release" -DCMAKE_BUILD_TYPE=Release
  ensure_python "$root/python/requirements.txt" "$root/python/requirements-test.txt"
}

# ensure_host NAME FOLDER REQUIREMENTS PROBE...: a virtual environment of the host's own (it asks for other versions than
# the tests do) in .cache/FOLDER; made anew when the requirements changed or the probe, run by its Python, fails.
ensure_host() {
  local name=$1 folder=$root/.cache/$2 requirements=$3
  shift 3
  if cmp --silent "$requirements" "$folder/installed" && "$folder/bin/python" "$@" >/dev/null 2>&1; then return; fi
  mkdir -p "$root/.cache"
  stage "Creating the virtual environment of $name" python3 -m venv --clear "$folder"
  stage "Installing $name" "$folder/bin/python" -m pip install --disable-pip-version-check \
    --requirement "$requirements" || stop 1 "$name cannot be installed; $skip_hint"
  cp "$requirements" "$folder/installed"
}

# Kratos serves two of them.
ensure_kratos() {
  ensure_host "Kratos GeoMechanics" venv-kratos "$hosts/kratos/requirements-kratos.txt" \
    -c 'import KratosMultiphysics.GeoMechanicsApplication'
  export HYPOFAB_KRATOS_PYTHON=$root/.cache/venv-kratos/bin/python
}
