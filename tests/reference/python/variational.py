"""The contact law `variational`: its energy, and forces by differentiating that energy numerically.

Two cells that touch have the energy

    E = 1/2 sum over both cells of the integral over its own surface of e(delta) dS,
    e(delta) = k delta^2/2 - P0 delta where delta > 0, else 0,
    delta(x) = 2 h0 - (signed distance from x to the other cell's surface, < 0 inside).

Every triangle is cut into m^2 equal parts. The distance is exact at their corners ('samples') and
affine in between; so the energy of a part is a sum over mid-points, exact for what is quadratic.

Nothing here is differentiated by hand. The energy is a chain of three functions, every one of few
numbers: overlap of a sample (its own place and the corners of the nearest triangle), mean energy of
a part (three overlaps), area of a triangle (three corners). Each is written so that it also takes
complex numbers, and its derivative is the imaginary part of f(x + i h) over h, exact to rounding
(Squire and Trapp 1998). Which triangle is nearest, and whether a face, an edge or a corner of it,
is found beforehand: the energy does not change to first order when that choice does, but at a kink.
"""

from dataclasses import dataclass

import numpy as np

from mesh import areas_and_normals
from model import Model

COMPLEX_STEP = 1e-30  # um: no difference is taken, so that it may be as small as one likes
FACE, EDGES, CORNERS = 0, (1, 2, 3), (4, 5, 6)  # edge k goes from corner k to corner k + 1


def subdivision(m):
    """Barycentric coordinates of the samples of a triangle [samples, 3], and its m^2 parts as rows
    of three samples."""
    number, weights = {}, []
    for i in range(m + 1):
        for j in range(m + 1 - i):
            number[i, j] = len(weights)
            weights.append(((m - i - j) / m, i / m, j / m))
    parts = []
    for i in range(m):
        for j in range(m - i):
            parts.append((number[i, j], number[i + 1, j], number[i, j + 1]))
            if i + j < m - 1:
                parts.append((number[i + 1, j + 1], number[i, j + 1], number[i + 1, j]))
    assert len(parts) == m * m
    return np.array(weights), np.array(parts)


def dot(a, b):
    """Without conjugation, which would not be analytic."""
    return np.sum(a * b, axis=-1)


# Where the other surface is. -----------------------------------------------------------------


def nearest_features(p, corners):
    """Of points p [points, 3] and triangles [triangles, corner, xyz]: the unsigned distance, and
    the triangle and its feature (FACE, one of EDGES, one of CORNERS) that are nearest."""
    best = np.full(len(p), np.inf)
    triangle, feature = np.zeros(len(p), dtype=int), np.zeros(len(p), dtype=int)
    for t, (a, b, c) in enumerate(corners):
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal)
        above_face = np.ones(len(p), dtype=bool)
        candidates = []
        for k, (start, end) in enumerate(((a, b), (b, c), (c, a))):
            along, to_p = end - start, p - start
            above_face &= to_p @ np.cross(normal, along) > 0
            s = to_p @ along / (along @ along)
            distance = np.linalg.norm(to_p - np.clip(s, 0, 1)[:, None] * along, axis=1)
            code = np.where(s <= 0, CORNERS[k], np.where(s >= 1, CORNERS[(k + 1) % 3], EDGES[k]))
            candidates.append((distance, code))
        # The nearest point of the face is nearer than any of its border, where it exists.
        height = np.where(above_face, np.abs((p - a) @ normal), np.inf)
        candidates.append((height, np.full(len(p), FACE)))
        for distance, code in candidates:
            nearer = distance < best
            best[nearer], triangle[nearer], feature[nearer] = distance[nearer], t, code[nearer]
    return best, triangle, feature


