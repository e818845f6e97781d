"""From displacements of nodes to the words of a beam: plunge, twist, slopes, kinds of modes."""

import math

CLEAR_MAJORITY = 0.8  # share of the kinetic energy that names a mode, as in core/sim.c


def mean(values, weights):
    return sum(v * w for v, w in zip(values, weights)) / sum(weights)


def slopes(x, y, w, weights):
    """Least-squares (dw/dx, dw/dy) of the axial displacement, or None for a section without
    thickness, whose rotation about x cannot be seen."""
    xx, yy, xy, xw, yw = (sum(a * b * m for a, b, m in zip(p, q, weights)) for p, q in (
        (x, x), (y, y), (x, y), (x, w), (y, w)))
    det = xx * yy - xy * xy
    if det <= 1e-12 * xx * xx:
        return None
    return (yy * xw - xy * yw) / det, (xx * yw - xy * xw) / det


def section_motion(station, displacement):
    """Rigid motion that fits a section best (weighted by mass): u, v at the origin of the section,
    w [m], theta [rad], cross-section rotations -dw/dx and -dw/dy [rad] (None for shells), and the
    kinetic parts (v, u, theta) about the mass centre for unit angular frequency."""
    weights = [n[3] for n in station.nodes]
    moved = [displacement[n[0]] for n in station.nodes]
    xc, yc = (mean([n[k] for n in station.nodes], weights) for k in (1, 2))
    uc, vc, wc = (mean([d[k] for d in moved], weights) for k in range(3))
    x, y = [n[1] - xc for n in station.nodes], [n[2] - yc for n in station.nodes]
    polar = sum(m * (a * a + b * b) for a, b, m in zip(x, y, weights))
    theta = sum(m * (a * d[1] - b * d[0]) for a, b, d, m in zip(x, y, moved, weights)) / polar
    tilt = slopes(x, y, [d[2] - wc for d in moved], weights)
    mass = sum(weights)
    return {"u": uc + theta * yc, "v": vc - theta * xc, "w": wc, "theta": theta,
            "slope_chordwise": None if tilt is None else -tilt[0],
            "slope_plunge": None if tilt is None else -tilt[1],
            "kinetic": (mass * vc * vc, mass * uc * uc, polar * theta * theta)}


def tip_record(mesh, displacement):
    """What a static case reports."""
    motion = section_motion(mesh.stations[-1], displacement)
    record = {"plunge_m": motion["v"], "chordwise_m": motion["u"], "axial_m": motion["w"],
              "twist_deg": math.degrees(motion["theta"])}
    if motion["slope_plunge"] is not None:
        record["slope_plunge_rad"] = motion["slope_plunge"]
        record["slope_chordwise_rad"] = motion["slope_chordwise"]
    return record


def mode_record(mesh, frequency, shape):
    """Frequency, label, shares of the kinetic energy and the shape along the span, mass-normalised
    and signed: the largest of tip v, u and theta times half the section's width is positive."""
    motions = [section_motion(s, shape) for s in mesh.stations]
    z = [s.z for s in mesh.stations]
    parts = [sum((b - a) * (p["kinetic"][k] + q["kinetic"][k]) / 2
                 for a, b, p, q in zip(z, z[1:], motions, motions[1:])) for k in range(3)]
    share = dict(zip(("bending", "lag", "torsion"), (p / sum(parts) for p in parts)))
    label = next((name for name, part in share.items() if part >= CLEAR_MAJORITY), "mixed")
    half = max(abs(n[1]) for n in mesh.stations[-1].nodes)
    tip = motions[-1]
    sign = math.copysign(1.0, max((tip["v"], tip["u"], tip["theta"] * half), key=abs))
    return {"frequency_hz": frequency, "label": label, "kinetic_share": share,
            "shape": {"z_m": z, "plunge": [sign * m["v"] for m in motions],
                      "chordwise": [sign * m["u"] for m in motions],
                      "twist_rad": [sign * m["theta"] for m in motions]}}
