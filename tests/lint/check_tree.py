#!/usr/bin/env python3
"""Rules of CONTRIBUTING.md that a script can check. Python 3 standard library.

    check_tree.py [--root DIR] [RULE ...]     all rules without arguments

Each rule is a generator of findings (file, line, text); one finding makes the script fail."""

import argparse
import csv
import json
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

CODE_FOLDERS = ("core", "api", "server", "cli", "tests")
TEXT_SUFFIXES = {".c", ".h", ".py", ".md", ".json", ".sh", ".sql", ".txt", ".cmake", ".svg", ".yaml"}
SKIPPED_FOLDERS = {"build", ".git", "__pycache__"}

# Which folders the sources of a folder may include from.
MAY_INCLUDE = {
    "core": {"core"},
    "api": {"api", "core"},
    "server": {"server", "api", "core"},
    "cli": {"cli", "api", "core"},
    "tests": {"tests", "server", "cli", "api", "core"},
}
# Third-party and system headers that only some files may see: header -> patterns of the path.
# Tests are free to look at the outside of a program with the same libraries.
RESTRICTED_HEADERS = {
    "microhttpd.h": (r"server/http(_\w+)?\.c", r"tests/.*"),
    "sqlite3.h": (r"server/(store_sqlite\w*|migrate)\.[ch]", r"tests/.*"),
    "cblas.h": (r"core/la\.c", r"tests/.*"),
    "lapacke.h": (r"core/la\.c", r"tests/.*"),
    "hdf5.h": (r"api/hdf5_\w+\.c", r"tests/.*"),
    "nlopt.h": (r"core/study/optimum\.c", r"tests/.*"),
    "cjson/cJSON.h": (r"(api|cli)/.*", r"tests/.*"),
    "curl/curl.h": (r"cli/http_client\.c", r"tests/.*"),
    "pthread.h": (r"cli/(study\.c|progress\.[ch])", r"server/.*", r"api/(hdf5_lock|both_threads)\.c", r"tests/.*"),
    "time.h": (r"(api|server|cli)/.*", r"tests/.*"),
    "unistd.h": (r"(server|cli)/.*", r"tests/.*"),
}
BANNED_CALLS = ("sprintf", "vsprintf", "strcpy", "strcat", "gets", "strtok", "setlocale", "atoi", "atof",
                "alloca")
# The core and the contract compute and translate; they never speak to the world.
SILENT_FOLDERS = ("core", "api")
SPEAKING_CALLS = ("printf", "fprintf", "puts", "fopen", "exit", "abort", "getenv", "time",
                  "clock_gettime", "clock")
# Parts of one module that share a header under another name: path of the parts -> header.
SHARED_HEADERS = {r"api/handle_\w+\.c": "api/route.h"}
RECORD_COLUMNS = ["t", "alpha_deg", "alpha_dot", "alpha_ddot", "w", "w_dot", "w_ddot", "cl", "cd", "cm"]
FILE_LINES_MAX = 500
FUNCTION_LINES_MAX = 60


def walk(root, folders=None):
    """Files below the root (or some of its folders) in a fixed order, build trees left out."""
    for top in ([root / f for f in folders] if folders else [root]):
        for path in sorted(top.rglob("*")) if top.is_dir() else []:
            parts = path.relative_to(root).parts
            if path.is_file() and not SKIPPED_FOLDERS.intersection(parts):
                yield path


def sources(root):
    return (p for p in walk(root, CODE_FOLDERS) if p.suffix in (".c", ".h", ".inc"))


def lines_of(path):
    return path.read_text(encoding="utf-8").splitlines()


CODE_NOISE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)


def bare_lines(path):
    """The lines of a C file with comments and literals blanked out, line numbers kept."""
    text = path.read_text(encoding="utf-8")
    return CODE_NOISE.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text).splitlines()


def rule_includes(root):
    """Dependence goes one way, and each library has its one door."""
    include = re.compile(r'\s*#\s*include\s*(["<])([^">]+)[">]')
    for path in sources(root):
        relative = path.relative_to(root).as_posix()
        folder = relative.split("/")[0]
        for number, line in enumerate(lines_of(path), 1):
            match = include.match(line)
            if not match:
                continue
            header = match.group(2)
            if match.group(1) == '"':
                if not (root / header).is_file():
                    yield path, number, "%s is not spelled from the root" % header
                elif header.split("/")[0] not in MAY_INCLUDE[folder]:
                    yield path, number, "%s/ must not include %s" % (folder, header)
            elif header in RESTRICTED_HEADERS and not any(
                    re.fullmatch(p, relative) for p in RESTRICTED_HEADERS[header]):
                yield path, number, "<%s> is not for this file" % header


