#!/usr/bin/env python3
"""What docs/NETWORKS.md says holds for the tables beside it, and the page is what they give. Python 3 standard
library."""

import statistics
import unittest

import build_networks
import drawings
from study import FOLDER, MEMORY, PAPER, SIZES, Study, of, quantile, read


class Networks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.study = Study(read())

    def misfit(self, network, coefficient):
        return statistics.median(self.study.misfits(network, "held", coefficient))

    def test_page_and_drawings_are_those_of_the_tables(self):
        self.assertEqual("\n".join(build_networks.page(self.study)) + "\n",
                         build_networks.PAGE.read_text(encoding="utf-8"))
        for name, text in drawings.all_of(self.study):
            self.assertEqual(text, (FOLDER / name).read_text(encoding="utf-8"), name)

    def test_every_draw_holds_out_the_same_records_for_all(self):
        for draw in range(1, self.study.draws + 1):
            held = [{e["record"] for e in of(self.study.tables["error"], n, part="held", draw=float(draw))}
                    for n in (PAPER, MEMORY)]
            self.assertEqual(held[0], held[1])
            self.assertTrue(0 < len(held[0]) < len(self.study.records) / 3)

    def test_both_kinds_have_as_many_weights(self):
        self.assertEqual(self.study.median(PAPER, "weights"), 352)
        self.assertEqual(self.study.median(MEMORY, "weights"), 352)

    def test_energy_error_falls_to_fifty_neurons(self):
        """By 56 % in the records trained, by 53 % in those held out."""
        for part, fall in (("trained", 0.56), ("held", 0.53)):
            shares = [self.study.energy_share(("lm", n), part) for n in SIZES]
            self.assertAlmostEqual(shares[SIZES.index(50)] / shares[0], 1.0 - fall, delta=0.03)

    def test_fifty_neurons_give_too_little_work(self):
        """Wrong by about a third of the mean size."""
        for part in ("trained", "held"):
            self.assertAlmostEqual(self.study.energy_share(PAPER, part), 0.33, delta=0.08)
            self.assertLess(quantile(self.study.energy_errors(PAPER, part), 0.5), -0.2)

    def test_errors_grow_no_smaller_beyond_fifty(self):
        self.assertGreater(self.study.energy_share(("lm", 100), "held"), 0.85 * self.study.energy_share(PAPER, "held"))
        for coefficient in ("cl", "cm"):
            self.assertGreater(self.misfit(("lm", 100), coefficient), 0.85 * self.misfit(PAPER, coefficient))

    def test_every_network_is_better_than_the_polar_alone(self):
        for coefficient in ("cl", "cm"):
            alone = statistics.median(
                self.study.records[e["record"]]["steady_" + coefficient]
                / self.study.records[e["record"]]["range_" + coefficient]
                for e in of(self.study.tables["error"], PAPER, part="held"))
            self.assertLess(self.misfit(PAPER, coefficient), 0.8 * alone)
            self.assertLess(self.misfit(("lm", 2), coefficient), 1.05 * alone)

    def test_memory_is_nearer_to_records_held_out(self):
        for coefficient in ("cl", "cm"):
            better, cases = self.study.better(MEMORY, PAPER, coefficient)
            self.assertGreater(better, 2 * cases / 3)
            self.assertLess(self.misfit(MEMORY, coefficient), 0.8 * self.misfit(PAPER, coefficient))

    def test_levenberg_marquardt_has_learnt_within_its_epochs(self):
        """The error of the records held out: near its least at half of the epochs, nearer at the end."""
        for draw in range(1, self.study.draws + 1):
            curve = of(self.study.tables["curve"], PAPER, draw=float(draw))
            least, last = min(c["held"] for c in curve), max(curve, key=lambda c: c["epoch"])
            half = min(curve, key=lambda c: abs(c["epoch"] - 0.5 * last["epoch"]))
            self.assertLess(last["held"], 1.02 * least)
            self.assertLess(half["held"], 1.15 * least)

    def test_quantiles(self):
        self.assertEqual([quantile([3.0, 1.0, 2.0], q) for q in (0.0, 0.25, 0.5, 1.0)], [1.0, 1.5, 2.0, 3.0])


if __name__ == "__main__":
    unittest.main()
