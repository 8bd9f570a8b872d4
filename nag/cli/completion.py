"""The command ``nag completion``: what a shell completes behind ``nag``.

The scripts hold the words themselves, so that completing starts no interpreter.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence

from nag.cli.running import CommandAnswer

SHELLS = ("bash", "zsh", "fish")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of ``nag completion``."""
    parser.add_argument(
        "shell",
        choices=SHELLS,
        metavar=f"{{{','.join(SHELLS)}}}",
        help='bash, zsh: eval "$(nag completion bash)"; fish: ... | source',
    )


def run(options: argparse.Namespace) -> CommandAnswer:
    """A script for a shell."""
    words = command_words()
    made = {"bash": _bash_lines, "zsh": _zsh_lines, "fish": _fish_lines}[options.shell](words)
    return CommandAnswer(made)


def command_words() -> dict[str, dict[str, tuple[str, ...]]]:
    """For each command its options, and for each of these the words that it takes, if few."""
    from nag.cli.command_line import COMMANDS, parser

    found = {}
    for name, *_ in COMMANDS:
        commands = next(a for a in parser([name])._actions if a.dest == "command")
        actions = commands.choices[name]._actions  # type: ignore[index,union-attr]
        options: dict[str, tuple[str, ...]] = {"": ()}
        for action in actions:
            choices = tuple(map(str, action.choices or ()))
            for option in action.option_strings or [""]:
                options[option] = options.get(option, ()) + choices
        found[name] = options
    return found


def _cases(words: Mapping[str, Mapping[str, Sequence[str]]]) -> list[str]:
    """The branches of a shell's ``case``: what may stand behind an option of a command."""
    lines = []
    for name, options in words.items():
        for option, choices in options.items():
            if option and choices:
                lines.append(f'    "{name} {option}") words="{" ".join(choices)}";;')
        own = " ".join(option for option in options if option)
        lines.append(f'    "{name} "*) words="{" ".join(options[""])}" options="{own}";;')
    return lines


def _bash_lines(words: Mapping[str, Mapping[str, Sequence[str]]]) -> list[str]:
    return [
        "_nag() {",
        '  local words="" options="" now="${COMP_WORDS[COMP_CWORD]}"',
        '  local last="${COMP_WORDS[COMP_CWORD-1]}"',
        '  if [ "$COMP_CWORD" -eq 1 ]; then',
        f'    words="{" ".join(words)}"',
        "  else",
        '    case "${COMP_WORDS[1]} $last" in',
        *_cases(words),
        "    esac",
        "  fi",
        # Options are for who begins one; files are for where no word is meant.
        '  [[ $now == -* ]] && words="$words $options"',
        '  COMPREPLY=($(compgen -W "$words" -- "$now"))',
        '  [ "${#COMPREPLY[@]}" -gt 0 ] || COMPREPLY=($(compgen -f -- "$now"))',
        "}",
        "complete -o filenames -F _nag nag",
    ]


def _zsh_lines(words: Mapping[str, Mapping[str, Sequence[str]]]) -> list[str]:
    return ["autoload -Uz bashcompinit && bashcompinit", *_bash_lines(words)]


def _fish_lines(words: Mapping[str, Mapping[str, Sequence[str]]]) -> list[str]:
    lines = [
        f"complete -c nag -n __fish_use_subcommand -a '{' '.join(words)}'",
    ]
    for name, options in words.items():
        seen = f"-n '__fish_seen_subcommand_from {name}'"
        for option, choices in options.items():
            taken = f" -x -a '{' '.join(choices)}'" if choices else ""
            if option.startswith("--"):
                lines.append(f"complete -c nag {seen} -l {option[2:]}{taken}")
            elif not option and choices:
                lines.append(f"complete -c nag {seen} -f -a '{' '.join(choices)}'")
    return lines