def rule_sizes(root):
    """Files and functions stay readable. In the house format a function body is what stands
    between braces in the first column."""
    for path in sources(root):
        lines = lines_of(path)
        if len(lines) > FILE_LINES_MAX:
            yield path, 1, "%d lines, at most %d" % (len(lines), FILE_LINES_MAX)
        start = None
        for number, line in enumerate(lines, 1):
            if line == "{":
                start = number
            elif line == "}" and start is not None:
                if number - start - 1 > FUNCTION_LINES_MAX:
                    yield path, start, "function of %d lines, at most %d" % (
                        number - start - 1, FUNCTION_LINES_MAX)
                start = None


def rule_format(root):
    """clang-format has nothing to change."""
    program = shutil.which("clang-format")
    if program is None:
        print("clang-format is not installed: rule 'format' skipped")
        return
    files = [str(p) for p in sources(root)]
    if not files:
        return
    result = subprocess.run([program, "--dry-run", "-Werror", "--style=file"] + files,
                            capture_output=True, text=True, check=False)
    for match in re.finditer(r"^(.+?):(\d+):\d+: error: (.+)$", result.stderr, re.M):
        yield Path(match.group(1)), int(match.group(2)), match.group(3)


def rule_calls(root):
    """Calls that overflow, depend on global state, or speak where only values may be returned."""
    banned = re.compile(r"(?<![\w.>])(%s)\s*\(" % "|".join(BANNED_CALLS))
    speaking = re.compile(r"(?<![\w.>])(%s)\s*\(" % "|".join(SPEAKING_CALLS))
    for path in sources(root):
        if path.relative_to(root).parts[0] == "tests":
            continue
        silent = path.relative_to(root).parts[0] in SILENT_FOLDERS
        for number, line in enumerate(bare_lines(path), 1):
            for pattern in (banned, speaking) if silent else (banned,):
                for match in pattern.finditer(line):
                    yield path, number, "%s() is not used here" % match.group(1)


def rule_headers(root):
    """Every module has its header: x.c or x_part.c goes with x.h, unless it is a program. Every
    header is guarded by its path and says what it is for."""
    for path in sources(root):
        relative = path.relative_to(root)
        if relative.parts[0] == "tests":
            continue
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".h":
            guard = "AEROM_" + re.sub(r"\W", "_", relative.as_posix()).upper()
            if "#ifndef %s\n#define %s\n" % (guard, guard) not in text:
                yield path, 1, "the guard is not %s" % guard
            if not text.startswith("/* %s\n" % relative.as_posix()):
                yield path, 1, "does not open with its path and purpose"
            continue
        if any(re.fullmatch(part, relative.as_posix()) and (root / header).is_file()
               for part, header in SHARED_HEADERS.items()):
            continue
        words = path.stem.split("_")
        stems = ["_".join(words[:n]) for n in range(1, len(words) + 1)]
        if not (any((path.parent / (s + ".h")).is_file() for s in stems)
                or re.search(r"^int main\(", text, re.M)):
            yield path, 1, "has no header %s.h and is no program" % path.stem


def rule_whitespace(root):
    """No trailing blanks, no tabs, one newline at the end."""
    for path in walk(root):
        if path.suffix not in TEXT_SUFFIXES:
            continue
        text = path.read_text(encoding="utf-8")
        if text and (not text.endswith("\n") or text.endswith("\n\n")):
            yield path, text.count("\n"), "does not end with one newline"
        for number, line in enumerate(text.split("\n"), 1):
            if line != line.rstrip():
                yield path, number, "trailing blank"
            if "\t" in line:
                yield path, number, "tab"