def are_inside(p, corners):
    """Whether points lie inside a closed surface: they see it under the solid angle 4 pi, others
    under 0 (angle of one triangle: Van Oosterom and Strackee 1983)."""
    angle = np.zeros(len(p))
    for triangle in corners:
        a, b, c = (corner - p for corner in triangle)
        A, B, C = (np.linalg.norm(v, axis=1) for v in (a, b, c))
        above = dot(a, np.cross(b, c))
        below = A * B * C + dot(a, b) * C + dot(b, c) * A + dot(c, a) * B
        angle += 2 * np.arctan2(above, below)
    return angle > 2 * np.pi


# The three functions that the energy is made of; all of them take complex numbers. --------------


def overlaps(p, a, b, c, feature, is_inside, h0):
    """delta at points p whose nearest triangle is (a, b, c), all [points, 3]."""
    corners = (a, b, c)
    squared = np.zeros(len(p), dtype=complex)
    normal = np.cross(b - a, c - a)
    on = feature == FACE
    squared[on] = (dot(normal, p - a) ** 2 / dot(normal, normal))[on]
    for k in range(3):
        start, along = corners[k], corners[(k + 1) % 3] - corners[k]
        across = np.cross(p - start, along)
        on = feature == EDGES[k]
        squared[on] = (dot(across, across) / dot(along, along))[on]
        on = feature == CORNERS[k]
        squared[on] = dot(p - start, p - start)[on]
    return 2 * h0 - np.where(is_inside, -1, 1) * np.sqrt(squared)


def mean_energies(delta, law):
    """Mean of e(delta) over parts with these overlaps at their corners [parts, 3], fJ/um^2.

    Mid-points of the sides are exact for a polynomial of degree two; where the line delta = 0 cuts
    a part, what is left is cut into triangles, each of them with its share of the area.
    """

    def over_triangle(p, q, r):
        middles = (p + q) / 2, (q + r) / 2, (r + p) / 2
        return sum((law.k / 2 * d - law.P0) * d for d in middles) / 3

    result = np.zeros(len(delta), dtype=complex)
    touches = delta.real > 0
    whole = touches.all(axis=1)
    result[whole] = over_triangle(*delta[whole].T)
    for k in range(3):
        p, q, r = delta[:, k], delta[:, (k + 1) % 3], delta[:, (k + 2) % 3]
        one, two, three = touches[:, k], touches[:, (k + 1) % 3], touches[:, (k + 2) % 3]
        # Corner p alone: from p the sides keep these shares of their lengths.
        on = one & ~two & ~three
        share = (p / (p - q) * p / (p - r))[on]
        result[on] = share * over_triangle(p[on], 0 * p[on], 0 * p[on])
        # Corner p is cut off: a quadrangle q, r, (r p), (p q).
        on = ~one & two & three
        of_r, of_q = (r / (r - p))[on], (q / (q - p))[on]
        result[on] = of_r * over_triangle(q[on], r[on], 0 * p[on])
        result[on] += (1 - of_r) * of_q * over_triangle(q[on], 0 * p[on], 0 * p[on])
    return result


def touching_shares(delta):
    """Share of each part where delta > 0."""
    touches = delta > 0
    result = touches.all(axis=1).astype(float)
    for k in range(3):
        p, q, r = delta[:, k], delta[:, (k + 1) % 3], delta[:, (k + 2) % 3]
        one, two, three = touches[:, k], touches[:, (k + 1) % 3], touches[:, (k + 2) % 3]
        on = one != two
        on &= two == three
        corner = (p[on] / (p - q)[on]) * (p[on] / (p - r)[on])
        result[on] = np.where(one[on], corner, 1 - corner)
    return result


def triangle_areas(a, b, c):
    m = np.cross(b - a, c - a)
    return np.sqrt(dot(m, m)) / 2


def slopes(function, arguments):
    """Derivatives of function(*arguments) [n] by every number of the arguments' rows: a list of
    arrays like the arguments."""
    result = []
    for number, argument in enumerate(arguments):
        slope = np.zeros(argument.shape)
        for column in range(argument.shape[1]):
            stepped = [x.astype(complex) for x in arguments]
            stepped[number][:, column] += 1j * COMPLEX_STEP
            slope[:, column] = function(*stepped).imag / COMPLEX_STEP
        result.append(slope)
    return result


