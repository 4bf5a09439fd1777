# Completion of stadion's commands, options and values in fish. The program itself knows them.
function __stadion_complete
    set -l words (commandline -opc) (commandline -ct)
    set -l answers ($words[1] complete $words[2..-1] 2>/dev/null)
    # The answers to --option=VALUE are values; fish completes the whole word.
    set -l typed (commandline -ct)
    set -l option (string match -r -- '^--[^=]*=' $typed)
    set -l value (string replace -r -- '^--[^=]*=' '' $typed)
    switch "$answers[1]"
        case ':files'
            for answer in $answers[2..-1] (__fish_complete_path $value)
                echo "$option$answer"
            end
        case ':folders'
            for answer in (__fish_complete_directories $value)
                echo "$option$answer"
            end
        case '*'
            for answer in $answers
                echo "$option$answer"
            end
    end
end
complete -c stadion -f -a '(__stadion_complete)'
