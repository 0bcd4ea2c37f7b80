# Completion of speculum in bash: source this file, or install the program. Options and settings come from --help.

# Long options of a command, or of the program itself; `$1` is the program.
_speculum_options() {
  "$1" $2 --help 2>/dev/null | sed -n 's/^  \(-[a-z],\)\?\(--[a-z-]*\).*/\2/p'
}

_speculum_settings() {
  "$1" --help 2>/dev/null | sed -n '/^Settings/,/^$/s/^  \([^ ]*\).*/\1/p'
}

_speculum() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} ending
  local commands="demo render reference compare accuracy regress bench info scenes" command="" scenes
  [[ " $commands " == *" ${COMP_WORDS[1]} "* ]] && [ "$COMP_CWORD" -gt 1 ] && command=${COMP_WORDS[1]}
  COMPREPLY=()
  case $before in
    --scene)
      scenes=$("${COMP_WORDS[0]}" scenes 2>/dev/null | sed -n 's/^\([^ ]*\) .*/\1/p')
      mapfile -t COMPREPLY < <(compgen -W "$scenes" -- "$word"; compgen -d -- "$word"
        for ending in toml obj gltf glb; do compgen -f -X "!*.$ending" -- "$word"; done)
      return
      ;;
    --set)
      mapfile -t COMPREPLY < <(compgen -W "$(_speculum_settings "${COMP_WORDS[0]}")" -S = -- "$word")
      compopt -o nospace 2>/dev/null
      return
      ;;
    --render-path) mapfile -t COMPREPLY < <(compgen -W "auto dynamic renderpass" -- "$word") && return ;;
    --present-mode) mapfile -t COMPREPLY < <(compgen -W "fifo mailbox immediate" -- "$word") && return ;;
    --platform) mapfile -t COMPREPLY < <(compgen -W "x11 wayland" -- "$word") && return ;;
    --log-level) mapfile -t COMPREPLY < <(compgen -W "trace debug info warn error off" -- "$word") && return ;;
    --sweep) mapfile -t COMPREPLY < <(compgen -W "quick full motion" -- "$word"; compgen -f -X '!*.toml' -- "$word") && return ;;
    --motion) mapfile -t COMPREPLY < <(compgen -W "scene" -- "$word"; compgen -f -X '!*.toml' -- "$word") && return ;;
    --shader-dir) mapfile -t COMPREPLY < <(compgen -d -- "$word") && return ;;
    --size | --time | --camera | --frames | --fps | --samples | --warmup | --gpu | --max-flip | --max-diff | --filter | --jobs | --repeat | --update) return ;;
    --out | --stats | --json | --mask | --heatmap | --sweep-results | --junit | --capture)
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return
      ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_speculum_options "${COMP_WORDS[0]}" "$command")" -- "$word")
  elif [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  elif [ "$command" = compare ]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  elif [ "$command" = regress ]; then
    mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$word"; compgen -d -- "$word")
  fi
}

complete -F _speculum speculum
