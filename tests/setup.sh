# shellcheck shell=sh
# Shared by scenes/demo.sh and tests/run.sh, which source it from the top folder: installs the missing
# packages of tests/packages.txt and builds. POSIX sh; stops the calling script with a clear line.

say() {
    printf 'orzo: %s\n' "$*"
}

stop() {
    printf 'orzo: %s\n' "$*" >&2
    exit 1
}

wanted_packages() {
    sed 's/#.*//' tests/packages.txt
}

missing_packages() {
    for package in $(wanted_packages); do
        state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)
        [ "$state" = installed ] || printf '%s ' "$package"
    done
}

# Runs its arguments as root: directly, or through sudo.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        command -v sudo >/dev/null ||
            stop "installing packages needs root: run this as root, or install sudo"
        sudo "$@"
    fi
}

install_packages() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "this is no Debian system: the packages of tests/packages.txt must be there already"
        return
    fi
    missing=$(missing_packages)
    [ -n "$missing" ] || return 0
    say "about to install these Debian packages and what they depend on:"
    # shellcheck disable=SC2086 # one word a package is meant
    printf '    %s\n' $missing
    as_root apt-get update -q || stop "apt-get update failed: is there a network?"
    # shellcheck disable=SC2086 # one word a package is meant
    as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends $missing ||
        stop "apt-get could not install: $missing"
}

# install_python FOLDER PACKAGE...: a virtual environment with these packages of tests/requirements.txt.
install_python() {
    environment=$1
    shift
    [ -x "$environment/bin/pip" ] || python3 -m venv "$environment" || return 1
    # shellcheck disable=SC2046 # one word a package is meant
    "$environment/bin/pip" install --quiet --disable-pip-version-check \
        $(for package in "$@"; do grep -E "^$package([=<>~].*)?\$" tests/requirements.txt; done)
}

# build_orzo FOLDER TYPE: configures and builds everything in FOLDER.
build_orzo() {
    say "building ($2) in $1/"
    log=$1/setup.log
    generator=
    mkdir -p "$1" || stop "cannot make the folder $1/"
    [ -f "$1/CMakeCache.txt" ] || generator='-G Ninja'
    # shellcheck disable=SC2086 # two words, or none
    cmake -S . -B "$1" $generator -DCMAKE_BUILD_TYPE="$2" >"$log" 2>&1 ||
        { cat "$log" >&2; stop "cmake could not configure $1/"; }
    cmake --build "$1" >"$log" 2>&1 ||
        { cat "$log" >&2; stop "the build in $1/ failed"; }
}

# The sources of the tests that open a device or run whole scenes: they name a device, or say that they need one.
device_test_files() {
    grep -lE 'OzDevice|#include "(compute/device|device_rig|sim/sim|run/run)\.h|ORZO_NEEDS_DEVICE' \
        tests/test_*.c
}
