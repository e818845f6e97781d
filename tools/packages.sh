# The Debian packages of the project, in one place. Sourced by ./run and ./test.

# What builds and runs the daemon and the command line.
BUILD_PACKAGES=(
    build-essential cmake ninja-build pkg-config curl
    libmicrohttpd-dev libcjson-dev libopenblas-dev liblapacke-dev libsqlite3-dev
    libzstd-dev libxxhash-dev libsodium-dev libcurl4-openssl-dev libinih-dev
    libnlopt-dev libhdf5-dev
)
# What the tests need besides.
TEST_PACKAGES=(libcmocka-dev python3 clang-format sqlite3 git)

say() {
    printf '== %s\n' "$*"
}

die() {
    printf 'error: %s\n' "$*" >&2
    exit 1
}

is_debian_12() {
    [ -r /etc/os-release ] && (
        . /etc/os-release
        [ "${ID:-}" = debian ] && [ "${VERSION_ID:-}" = 12 ]
    )
}

# Installs those of the named packages that are missing. On another system it only says which ones
# there are; AEROM_SKIP_PACKAGES=1 goes on with what the machine has.
need_packages() {
    local missing=() package sudo=()
    if [ "${AEROM_SKIP_PACKAGES:-0}" = 1 ]; then
        say "packages: taken as they are (AEROM_SKIP_PACKAGES=1)"
        return
    fi
    if ! is_debian_12; then
        die "this is not Debian 12. Install what corresponds to these Debian packages,
then try again with AEROM_SKIP_PACKAGES=1:
  $*"
    fi
    for package in "$@"; do
        if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
            missing+=("$package")
        fi
    done
    if [ ${#missing[@]} -eq 0 ]; then
        say "packages: all there"
        return
    fi
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "neither root nor sudo; as root run:
  apt-get install --no-install-recommends ${missing[*]}"
        sudo=(sudo)
    fi
    say "packages: installing ${missing[*]}"
    "${sudo[@]}" apt-get update -q
    "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends "${missing[@]}"
}
