# Completion for bash. It asks the program itself: 'sightline COMMAND --help words' lists the options.
_sightline() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} program=${COMP_WORDS[0]}
    local command=${COMP_WORDS[1]} names
    if [ "$COMP_CWORD" -eq 1 ]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$program" --help words 2>/dev/null | cut -f1) help" -- "$word")
        return
    fi
    names=$("$program" "$command" --help words 2>/dev/null |
        awk -F'\t' -v option="$before" '$1 == option {print $3}')
    if [ -n "$names" ]; then
        mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
        return
    fi
    case $word in
    -*) mapfile -t COMPREPLY < <(compgen -W "$("$program" "$command" --help words 2>/dev/null | cut -f1)" -- "$word") ;;
    *) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    esac
}
complete -o filenames -F _sightline sightline
