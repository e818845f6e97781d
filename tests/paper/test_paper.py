#!/usr/bin/env python3
"""What docs/PAPER.md says of the fibres: wash-out lowers the twist, and fibres towards the leading edge put stall flutter
off. Needs AEROMD, the daemon. Python 3 standard library."""

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

    def test_wash_out_twists_less_and_is_stable_longer(self):
        found = self.service.grid([(cells.DYNAMIC, NETWORK)],
                                  [(cells.ANGLE, (-40, 0, 40)), (cells.SPEED, (6.0, 11.0))],
                                  ("verdict", "tip_twist_deg", "counters.outside_hull"))
        slow, fast = zip(*found["verdict"])
        self.assertEqual(slow, ("stable",) * 3)
        self.assertEqual(fast, ("stable", "stall_flutter", "stall_flutter"))
        out, straight, into = (row[0] for row in found["tip_twist_deg"])
        self.assertLess(out, 0.8 * straight)
        self.assertGreater(into, 1.2 * straight)
        self.assertEqual([row[0] for row in found["counters.outside_hull"]], [0, 0, 0])

    def test_boundary_lies_in_the_grid(self):
        """A search and a grid of 0.25 m/s agree on where the beam is stable no more."""
        rows = results.boundaries(self.service, [(cells.DYNAMIC, NETWORK)], (0,), results.STABLE)
        speeds = [9.5 + 0.25 * k for k in range(9)]
        verdicts = self.service.grid([(cells.DYNAMIC, NETWORK), (cells.ANGLE, 0)], [(cells.SPEED, speeds)],
                                     ("verdict",))["verdict"]
        first = next(k for k, verdict in enumerate(verdicts) if verdict != "stable")
        self.assertGreater(first, 0)
        self.assertTrue(speeds[first - 1] - 0.05 <= rows[0]["boundary"] <= speeds[first] + 0.05, (rows[0], verdicts))


if __name__ == "__main__":
    unittest.main()
