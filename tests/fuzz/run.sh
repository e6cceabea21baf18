#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh BUILD SECONDS: each fuzzer for so long, from corpus/ and what earlier runs found. New finds
# go to BUILD/fuzz/NAME; what breaks something is left beside it and ends the run.
set -eu
build=$1
seconds=$2
here=$(dirname "$0")
export LSAN_OPTIONS="suppressions=$here/../../cmake/leaks-of-libraries.txt:print_suppressions=0"
for corpus in "$here"/corpus/*/; do
  name=$(basename "$corpus")
  found=$build/fuzz/$name
  mkdir -p "$found"
  seeds=$corpus
  [ "$name" = model_file ] && seeds="$corpus $here/../../models"
  echo "== $name"
  # Exact algebra may take long on strange numbers: that is no fault.
  # shellcheck disable=SC2086
  "$build/bin/fuzz_$name" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -max_len=20000 \
    -artifact_prefix="$build/fuzz/$name-" -verbosity=0 -print_final_stats=1 "$found" $seeds \
    >"$found.log" 2>&1 || { cat "$found.log"; exit 1; }
  sed -n 's/^stat::number_of_executed_units: */inputs tried: /p' "$found.log"
done
