#!/bin/sh
# packaging/package.sh BUILD [--offline] [PACKAGE...]: makes Debian packages in build/package, from what was built in
# BUILD. `./stadion package` calls it.
#
# With --offline, one archive for machines without internet follows: our package, everything that it depends on and
# recommends, what the kiosk session needs, and the named packages. It holds a program `install`, which checks the
# SHA256 sums and installs from the archive alone. The machine must have Debian 12; a bare one is enough.
#
# The packages come from the sources of this machine's apt, with lists and states of their own. So nothing depends on
# what is installed here, and nothing here changes. It needs no root.
set -eu
build=$1
shift
case ${1:-} in
  -h | --help)
    echo "Usage: ./stadion package [--offline] [PACKAGE...]"
    echo
    echo "Makes Debian packages in build/package. --offline adds an archive for machines without internet: our package,"
    echo "all packages that it needs, those of the kiosk session, and the named ones, such as a driver."
    exit 0
    ;;
esac
root=$(cd "$(dirname "$0")/.." && pwd)
out=$root/build/package
say() { printf 'stadion: %s\n' "$*" >&2; }
fail() { say "$*"; exit 2; }

offline=
wanted="xserver-xorg-core xserver-xorg-input-libinput xauth kbd"
for word; do
  case $word in
    --offline) offline=1 ;;
    -*) fail "package: unknown option $word; there is --offline" ;;
    *) wanted="$wanted $word" ;;
  esac
done
command -v cpack >/dev/null || fail "package: no cpack: apt-get install cmake"
command -v dpkg-shlibdeps >/dev/null || fail "package: no dpkg-shlibdeps: apt-get install dpkg-dev"

rm -rf "$out"
mkdir -p "$out"
say "package: making the Debian packages (log: build/package/cpack.log)"
(cd "$build" && cpack -G DEB -B "$out/cpack") >"$out/cpack.log" 2>&1 || { tail -n 15 "$out/cpack.log" >&2; exit 3; }
mv "$out"/cpack/*.deb "$out/"
rm -rf "$out/cpack"
for file in "$out"/*.deb; do say "package: $file ($(($(stat -c %s "$file") / 1048576)) MiB)"; done
[ -n "$offline" ] || exit 0

ours=$(find "$out" -maxdepth 1 -name 'stadion_*.deb')
version=$(dpkg-deb -f "$ours" Version) architecture=$(dpkg-deb -f "$ours" Architecture)
name=stadion-offline-$version-$architecture
folder=$out/$name
mkdir -p "$folder/packages" "$out/apt/lists/partial" "$out/apt/cache/archives/partial"
: >"$out/apt/status"
cp "$ours" "$folder/packages/"

# apt with a state of its own, in which nothing is installed: so everything is downloaded.
own_apt() {
  apt-get -o Dir::State="$out/apt" -o Dir::State::lists="$out/apt/lists" -o Dir::State::status="$out/apt/status" \
    -o Dir::Cache="$out/apt/cache" -o Debug::NoLocking=1 -o APT::Sandbox::User= -o APT::Architecture="$architecture" \
    -o APT::Install-Recommends=false "$@"
}
say "package: reading the lists of packages"
own_apt update -qq >"$out/apt/update.log" 2>&1 || { tail -n 5 "$out/apt/update.log" >&2; fail "package: no lists of packages; is there a network?"; }
recommended=$(dpkg-deb -f "$ours" Recommends | tr -d ' ' | tr ',' ' ')
wanted="$recommended $wanted"
# shellcheck disable=SC2086 # a list of words
own_apt install -y --print-uris "$ours" $wanted >"$out/apt/uris" 2>"$out/apt/errors" || { cat "$out/apt/errors" >&2; fail "package: these packages do not fit together: $wanted"; }
count=$(grep -c "^'.*\.deb'" "$out/apt/uris" || true)
bytes=$(sed -n "s/^'.*\.deb' [^ ]* \([0-9]*\).*/\1/p" "$out/apt/uris" | awk '{ sum += $1 } END { printf "%d", sum }')
say "package: downloading $count packages, $((bytes / 1048576)) MiB"
if [ -t 2 ]; then quiet=; else quiet=-qq; fi
# shellcheck disable=SC2086
own_apt install -y --download-only $quiet "$ours" $wanted >&2
mv "$out/apt/cache/archives/"*.deb "$folder/packages/"
echo "stadion $wanted" >"$folder/wanted"

# A list of packages, as apt reads it.
(
  cd "$folder"
  for file in packages/*.deb; do
    dpkg-deb -f "$file" | sed '/^[[:space:]]*$/d'  # a blank line would end the section
    printf 'Filename: ./%s\nSize: %s\nSHA256: %s\n\n' "$file" "$(stat -c %s "$file")" "$(sha256sum "$file" | cut -d ' ' -f 1)"
  done >Packages
)
cp "$root/packaging/hall/install-offline" "$folder/install"
chmod 755 "$folder/install"
(cd "$folder" && find . -type f | sort | xargs sha256sum >"$out/sums" && mv "$out/sums" SHA256SUMS)
say "package: writing the archive"
tar -C "$out" --owner=0 --group=0 --sort=name -cf "$out/$name.tar" "$name"
(cd "$out" && sha256sum "$name.tar" >"$name.tar.sha256")
rm -rf "$folder" "$out/apt"
say "package: $out/$name.tar ($(($(stat -c %s "$out/$name.tar") / 1048576)) MiB, $((count + 1)) packages). On the other machine: tar xf $name.tar && sudo $name/install"
