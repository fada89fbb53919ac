# Measuring two programs against each other, for ci/perf and ci/perf-self-test, which source it
# after ci/lib.sh. They set:
#   base_command head_command   arrays: program and arguments
#   base_commit head_commit     names of the two in the history
#   database                    the history
#   folder                      for results
#   processes                   of each program in a session
#   least_time                  seconds of each benchmark in a process
# shellcheck shell=bash disable=SC2154

lightproof=build/release/lightproof

# run_once SIDE NUMBER FILTER: one process of base or head.
run_once() {
  local -n command=$1_command
  "${command[@]}" --benchmark_filter="$3" --benchmark_min_time="$least_time" \
    --benchmark_out="$folder/$1-$2.json" --benchmark_out_format=json >"$folder/log" 2>&1 ||
    { cat "$folder/log" >&2 && return 1; }
}

# add_session SESSION: the results that lie in the folder, each in the name of its side's commit. A
# side may have none.
add_session() {
  local side commit files
  for side in base head; do
    commit=${side}_commit
    files=("$folder/$side"-*.json)
    [[ -f ${files[0]} ]] || continue
    "$lightproof" history add -q --db "$database" --session "$1" --commit "${!commit}" \
      "${files[@]}" || return
  done
}

# measure_session SESSION FILTER: base and head in turns, first the one, then the other (ABBA), so
# that a drift of the machine falls on both alike.
measure_session() {
  local i sides
  rm -f "$folder"/{base,head}-*.json
  for ((i = 0; i < processes; ++i)); do
    ((i % 2)) && sides="head base" || sides="base head"
    for side in $sides; do run_once "$side" "$i" "$2" || return; done
  done
  node ci/perf.mjs adopt "$folder/head-0.json" "$folder"/base-*.json && add_session "$1"
}

# count_session SESSION REGEX: instructions of both, where they have benchmarks count/….
count_session() {
  rm -f "$folder"/{base,head}-*.json
  node ci/perf.mjs count "$folder/head-0.json" "$2" "${head_command[@]}" &&
    node ci/perf.mjs count "$folder/base-0.json" "$2" "${base_command[@]}" || return
  if [[ -f $folder/head-0.json && -f $folder/base-0.json ]]; then
    node ci/perf.mjs adopt "$folder/head-0.json" "$folder/base-0.json" || return
  fi
  add_session "$1"
}

# error_session SESSION: errors of both, where they have benchmarks error/…: one process of each, since
# they depend on seeds alone.
error_session() {
  local side
  rm -f "$folder"/{base,head}-*.json
  for side in base head; do
    local -n command=${side}_command
    "${command[@]}" --benchmark_list_tests 2>/dev/null | grep -q '^error/' || continue
    run_once "$side" 0 '^error/' || return
  done
  if [[ -f $folder/head-0.json && -f $folder/base-0.json ]]; then
    node ci/perf.mjs adopt "$folder/head-0.json" "$folder/base-0.json" || return
  fi
  add_session "$1"
}

# exactly NAMES…: a filter of Google Benchmark that fits these names and no other.
exactly() {
  local names
  names=$(printf '%s\n' "$@" | sed 's/[][\.*^$+?(){}|]/\\&/g' | paste -sd '|')
  printf '^(%s)$' "$names"
}

# compare_commits WORDS…: `history compare` of both, with these options; its status.
compare_commits() {
  "$lightproof" history compare "$base_commit" "$head_commit" --db "$database" "$@"
}

# confirm SESSION: measures again what is suspected, if anything is.
confirm() {
  local suspects status=0
  compare_commits -q --json "$folder/compare.json" || status=$?
  ((status < 2)) || return "$status"
  mapfile -t suspects < <(node ci/perf.mjs suspects "$folder/compare.json")
  ((${#suspects[@]})) || return 0
  say "suspected, measured again: ${suspects[*]}"
  measure_session "$1" "$(exactly "${suspects[@]}")"
}
