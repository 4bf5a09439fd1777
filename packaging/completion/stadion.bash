# Completion of stadion's commands, options and values in bash. The program itself knows them.
_stadion() {
  local IFS=$'\n' current=${COMP_WORDS[COMP_CWORD]} answers
  mapfile -t answers < <("${COMP_WORDS[0]}" complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  # bash makes words of --option=VALUE at the sign, and replaces only what follows it.
  [[ $current != = ]] || current=
  case ${answers[0]} in
    :files) compopt -o filenames; mapfile -t COMPREPLY < <(printf '%s\n' "${answers[@]:1}"; compgen -f -- "$current") ;;
    :folders) compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
    *) COMPREPLY=("${answers[@]}") ;;
  esac
  [[ -n ${COMPREPLY[0]} ]] || COMPREPLY=("${COMPREPLY[@]:1}")
}
complete -F _stadion stadion
