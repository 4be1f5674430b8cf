"""First triangulations for Surface Evolver, as data files: a membrane of area 4 pi and reduced volume nu.

Ellipsoids are icosahedra whose sides are cut in three, 180 facets, on the ellipsoid that has that nu: after any number of refinements all but
twelve vertices have six neighbours, which the energy of a vertex star likes best. A stomatocyte cannot be had from one; it begins as an inner and
an outer sphere joined by half a torus, cut in rings of triangles that are nearly equilateral."""
import math

PI = math.pi


def icosahedron(cuts):
    """Vertices on the unit sphere, two of them at its poles; and triangles."""
    ring = lambda turn, z: [(math.cos(2 * PI * (k + turn) / 5) * 2 / 5**.5, math.sin(2 * PI * (k + turn) / 5) * 2 / 5**.5, z) for k in range(5)]
    corner = [(0, 0, 1)] + ring(0, 5**-.5) + ring(.5, -5**-.5) + [(0, 0, -1)]
    sides = []
    for k in range(5):
        a, b, c, d = 1 + k, 1 + (k + 1) % 5, 6 + k, 6 + (k + 1) % 5
        sides += [(0, a, b), (a, c, b), (b, c, d), (11, d, c)]
    number, places, triangles = {}, [], []

    def vertex(side, i, j):
        p = [sum(w * corner[s][t] for w, s in zip((cuts - i - j, i, j), side)) / cuts for t in range(3)]
        key = tuple(round(x, 7) + 0.0 for x in p)
        if key not in number:
            number[key] = len(places)
            places.append([x / math.hypot(*p) for x in p])
        return number[key]

    for side in sides:
        for i in range(cuts):
            for j in range(cuts - i):
                triangles.append((vertex(side, i, j), vertex(side, i + 1, j), vertex(side, i, j + 1)))
                if i + j < cuts - 1:
                    triangles.append((vertex(side, i + 1, j), vertex(side, i + 1, j + 1), vertex(side, i, j + 1)))
    return places, triangles


def revolved(meridian):
    """Area and volume of the surface that (r, z), ... sweeps round the z axis."""
    area = volume = 0
    for (r, z), (s, y) in zip(meridian, meridian[1:]):
        area += PI * (r + s) * math.hypot(s - r, y - z)
        volume += PI / 3 * (r * r + r * s + s * s) * (y - z)
    return area, volume


def ellipsoid(long, nu):
    low, high = 0.02, 1
    while high - low > 1e-9:
        flat = (low + high) / 2
        axis = 1 / flat if long else flat
        area, volume = revolved([(math.sin(PI * k / 1000), -axis * math.cos(PI * k / 1000)) for k in range(1001)])
        low, high = (flat, high) if 6 * PI**.5 * volume / area**1.5 < nu else (low, flat)
    size = (4 * PI / area)**.5
    places, triangles = icosahedron(3)
    return [(size * x, size * y, size * axis * z) for x, y, z in places], triangles


def bowl():
    """(r, z) from the pole of the inner sphere over the rim to that of the outer one, by the angle of the meridian."""
    turn, steps = 2.44, 4000
    inner, rim, outer = 0.55 * turn, 0.1 * PI, 0.78 * turn
    step = (inner + rim + outer) / steps
    r, z, points = 0.0, 0.0, []
    for k in range(steps):
        points.append((max(r, 0), z))
        s = (k + 0.5) * step
        angle = (-turn * s / inner if s < inner else -turn + PI * (s - inner) / rim if s < inner + rim
                 else PI - turn + turn * (s - inner - rim) / outer)
        r, z = r + math.cos(angle) * step, z + math.sin(angle) * step
    return points + [(0, z)]


def rings(meridian, edge):
    """Triangles of about that edge, at area 4 pi."""
    size = (4 * PI / revolved(meridian)[0])**.5
    count = round(len(meridian) * size * math.dist(meridian[0], meridian[1]) / edge * 1.12)
    places, triangles, before = [], [], None
    for k in range(count + 1):
        r, z = (size * x for x in meridian[round(k * (len(meridian) - 1) / count)])
        n = 1 if k in (0, count) else max(5, round(2 * PI * r / edge))
        turn, first = k % 2 / 2, len(places)
        places += [(r * math.cos(2 * PI * (j + turn) / n), r * math.sin(2 * PI * (j + turn) / n), z) for j in range(n)]
        if before:
            triangles += zipped(before, (first, n, turn))
        before = first, n, turn
    return places, triangles


def zipped(one, two):
    """Between two rings (first vertex, how many, turn): the next triangle has its base where it is shorter to go."""
    (a, n, p), (b, m, q), i, j = one, two, 0, 0
    while (n > 1 and i < n) or (m > 1 and j < m):
        if m == 1 or (n > 1 and i < n and (j >= m or (i + 1 + p) / n <= (j + 1 + q) / m)):
            yield a + i % n, a + (i + 1) % n, b + j % m
            i += 1
        else:
            yield a + i % n, b + (j + 1) % m, b + j % m
            j += 1


def datafile(places, triangles, nu):
    """The Willmore energy at that area and volume. Triangles turn about their outer normals."""
    edge, ends, rows = {}, [], []
    for corners in triangles:
        row = []
        for a, b in zip(corners, corners[1:] + corners[:1]):
            if (b, a) not in edge:
                ends.append((a, b))
                edge[a, b] = len(ends)
            row.append(-edge[b, a] if (b, a) in edge else edge[a, b])
        rows.append(row)
    lines = ["quantity bend energy method star_perp_sq_mean_curvature global",
             f"quantity ar fixed = {4 * PI:.15g} method facet_area global", "vertices"]
    lines += [f"{k + 1} {x:.12g} {y:.12g} {z:.12g}" for k, (x, y, z) in enumerate(places)]
    lines += ["edges"] + [f"{k + 1} {a + 1} {b + 1}" for k, (a, b) in enumerate(ends)]
    lines += ["faces"] + [f"{k + 1} {' '.join(map(str, row))} tension 0" for k, row in enumerate(rows)]
    lines += ["bodies", f"1 {' '.join(str(k + 1) for k in range(len(rows)))} volume {4 * PI / 3 * nu:.15g}", "read"]
    return "\n".join(lines) + "\n"


def start(family, nu):
    return datafile(*(rings(bowl(), 0.24) if family == "stomatocyte" else ellipsoid(family == "prolate", nu)), nu)
