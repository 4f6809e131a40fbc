# Completion for weft: commands and options are asked of the program itself.

# The commands of a group ("" or "region"), as its --help lists them.
_weft_commands() {
    weft "$@" --help 2>/dev/null | sed -n '/^Commands:/,/^$/p' | grep -oE '^  [a-z]+' | tr -d ' '
}

_weft() {
    local current=${COMP_WORDS[COMP_CWORD]} command=() known word
    known=$(_weft_commands)
    # Only words that are commands lead on; a folder of the same name beside them does not count.
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        [[ $'\n'$known$'\n' == *$'\n'"$word"$'\n'* ]] || break
        command+=("$word")
        known=$(_weft_commands "${command[@]}")
        [[ $known ]] || break
    done
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(weft "${command[@]}" --help 2>/dev/null |
            sed -n '/^Options:/,/^$/p' | grep -oE '^  (-[a-z],)?(--[a-z][a-z-]*,?)+' | grep -oE -- '--[a-z][a-z-]*' | sort -u)" -- "$current")
    elif [[ $known && ${#command[@]} -eq $((COMP_CWORD - 1)) ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$known" -- "$current")
    fi
}
complete -o default -F _weft weft
