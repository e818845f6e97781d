"""Closed forms that the finite-element numbers are held against: classical lamination theory of a
strip with free chord, Euler-Bernoulli, Bredt for one and two cells, Vlasov for open sections."""

import math

BENDING_ROOTS = (1.87510407, 4.69409113, 7.85475744, 10.99554073)


def reduced_stiffness(material, angle_deg):
    """Plane-stress stiffness of a ply in axes (z, s): rows z, s, zs."""
    c, s = math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))
    nu_tl = material["nu_lt"] * material["e_t_pa"] / material["e_l_pa"]
    d = 1 - material["nu_lt"] * nu_tl
    q11, q22 = material["e_l_pa"] / d, material["e_t_pa"] / d
    q12, q66 = material["nu_lt"] * material["e_t_pa"] / d, material["g_lt_pa"]
    a, b = q11 - q12 - 2 * q66, q12 - q22 + 2 * q66
    q = [[0.0] * 3 for _ in range(3)]
    q[0][0] = q11 * c**4 + 2 * (q12 + 2 * q66) * s**2 * c**2 + q22 * s**4
    q[1][1] = q11 * s**4 + 2 * (q12 + 2 * q66) * s**2 * c**2 + q22 * c**4
    q[0][1] = q[1][0] = (q11 + q22 - 4 * q66) * s**2 * c**2 + q12 * (s**4 + c**4)
    q[2][2] = (q11 + q22 - 2 * q12 - 2 * q66) * s**2 * c**2 + q66 * (s**4 + c**4)
    q[0][2] = q[2][0] = a * s * c**3 + b * s**3 * c
    q[1][2] = q[2][1] = a * s**3 * c + b * s * c**3
    return q


