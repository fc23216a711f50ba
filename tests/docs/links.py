#!/usr/bin/python3
"""Every relative link of every Markdown page must lead to a file, and to a heading where it names one.

usage: links.py SOURCE_DIR     prints one line a dead link; exit code 1 if there is any.
"""
import pathlib
import re
import sys

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)|(?:src|href)=\"([^\"]+)\"")
HEADING = re.compile(r"^#+\s+(.*?)\s*#*$", re.MULTILINE)
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.MULTILINE | re.DOTALL)
SKIPPED = {"build", "out", ".git"}


def anchors(text):
    """Heading anchors as forges make them: lower case, no punctuation, dashes for spaces."""
    plain = [re.sub(r"[`*]", "", heading) for heading in HEADING.findall(text)]
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in plain}


def dead_links(root):
    pages = [p for p in sorted(root.rglob("*.md")) if not SKIPPED & set(p.relative_to(root).parts)]
    for page in pages:
        text = page.read_text()
        for groups in LINK.findall(CODE.sub("", text)):
            link = groups[0] or groups[1]
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = page if not path else page.parent / path
            if not target.exists():
                yield f"{page.relative_to(root)}: {link}: no such file"
            elif anchor and target.suffix == ".md" and anchor not in anchors(target.read_text()):
                yield f"{page.relative_to(root)}: {link}: no such heading"


def main():
    dead = list(dead_links(pathlib.Path(sys.argv[1])))
    print("\n".join(dead) or "every link resolves")
    return 1 if dead else 0


if __name__ == "__main__":
    sys.exit(main())
