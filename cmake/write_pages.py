#!/usr/bin/env python3
"""usage: write_pages.py PROGRAM FOLDER [--date YYYY-MM-DD]

Asks PROGRAM, and every command that it names, for --help, and writes to FOLDER from nothing else:

  man1/PROGRAM.1, man1/PROGRAM-COMMAND.1   manual pages
  bash/PROGRAM, zsh/_PROGRAM               completion of commands, options and their choices

Help that does not have the form that is expected of it is an error, not a page with holes. The date
of the pages is that of --date or of SOURCE_DATE_EPOCH, else they have none: the same program makes
the same pages.
"""
import argparse
import datetime
import os
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap
from dataclasses import dataclass, field

COLUMN = 34  # where descriptions begin in the help
HEADINGS = {"Positionals:", "Options:", "Subcommands:"}


@dataclass
class Entry:
    """An option, a positional or a command, with what the help says of it."""

    names: list  # of an option: each with its dashes
    value: str  # what stands behind the names
    text: str

    @property
    def word(self):
        """What a value is called: TEXT, PATH, N; empty for a flag."""
        word = re.split(r"[\s:={\[]", self.value.strip(), maxsplit=1)[0]
        return "" if word in {"REQUIRED", "Excludes", "Needs", "..."} else word

    @property
    def choices(self):
        """The values that the help lists, as {a,b} behind a colon, or as a|b."""
        braces = re.search(r":\{([^}]*)\}", self.value)
        if braces:
            return braces.group(1).split(",")
        bars = re.match(r"\s*([\w.+-]+(?:\|[\w.+-]+)+)", self.value)
        return bars.group(1).split("|") if bars else []

    @property
    def takes_value(self):
        """Whether the next word is the option's: {zero} names the value of an option without one."""
        return bool(self.word) and not self.value.startswith("{")

    @property
    def may_repeat(self):
        return "..." in self.value


@dataclass
class Command:
    """A command by the words that call it, and its help, taken apart."""

    words: list
    summary: str = ""
    usage: str = ""
    positionals: list = field(default_factory=list)
    options: list = field(default_factory=list)
    commands: list = field(default_factory=list)
    footer: list = field(default_factory=list)
    children: list = field(default_factory=list)

    @property
    def page(self):
        return "-".join(self.words)


