# Completion of speculum in bash: source this file, or install the program. Options and settings come from --help.

# Long options of a command, or of the program itself; `$1` is the program.
_speculum_options() {
  "$1" $2 --help 2>/dev/null | sed -n 's/^  \(-[a-z],\)\?\(--[a-z-]*\).*/\2/p'
}

_speculum_settings() {
  "$1" --help 2>/dev/null | sed -n '/^Settings/,/^$/s/^  \([^ ]*\).*/\1/p'
}

# Offers the words of `$2` that begin with `$1`.
_speculum_words() {
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$2" -- "$1")
}

# Offers what begins with `$1`: folders, and files with one of the other arguments at their end. bash then escapes
# blanks, and ends a folder in a slash.
_speculum_files() {
  local word=$1 ending
  shift
  compopt -o filenames 2>/dev/null
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(
    { compgen -d -- "$word"; for ending in "${@:-}"; do compgen -f -X "!*$ending" -- "$word"; done; } | sort -u)
}

_speculum() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local commands="demo render reference compare accuracy regress bench info scenes" command=""
  local scenes=(.toml .obj .gltf .glb)
  [[ " $commands " == *" ${COMP_WORDS[1]} "* ]] && [ "$COMP_CWORD" -gt 1 ] && command=${COMP_WORDS[1]}
  COMPREPLY=()
  case $before in
    --scene)
      _speculum_words "$word" "$("$program" scenes 2>/dev/null | sed -n 's/^\([^ ]*\) .*/\1/p')"
      _speculum_files "$word" "${scenes[@]}"
      ;;
    --set)
      mapfile -t COMPREPLY < <(compgen -W "$(_speculum_settings "$program")" -S = -- "$word")
      compopt -o nospace 2>/dev/null
      ;;
    --render-path) _speculum_words "$word" "auto dynamic renderpass" ;;
    --present-mode) _speculum_words "$word" "fifo mailbox immediate" ;;
    --platform) _speculum_words "$word" "x11 wayland" ;;
    --log-level) _speculum_words "$word" "trace debug info warn error off" ;;
    --sweep) _speculum_words "$word" "quick full motion" && _speculum_files "$word" .toml ;;
    --motion) _speculum_words "$word" "scene" && _speculum_files "$word" .toml ;;
    --shader-dir) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    --size | --time | --camera | --frames | --fps | --samples | --warmup | --gpu | --max-flip | --max-diff | --filter | --jobs | --repeat) ;;
    --out | --stats | --json | --mask | --heatmap | --sweep-results | --junit | --capture) _speculum_files "$word" ;;
    *)
      if [[ $word == -* ]]; then
        _speculum_words "$word" "$(_speculum_options "$program" "$command")"
      elif [ "$COMP_CWORD" -eq 1 ]; then
        _speculum_words "$word" "$commands"
        [ -z "$word" ] || _speculum_files "$word" "${scenes[@]}"
      elif [ "$COMP_CWORD" -eq 2 ] && [ "$command" = demo ]; then
        _speculum_files "$word" "${scenes[@]}"
      elif [ "$command" = compare ]; then
        _speculum_files "$word"
      elif [ "$command" = regress ]; then
        _speculum_files "$word" .toml
      fi
      ;;
  esac
}

complete -F _speculum speculum
