"""Writes or checks a polar document that a script of this folder makes. Python 3 standard library."""

import argparse
import json
import sys
from pathlib import Path


def text_of(document):
    """The document as JSON, one key a line, so that a change of one table is one changed line."""
    rows = ["  %s: %s" % (json.dumps(key), json.dumps(value)) for key, value in document.items()]
    return "{\n" + ",\n".join(rows) + "\n}\n"


def main(path, document):
    """Writes `document` to `path`; with --check only compares and fails when they differ."""
    parser = argparse.ArgumentParser(description="Build %s." % Path(path).name)
    parser.add_argument("--check", action="store_true",
                        help="write nothing; fail when the committed file differs")
    arguments = parser.parse_args()
    text = text_of(document)
    if not arguments.check:
        Path(path).write_text(text, encoding="utf-8")
        return 0
    if Path(path).exists() and Path(path).read_text(encoding="utf-8") == text:
        return 0
    print("%s differs from what its script builds: run the script without --check" % path,
          file=sys.stderr)
    return 1
