#!/usr/bin/env python3
"""The committed reference numbers and the parts of their generator that need no solver."""

import json
import math
import unittest

import calculix
import ccx
import closed_form as cf
import sections
from cases import all_cases
from motion import section_motion
from section_mesh import SectionMesh, face_integrals
from span_mesh import Station, sweep

MATERIALS = calculix.load_materials()
DOCUMENT = json.loads(calculix.OUTPUT.read_text(encoding="utf-8"))
RECORDS = {r["name"]: r for r in DOCUMENT["cases"]}
ALUMINIUM = [("aluminium", 0, 0.001)]


class Committed(unittest.TestCase):
    def test_every_case_has_its_record_and_no_other(self):
        self.assertEqual([c.name for c in all_cases()], [r["name"] for r in DOCUMENT["cases"]])

    def test_definitions_and_materials_are_those_of_the_table(self):
        for case in all_cases():
            with self.subTest(case=case.name):
                self.assertEqual(calculix.rounded(case.definition()),
                                 RECORDS[case.name]["definition"])
        for name, values in DOCUMENT["materials"].items():
            for key, value in values.items():
                self.assertEqual(value, MATERIALS[name][key], (name, key))

    def test_closed_forms_agree_and_are_evaluated_anew(self):
        for case in all_cases():
            record = RECORDS[case.name]
            checks = case.checks(case, MATERIALS, record["models"]["fine"])
            self.assertEqual(len(checks), len(record["checks"]), case.name)
            for what, value, expected, tolerance in checks:
                with self.subTest(case=case.name, what=what):
                    self.assertLessEqual(abs(value / expected - 1), tolerance)

    def test_meshes_are_converged(self):
        """Frequencies to 0.7 %, motions to 1.5 % of the load's largest."""
        for name, record in RECORDS.items():
            with self.subTest(case=name):
                for mode in record["models"]["fine"]["modes"]:
                    self.assertLess(mode["mesh_error_hz"], 0.007 * mode["frequency_hz"])
                for load, entry in record["models"]["fine"]["static"].items():
                    if load == "tip_axial":
                        continue  # so small a motion that its cross terms are rounding
                    floor = calculix.noise(entry["tip"])
                    for key, error in entry["mesh_error"].items():
                        self.assertLess(error, 0.015 / calculix.NOISE * floor[key], key)

    def test_cross_terms_of_the_unit_loads_are_reciprocal(self):
        for name, record in RECORDS.items():
            static = record["models"]["fine"]["static"]
            with self.subTest(case=name):
                force_twist = math.radians(static["tip_force_y"]["tip"]["twist_deg"])
                torque_plunge = static["tip_torque"]["tip"]["plunge_m"]
                size = static["tip_force_y"]["tip"]["plunge_m"]
                self.assertLess(abs(force_twist - torque_plunge),
                                1e-4 * abs(force_twist) + 1e-6 * size)

    def test_opposite_angles_are_mirror_images(self):
        plus, minus = (RECORDS[n]["models"]["fine"] for n in ("paper-beam-45", "paper-beam-m45"))
        for a, b in zip(plus["modes"], minus["modes"]):
            self.assertLess(abs(a["frequency_hz"] / b["frequency_hz"] - 1), 1e-3)
        twists = [m["static"]["line_force_y"]["tip"]["twist_deg"] for m in (plus, minus)]
        self.assertLess(abs(twists[0] + twists[1]), 2e-3 * abs(twists[0]))
        self.assertLess(twists[1], 0.0)  # fibres towards the leading edge wash out


