# Completion of stadion's commands, options and values in fish. The program itself knows them.
function __stadion_complete
    set -l words (commandline -opc) (commandline -ct)
    set -l answers ($words[1] complete $words[2..-1] 2>/dev/null)
    switch "$answers[1]"
        case ':files'
            __fish_complete_path (commandline -ct)
        case ':folders'
            __fish_complete_directories (commandline -ct)
        case '*'
            printf '%s\n' $answers
    end
end
complete -c stadion -f -a '(__stadion_complete)'