def inverse(matrix):
    """Gauss-Jordan with pivoting after scaling rows and columns by the diagonal."""
    n = len(matrix)
    scale = [1 / math.sqrt(matrix[i][i]) for i in range(n)]
    rows = [[matrix[i][j] * scale[i] * scale[j] for j in range(n)]
            + [1.0 if i == j else 0.0 for j in range(n)] for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [v / rows[i][i] for v in rows[i]]
        for r in range(n):
            if r != i:
                rows[r] = [v - rows[r][i] * p for v, p in zip(rows[r], rows[i])]
    return [[rows[i][n + j] * scale[i] * scale[j] for j in range(n)] for i in range(n)]


def strip_compliance(plies, materials):
    """Compliances per unit width with no force but the two moments: d11 (bending), d16 (coupling),
    d66 (twist) of curvatures (k_z, k_zs = 2 theta') [1/(N m)]."""
    height = sum(p[2] for p in plies)
    abd = [[0.0] * 6 for _ in range(6)]
    low = -height / 2
    for name, angle, thickness in plies:
        q, high = reduced_stiffness(materials[name], angle), low + thickness
        for i in range(3):
            for j in range(3):
                abd[i][j] += q[i][j] * thickness
                abd[i + 3][j] += q[i][j] * (high**2 - low**2) / 2
                abd[i][j + 3] = abd[i + 3][j]
                abd[i + 3][j + 3] += q[i][j] * (high**3 - low**3) / 3
        low = high
    d = inverse(abd)
    return d[3][3], d[3][5], d[5][5]


def integrate(function, length, steps=400):
    """Simpson."""
    h = length / steps
    return h / 3 * sum(function(i * h) * (1 if i in (0, steps) else 4 if i % 2 else 2)
                       for i in range(steps + 1))


def warping_length(compliance, chord):
    """Distance over which a clamped root holds the warping of a strip [m]: sqrt(E I_w / G J), with
    G J free to bend and E I_w from bending of the wall with the twist held."""
    d11, d16, d66 = compliance
    return chord * math.sqrt(d66**2 / (d11 * d66 - d16**2) / 48)


def strip_line_load(compliance, chord_at, length, shear_compliance=0.0):
    """Tip plunge [m] and twist [rad] under 1 N/m upward; shear_compliance: chord / (k G A) [m/N].
    Curvatures of the wall are k = -v'' and, as s runs to -x, +2 theta'; the load gives
    M_z = -(L - z)^2 / 2. The twist rate r obeys r - l^2 r'' = that of the free section, with r = 0
    at the root and the warping length l there; what is missing of it stiffens the bending."""
    d11, d16, d66 = compliance
    reach = warping_length(compliance, chord_at(0))
    factor = -d16 / (2 * chord_at(0))
    start = factor * (length**2 / 2 + reach**2)

    def free_rate(z):
        return -d16 / (2 * chord_at(z)) * (length - z)**2 / 2

    def missing_rate(z):
        return factor * reach**2 - start * math.exp(-z / reach)

    twist = integrate(lambda z: free_rate(z) + missing_rate(z), length)
    plunge = integrate(lambda z: (length - z) * (
        d11 / chord_at(z) * (length - z)**2 / 2 - 2 * d16 / d66 * missing_rate(z)
        + shear_compliance / chord_at(z)), length)
    return plunge, twist


def strip_torque(compliance, chord, length):
    """Tip twist [rad] under 1 N m at the tip of a uniform strip, warping held at the root."""
    reach = warping_length(compliance, chord)
    return compliance[2] / (4 * chord) * (length - reach * math.tanh(length / reach))


def sandwich_torque(face, core, angle_deg, chord, length):
    """Tip twist [rad] under 1 N m of a symmetric sandwich whose core shears: face, core: (material,
    thickness). With p the sliding of one face on the other beyond that of rigid normals, the
    face's shear p'/2 - d theta' and the core's p / h are in balance: p'' = mu^2 p, free edges.
    Bredt's value 2 G t d^2 c loses the share tanh(a) / a, a = mu c / 2; the root holds the warping
    that is left."""
    (material, t), (filler, h) = face, core
    s = inverse(reduced_stiffness(material, angle_deg))
    shear = 1 / s[2][2]  # of a face free to stretch
    axial = s[2][2] / (s[0][0] * s[2][2] - s[0][2]**2)  # of a face held against shear
    d, mu = h + t, math.sqrt(2 * filler["g_lt_pa"] / (h * shear * t))
    a = mu * chord / 2
    gj = 2 * shear * t * d**2 * chord * (1 - math.tanh(a) / a)

    def warping(x):
        return d * (math.sinh(mu * x) / (mu * math.cosh(a)) - x / 2)

    eiw = 2 * axial * t * integrate(lambda x: warping(x - chord / 2)**2, chord)
    return restrained_twist(gj, eiw, length)


def bending_hz(ei, mass, length, mode):
    return BENDING_ROOTS[mode]**2 / (2 * math.pi * length**2) * math.sqrt(ei / mass)


def torsion_hz(gj, inertia, length, boundary=0.0):
    """First torsion mode; a root whose warping is held shortens the beam by `boundary`."""
    return math.sqrt(gj / inertia) / (4 * (length - boundary))


def restrained_twist(gj, eiw, length):
    """Twist of the tip under a unit tip torque, warping held at the root and free at the tip."""
    k = math.sqrt(gj / eiw)
    return (length - math.tanh(k * length) / k) / gj


def box(width, height, t, web_from_front=None):
    """Mid-line rectangle of one wall thickness, with or without a vertical web: area, second
    moments about the centroid, torsion constant (Bredt plus the walls' own), distance of the
    centroid from the middle of the rectangle, towards the front."""
    walls = [(width, t * width * height**2 / 4 * 2, t * width**3 / 12 * 2),
             (height, t * height**3 / 12 * 2, t * height * width**2 / 4 * 2)]
    area = 2 * t * (width + height)
    i_flap, i_lag = (sum(w[k] for w in walls) for k in (1, 2))
    own = 2 * (width + height) * t**3 / 3
    if web_from_front is None:
        return {"area": area, "i_flap": i_flap, "i_lag": i_lag, "shift": 0.0,
                "j": 4 * (width * height)**2 * t / (2 * (width + height)) + own}
    x_web = width / 2 - web_from_front
    shift = t * height * x_web / (area + t * height)
    i_lag += t * height * x_web**2 - (area + t * height) * shift**2
    a1, a2 = web_from_front * height, (width - web_from_front) * height
    l1, l2 = 2 * web_from_front + 2 * height, 2 * (width - web_from_front) + 2 * height
    # Equal twist of both cells: (l_i q_i - height q_j) / (2 A_i G t theta') = 1, with G theta' = 1.
    det = l1 * l2 - height**2
    q1, q2 = (2 * t * (a1 * l2 + a2 * height) / det, 2 * t * (a2 * l1 + a1 * height) / det)
    return {"area": area + t * height, "i_flap": i_flap + t * height**3 / 12, "i_lag": i_lag,
            "shift": shift, "j": 2 * (a1 * q1 + a2 * q2) + own + height * t**3 / 3}


def channel(width, height, t):
    """Flanges `width` long to one side of a web `height` high (mid-lines): J, area, warping
    constant about the shear centre, distance of that centre behind the web, second moment."""
    return {"j": (2 * width + height) * t**3 / 3, "area": (2 * width + height) * t,
            "iw": t * width**3 * height**2 / 12 * (3 * width + 2 * height) / (6 * width + height),
            "e": 3 * width**2 / (6 * width + height),
            "i_flap": t * height**3 / 12 + 2 * t * width * height**2 / 4 + width * t**3 / 6}


def i_section(width, height, t):
    """Flanges `width` wide, web `height` high between their mid-lines."""
    return {"j": (2 * width + height) * t**3 / 3, "area": (2 * width + height) * t,
            "iw": t * width**3 * height**2 / 24, "e": 0.0,
            "i_flap": t * height**3 / 12 + 2 * t * width * height**2 / 4 + width * t**3 / 6}
