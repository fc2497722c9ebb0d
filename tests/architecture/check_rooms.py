"""Checks the rules of docs/ARCHITECTURE.md on a source tree: prints a line for each breach, exits 1 if there is one.

- A room includes only itself and the rooms that its CMakeLists.txt names in DEPENDS; those names make no cycle.
- The table of docs/ARCHITECTURE.md says the same.
- No file includes itself by way of others.
- OpenCASCADE's headers (*.hxx) stay in occ_adapter, samples, benchmarks and tests, and in occ_adapter in .cpp files and occ_private.h.
- No C++ file is longer than 600 lines.
- No two headers define a type of one name: they share one namespace, and a program that links both would mix them up.
"""

import pathlib
import re
import sys

LONGEST_FILE = 600
INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.M)
TYPE = re.compile(r"^(?:class|struct|enum class)\s+(\w+)[^;]*?\{", re.M)
ROOM = re.compile(r"geovor_room\(\s*(\w+)(.*?)\)", re.S)


def includes(path):
    """(quoted?, name) of every include of a file."""
    return [(mark == '"', name) for mark, name in INCLUDE.findall(path.read_text())]


def declared_rooms(root):
    """Room name -> rooms that it may include, from the CMake files."""
    rooms = {}
    for cmake in sorted([*root.glob("src/*/CMakeLists.txt"), *root.glob("occ_adapter/CMakeLists.txt")]):
        for name, arguments in ROOM.findall(cmake.read_text()):
            rooms[name] = set(re.sub(r".*DEPENDS", "", arguments, flags=re.S).split()) if "DEPENDS" in arguments else set()
    return rooms


def cycle(graph):
    """A list of nodes that runs in a circle, or None."""
    done, path = set(), []

    def visit(node):
        if node in path:
            return path[path.index(node):] + [node]
        if node in done:
            return None
        path.append(node)
        for target in sorted(graph.get(node, ())):
            found = visit(target)
            if found:
                return found
        path.pop()
        done.add(node)
        return None

    for node in sorted(graph):
        found = visit(node)
        if found:
            return found
    return None


def sources(root, *folders):
    return sorted(p for folder in folders for p in (root / folder).rglob("*") if p.suffix in (".h", ".cpp"))


def check_room_includes(root, rooms):
    for path in sources(root, "src", "occ_adapter"):
        parts = path.relative_to(root).parts
        room = parts[1] if parts[0] == "src" else "occ_adapter"
        if room not in rooms:
            yield f"{path.relative_to(root)}: its room '{room}' has no geovor_room() in a CMakeLists.txt"
            continue
        for quoted, name in includes(path):
            other = name.split("/")[0] if "/" in name else room
            if other in rooms and other != room and other not in rooms[room]:
                yield f"{path.relative_to(root)}: {room} may not include {other} ({name})"
            if quoted and other == "tools":
                yield f"{path.relative_to(root)}: {room} may not include the program ({name})"


def check_table(root, rooms):
    table = {}
    for line in (root / "docs" / "ARCHITECTURE.md").read_text().splitlines():
        row = re.fullmatch(r"\| `(\w+)` \|.*\| ?([\w ]*)\|", line)
        if row:
            table[row.group(1)] = set(row.group(2).split())
    for room in sorted(rooms.keys() | table.keys()):
        if rooms.get(room) != table.get(room):
            yield f"docs/ARCHITECTURE.md: {room}: the table and its CMakeLists.txt differ in what it may include"


def check_kernel_headers(root):
    for path in sources(root, "src", "occ_adapter", "tools", "samples", "benchmarks", "tests"):
        names = [name for _, name in includes(path) if name.endswith(".hxx")]
        where = path.relative_to(root).as_posix()
        allowed = where == "occ_adapter/occ_private.h" or (
            where.startswith(("samples/", "benchmarks/", "tests/")) or (where.startswith("occ_adapter/") and path.suffix == ".cpp"))
        if names and not allowed:
            yield f"{where}: OpenCASCADE's {names[0]} may be included by occ_adapter's .cpp files and occ_private.h only"


def check_file_cycles(root):
    graph = {}
    for path in sources(root, "src", "occ_adapter", "tools"):
        targets = set()
        for quoted, name in includes(path):
            for base in (path.parent, root / "src", root):
                if quoted and (base / name).is_file():
                    targets.add((base / name).resolve())
                    break
        graph[path.resolve()] = targets
    found = cycle(graph)
    if found:
        yield "files include each other in a circle: " + " -> ".join(p.name for p in found)


def check_lengths(root):
    for path in sources(root, "src", "occ_adapter", "tools", "samples", "benchmarks", "tests"):
        lines = len(path.read_text().splitlines())
        if lines > LONGEST_FILE:
            yield f"{path.relative_to(root)}: {lines} lines where {LONGEST_FILE} are allowed"


def check_names(root):
    defined = {}
    for path in sources(root, "src", "occ_adapter", "tools"):
        if path.suffix != ".h":
            continue
        for name in TYPE.findall(path.read_text()):
            first = defined.setdefault(name, path)
            if first != path:
                yield f"{path.relative_to(root)}: {name} is the name of another type in {first.relative_to(root)}"


def breaches(root):
    rooms = declared_rooms(root)
    if not rooms:
        yield "no geovor_room() found: is this the root of the project?"
    found = cycle(rooms)
    if found:
        yield "rooms depend on each other in a circle: " + " -> ".join(found)
    yield from check_room_includes(root, rooms)
    yield from check_table(root, rooms)
    yield from check_kernel_headers(root)
    yield from check_file_cycles(root)
    yield from check_names(root)
    yield from check_lengths(root)


if __name__ == "__main__":
    lines = list(breaches(pathlib.Path(sys.argv[1])))
    print("\n".join(lines) if lines else "every rule is kept")
    sys.exit(1 if lines else 0)
