#!/usr/bin/python3
"""Checks the module arrows of arrows.txt against every #include and every CMake DEPENDS.

usage: layers.py SOURCE_DIR [ARROWS]     prints one line a fault; exit code 1 if there is any.

Faults: an include or a link that is no arrow; a cycle in the arrows or among headers; another module's
private header (detail/); a third-party header where it does not belong; a library that prints or ends the
process; a file that is too long.
"""
import fnmatch
import pathlib
import re
import sys

LONGEST = 800
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = (".hpp", ".cpp", ".h", ".cc")
PROGRAMS = ("apps", "python")  # stand on the library; their headers are nobody else's


class Arrows:
    """modules: name -> everything at or below it; third_party: [(pattern, places, private)];
    forbidden: [(regular expression, files that may)]."""

    def __init__(self, path):
        self.faults, direct, self.third_party, self.forbidden = [], {}, [], []
        for line in path.read_text().splitlines():
            line = line.split("#")[0].strip()
            if line.startswith("!"):
                expression, _, files = line[1:].partition("=>")
                self.forbidden.append((re.compile(expression.strip()), files.split()))
            elif line.startswith("@"):
                pattern, _, places = (part.strip() for part in line[1:].partition("=>"))
                places = places.split()
                self.third_party.append((pattern if "*" in pattern else pattern + "*",
                                         set(places) - {"private"}, "private" in places))
            elif line:
                name, _, below = line.partition(":")
                direct[name.strip()] = below.split()
        self.modules = {}
        for name in direct:
            self.reach(name, direct, [])

    def reach(self, name, direct, path):
        if name in path:
            self.faults.append("arrows: cycle " + " -> ".join(path[path.index(name):] + [name]))
            return set()
        if name not in direct:
            self.faults.append(f"arrows: {path[-1]} points at unknown module {name}")
            return set()
        if name not in self.modules:
            below = {name}
            for other in direct[name]:
                below |= self.reach(other, direct, path + [name])
            self.modules[name] = below
        return self.modules[name]


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1], match[2]


def check_camber_include(where, module, header, arrows):
    other = header.split("/")[1]
    if other not in arrows.modules:
        return [f"{where}: includes unknown module {other}"]
    if other not in arrows.modules[module]:
        return [f"{where}: {module} may not include {other}"]
    if other != module and "/detail/" in header:
        return [f"{where}: {header} is private to {other}"]
    return []


def check_third_party(where, module, is_public, header, arrows):
    for pattern, places, private in arrows.third_party:
        if fnmatch.fnmatch(header, pattern):
            if "*" not in places and module not in places:
                return [f"{where}: {header} does not belong into {module}"]
            if private and is_public:
                return [f"{where}: {header} in a public header"]
            return []
    return []


def check_source(path, root, module, arrows):
    faults = []
    is_public = path.suffix == ".hpp" and "detail" not in path.parts and module not in PROGRAMS
    for number, bracket, header in includes(path):
        where = f"{path.relative_to(root)}:{number}"
        if header.startswith("camber/"):
            faults += check_camber_include(where, module, header, arrows)
        elif bracket == '"' and ".." in header.split("/"):
            faults.append(f'{where}: write <camber/...> instead of "{header}"')
        else:
            faults += check_third_party(where, module, is_public, header, arrows)
    if module not in PROGRAMS:
        faults += check_forbidden(path, root, arrows)
    return faults


def check_forbidden(path, root, arrows):
    faults = []
    for expression, exempt in arrows.forbidden:
        if str(path.relative_to(root / "src/camber")) in exempt:
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = expression.search(line.split("//")[0])
            if match:
                faults.append(f"{path.relative_to(root)}:{number}: a library does not call {match[0]}")
    return faults


def check_links(path, root, module, arrows):
    return [f"{path.relative_to(root)}: {module} may not link {other}"
            for other in re.findall(r"camber::(\w+)", path.read_text())
            if other not in arrows.modules[module]]


def header_cycles(root):
    """Cycles of #include <camber/...> among headers."""
    source = root / "src"
    graph = {str(path.relative_to(source)): [h for _, _, h in includes(path) if h.startswith("camber/")]
             for path in sorted(source.rglob("*.hpp"))}
    faults, done = [], set()

    def visit(header, path):
        if header in path:
            faults.append("headers: cycle " + " -> ".join(path[path.index(header):] + [header]))
        elif header not in done:
            for other in graph.get(header, ()):
                visit(other, path + [header])
            done.add(header)

    for header in graph:
        visit(header, [])
    return faults


def check(root, arrows_path):
    arrows = Arrows(arrows_path)
    faults = list(arrows.faults)
    places = [(folder, folder.name) for folder in sorted((root / "src/camber").iterdir())
              if folder.is_dir()]
    places += [(root / "apps", "apps"), (root / "python", "python")]
    for folder, module in places:
        sources = [p for p in sorted(folder.rglob("*")) if p.suffix in SOURCES]
        if sources and module not in arrows.modules:
            faults.append(f"{folder.relative_to(root)}: module is not in the arrows")
            continue
        for path in sources:
            faults += check_source(path, root, module, arrows)
        for path in sorted(folder.rglob("CMakeLists.txt")):
            faults += check_links(path, root, module, arrows) if module not in PROGRAMS else []
    faults += header_cycles(root)
    for top in ("src", "apps", "tests", "bench", "tools", "examples", "python"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in SOURCES + (".py",):
                length = len(path.read_text().splitlines())
                if length > LONGEST:
                    faults.append(f"{path.relative_to(root)}: {length} lines, at most {LONGEST}")
    return faults


def main():
    root = pathlib.Path(sys.argv[1])
    arrows = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parent / "arrows.txt")
    faults = check(root, arrows)
    print("\n".join(faults) or "every arrow points down")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