# The law. ---------------------------------------------------------------------------------------


class TooDeep(Exception):
    """Surfaces that passed through each other, which the law leaves out: nothing to compare."""


@dataclass
class SurfaceContact:
    """Two cells that act on each other."""

    cell_a: int
    cell_b: int
    force_a: np.ndarray  # nN [nodes, 3]
    force_b: np.ndarray
    energy: float  # fJ
    area: float  # um^2: mean of the two surfaces' areas where delta > 0


def half_contact(x_own, x_other, triangles, m, law, with_forces=True):
    """The contact on one cell's own surface: half of the integral of e, half of the area, and the
    forces on the nodes of this cell and of the other one. None where nothing touches."""
    weights, parts = subdivision(m)
    corners, others = x_own[triangles], x_other[triangles]
    samples = np.einsum("sc,tcx->tsx", weights, corners)
    # A part that touches has a sample nearer than 2 h0; its other samples are one side farther.
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    reach = 2 * law.h0 + sides.max() / m

    def are_near(points, x):
        """Whether they may be nearer than that to a triangle with nodes of the cell x."""
        margin = reach + 1e-6
        return ((points > x.min(axis=0) - margin) & (points < x.max(axis=0) + margin)).all(axis=-1)

    near = are_near(samples, x_other)  # [triangles, samples]
    if not near.any():
        return None
    p = samples[near]
    # Triangles of the other cell whose box comes near to the box of these samples.
    low, high = p.min(axis=0) - reach, p.max(axis=0) + reach
    seen = np.nonzero(((others.max(axis=1) > low) & (others.min(axis=1) < high)).all(axis=1))[0]
    if len(seen) == 0:
        return None
    distance, found, feature = nearest_features(p, others[seen])
    nearest = seen[found]
    counts = distance < reach
    is_inside = np.zeros(len(p), dtype=bool)
    is_inside[counts] = are_inside(p[counts], others)

    # Overlaps of all samples; those far away have none, and belong to no part that touches.
    overlap = np.full(near.shape, -np.inf)
    a, b, c = others[nearest].swapaxes(0, 1)
    overlap[near] = overlaps(p, a, b, c, feature, is_inside, law.h0).real
    at_parts = overlap[:, parts]  # [triangles, parts, corner]
    owner, part = np.nonzero((at_parts > 0).any(axis=2))
    if len(owner) == 0:
        return None
    delta = at_parts[owner, part]
    assert np.isfinite(delta).all()
    if delta.max() > law.largest_overlap:
        raise TooDeep

    areas, _ = areas_and_normals(x_own, triangles)
    weight = areas[owner] / m**2 / 2
    energy = np.sum(weight * mean_energies(delta, law).real)
    area = np.sum(weight * touching_shares(delta))
    force_own, force_other = np.zeros_like(x_own), np.zeros_like(x_other)
    if not with_forces:
        return energy, area, force_own, force_other

    # Through the overlaps: dE/ddelta of every sample, then the places that it depends on.
    (by_delta,) = slopes(lambda d: mean_energies(d, law), [delta])
    by_overlap = np.zeros(near.shape)
    np.add.at(by_overlap, (owner[:, None], parts[part]), weight[:, None] * by_delta)
    load = by_overlap[near]
    acts = load != 0
    triangle_of, sample_of = (index[acts] for index in np.nonzero(near))
    feature, is_inside, nearest = feature[acts], is_inside[acts], nearest[acts]
    of_p, *of_corners = slopes(
        lambda *places: overlaps(*places, feature, is_inside, law.h0),
        [p[acts], a[acts], b[acts], c[acts]],
    )
    for corner in range(3):
        pull = (load[acts] * weights[sample_of, corner])[:, None] * of_p
        np.add.at(force_own, triangles[triangle_of, corner], -pull)
        np.add.at(
            force_other, triangles[nearest, corner], -load[acts][:, None] * of_corners[corner]
        )
    # Through the area of the triangles.
    density = np.zeros(len(triangles))
    np.add.at(density, owner, mean_energies(delta, law).real / m**2 / 2)
    for corner, slope in enumerate(slopes(triangle_areas, list(corners.swapaxes(0, 1)))):
        np.add.at(force_own, triangles[:, corner], -density[:, None] * slope)
    return energy, area, force_own, force_other


