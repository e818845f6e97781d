"""What the scripts that build pages ask of `aerom`, and read of tables. Python 3 standard library."""

import csv
import json
import subprocess


def run(*command, text=None):
    """Standard output of a program; where it fails, the end of the script with what it said."""
    command = [str(word) for word in command]
    result = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise SystemExit("%s\n%s" % (" ".join(command), result.stderr))
    return result.stdout


def document(aerom, case, *options):
    """The summary of a case, or what the options of `aerom run` ask for."""
    return json.loads(run(aerom, "run", "-", *options, text=json.dumps(case)))


def loop(aerom, *options):
    """Lines of `aerom loop` as numbers by column, without the last one, the work."""
    return numbers(run(aerom, "loop", *options).splitlines()[:-1])


def rows(path):
    """Lines of a table as texts by column."""
    with open(path, newline="", encoding="ascii") as file:
        return list(csv.DictReader(file))


def numbers(lines):
    """The same of lines whose cells are all numbers."""
    return [{column: float(cell) for column, cell in row.items()} for row in csv.DictReader(lines)]


def record(path):
    """A record of data/cfd."""
    return numbers(path.read_text(encoding="ascii").splitlines())
