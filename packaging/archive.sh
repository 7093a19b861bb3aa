#!/usr/bin/env bash
# The release for this machine's kind, to be unpacked anywhere (or in /usr/local: the folders are its): the program, manual pages, completions of three shells, the
# schema of study files, licences. Ends with the archive's name. With PROGRAM and MAN set, to what was built before, it builds nothing.
#
#     packaging/archive.sh [FOLDER]         FOLDER is target/archive unless named
set -euo pipefail
out=$(realpath -m "${1:-$(dirname "$0")/../target/archive}")
cd "$(dirname "$0")/.."
if [ -z "${PROGRAM:-}" ]; then
  cargo build --release --locked --bin gearwear --example write_man
  built=${CARGO_TARGET_DIR:-target}/release
  PROGRAM=$built/gearwear MAN=$built/examples/write_man
fi
name=gearwear-$("$PROGRAM" --version | cut -d' ' -f2)-$(rustc -vV | sed -n 's/^host: //p')
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
to=$home/$name
mkdir -p "$to"/bin "$to"/share/{bash-completion/completions,zsh/site-functions,fish/vendor_completions.d,doc/gearwear} "$out"
install -m 755 "$PROGRAM" "$to/bin/gearwear"
strip "$to/bin/gearwear"
"$MAN" "$to/share/man/man1"
"$PROGRAM" completions bash >"$to/share/bash-completion/completions/gearwear"
"$PROGRAM" completions zsh >"$to/share/zsh/site-functions/_gearwear"
"$PROGRAM" completions fish >"$to/share/fish/vendor_completions.d/gearwear.fish"
"$PROGRAM" schema >"$to/share/doc/gearwear/study.schema.json"
cp README.md CHANGELOG.md LICENSE-APACHE LICENSE-MIT "$to/share/doc/gearwear/"
# the same files make the same archive: no owners, the times of the last commit
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct 2>/dev/null || echo 0)" -C "$home" -c "$name" |
  gzip -n9 >"$out/$name.tar.gz"
echo "$out/$name.tar.gz"