class Mesh(unittest.TestCase):
    def test_areas_of_sections(self):
        box = sections.Box(0.06, 0.02, *(ALUMINIUM,) * 4, web=ALUMINIUM, x_web=0.01)
        for shape, area in ((box, 2 * 0.08 * 0.001 + 0.019 * 0.001),
                            (sections.Channel(0.025, 0.04, ALUMINIUM), 0.09 * 0.001),
                            (sections.ISection(0.03, 0.04, ALUMINIUM), 0.099 * 0.001)):
            mesh = SectionMesh(shape.blocks(6, 4))
            self.assertAlmostEqual(sum(map(mesh.area, mesh.cells)) / area, 1, 12)
            self.assertAlmostEqual(sum(mesh.nodal_areas()) / area, 1, 12)

    def test_the_web_shares_its_nodes(self):
        box = sections.Box(0.06, 0.02, *(ALUMINIUM,) * 4, web=ALUMINIUM, x_web=0.01)
        mesh = SectionMesh(box.blocks(9, 3))
        edges = {}
        for cell in mesh.cells:
            for a, b in zip(cell.nodes[:4], cell.nodes[1:4] + cell.nodes[:1]):
                edges[frozenset((a, b))] = edges.get(frozenset((a, b)), 0) + 1
        # Euler: corners - edges + cells is 1 - holes; two cells of the box are two holes.
        self.assertEqual(len(mesh.corner) - len(edges) + len(mesh.cells), -1)

    def test_consistent_forces_of_a_face(self):
        square = [(x, 0.0, z) for x, z in ((0, 0), (2, 0), (2, 3), (0, 3), (1, 0), (2, 1.5), (1, 3),
                                           (0, 1.5))]
        parts = face_integrals(square)
        for i, part in enumerate(parts):
            self.assertAlmostEqual(part, 6 * (-1 / 12 if i < 4 else 1 / 3), 12)

    def test_line_load_of_a_tapered_strip(self):
        chord = 0.06
        mesh = sweep(sections.strip_blocks(chord, [("foam", 0, 0.002)], 3, [1]), 0.5, 7, MATERIALS,
                     "C3D20R", lambda z: 1 - z)
        forces = mesh.line_load(lambda z: chord * (1 - z))
        self.assertAlmostEqual(sum(forces.values()), 0.5, 9)
        moment = sum(f * mesh.nodes[n][2] for n, f in forces.items())
        self.assertAlmostEqual(moment, 0.125, 9)

    def test_motion_of_a_rigid_section(self):
        nodes = [(1, 0.0, 0.0, 2.0), (2, 1.0, 0.0, 1.0), (3, 1.0, 0.5, 1.0), (4, 0.0, 0.5, 3.0)]
        u, v, theta, tilt = 0.3, -0.2, 1e-3, 4e-3
        moved = {n: (u - theta * y, v + theta * x, 0.7 - tilt * y) for n, x, y, _ in nodes}
        motion = section_motion(Station(0.0, nodes), moved)
        for key, value in (("u", u), ("v", v), ("theta", theta), ("slope_plunge", tilt),
                           ("slope_chordwise", 0.0)):
            self.assertAlmostEqual(motion[key], value, 12)


class ClosedForms(unittest.TestCase):
    def test_isotropic_strip(self):
        m = MATERIALS["aluminium"]
        d11, d16, d66 = cf.strip_compliance([("aluminium", 25, 0.001)] * 2, MATERIALS)
        self.assertAlmostEqual(d11 * m["e_l_pa"] * 0.002**3 / 12, 1, 9)
        self.assertAlmostEqual(d66 * m["g_lt_pa"] * 0.002**3 / 12, 1, 9)
        self.assertLess(abs(d16), 1e-9 * d11)

    def test_two_equal_cells_are_one_cell_with_an_idle_web(self):
        whole, halves = cf.box(0.06, 0.02, 0.001), cf.box(0.06, 0.02, 0.001, 0.03)
        self.assertAlmostEqual((halves["j"] - 0.02 * 0.001**3 / 3) / whole["j"], 1, 12)


class Solver(unittest.TestCase):
    def test_numbers_fit_the_twenty_characters_of_a_field(self):
        for value in (-7.0075757575757576e-05, -1 / 3, 141.96e9, -0.037):
            self.assertLessEqual(len(ccx.number(value)), 20)
            self.assertAlmostEqual(float(ccx.number(value)) / value, 1, 11)

    def test_tables_are_read_in_order(self):
        text = ("\n displacements (vx,vy,vz) for set PRINTED and time  0.1000000E+01\n\n"
                "         7  1.000000E+00 -2.000000E+00  3.000000E-01\n\n"
                " total mass for set EALL and time  0.1000000E+01\n\n        1.196210E-02\n\n"
                "     E I G E N V A L U E   O U T P U T\n\n MODE NO    EIGENVALUE\n\n"
                "      1   0.6E+03   0.25E+02   0.4E+01   0.0E+00\n\n"
                "     P A R T I C I P A T I O N   F A C T O R S\n\n"
                "      1   0.1E+01   0.1E+01   0.1E+01   0.1E+01\n\n"
                " displacements (vx,vy,vz) for set PRINTED and time  0.2000000E+01\n\n"
                "         7  0.000000E+00  5.000000E+00  0.000000E+00\n")
        moved, modes, mass = ccx.read(text, 1, 1)
        self.assertEqual(moved, [{7: (1.0, -2.0, 0.3)}])
        self.assertEqual(modes, [(4.0, {7: (0.0, 5.0, 0.0)})])
        self.assertEqual(mass, 0.01196210)
        with self.assertRaises(RuntimeError):
            ccx.read(text, 2, 1)


if __name__ == "__main__":
    unittest.main()
