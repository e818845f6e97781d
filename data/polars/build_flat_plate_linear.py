#!/usr/bin/env python3
"""Builds flat-plate-linear.json: thin-aerofoil theory as a table of straight lines."""

import math
import sys
from pathlib import Path

import polar_file

TARGET = Path(__file__).resolve().parent / "flat-plate-linear.json"
STEP = 10  # [deg]; straight lines need no more


def document():
    degrees = list(range(-90, 91, STEP))
    return {
        "name": "flat-plate-linear",
        "description": "c_l = 2 pi alpha, c_m about mid-chord = (pi / 2) alpha, c_d = 0",
        "provenance": "Thin-aerofoil theory, linear at every angle: for comparison with closed "
                      "forms, not for predictions.",
        "linear_from_deg": -90,
        "linear_to_deg": 90,
        "alpha_deg": degrees,
        "plunge_c": [0],
        "cl": [[2 * math.pi * math.radians(a) for a in degrees]],
        "cd": [[0] * len(degrees)],
        "cm": [[0.5 * math.pi * math.radians(a) for a in degrees]],
    }


if __name__ == "__main__":
    sys.exit(polar_file.main(TARGET, document()))
