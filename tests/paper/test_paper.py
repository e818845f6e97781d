#!/usr/bin/env python3
"""What docs/PAPER.md says of the fibres: wash-out lowers the twist, and fibres towards the leading edge keep the swing of
stall flutter small. Needs AEROMD, the daemon. Python 3 standard library."""

import os
import unittest

import cells
import results

NETWORK = dict(results.MODELS)["network"]


class Paper(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.service = cells.Service(os.environ["AEROMD"], 2)

    @classmethod
    def tearDownClass(cls):
        cls.service.__exit__()

    def test_e_star(self):
        """Eq. of E*: the speed of the marked points."""
        self.assertAlmostEqual(cells.speed_of(results.MARKED_E_STAR), 6.09, delta=0.005)
        self.assertAlmostEqual(cells.e_star_of(cells.speed_of(0.7e6)), 0.7e6, delta=1.0)

    def test_wash_out_twists_less_and_swings_less(self):
        found = self.service.grid([(cells.DYNAMIC, NETWORK)],
                                  [(cells.ANGLE, (-40, 0, 40)), (cells.SPEED, (3.5, 6.0, 8.5))],
                                  ("verdict", "tip_twist_deg", "tip_twist_rms_deg", "counters.outside_hull"))
        calm, slow, fast = zip(*found["verdict"])
        self.assertEqual(calm, ("stable",) * 3)
        self.assertEqual((slow, fast), (("stall_flutter",) * 3,) * 2)
        for row, limit in zip(found["tip_twist_rms_deg"], (0.9, 4.0, 4.0)):
            self.assertLess(row[1], 0.5)
            self.assertTrue(row[2] < limit and (row[2] > 1.0) == (limit > 1.0), row)
        out, straight, into = (row[1] for row in found["tip_twist_deg"])
        self.assertLess(out, 0.8 * straight)
        self.assertGreater(into, 1.2 * straight)
        self.assertEqual([row[1] for row in found["counters.outside_hull"]], [0, 0, 0])

    def test_boundary_lies_in_the_grid(self):
        """A search and a grid of 0.25 m/s agree on where the beam is stable no more."""
        rows = results.boundaries(self.service, [(cells.DYNAMIC, NETWORK)], (0,), results.STABLE)
        speeds = [3.25 + 0.25 * k for k in range(7)]
        verdicts = self.service.grid([(cells.DYNAMIC, NETWORK), (cells.ANGLE, 0)], [(cells.SPEED, speeds)],
                                     ("verdict",))["verdict"]
        first = next(k for k, verdict in enumerate(verdicts) if verdict != "stable")
        self.assertGreater(first, 0)
        self.assertTrue(speeds[first - 1] - 0.05 <= rows[0]["boundary"] <= speeds[first] + 0.05, (rows[0], verdicts))


if __name__ == "__main__":
    unittest.main()
