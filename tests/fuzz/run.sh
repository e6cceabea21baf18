#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh BUILD SECONDS: each fuzzer for so long, half of it from corpus/ and what earlier runs found,
# half from inputs of a megabyte. New finds go to BUILD/fuzz/NAME; what breaks something is left
# beside it and ends the run.
set -eu
build=$1
half=$((($2 + 1) / 2))
here=$(dirname "$0")
export LSAN_OPTIONS="suppressions=$here/../../cmake/leaks-of-libraries.txt:print_suppressions=0"

# fuzz LOG OPTION... FOLDER...: what is found goes to the first folder.
fuzz() {
  log=$1
  shift
  # Exact algebra may take long on strange numbers: that is no fault.
  "$build/bin/fuzz_$name" -max_total_time="$half" -rss_limit_mb=4096 \
    -artifact_prefix="$build/fuzz/$name-" -verbosity=0 -print_final_stats=1 "$@" \
    >"$log" 2>&1 || { cat "$log"; exit 1; }
  sed -n 's/^stat::number_of_executed_units: */inputs tried: /p' "$log"
}

for corpus in "$here"/corpus/*/; do
  name=$(basename "$corpus")
  found=$build/fuzz/$name
  large=$build/fuzz-large/$name
  mkdir -p "$found"
  rm -rf "$large" "$large-found"
  mkdir -p "$large" "$large-found"
  "$build/bin/fuzz_large_inputs" "$name" "$large" "$corpus"*
  seeds=$corpus
  [ "$name" = model_file ] && seeds="$corpus $here/../../models"
  echo "== $name"
  # shellcheck disable=SC2086
  fuzz "$found.log" -timeout=60 -max_len=20000 "$found" $seeds
  echo "== $name, up to a megabyte"
  # Without length control mutations of the large inputs are large from the beginning.
  fuzz "$found-large.log" -timeout=300 -max_len=1048576 -len_control=0 "$large-found" "$large"
done