class VariationalModel(Model):
    """The model with this law; cells slide on each other without friction."""

    @property
    def parts_per_edge(self):
        """Samples of the largest cell at rest are no farther apart than the range 2 h0."""
        edge = self.radius.max() * self.mesh.edge_length.mean()
        return max(2, int(np.ceil(edge / (2 * self.law.h0))))

    def contact_pairs(self, x, with_forces=True):
        contacts = []
        for a in range(self.n_cells):
            for b in range(a + 1, self.n_cells):
                sides = [
                    half_contact(
                        x[own], x[other], self.mesh.triangles, self.parts_per_edge, self.law,
                        with_forces,
                    )
                    for own, other in ((a, b), (b, a))
                ]
                contact = SurfaceContact(a, b, np.zeros_like(x[a]), np.zeros_like(x[b]), 0.0, 0.0)
                for side, is_a in zip(sides, (True, False)):
                    if side is None:
                        continue
                    energy, area, own, other = side
                    contact.energy += energy
                    contact.area += area
                    contact.force_a += own if is_a else other
                    contact.force_b += other if is_a else own
                if any(sides):
                    contacts.append(contact)
        return contacts

    def contact_energy(self, x):
        return sum(contact.energy for contact in self.contact_pairs(x, with_forces=False))

    def contact_force(self, x, pairs):
        force = np.zeros_like(x)
        for contact in pairs:
            force[contact.cell_a] += contact.force_a
            force[contact.cell_b] += contact.force_b
        return force

    def cytosol_energy(self, volumes):
        """Of a proportional controller: minus the integral of P dV from the target volume on."""
        strain = volumes / self.target_volume - 1
        offset = np.array([self.offset_pressure(cell) for cell in range(self.n_cells)])
        return np.sum(self.target_volume * strain * (self.parameters.K_kPa * strain / 2 - offset))

    def energy(self, x, forces):
        """All that is stored, fJ."""
        return self.cytosol_energy(forces.volume) + sum(c.energy for c in forces.pairs) + sum(
            self.elastic_energy(cell, R) + self.bending_energy(cell) + self.tension_energy(cell)
            for cell, R in zip(x, self.radius)
        )

    def hydrostatic_stress(self, x, pairs, volumes):
        """3 V sigma = sum F_i.(x_i - x_a) + half of each contact's virial Y = - sum F_i.x_i over
        both cells. Tension positive; x_a: mean of the cell's nodes. kPa."""
        centre = x.mean(axis=1)
        virial = np.zeros(self.n_cells)
        for contact in pairs:
            a, b = contact.cell_a, contact.cell_b
            own = -np.sum(contact.force_a * (x[a] - centre[a]))
            own -= np.sum(contact.force_b * (x[b] - centre[a]))
            virial[a] += np.sum(contact.force_a * (x[a] - centre[a])) + own / 2
            virial[b] += np.sum(contact.force_b * (x[b] - centre[b])) + own / 2
        return virial / (3 * volumes)

    def velocity(self, forces):
        """Gamma v = F, eqn (1), with drag and cortex alone: the same matrix at every time."""
        if not hasattr(self, "inverse_friction"):
            self.inverse_friction = np.linalg.inv(self.scalar_friction_matrix([]))
        force = forces.total
        return (self.inverse_friction @ force.reshape(-1, 3)).reshape(force.shape)
