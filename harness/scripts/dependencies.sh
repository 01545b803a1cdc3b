# shellcheck shell=bash
# The system packages of pairsum (Debian 12 names) and how they get installed. To be sourced; packages_log: where apt-get's
# words go.
# shellcheck disable=SC2034  # the lists are used by name, see packages_of

build_packages=(g++ cmake make ninja-build pkg-config git libbenchmark-dev libtbb-dev libeigen3-dev
  nlohmann-json3-dev libhwloc-dev libcli11-dev libfmt-dev libhwy-dev libhdf5-dev)
plots_packages=(python3-pandas python3-scipy python3-matplotlib python3-jinja2)
tests_packages=(libgtest-dev librapidcheck-dev valgrind python3-jsonschema python3-pytest
  python3-h5py python3-vtk9 python3-gsd
  libopenmpi-dev openmpi-bin libtrilinos-zoltan-dev
  clang-14 libomp-14-dev libclang-rt-14-dev clang-format-14 clang-tidy-14
  chromium chromium-driver python3-selenium)

exit_missing=3 # what a script exits with when something it needs is not installed

# packages_of GROUP...: the packages of these groups (build, plots, tests), one per line.
packages_of() {
  local group
  for group in "$@"; do
    local -n members="${group}_packages"
    printf '%s\n' "${members[@]}"
  done
}

# missing_of PACKAGE...: those that dpkg does not have installed, one per line.
missing_of() {
  local installed package
  # dpkg-query fails if it does not know one of them, but lists the others all the same.
  # shellcheck disable=SC2016  # the braces are dpkg-query's
  installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    grep --quiet --line-regexp --fixed-strings "installed $package" <<<"$installed" || echo "$package"
  done
}

# install_line PACKAGE...: the command that installs them, as a user would type it.
install_line() { echo "apt-get install -y --no-install-recommends $*"; }

# ensure_packages GROUP...: installs what is missing of these groups. Returns 3, after saying what to do,
# if that is not possible.
ensure_packages() {
  local wanted missing as_root=()
  mapfile -t wanted < <(packages_of "$@")
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    {
      echo "This is no Debian or Ubuntu (no apt-get, dpkg). Install what these Debian packages hold,"
      echo "then run again with --no-install:"
      echo "  ${wanted[*]}"
    } >&2
    return "$exit_missing"
  fi
  mapfile -t missing < <(missing_of "${wanted[@]}")
  if ((${#missing[@]} == 0)); then
    echo "packages: all ${#wanted[@]} are installed"
    return 0
  fi
  if [[ $(id -u) != 0 ]]; then
    if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
      {
        echo "${#missing[@]} packages are missing, and only root can install them. As root:"
        echo "  $(install_line "${missing[@]}")"
      } >&2
      return "$exit_missing"
    fi
    as_root=(sudo -n)
  fi
  echo "packages: installing ${missing[*]}"
  if ! apt_get "${as_root[@]}" -- "${missing[@]}" >>"${packages_log:-/dev/stdout}"; then
    {
      echo "apt-get could not install the missing packages. Try, as root, after apt-get update:"
      echo "  $(install_line "${missing[@]}")"
    } >&2
    return "$exit_missing"
  fi
}

# apt_get [sudo -n] -- PACKAGE...: refreshes the lists and installs; waits for another apt-get to end.
apt_get() {
  local as_root=()
  while [[ $1 != -- ]]; do
    as_root+=("$1")
    shift
  done
  shift
  local call=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=120)
  "${call[@]}" update </dev/null || echo "packages: the lists could not be refreshed, going on with the old ones" >&2
  "${call[@]}" install -y --no-install-recommends "$@" </dev/null
}

# choose_python MODULE...: sets and exports PYTHON (kept if set, else the system's, which sees the Debian
# packages; the first python3 in PATH may be another one). Returns 3, after saying what to do, if a module
# cannot be imported.
choose_python() {
  local problem
  export PYTHON=${PYTHON:-/usr/bin/python3}
  if ! problem=$("$PYTHON" -c 'import sys; [__import__(name) for name in sys.argv[1:]]' "$@" 2>&1); then
    {
      echo "$PYTHON cannot import all of $*: ${problem##*$'\n'}"
      echo "Set PYTHON to one that can, or install, as root:"
      echo "  $(install_line "${@/#/python3-}")"
    } >&2
    return "$exit_missing"
  fi
}
