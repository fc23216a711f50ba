#!/usr/bin/env python3
"""The man page and the bash completion of camber, made from what its --help prints.

    tools/make_man.py build/release/apps/camber/camber FOLDER     # FOLDER/camber.1, FOLDER/camber.bash
"""
import pathlib
import re
import subprocess
import sys

CHOICES = re.compile(r":\{([^}]*)\}")


def help_of(binary, *verb):
    done = subprocess.run([binary, *verb, "--help"], capture_output=True, text=True, check=True)
    return done.stdout


def entries(text, section):
    """(name, description) of the lines of one section; continued lines are joined."""
    found, inside = [], False
    for line in text.splitlines():
        if not line.startswith(" "):
            inside = line.rstrip(":") == section
            continue
        if not inside:
            continue
        if line.startswith("   ") and found:
            found[-1][1] += (" " if found[-1][1] else "") + line.strip()
            continue
        head, *rest = re.split(r"  +", line.strip(), maxsplit=1)
        found.append([head, rest[0] if rest else ""])
    return found


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def version_of(binary):
    return subprocess.run([binary, "--version"], capture_output=True, text=True,
                          check=True).stdout.split()[-1]


def man_page(binary, version):
    top = help_of(binary)
    verbs = entries(top, "Subcommands")
    intro = top.split("Usage:")[0].split("Exit codes:")
    out = [f'.TH CAMBER 1 "" "camber {version}" "User Commands"', ".SH NAME",
           "camber \\- " + escaped(intro[0].strip().split(":")[0][0].lower() +
                                   intro[0].strip().split(":")[0][1:]),
           ".SH SYNOPSIS", ".B camber", ".I VERB", "[options]", ".SH DESCRIPTION",
           escaped(intro[0].strip())]
    for verb, what in verbs:
        text = help_of(binary, verb)
        out += [f".SH CAMBER {verb.upper()}", escaped(what[0].upper() + what[1:] + "."), ".PP",
                f".B camber {verb}"]
        for section in ("Positionals", "Options"):
            for head, description in entries(text, section):
                out += [".TP", ".B " + escaped(head), escaped(description)]
    out += [".SH EXIT STATUS"]
    for code, meaning in re.findall(r"(\d+) ([^,.]+(?:,\s*not watertight or not on the CAD)?)",
                                    " ".join(intro[1].split())):
        out += [".TP", f".B {code}", escaped(meaning.strip())]
    out += [".SH SEE ALSO", escaped("The documentation that is installed beside this page, "
                                    "/usr/share/doc/camber, begins with README.md and "
                                    "docs/tutorial.md.")]
    return "\n".join(out) + "\n"


def completion(binary):
    verbs = [verb for verb, _ in entries(help_of(binary), "Subcommands")]
    lines = ["# bash completion for camber; made by tools/make_man.py from camber --help",
             "_camber() {", '  local word="${COMP_WORDS[COMP_CWORD]}" '
             'before="${COMP_WORDS[COMP_CWORD-1]}" verb="${COMP_WORDS[1]}"',
             "  COMPREPLY=()", "  if [ \"$COMP_CWORD\" -eq 1 ]; then",
             f"    COMPREPLY=($(compgen -W \"{' '.join(verbs)} --help --version\" -- \"$word\"))",
             "    return", "  fi", '  case "$verb" in']
    for verb in verbs:
        flags, choices = [], []
        for head, _ in entries(help_of(binary, verb), "Options"):
            names = head.split(" ")[0].split(",")
            flags += names
            listed = CHOICES.search(head)
            if listed:
                choices.append((names, listed.group(1).replace(",", " ")))
        lines += [f"    {verb})", '      case "$before" in']
        for names, values in choices:
            lines += [f"        {'|'.join(names)}) COMPREPLY=($(compgen -W \"{values}\" -- "
                      "\"$word\")); return ;;"]
        lines += ["        *) ;;", "      esac", '      if [[ "$word" == -* ]]; then',
                  f"        COMPREPLY=($(compgen -W \"{' '.join(flags)}\" -- \"$word\"))",
                  "      fi ;;"]
    lines += ["    *) ;;", "  esac", "  return 0", "}",
              "complete -o default -F _camber camber"]
    return "\n".join(lines) + "\n"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    binary, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "camber.1").write_text(man_page(binary, version_of(binary)))
    (folder / "camber.bash").write_text(completion(binary))


if __name__ == "__main__":
    main()
