#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# install-dependencies.sh [--without-page] PACKAGES...: installs what cmake/packages-debian.txt names, and
# packages named as arguments, that the machine lacks; npm, too, unless without the page. Elsewhere than
# on Debian and its kin it prints the list and stops.
set -eu
here=$(dirname "$0")
with_page=yes
[ "${1-}" != --without-page ] || { with_page= && shift; }
# Each word is a package, or alternatives with bars between them.
packages=$(sed -e 's/#.*//' -e 's/ *| */|/g' -e '/^[[:space:]]*$/d' "$here/packages-debian.txt" | tr '\n' ' ')"$*"

if ! command -v dpkg-query >/dev/null 2>&1; then
  echo "This is not a Debian system. Install the equivalents of these Debian packages, then run make again:"
  echo "  $(echo "$packages" | sed -e 's/|[^ ]*//g')"
  command -v cmake >/dev/null 2>&1 && exit 0   # try the build: CMake names what is missing
  exit 1
fi

# is_enough VERSION PACKAGE: PACKAGE names the least version that is needed, if any.
is_enough() {
  case "$2" in
    *'>='*) dpkg --compare-versions "$1" ge "${2#*>=}" ;;
  esac
}
is_installed() {
  found=$(dpkg-query -W -f '${db:Status-Status} ${Version}' "${1%%>=*}" 2>/dev/null) || return 1
  [ "${found%% *}" = installed ] && is_enough "${found#* }" "$1"
}
any_installed() {
  for one in $(echo "$1" | tr '|' ' '); do
    is_installed "$one" && return 0
  done
  return 1
}
# The first alternative that this Debian has; the first one if it has none, for the message of apt-get.
chosen() {
  for one in $(echo "$1" | tr '|' ' '); do
    found=$(apt-cache policy "${one%%>=*}" 2>/dev/null | sed -n 's/^  Candidate: \([^(].*\)/\1/p')
    [ -n "$found" ] && is_enough "$found" "$one" && echo "${one%%>=*}" && return
  done
  echo "${1%%|*}"
}

missing=
for package in $packages; do
  any_installed "$package" || missing="$missing $package"
done
# The page of `regulus report` alone needs npm, of any origin; everything else is built without it.
page=
[ -z "$with_page" ] || command -v npm >/dev/null 2>&1 || page=npm
[ -n "$missing$page" ] || exit 0

root=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null 2>&1 || {
    [ -n "$missing" ] || { echo "npm is missing: regulus report will be without its page."; exit 0; }
    echo "These packages are missing and installing them needs root: apt-get install$(echo "$missing" | sed -e 's/|[^ ]*//g')" >&2
    exit 1
  }
  root=sudo
  echo "Installing needs root; sudo may ask for your password."
fi
export DEBIAN_FRONTEND=noninteractive
$root apt-get update -qq
install=
for package in $missing; do
  install="$install $(chosen "$package")"
done
echo "Installing:$install $page"
[ -z "$install" ] || $root apt-get install -y -qq --no-install-recommends $install >/dev/null
[ -z "$page" ] || $root apt-get install -y -qq --no-install-recommends $page >/dev/null ||
  echo "npm could not be installed: regulus report will be without its page."
