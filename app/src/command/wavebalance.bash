# Completion of bash for wavebalance. Commands, options and keys come from the program itself.

# The commands, and the options of one of them.
_wavebalance_commands() { "$1" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'; }
_wavebalance_options() { "$1" "$2" --help | sed -n '/^Options:/,$p' | grep -oE -- '--[a-z]+(-[a-z]+)*' | sort -u; }

# section.key, followed by $3, or for "section.key=" the texts that the key may be.
_wavebalance_keys() {
  local key=${2%%=*}
  case $2 in
    *=*) "$1" keys --names | awk -v key="$key" '$1 == key { for (i = 2; i <= NF; ++i) print key "=" $i }' ;;
    *) "$1" keys --names | awk -v after="${3-}" '{ print $1 after }' ;;
  esac
}

# What a filter of `wavebalance keys` may be, less choices.
_wavebalance_filters() { "$1" keys --names | awk '{ split($1, part, "."); print part[1]; print $1 }' | sort -u; }

# The words of $1 that begin with $2; folders, and with "scenes" files that end in .toml.
_wavebalance_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$2"); }
_wavebalance_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$2"; [ "$1" = folders ] || compgen -f -X '!*.toml' -- "$2")
}

_wavebalance() {
  local program=$1 command=${COMP_WORDS[1]-} line=${COMP_LINE:0:COMP_POINT} word typed
  word=${line##*[[:space:]]}  # bash breaks words at "=" too
  IFS=$' \t' read -r -a typed <<< "${line%"$word"}"
  COMPREPLY=()
  if [ "${#typed[@]}" -le 1 ]; then
    _wavebalance_words "$(_wavebalance_commands "$program") --help --version" "$word"
    return
  fi
  case $command:${typed[-1]}:$word in
    *:--set:*) compopt -o nospace 2>/dev/null; _wavebalance_words "$(_wavebalance_keys "$program" "$word" =)" "$word" ;;
    *:--unset:*) _wavebalance_words "$(_wavebalance_keys "$program" "$word")" "$word" ;;
    init:--output:* | init:-o:*) _wavebalance_files scenes "$word" ;;
    *:--output:* | *:-o:* | *:--start-from:*) _wavebalance_files folders "$word" ;;
    *:*:-*) _wavebalance_words "$(_wavebalance_options "$program" "$command")" "$word" ;;
    keys:*) _wavebalance_words "$(_wavebalance_filters "$program")" "$word" ;;
    init:*) _wavebalance_words "bar matrices blade study" "$word" ;;
    overlay:*) _wavebalance_files folders "$word" ;;
    convert:*) compopt -o default 2>/dev/null ;;
    *) _wavebalance_files scenes "$word" ;;
  esac
  case $word in *=*) COMPREPLY=("${COMPREPLY[@]#"${word%%=*}="}") ;; esac  # bash replaces what follows the last "="
}

complete -F _wavebalance wavebalance
