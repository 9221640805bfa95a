# Completion for fish. It asks the program itself: 'sightline COMMAND --help words' lists the options.
function __sightline_words
    set -l words (commandline -opc)
    if test (count $words) -gt 1
        sightline $words[2] --help words 2>/dev/null | awk -F'\t' '{print $1 "\t" $4}'
    else
        sightline --help words 2>/dev/null | awk -F'\t' '{print $1 "\t" $4}'
    end
end
function __sightline_names
    set -l words (commandline -opc)
    test (count $words) -gt 2; or return
    sightline $words[2] --help words 2>/dev/null | awk -F'\t' -v option=$words[-1] \
        '$1 == option {n = split($3, names, " "); for (i = 1; i <= n; i++) print names[i]}'
end
complete -c sightline -n 'test (count (commandline -opc)) -eq 1' -f -a '(__sightline_words)'
complete -c sightline -n 'string match -q -- "-*" (commandline -ct)' -f -a '(__sightline_words)'
complete -c sightline -n 'test (count (__sightline_names)) -gt 0' -f -a '(__sightline_names)'