def rule_equations(root):
    """Every function and file docs/EQUATIONS.md names exists, and every row of a table with a column
    "function" names one."""
    table = root / "docs" / "EQUATIONS.md"
    if not table.is_file():
        yield table, 1, "is missing"
        return
    words, files = set(), set()
    for path in sources(root):
        words.update(re.findall(r"\w+", path.read_text(encoding="utf-8")))
        files.add(path.name)
    rows, column = 0, None
    for number, line in enumerate(lines_of(table), 1):
        for name in re.findall(r"`([A-Za-z_]\w*)(?:\(\))?`", line):
            if name not in words:
                yield table, number, "%s does not exist" % name
        for name in re.findall(r"`(?:\w+/)*(\w+\.[ch])`", line):
            if name not in files:
                yield table, number, "%s does not exist" % name
        cells = [cell.strip() for cell in line.split("|")]
        if "function" in cells:
            column = cells.index("function")
        elif len(cells) < 3:
            column = None
        elif column is not None and not set(line) <= set("|-: "):
            rows += 1
            if not re.search(r"`[A-Za-z_]\w*", cells[column]):
                yield table, number, "the row names no function"
    if rows == 0:
        yield table, 1, "has no row of an equation"


def rule_data(root):
    """Library files parse, say where they come from, and share no name; the generated polars are
    what their scripts build."""
    seen = {}
    for kind in ("materials", "polars", "networks"):
        for path in sorted((root / "data" / kind).glob("*.json")):
            try:
                document = json.loads(path.read_text(encoding="utf-8"))
            except ValueError as error:
                yield path, 1, "not JSON: %s" % error
                continue
            if not document.get("provenance"):
                yield path, 1, "has no provenance"
            for entry in document["materials"] if kind == "materials" else [document]:
                first = seen.setdefault((kind, entry["name"]), path)
                if first is not path:
                    yield path, 1, "%s is also in %s" % (entry["name"], first.name)
    for script in sorted((root / "data").rglob("build_*.py")):
        result = subprocess.run([sys.executable, str(script), "--check"], capture_output=True,
                                text=True, check=False)
        if result.returncode != 0:
            yield script, 1, (result.stderr.strip() or "--check failed").splitlines()[-1]


def record_faults(path, row):
    """What is wrong with one record of the flow computations, given its line of the index."""
    with open(path, newline="", encoding="ascii") as file:
        rows = list(csv.reader(file))
    if rows[0] != RECORD_COLUMNS:
        yield 1, "the columns are not %s" % ",".join(RECORD_COLUMNS)
        return
    if len(rows) - 1 != int(row["samples"]):
        yield len(rows), "%d samples, the index says %s" % (len(rows) - 1, row["samples"])
    for number, cells in enumerate(rows[1:], 2):
        try:
            values = [float(cell) for cell in cells]
        except ValueError:
            values = []
        if len(values) != len(RECORD_COLUMNS) or not all(map(math.isfinite, values)):
            yield number, "not %d finite numbers" % len(RECORD_COLUMNS)
        elif abs(values[0] - (number - 1) * float(row["interval"])) > 1e-6:
            yield number, "time %g is not %d intervals of %s" % (values[0], number - 1, row["interval"])


def rule_records(root):
    """The records of the flow computations are those of their index, and the index has the settings of
    the design."""
    folder = root / "data" / "cfd"
    index = folder / "index.csv"
    if not index.is_file():
        return
    tables = {}
    for path in (index, folder / "design.csv"):
        with open(path, newline="", encoding="ascii") as file:
            tables[path.stem] = {row["name"]: row for row in csv.DictReader(file)}
    for number, (name, row) in enumerate(tables["index"].items(), 2):
        settings = tables["design"].get(name)
        if settings is None or any(row[key] != value for key, value in settings.items()):
            yield index, number, "%s is not a run of the design" % name
        record = folder / "records" / (name + ".csv")
        if record.is_file() != (row["status"] == "done"):
            yield index, number, "%s has the status %s %s a record" % (
                name, row["status"], "with" if record.is_file() else "without")
        elif record.is_file():
            for line, text in record_faults(record, row):
                yield record, line, text
    for path in sorted((folder / "records").glob("*")):
        if path.suffix != ".csv" or path.stem not in tables["index"]:
            yield path, 1, "is not in the index"


RULES = {name[len("rule_"):]: rule for name, rule in list(globals().items())
         if name.startswith("rule_")}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[2])
    parser.add_argument("rules", nargs="*", metavar="RULE", help=", ".join(RULES))
    arguments = parser.parse_args()
    root = arguments.root.resolve()
    unknown = [name for name in arguments.rules if name not in RULES]
    if unknown:
        parser.error("no rule %s" % ", ".join(unknown))
    found = 0
    for name in arguments.rules or RULES:
        for path, line, text in RULES[name](root):
            print("%s:%d: %s: %s" % (path.relative_to(root), line, name, text))
            found += 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
