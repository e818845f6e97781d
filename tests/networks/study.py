"""The tables of a study of networks, and what is read from them. Python 3 standard library."""

import csv
import statistics
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "docs" / "networks"
COLUMNS = {
    "trial": ("model", "hidden", "draw", "weights", "seconds", "epochs", "kept", "trained", "held"),
    "curve": ("model", "hidden", "draw", "epoch", "trained", "held"),
    "record": ("record", "name", "period", "steady_cl", "range_cl", "steady_cm", "range_cm", "work_pitch",
               "work_plunge"),
    "error": ("model", "hidden", "draw", "record", "part", "cl", "cm", "work_pitch", "work_plunge"),
    "cycle": ("model", "hidden", "name", "part", "alpha_deg", "alpha_dot", "record_cl", "record_cm", "steady_cl",
              "steady_cm", "cl", "cm"),
    "cost": ("model", "hidden", "sections", "ns"),
}
WORDS = ("model", "name", "part")
SIZES = (2, 4, 8, 16, 25, 50, 100)
PAPER, MEMORY = ("lm", 50), ("lstm", 7)
NETWORKS = tuple(("lm", n) for n in SIZES) + (("adam", 50), MEMORY)
NAMES = {("adam", 50): "50, Adam", MEMORY: "LSTM, 7 cells"}


def write(tables):
    FOLDER.mkdir(exist_ok=True)
    for kind, rows in tables.items():
        with open(FOLDER / (kind + ".csv"), "w", newline="", encoding="ascii") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS[kind])
            writer.writerows(rows)


def parse(kind, rows):
    return [{k: v if k in WORDS else float(v) for k, v in zip(COLUMNS[kind], row)} for row in rows]


def read():
    """{table: rows as dictionaries}"""
    tables = {}
    for kind in COLUMNS:
        with open(FOLDER / (kind + ".csv"), newline="", encoding="ascii") as file:
            tables[kind] = parse(kind, list(csv.reader(file))[1:])
    return tables


def of(rows, network, **wanted):
    return [r for r in rows if (r["model"], r["hidden"]) == network
            and all(r[k] == v for k, v in wanted.items())]


def quantile(values, share):
    values = sorted(values)
    place = share * (len(values) - 1)
    low = int(place)
    return values[low] + (place - low) * (values[min(low + 1, len(values) - 1)] - values[low])


class Study:
    """The tables, and what the page shows of them."""

    def __init__(self, tables):
        self.tables = tables
        self.records = {r["record"]: r for r in tables["record"]}
        self.draws = int(max(t["draw"] for t in tables["trial"]))

    def misfits(self, network, part, coefficient):
        """Rms errors by the range of the record."""
        return [e[coefficient] / self.records[e["record"]]["range_" + coefficient]
                for e in of(self.tables["error"], network, part=part)]

    def pitching(self):
        """Sines in which the section pitches."""
        return {n for n, r in self.records.items() if r["period"] > 0.0 and r["work_pitch"] != 0.0}

    def energy_errors(self, network, part):
        """Eq. (B.1) with c_p = c_m alpha_dot c/V."""
        pitching = self.pitching()
        return [e["work_pitch"] / self.records[e["record"]]["work_pitch"] - 1.0
                for e in of(self.tables["error"], network, part=part) if e["record"] in pitching]

    def energy_share(self, network, part):
        """Mean error of the work of the pitch over its mean size: cycles of little work count little."""
        pitching = self.pitching()
        errors = [e for e in of(self.tables["error"], network, part=part) if e["record"] in pitching]
        return (sum(abs(e["work_pitch"] - self.records[e["record"]]["work_pitch"]) for e in errors)
                / sum(abs(self.records[e["record"]]["work_pitch"]) for e in errors))

    def median(self, network, column):
        return statistics.median(t[column] for t in of(self.tables["trial"], network))

    def cost(self, network, sections):
        rows = of(self.tables["cost"], network, sections=float(sections))
        return rows[0]["ns"] if rows else None

    def better(self, one, other, coefficient):
        """In how many of the trials with records held out `one` has the smaller error."""
        errors = [{(e["draw"], e["record"]): e[coefficient] for e in of(self.tables["error"], n, part="held")}
                  for n in (one, other)]
        both = [key for key in errors[0] if key in errors[1]]
        return sum(errors[0][k] < errors[1][k] for k in both), len(both)
