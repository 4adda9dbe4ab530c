# Completion of `hypofab` in fish, as hypofab.bash has it: commands, options, presets and sands as the program itself lists
# them, else files. Installed for everyone by cmake --install; by hand: source cli/completion/hypofab.fish

function __hypofab_words
    set -l words (commandline -opc)
    set -l program $words[1]
    set -l command $words[2]
    if test (count $words) -eq 1
        $program --help 2>/dev/null | string replace -rf '^  ([a-z][a-z-]*) +(.*)' '$1\t$2'
    else if string match -q -- '-*' (commandline -ct)
        $program $command --help 2>/dev/null | string match -ra -- '--[A-Za-z0-9-]+' | sort -u
    else if test "$words[-1]" = --sand; or test "$command" = materials
        $program materials 2>/dev/null | string replace -rf '^([^ ]+) .*' '$1'
    else if test "$command" = init
        $program presets 2>/dev/null | string match -r '^[a-z][^ ]*'
    end
end

# Files only behind a command.
complete -c hypofab -n 'test (count (commandline -opc)) -eq 1' -f
complete -c hypofab -a '(__hypofab_words)'
