#!/usr/bin/python3
"""Every relative link of every Markdown page must lead to a file, and to a heading where it names one;
every source that a comment or page cites, as in [karman2022], must be in docs/references.bib.

usage: links.py SOURCE_DIR     prints one line a fault; exit code 1 if there is any.
"""
import pathlib
import re
import sys

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)|(?:src|href)=\"([^\"]+)\"")
HEADING = re.compile(r"^#+\s+(.*?)\s*#*$", re.MULTILINE)
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.MULTILINE | re.DOTALL)
CITATION = re.compile(r"\[([a-z]+(?:19|20)\d\d)\]")
SKIPPED = {"build", "out", ".git", "node_modules"}


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


def unknown_citations(root):
    keys = set(re.findall(r"^@\w+\{([^,]+),", (root / "docs/references.bib").read_text(), re.MULTILINE))
    for folder, suffixes in (("src", (".hpp", ".cpp")), ("apps", (".hpp", ".cpp")), ("docs", (".md",))):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in suffixes:
                for key in sorted(set(CITATION.findall(path.read_text())) - keys):
                    yield f"{path.relative_to(root)}: [{key}] is not in docs/references.bib"


def main():
    root = pathlib.Path(sys.argv[1])
    faults = [*dead_links(root), *unknown_citations(root)]
    print("\n".join(faults) or "every link and citation resolves")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