def run(program, words):
    done = subprocess.run([program, *words], capture_output=True, encoding="utf-8", check=False,
                          env={**os.environ, "LC_ALL": "C.UTF-8"})
    if done.returncode != 0:
        sys.exit(f"{program} {' '.join(words)}: status {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def entry_of(line, following, where):
    """An entry's line, with the lines that go on with its description."""
    if following or len(line) <= COLUMN:
        left, right = (line, "") if len(line) > COLUMN and line[COLUMN - 1] != " " else (
            line[:COLUMN], line[COLUMN:])
    elif line[COLUMN - 1] != " ":
        sys.exit(f"{where}: no description: {line.strip()}")
    else:
        left, right = line[:COLUMN], line[COLUMN:]
    text = " ".join(part.strip() for part in [right, *following] if part.strip())
    if not text:
        sys.exit(f"{where}: no description: {line.strip()}")
    names = re.match(r"\s*((?:-[\w-]+)(?:,-[\w-]+)*|[\w-]+)(.*)$", left.rstrip())
    if not names:
        sys.exit(f"{where}: not an entry of a help text: {line.strip()}")
    return Entry(names.group(1).split(","), names.group(2).strip(), text)


def parse(program, words):
    """The command that these words call, and those below it."""
    command = Command([pathlib.Path(program).name, *words])
    where = f"{command.page} --help"
    lines = run(program, [*words, "--help"]).rstrip().split("\n")
    if len(lines) < 3 or not lines[1].startswith("Usage: "):
        sys.exit(f"{where}: expected a summary and a line that begins with 'Usage: '")
    command.summary, command.usage = lines[0].strip(), lines[1][len("Usage: "):].strip()
    lists = {"Positionals:": command.positionals, "Options:": command.options,
             "Subcommands:": command.commands}
    current, at = None, 2
    while at < len(lines):
        line = lines[at]
        at += 1
        if line in HEADINGS:
            current = lists[line]
        elif re.match(r" {2}\S", line) and current is not None:
            following = []
            while at < len(lines) and lines[at].startswith(" " * COLUMN):
                following.append(lines[at])
                at += 1
            current.append(entry_of(line, following, where))
        elif line and not line.startswith(" "):
            command.footer = lines[at - 1:]
            break
        elif line:
            sys.exit(f"{where}: neither a heading nor an entry: {line}")
    if not command.options:
        sys.exit(f"{where}: no options")
    command.children = [parse(program, [*words, entry.names[0]]) for entry in command.commands]
    return command


def all_commands(command):
    yield command
    for child in command.children:
        yield from all_commands(child)


# Manual pages.

def roff(text):
    """Text in which nothing is a request or an escape."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga")
    text = text.replace("^", "\\(ha").replace("~", "\\(ti")
    text = "".join(c if ord(c) < 128 else f"\\[u{ord(c):04X}]" for c in text)
    return "\\&" + text if text.startswith(".") else text


def prose(text):
    """A paragraph, in lines of the source that are not long."""
    return "\n".join(roff(line) for line in textwrap.wrap(text, 70, break_long_words=False,
                                                         break_on_hyphens=False))


def item(entry):
    names = ", ".join(f"\\fB{roff(name)}\\fR" for name in entry.names)
    value = entry.value
    space = "" if not value or value[0] in "{[:=" else " "
    return f".TP\n{names}{space}{roff(value)}\n{prose(entry.text)}\n"


def manual_page(command, version, date):
    name = command.page
    parts = [f'.TH {roff(name.upper())} 1 "{date}" "{roff(version)}" "User Commands"\n',
             f".SH NAME\n{roff(name)} \\- {roff(command.summary.rstrip('.'))}\n"]
    called = len(command.words)
    words = command.usage.split()
    parts.append(f".SH SYNOPSIS\n\\fB{roff(' '.join(words[:called]))}\\fR "
                 f"{roff(' '.join(words[called:]))}\n")
    for heading, entries in (("ARGUMENTS", command.positionals), ("OPTIONS", command.options),
                             ("COMMANDS", command.commands)):
        if entries:
            parts.append(f".SH {heading}\n" + "".join(item(entry) for entry in entries))
    if command.footer:
        body = "\n".join(line.strip() for line in command.footer).strip()
        paragraphs = [prose(re.sub(r"\s+", " ", text)) for text in re.split(r"\n\s*\n", body)]
        parts.append(".SH NOTES\n" + "\n.PP\n".join(paragraphs) + "\n")
    related = [child.page for child in command.children]
    if called > 1:
        related.append("-".join(command.words[:-1]))
    if related:
        references = [f".BR {roff(page)} (1)" for page in sorted(related)]
        parts.append(".SH SEE ALSO\n" + " ,\n".join(references) + "\n")
    return "".join(parts)


# Completion.

def is_file(entry):
    return entry.word == "PATH" or (not entry.names[0].startswith("-") and not entry.choices and
                                    entry.names[0] in {"MAP", "DUMP", "RESULT", "DIR"}) or \
        entry.names[0] == "--map"


def positional_choices(command):
    return [choice for entry in command.positionals for choice in
            (entry.choices or ([] if "|" not in entry.value else entry.value.split()[0].split("|")))]


def options_of(command):
    return [name for option in command.options for name in option.names]


def bash_completion(root):
    program = root.words[0]
    function = "_" + re.sub(r"\W", "_", program)
    lines = [f"# Completion of {program} for bash; written from the program's own help.",
             f"{function}() {{", "  local word=${COMP_WORDS[COMP_CWORD]} called= at=1 next",
             "  COMPREPLY=()",
             "  # The command: the leading words that name one.",
             "  while ((at < COMP_CWORD)); do", "    next=\"$called ${COMP_WORDS[at]}\"",
             "    case $next in"]
    below = [c for c in all_commands(root) if len(c.words) > 1]
    patterns = " | ".join(f"' {' '.join(c.words[1:])}'" for c in below)
    lines += [f"      {patterns}) called=$next ;;", "      *) break ;;", "    esac",
              "    ((at++))", "  done", "  local before=${COMP_WORDS[COMP_CWORD - 1]}",
              "  # bash takes --option=value for three words.", "  local joined=",
              "  if [[ $word == = ]]; then", "    word= joined=1",
              "  elif [[ $before == = ]]; then",
              "    before=${COMP_WORDS[COMP_CWORD - 2]} joined=1", "  fi",
              "  case \"$called $before\" in"]
    for command in all_commands(root):
        called = "".join(" " + word for word in command.words[1:])
        for option in command.options:
            cases = " | ".join(f"'{called} {name}'" for name in option.names)
            if option.choices:
                lines += [f"    {cases})"]
                # The value of an option that needs none stands behind a sign of equality.
                lines += [] if option.takes_value else ["      if [[ $joined ]]; then"]
                lines += [f"      mapfile -t COMPREPLY < <(compgen -W '{' '.join(option.choices)}'"
                          " -- \"$word\")", "      return"]
                lines += [] if option.takes_value else ["      fi"]
                lines += ["      ;;"]
            elif is_file(option):
                lines += [f"    {cases})", "      mapfile -t COMPREPLY < <(compgen -f -- \"$word\")",
                          "      compopt -o filenames 2>/dev/null", "      return", "      ;;"]
            elif option.takes_value:
                lines += [f"    {cases}) return ;;"]
    lines += ["  esac", "  local words= files=", "  case $called in"]
    for command in all_commands(root):
        called = "".join(" " + word for word in command.words[1:])
        words = [entry.names[0] for entry in command.commands] + positional_choices(command)
        files = "1" if any(is_file(entry) for entry in command.positionals) else ""
        lines += [f"    '{called}')", "      if [[ $word == -* ]]; then",
                  f"        words='{' '.join(options_of(command))}'", "      else",
                  f"        words='{' '.join(words)}' files={files}", "      fi", "      ;;"]
    lines += ["  esac", "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")",
              "  if [[ $files ]]; then", "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")",
              "    compopt -o filenames 2>/dev/null", "  fi", "}",
              f"complete -F {function} {program}", ""]
    return "\n".join(lines)


def zsh_text(text):
    """Inside of single quotes, as the description of a specification."""
    text = re.sub(r"([\[\]:\\])", r"\\\1", text)
    return text.replace("'", "'\\''")


def zsh_action(entry):
    if entry.choices:
        return f"({' '.join(entry.choices)})"
    return "_files" if is_file(entry) else " "


def zsh_specifications(command):
    for option in command.options:
        repeat = "*" if option.may_repeat else ""
        others = "" if repeat or len(option.names) == 1 else f"({' '.join(option.names)})"
        for name in option.names:
            value = ""
            if option.takes_value:
                equals = "=" if name.startswith("--") else "+"
                value = f":{zsh_text(option.word.lower())}:{zsh_action(option)}"
            elif option.choices:
                equals, value = "=-", f"::value:{zsh_action(option)}"
            else:
                equals = ""
            yield f"'{others}{repeat}{name}{equals}[{zsh_text(option.text)}]{value}'"
    for at, entry in enumerate(command.positionals, start=1):
        choices = entry.choices or ([] if "|" not in entry.value else
                                    entry.value.split()[0].split("|"))
        action = f"({' '.join(choices)})" if choices else zsh_action(entry)
        where = "*" if entry.may_repeat else str(at)
        yield f"'{where}:{zsh_text(entry.names[0])}:{action}'"


def zsh_function(command):
    name = "_" + re.sub(r"\W", "_", "_".join(command.words))
    lines = [f"{name}() {{"]
    specifications = list(zsh_specifications(command))
    if command.commands:
        lines.append("  local curcontext=$curcontext state line")
        specifications += ["'1:command:->command'", "'*::argument:->argument'"]
        lines.append("  _arguments -C \\\n    " + " \\\n    ".join(specifications))
        lines += ["  case $state in", "    command)", "      local -a commands=("]
        lines += [f"        '{entry.names[0]}:{zsh_text(entry.text)}'" for entry in command.commands]
        lines += ["      )", "      _describe command commands", "      ;;", "    argument)",
                  "      case $line[1] in"]
        lines += [f"        {child.words[-1]}) {name}_{re.sub(r'[^0-9A-Za-z]', '_', child.words[-1])} ;;"
                  for child in command.children]
        lines += ["      esac", "      ;;", "  esac"]
    else:
        lines.append("  _arguments \\\n    " + " \\\n    ".join(specifications))
    return "\n".join([*lines, "}", ""])


def zsh_completion(root):
    program = root.words[0]
    function = "_" + re.sub(r"\W", "_", program)
    return "\n".join([f"#compdef {program}",
                      f"# Completion of {program} for zsh; written from the program's own help.", "",
                      *(zsh_function(command) for command in all_commands(root)),
                      f'{function} "$@"', ""])


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--date", default="")
    arguments = parser.parse_args()
    epoch = os.environ.get("SOURCE_DATE_EPOCH")
    if epoch and not arguments.date:
        arguments.date = datetime.datetime.fromtimestamp(
            int(epoch), datetime.timezone.utc).strftime("%Y-%m-%d")
    version = run(arguments.program, ["--version"]).strip()
    root = parse(arguments.program, [])
    name = root.words[0]
    pages = {f"man1/{command.page}.1": manual_page(command, version, arguments.date)
             for command in all_commands(root)}
    pages[f"bash/{name}"] = bash_completion(root)
    pages[f"zsh/_{name}"] = zsh_completion(root)
    # No page of a command that is gone.
    for folder in ("man1", "bash", "zsh"):
        shutil.rmtree(arguments.folder / folder, ignore_errors=True)
    for path, text in pages.items():
        file = arguments.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


main()
