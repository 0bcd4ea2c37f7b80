# Completion of speculum in bash: source this file, or install the program. tests/completion.cpp holds its lists against
# the program's own.

_speculum_options() {
  local common="--set --gpu --render-path --validation --log-level --shader-dir --help"
  case $1 in
    "" | demo)
      echo "--scene --size --frames --sweep-results --present-mode $common"
      [ -n "$1" ] || echo "--version"
      ;;
    render) echo "--scene --size --time --camera --out --sweep-results --stats --frames --fps $common" ;;
    reference) echo "--scene --size --time --camera --out --samples $common" ;;
    compare) echo "--mask --heatmap --json --max-flip --max-diff $common" ;;
    accuracy) echo "--scene --size --time --out --sweep $common" ;;
    bench) echo "--scene --size --time --camera --frames --warmup --json --sweep-results --prices --reference $common" ;;
    info | scenes) echo "$common" ;;
  esac
}

_speculum_settings() {
  echo "reflection.scale reflection.samples reflection.max_depth reflection.min_pixels reflection.min_throughput
    reflection.max_passes reflection.update_interval reflection.skip_unchanged reflection.mesh_error
    reflection.clip view.samples view.exposure view.tone_map
    view.clear_color view.texture_filter view.wireframe view.continuous effects.shadows effects.roughness
    effects.rough_samples effects.rough_lookup effects.per_sample effects.ripple effects.casts_light effects.curved
    effects.curved_lookup effects.environment_size effects.environment_interval effects.environment_box effects.fresnel
    effects.textures effects.glyphs quality.budget_ms quality.max_error
    debug.omit_barrier debug.check_finite debug.skip_hidden debug.cull_clusters debug.mask_passes"
}

_speculum() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local commands="demo render reference compare accuracy bench info scenes" command="" scenes
  [[ " $commands " == *" ${COMP_WORDS[1]} "* ]] && [ "$COMP_CWORD" -gt 1 ] && command=${COMP_WORDS[1]}
  COMPREPLY=()
  case $before in
    --scene)
      scenes=$("${COMP_WORDS[0]}" scenes 2>/dev/null | sed -n 's/^\([^ ]*\) .*/\1/p')
      mapfile -t COMPREPLY < <(compgen -W "$scenes" -- "$word"; compgen -f -X '!*.toml' -- "$word"; compgen -f -X '!*.obj' -- "$word"
        compgen -d -- "$word")
      return
      ;;
    --set)
      mapfile -t COMPREPLY < <(compgen -W "$(_speculum_settings)" -S = -- "$word")
      compopt -o nospace 2>/dev/null
      return
      ;;
    --render-path) mapfile -t COMPREPLY < <(compgen -W "auto dynamic renderpass" -- "$word") && return ;;
    --present-mode) mapfile -t COMPREPLY < <(compgen -W "fifo mailbox immediate" -- "$word") && return ;;
    --log-level) mapfile -t COMPREPLY < <(compgen -W "trace debug info warn error off" -- "$word") && return ;;
    --sweep) mapfile -t COMPREPLY < <(compgen -W "quick full" -- "$word"; compgen -f -X '!*.toml' -- "$word") && return ;;
    --shader-dir) mapfile -t COMPREPLY < <(compgen -d -- "$word") && return ;;
    --size | --time | --camera | --frames | --fps | --samples | --warmup | --gpu | --max-flip | --max-diff) return ;;
    --out | --stats | --json | --mask | --heatmap | --sweep-results)
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return
      ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_speculum_options "$command")" -- "$word")
  elif [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  elif [ "$command" = compare ]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}

complete -F _speculum speculum
