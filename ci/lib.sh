# Shared by the scripts of this folder, which source it from the root of the repository.
# shellcheck shell=bash

quiet=
cache=${LIGHTPROOF_CACHE:-${XDG_CACHE_HOME:-${HOME:?}/.cache}/lightproof}

# say WORDS…: one line, unless --quiet was given.
say() { [[ $quiet ]] || printf '%s\n' "$*"; }

# die STATUS WORDS…: an error message, then the end.
die() {
  local status=$1
  shift
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit "$status"
}

# usage: the comment at the head of the calling script.
usage() { sed -n '2,/^$/s/^# \{0,1\}//p' "$0"; }

# seconds_since START: time passed since an earlier value of EPOCHREALTIME, in tenths of a second.
seconds_since() {
  local tenths=$(((${EPOCHREALTIME//[!0-9]/} - ${1//[!0-9]/}) / 100000))
  printf '%d.%d s' $((tenths / 10)) $((tenths % 10))
}

# step NAME COMMAND…: runs the command with its output in build/log/NAME.log and prints one line
# with the time taken; if it fails, the end of the log too. The command runs without `set -e`:
# functions given here chain with &&.
step() {
  local name=$1 log=build/log/$1.log start=$EPOCHREALTIME status=0
  shift
  mkdir -p build/log
  [[ $quiet ]] || printf '%-9s ' "$name"
  "$@" >"$log" 2>&1 </dev/null || status=$?
  if ((status == 0)); then
    say "done in $(seconds_since "$start")"
    return
  fi
  say "FAILED after $(seconds_since "$start")"
  { tail -n 200 "$log" && echo "$name failed with status $status; all of its output: $log"; } >&2
  return "$status"
}

# as_root COMMAND…: directly as root, through sudo where it asks nothing or there is somebody to
# ask; else status 2.
as_root() {
  if ((EUID == 0)); then
    "$@"
  elif can_sudo; then
    sudo -- "$@"
  else
    echo "root is needed for: $*" >&2
    return 2
  fi
}

can_sudo() { command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [[ -t 2 ]]; }; }
