# Completion for weft: commands and options are asked of the program itself.
_weft() {
    local current=${COMP_WORDS[COMP_CWORD]} words=() word
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        [[ $word == -* ]] && break
        [[ -e $word ]] || words+=("$word")
    done
    if [[ $current == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(weft "${words[@]}" --help 2>/dev/null |
            grep -oE -- '--[a-z][a-z-]+' | sort -u)" -- "$current")
    elif ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W "$(weft --help 2>/dev/null |
            sed -n '/^Subcommands:/,$p' | grep -oE '^  [a-z]+' | tr -d ' ')" -- "$current")
    fi
}
complete -o default -F _weft weft
