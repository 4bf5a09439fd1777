#!/usr/bin/env bash
# bench/gpu/pack.sh [FOLDER]: copies the release build with its libraries, shows and assets into FOLDER (default: build/gpu),
# and packs FOLDER.tar.gz of it. It runs on an x86-64 machine with a graphics card that has neither packages nor a network:
# copy the archive there, unpack it and start run.sh. OpenGL and EGL are not copied: they belong to the driver of the card.
set -euo pipefail
root=$(dirname "$(dirname "$(dirname "$(readlink -f "$0")")")")
folder=${1:-$root/build/gpu}
bin=$root/build/release/bin
for program in stadion stadion-bench stadion-measure stadion-wall stadion-import; do
  [ -x "$bin/$program" ] || { echo "pack: there is no $program; build it: cmake --build --preset release" >&2; exit 2; }
done
rm -rf "$folder"
mkdir -p "$folder/bin" "$folder/lib/stadion" "$folder/share/stadion/assets"
for program in stadion stadion-bench stadion-measure stadion-wall stadion-import; do
  strip -o "$folder/bin/$program" "$bin/$program"
done
for program in "$bin"/stadion*; do ldd "$program"; done 2>/dev/null | awk '$2 == "=>" && $3 ~ /^\// {print $3}' | sort -u |
  while read -r library; do
    # The C library and its loader come with the target's system; OpenGL comes with its driver.
    case $(basename "$library") in libc.so* | libm.so* | libpthread* | libdl.so* | librt.so* | ld-linux* | libGL* | libEGL* | libOpenGL*) ;;
      *) cp -L "$library" "$folder/lib/" ;;
    esac
  done
cp -r "$root/scripts" "$root/walls" "$folder/share/stadion/"
tar -C "$root/assets" --exclude=./generator -cf - . | tar -C "$folder/share/stadion/assets" -xf -
cp "$root/bench/gpu/run.sh" "$root/bench/gpu/report.py" "$folder/"
tar -C "$(dirname "$folder")" -czf "$folder.tar.gz" "$(basename "$folder")"
du -sh "$folder" "$folder.tar.gz"
