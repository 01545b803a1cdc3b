#!/bin/sh
# Builds oneTBB for ThreadSanitizer, from the source of the installed Debian package: onetbb.sh PREFIX
# Where that cannot be, its last line says why.
set -eu
prefix=$1 work=$1/work
[ ! -e "$prefix/built" ] || exit 0
rm -rf "$prefix"
mkdir -p "$work/sources" "$work/lists/partial" "$work/cache/archives/partial"
cd "$work"

give_up() {
  [ ! -e log ] || tail -n 5 log
  echo "$1"
  exit 1
}
command -v apt-get >/dev/null || give_up "this system has no apt-get"
version=$(dpkg-query --show --showformat='${source:Version}' libtbb-dev) || give_up "libtbb-dev is not a package of this system"

# The system's own places, asked for sources; nothing of it is changed.
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  case $file in
    *.list) [ ! -e "$file" ] || sed -n 's/^deb /deb-src /p' "$file" >"sources/${file##*/}" ;;
    *.sources) [ ! -e "$file" ] || sed 's/^Types:.*/Types: deb-src/' "$file" >"sources/${file##*/}" ;;
  esac
done
apt() {
  timeout 120 apt-get -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$work/sources" -o "Dir::State::lists=$work/lists" \
    -o "Dir::Cache=$work/cache" -o APT::Sandbox::User= "$@" >>log 2>&1
}
apt update || true # one of several places may be down
apt source --download-only "onetbb=$version" || give_up "apt-get has no source of onetbb $version"
tar xf onetbb_*.orig.tar.*

# The allocator, too: memory that one without ThreadSanitizer hands out again looks like a race.
{
  cmake -S oneTBB-*/ -B build -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14 \
    -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_PROXY_BUILD=OFF -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON \
    -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib &&
    cmake --build build --parallel 2 && cmake --install build
} >>log 2>&1 || give_up "oneTBB $version does not build with ThreadSanitizer"
cd "$prefix"
rm -rf "$work"
touch built
