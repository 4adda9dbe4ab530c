# Completion of `hypofab` in bash: commands, options, presets and sands as the program itself lists them, else files.
# Installed for everyone by cmake --install; by hand: source cli/completion/hypofab.bash
# shellcheck shell=bash

_hypofab() {
  local program=${COMP_WORDS[0]} command=${COMP_WORDS[1]:-} word=${COMP_WORDS[COMP_CWORD]} words=
  if ((COMP_CWORD == 1)); then
    words=$("$program" --help 2>/dev/null | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p')
  elif [[ $word == -* ]]; then
    words=$("$program" "$command" --help 2>/dev/null | grep -oE -- '--[A-Za-z0-9-]+' | sort -u)
  elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == --sand || $command == materials ]]; then
    words=$("$program" materials 2>/dev/null | sed -n 's/^\([^ ][^ ]*\) .*/\1/p')
  elif [[ $command == init ]]; then
    words=$("$program" presets 2>/dev/null | grep '^[a-z]')
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -o default -F _hypofab hypofab
