#!/bin/sh
# sbom.sh BUILD: the software bill of materials of the programs in BUILD/bin, as SPDX 2.3 JSON on stdout.
#
# Packages are those of the libraries that the programs are linked with (ldd), those that they load at run time, and
# those of the libraries that these are linked with in turn, as dpkg knows them on this machine; those that are not
# installed are left out, and named on stderr. What Debian says of a package's licence is quoted, not concluded: a copyright
# file that is machine-readable names licences of parts, which need not be what is linked.
set -eu
build=$1
[ -x "$build/bin/stadion" ] || { echo "sbom: there is no program in $build/bin; build it first" >&2; exit 2; }
programs="./stadion ./stadion-import ./stadion-wall ./libstadion-http.so"
# Loaded at run time, also by GLFW and OpenAL, and libraries that are headers alone: no program names them.
others="libosmesa6 libddsc0debian libsndfile1 libzip4 libegl1 libegl-mesa0 libgl1-mesa-dri libglfw3 libopenal1 libx11-6 libasound2 \
libgl1 libglx0 libglx-mesa0 libx11-xcb1 libxcursor1 libxi6 libxinerama1 libxrandr2 libxrender1 libxxf86vm1 libxss1 libxext6 libdbus-1-3 libpulse0 \
libjack-jackd2-0 libportaudio2 libeigen3-dev libcli11-dev nlohmann-json3-dev tao-pegtl-dev"

