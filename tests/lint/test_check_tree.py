#!/usr/bin/env python3
"""Each lint rule must find the fault it is for, and nothing in a clean tree."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent / "check_tree.py"
HEADER = "/* core/a.h\n * A. */\n#ifndef AEROM_CORE_A_H\n#define AEROM_CORE_A_H\nint a_one(void);\n#endif\n"
SOURCE = '#include "core/a.h"\n\nint a_one(void)\n{\n    return 1; /* not sprintf( */\n}\n'
MATERIAL = '{ "provenance": "here", "materials": [{ "name": "m" }] }\n'
EQUATIONS = "| equation | function |\n|---|---|\n| (A.4) | `a_one` |\n"
DESIGN = "name,re\nr,1\n"
INDEX = "name,re,status,interval,samples\nr,1,done,0.1,2\n"
RECORD = ("t,alpha_deg,alpha_dot,alpha_ddot,w,w_dot,w_ddot,cl,cd,cm\n"
          "0.1,2,0,0,0,0,0,0.3,0.1,0.1\n0.2,2,0,0,0,0,0,0.3,0.1,0.1\n")
CLEAN = {"core/a.h": HEADER, "core/a.c": SOURCE, "data/materials/m.json": MATERIAL,
         "docs/EQUATIONS.md": EQUATIONS, "data/cfd/design.csv": DESIGN, "data/cfd/index.csv": INDEX,
         "data/cfd/records/r.csv": RECORD}

# rule, files that replace or join those of the clean tree, what the finding must say
FAULTS = [
    ("includes", {"core/a.c": '#include "api/b.h"\n', "api/b.h": "\n"}, "must not include api/b.h"),
    ("includes", {"api/b.h": '#include "server/c.h"\n', "server/c.h": "\n"}, "must not include"),
    ("includes", {"core/a.c": '#include "a.h"\n'}, "not spelled from the root"),
    ("includes", {"server/jobs.c": "#include <microhttpd.h>\n"}, "<microhttpd.h>"),
    ("includes", {"server/jobs.c": "#include <sqlite3.h>\n"}, "<sqlite3.h>"),
    ("includes", {"core/a.c": "#include <lapacke.h>\n"}, "<lapacke.h>"),
    ("includes", {"api/b.c": "#include <hdf5.h>\n"}, "<hdf5.h>"),
    ("includes", {"core/study/a.c": "#include <nlopt.h>\n"}, "<nlopt.h>"),
    ("includes", {"core/a.c": "#include <pthread.h>\n"}, "<pthread.h>"),
    ("sizes", {"core/a.c": "int x;\n" * 501}, "501 lines"),
    ("sizes", {"core/a.c": "int a_one(void)\n{\n" + "    ;\n" * 61 + "}\n"}, "function of 61 lines"),
    ("calls", {"server/c.c": "void f(void)\n{\n    sprintf(b, s);\n}\n"}, "sprintf()"),
    ("calls", {"core/a.c": "void f(void)\n{\n    printf(s);\n}\n"}, "printf()"),
    ("headers", {"core/b.c": "int b;\n"}, "has no header b.h"),
    ("headers", {"core/a.h": "int a_one(void);\n"}, "guard is not AEROM_CORE_A_H"),
    ("headers", {"core/a.h": HEADER.split("\n", 2)[2]}, "does not open with its path"),
    ("whitespace", {"docs/x.md": "text \n"}, "trailing blank"),
    ("whitespace", {"core/a.c": "int a;"}, "one newline"),
    ("whitespace", {"core/a.c": "\tint a;\n"}, "tab"),
    ("equations", {"docs/EQUATIONS.md": EQUATIONS.replace("a_one", "a_two")}, "a_two does not exist"),
    ("equations", {"docs/EQUATIONS.md": "nothing\n"}, "no row"),
    ("equations", {"docs/EQUATIONS.md": EQUATIONS.replace("`a_one`", "someone")}, "no function"),
    ("equations", {"docs/EQUATIONS.md": EQUATIONS + "in `test_none.c`\n"}, "test_none.c does not"),
    ("data", {"data/materials/n.json": MATERIAL}, "m is also in m.json"),
    ("data", {"data/materials/n.json": "{"}, "not JSON"),
    ("data", {"data/polars/p.json": '{ "name": "p" }\n'}, "no provenance"),
    ("data", {"data/polars/build_p.py": "import sys\nsys.exit('differs')\n"}, "differs"),
    ("records", {"data/cfd/design.csv": "name,re\nr,2\n"}, "not a run of the design"),
    ("records", {"data/cfd/index.csv": INDEX.replace("done", "failed")}, "status failed with a record"),
    ("records", {"data/cfd/records/s.csv": RECORD}, "is not in the index"),
    ("records", {"data/cfd/records/r.csv": RECORD.replace("w,w_dot", "w_dot,w")}, "the columns"),
    ("records", {"data/cfd/records/r.csv": RECORD + "0.3,2,0,0,0,0,0,0.3,0.1,0.1\n"}, "3 samples"),
    ("records", {"data/cfd/records/r.csv": RECORD.replace("0.2,", "0.25,")}, "time 0.25"),
    ("records", {"data/cfd/records/r.csv": RECORD.replace("0.3,0.1", "nan,0.1")}, "finite numbers"),
]


def run(rule, files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, str(SCRIPT), "--root", folder, rule],
                              capture_output=True, text=True, check=False)


class Rules(unittest.TestCase):
    def test_clean_tree_passes(self):
        for rule in sorted({rule for rule, _, _ in FAULTS}):
            with self.subTest(rule=rule):
                result = run(rule, CLEAN)
                self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_faults_are_found(self):
        for rule, files, text in FAULTS:
            with self.subTest(rule=rule, text=text):
                result = run(rule, {**CLEAN, **files})
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn(text, result.stdout)


if __name__ == "__main__":
    unittest.main()
