#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# write-datasheets.sh REGULUS >DATASHEETS.md: the datasheets of some robots of this folder, made again.
set -eu
regulus=$1
cd "$(dirname "$0")"
cat <<'EOF'
# Datasheets of some robots

`make datasheets` makes this page again. Each value lies between two ends: one is attained at the place in the
list, the other is proved for every pose of the motion and every load. Loads, speeds and motors are examples of the
model files. A `?` is an end that was not found in the 30 s to 90 s that a robot has, on one thread;
[BOUNDS.md](../codegen/question/bound/BOUNDS.md) describes the quantities and says what they do not mean.
EOF
sheet=$(mktemp)
trap 'rm -f "$sheet"' EXIT
for question in "robot_1 table4_5 75" "robot_2 table5_20 60" "hexapod_6rus work 90" "delta work 30" "octahedral work 45"; do
  set -- $question
  status=0
  "$regulus" datasheet "$1.toml" "$2" --gap 0.05 --time-limit "$3" --threads 1 --markdown --quiet >"$sheet" || status=$?
  [ "$status" -le 2 ] || exit "$status"
  echo
  sed 's/^# /## /' "$sheet"
done