# One awk for all packages: starting programs for each of them would take most of the time.
words='
function id(s) { gsub(/[^A-Za-z0-9.-]/, "-", s); return s }
function text(s,   done) {
  gsub(/[\001-\037]/, "", s)
  while (match(s, /["\\]/)) {
    done = done substr(s, 1, RSTART - 1) "\\" substr(s, RSTART, 1)
    s = substr(s, RSTART + 1)
  }
  return done s
}'

# What ldd asks, without the shell script around it.
loader=$(ldd "$build/bin/stadion" | sed -n 's/^[[:space:]]*\(\/[^ ]*\) (.*/\1/p')
linked() { # the packages whose libraries these files are linked with
  libraries=$(for file; do "$loader" --list "$file"; done |
    sed -n 's/.* => \(\/[^ ]*\) .*/\1/p; s/^[[:space:]]*\(\/[^ ]*\) (.*/\1/p' | sort -u)
  # A package may have a library below /lib that is found below /usr/lib, and the other way round.
  for library in $libraries; do
    real=$(readlink -f "$library")
    printf '%s\n' "$library" "$real" "/usr$library" "${real#/usr}"
  done | sort -u | xargs dpkg-query -S 2>/dev/null | sed 's/:.*//' | sort -u
}

installed() { # those of these packages
  dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null | sed -n 's/ installed$//p' | sort -u
}

libraries() { # those of packages, each once whatever names it has
  dpkg -L $1 | grep '\.so\(\.[0-9.]*\)\?$' | xargs -r stat -Lc '%i %n' | sort -u -k1,1 | sed 's/^[0-9]* //'
}

licences() { # what the machine-readable copyright files of packages name: package, tab, licence
  for p; do
    [ ! -r "/usr/share/doc/$p/copyright" ] || printf '%s\0' "/usr/share/doc/$p/copyright"
  done | xargs -0 -r awk '
    FNR == 1 { split(FILENAME, folders, "/"); package = folders[5] }
    /^Format: *http/ { readable[package] = 1 }
    /^License: *[^ ]/ { sub(/^License: */, ""); name[++count] = $0; of[count] = package }
    END { for (i = 1; i <= count; ++i) if (of[i] in readable) printf "%s\t%s\n", of[i], name[i] }' |
    sort -t "$(printf '\t')" -u -k1,1 -k2
}

version=$(sed -n 's/^project(Stadion VERSION \([0-9.]*\).*/\1/p' "$(dirname "$0")/../CMakeLists.txt")
created=$(date -u ${SOURCE_DATE_EPOCH:+-d "@$SOURCE_DATE_EPOCH"} +%Y-%m-%dT%H:%M:%SZ)
mark=$(cat "$build/bin/stadion" "$build/bin/stadion-import" "$build/bin/stadion-wall" | sha256sum | cut -c1-32)
links=$(cd "$build/bin" && linked $programs)
present=$(installed $others)
absent=$(for p in $others; do case "
$present
" in *"
$p
"*) ;; *) printf ' %s' "$p" ;; esac; done)
[ -z "$absent" ] || echo "sbom: not installed, and left out:$absent" >&2
loaded=$({ echo "$present"; linked $(libraries "$present"); } | sort -u)

cat <<HEAD
{
  "spdxVersion": "SPDX-2.3",
  "dataLicense": "CC0-1.0",
  "SPDXID": "SPDXRef-DOCUMENT",
  "name": "stadion-$version",
  "documentNamespace": "https://spdx.org/spdxdocs/stadion-$version-$mark",
  "creationInfo": { "created": "$created", "creators": ["Tool: stadion-sbom-$version"] },
  "packages": [
    { "name": "stadion", "SPDXID": "SPDXRef-stadion", "versionInfo": "$version", "downloadLocation": "NOASSERTION",
      "filesAnalyzed": false, "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION",
      "copyrightText": "NOASSERTION" }
HEAD
form='${Package}|${Version}|${Architecture}|${source:Package}|${source:Version}|${Homepage}\n'
all=$(printf '%s\n%s\n' "$links" "$loaded" | sort -u)
{ licences $all; echo; dpkg-query -W -f="$form" $all | sort -u; } | awk "$words"'
  !packages && $0 == "" { packages = 1; next }
  !packages {
    p = substr($0, 1, index($0, "\t") - 1)
    if (++licences[p] <= 30) quoted[p] = quoted[p] (licences[p] > 1 ? ";" : "") substr($0, length(p) + 2)
    next
  }
  {
    split($0, field, "|")
    p = field[1]; v = field[2]; home = field[6]
    printf "    ,{ \"name\": \"%s\", \"SPDXID\": \"SPDXRef-deb-%s\", \"versionInfo\": \"%s\", \"supplier\": \"Organization: Debian\",\n", p, id(p), text(v)
    printf "      \"downloadLocation\": \"NOASSERTION\", \"filesAnalyzed\": false, \"licenseConcluded\": \"NOASSERTION\",\n"
    printf "      \"licenseDeclared\": \"NOASSERTION\", \"copyrightText\": \"NOASSERTION\",\n"
    gsub(/;/, "; ", quoted[p])
    if (quoted[p] != "") printf "      \"licenseComments\": \"Debian names for its parts: %s\",\n", text(quoted[p])
    if (home != "") printf "      \"homepage\": \"%s\",\n", text(home)
    printf "      \"sourceInfo\": \"Debian source package %s %s\",\n", text(field[4]), text(field[5])
    printf "      \"externalRefs\": [{ \"referenceCategory\": \"PACKAGE-MANAGER\", \"referenceType\": \"purl\",\n"
    gsub(/[+]/, "%2B", p); gsub(/[+]/, "%2B", v); gsub(/:/, "%3A", v)
    printf "        \"referenceLocator\": \"pkg:deb/debian/%s@%s?arch=%s\" }] }\n", p, v, field[3]
  }'
cat <<'MIDDLE'
  ],
  "relationships": [
    { "spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-stadion" }
MIDDLE
relate() { # kind, packages
  printf '%s\n' "$2" | awk -v kind="$1" "$words"'
    $0 != "" {
      printf "    ,{ \"spdxElementId\": \"SPDXRef-stadion\", \"relationshipType\": \"%s\", \"relatedSpdxElement\": \"SPDXRef-deb-%s\" }\n", kind, id($0)
    }'
}
relate DYNAMIC_LINK "$links"
relate DEPENDS_ON "$loaded"
printf '  ]\n}\n'
