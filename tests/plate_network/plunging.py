"""Small plunging over the open bubble, at the frequency of the shedding and around it: damping by that of thin-aerofoil
theory, of records, of the network that has not seen them, and of the shipped one over the frequency. Python 3 standard
library."""

import math

import ask
import svg

MEANS_DEG = (3.5, 8.5)      # angles about which the bubble is open
SLOWEST = 0.25              # f c/V
DRAWN_MEAN, DRAWN_SWING = 5.0, 0.5  # deg, of the curves
FREQUENCIES = [0.2 * 1.04 ** k for k in range(58)]
THEORY = ("--dynamic", "attached", "--polar", "flat-plate-linear")
MODELS = ((("--dynamic", "dynamic_stall"), svg.GREEN),
          (("--dynamic", "network", "--network", "plate-4pct"), svg.ORANGE))


def work(aerom, dynamic, mean_deg, plunge, frequency):
    text = ask.run(aerom, "loop", "--mean-deg", mean_deg, "--plunge", "%r" % plunge, "--frequency", "%r" % frequency,
                   "--cycles", 30, "--steps", 100, *dynamic)
    return float(text.splitlines()[-1].split()[2])


def incidence_deg(plunge, frequency):
    return math.degrees(2.0 * math.pi * frequency * plunge)


def found(aerom, items):
    """Of the items of build_network those that plunge alone, with their damping by that of theory, by frequency."""
    for item in sorted(items, key=lambda i: i["frequency"] or 0.0):
        row = item["row"]
        if item["frequency"] is None or row["pitch"] or item["frequency"] < SLOWEST \
                or not MEANS_DEG[0] <= float(row["mean_deg"]) <= MEANS_DEG[1]:
            continue
        plunge = float(row["plunge"].split("@")[0])
        theory = work(aerom, THEORY, row["mean_deg"], plunge, item["frequency"])
        yield {"name": item["name"], "frequency": item["frequency"], "mean": float(row["mean_deg"]),
               "swing": incidence_deg(plunge, item["frequency"]), "record": item["work"] / theory,
               "error": abs(item["uncertain"] / theory), "stall": item["dynamic_stall"]["work"] / theory,
               "network": item["lags"]["work"] / theory}


def table(rows):
    yield "| record | f c/V | about | incidence | record | dynamic stall | network, not trained on it |"
    yield "|---|---|---|---|---|---|---|"
    for r in rows:
        yield "| `%s` | %.2f | %g deg | ± %.1f deg | %+.2f ± %.2f | %+.2f | %+.2f |" % (
            r["name"], r["frequency"], r["mean"], r["swing"], r["record"], r["error"], r["stall"], r["network"])


def drawing(aerom, rows):
    """Damping over the frequency: marks of the records, curves of the models about one angle."""
    ticks = [(f, "%g" % f) for f in (0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.4, 1.8)]
    panel = svg.Panel(70, 46, 640, 330, svg.Axis(0.2, 1.9, ticks, log=True, label="f c/V"),
                      svg.Axis(-3.0, 5.0, label="damping by that of thin-aerofoil theory"),
                      "Plunging a little about 3.5 to 8.5 deg: below zero the flow feeds it")
    panel.curve((0.2, 1.9), (0.0, 0.0), svg.GREY, 1.0)
    motions = [(DRAWN_MEAN, math.radians(DRAWN_SWING) / (2.0 * math.pi * f), f) for f in FREQUENCIES]
    theory = [work(aerom, THEORY, *m) for m in motions]
    for dynamic, colour in MODELS:
        panel.curve(FREQUENCIES, [work(aerom, dynamic, *m) / t for m, t in zip(motions, theory)], colour, 2)
    for r in rows:
        if r["swing"] < 3.0:
            panel.mark(r["frequency"], r["record"], r["error"])
            panel.mark(r["frequency"], r["network"], fill=svg.ORANGE)
    names = [(svg.BLACK, "flow computation"), (svg.ORANGE, "network about 5 deg"), (svg.GREEN, "dynamic stall about 5 deg")]
    note = '<text x="70" y="466">orange marks: the motion of the record, by a network not trained on it</text>'
    return svg.document(760, 484, "Damping of small plunging over the frequency",
                        [panel, *svg.legend(names, 70, 442, 210), note])
