"""Contact of two triangles, eqns (5)-(7) of Cuvelier et al. 2021, in the paper's normal-only form.

Both surfaces are moved outward by h0. Two triangles A and B of different cells meet in the plane
that bisects the wedge between their moved planes; its normal n = (n_B - n_A)/|n_B - n_A| points
from B to A. The overlap along n is delta(x) = [o_A + o_B - (n_A + n_B).x]/c with o = n.corner + h0
and c = |n_B - n_A|/2. The pressure P = k delta - P0 acts on the polygon in which both triangles,
projected along n, and delta >= 0 meet.
"""

from dataclasses import dataclass

import numpy as np

SMALLEST_POLYGON_UM2 = 1e-9
SMALLEST_PROJECTION = 1e-6  # of the triangle's own area: it is seen edge-on


@dataclass
class ContactLaw:
    h0: float  # um
    P0: float  # kPa
    k: float  # kPa/um
    reject_cos: float  # pairs with n_A . n_B >= this are no contact
    largest_overlap: float  # um; deeper pairs are surfaces that passed each other


@dataclass
class Pair:
    """Two triangles that act on each other; nodes are numbers among all nodes of all cells."""

    cell_a: int
    cell_b: int
    nodes_a: tuple
    nodes_b: tuple
    normal: np.ndarray
    area: float  # um^2
    f: list  # nN; node i of A feels + f_i n
    g: list  # nN; node k of B feels - g_k n
    lam: list  # barycentric coordinates of the polygon's centroid in A
    mu: list  # and in B


def clip(polygon, inside):
    """Sutherland and Hodgman 1974: the part of a polygon where the affine `inside` is >= 0."""
    result = []
    for n, current in enumerate(polygon):
        previous = polygon[n - 1]
        d0, d1 = inside(previous), inside(current)
        if (d0 >= 0) != (d1 >= 0):
            s = d0 / (d0 - d1)
            result.append(
                (
                    previous[0] + s * (current[0] - previous[0]),
                    previous[1] + s * (current[1] - previous[1]),
                )
            )
        if d1 >= 0:
            result.append(current)
    return result


def twice_area(p, q, r):
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def barycentric(triangle, p):
    """Affine functions that are 1 at one corner and 0 at the others, at the point p."""
    whole = twice_area(*triangle)
    u, v, w = triangle
    return [twice_area(p, v, w) / whole, twice_area(u, p, w) / whole, twice_area(u, v, p) / whole]


def contact_in_plane(triangle_a, triangle_b, delta, law):
    """The pair in its plane: (area, f, g, lambda, mu), or None where the two do not meet.

    triangle_a, triangle_b: projected corners (three (u, v) tuples); delta: affine function of p.
    Everything integrated is at most quadratic: three edge mid-points per triangle are exact.
    """
    polygon = list(triangle_a)
    sign = 1.0 if twice_area(*triangle_b) > 0 else -1.0
    for n in range(3):
        p, q = triangle_b[n], triangle_b[(n + 1) % 3]
        polygon = clip(polygon, lambda x, p=p, q=q: sign * twice_area(p, q, x))
    polygon = clip(polygon, delta)
    if len(polygon) < 3:
        return None
    area, f, g = 0.0, [0.0] * 3, [0.0] * 3
    centroid = [0.0, 0.0]
    for n in range(1, len(polygon) - 1):
        corners = (polygon[0], polygon[n], polygon[n + 1])
        part = 0.5 * abs(twice_area(*corners))
        area += part
        for m in range(3):
            p, q = corners[m], corners[(m + 1) % 3]
            x = (0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]))
            weight = part / 3
            centroid[0] += weight * x[0]
            centroid[1] += weight * x[1]
            load = weight * (law.k * delta(x) - law.P0)
            for corner, value in enumerate(barycentric(triangle_a, x)):
                f[corner] += load * value
            for corner, value in enumerate(barycentric(triangle_b, x)):
                g[corner] += load * value
    if area < SMALLEST_POLYGON_UM2:
        return None
    middle = (centroid[0] / area, centroid[1] / area)
    if delta(middle) > law.largest_overlap:
        return None
    return area, f, g, barycentric(triangle_a, middle), barycentric(triangle_b, middle)


def contacts_of_cells(cell_a, cell_b, x_a, x_b, normals_a, normals_b, triangles, law):
    """All pairs of triangles of two cells that act on each other.

    x [nodes, 3], normals [triangles, 3] of either cell. What can be said about many pairs at once
    (angle, distance, projection) is done for all; the clipping goes pair by pair.
    """
    corners_a, corners_b = x_a[triangles], x_b[triangles]  # [triangles, corner, xyz]
    centre_a, centre_b = corners_a.mean(axis=1), corners_b.mean(axis=1)
    radius_a = np.linalg.norm(corners_a - centre_a[:, None], axis=2).max(axis=1)
    radius_b = np.linalg.norm(corners_b - centre_b[:, None], axis=2).max(axis=1)
    distance = np.linalg.norm(centre_a[:, None] - centre_b[None], axis=2)
    # Two points above each other are never farther apart than the overlap plus 2 h0 / c.
    reach = law.largest_overlap + 4 * law.h0
    near = distance < radius_a[:, None] + radius_b[None] + reach
    angle = normals_a @ normals_b.T < law.reject_cos
    A, B = np.nonzero(near & angle)
    if len(A) == 0:
        return []

    n_a, n_b = normals_a[A], normals_b[B]
    m = n_b - n_a
    c = np.linalg.norm(m, axis=1) / 2
    n = m / (2 * c)[:, None]
    a, b = corners_a[A], corners_b[B]
    # A frame in the plane: the world's axis that is farthest from n, made orthogonal to it.
    axis = np.eye(3)[np.argmin(np.abs(n), axis=1)]
    e1 = axis - np.sum(axis * n, axis=1)[:, None] * n
    e1 /= np.linalg.norm(e1, axis=1)[:, None]
    e2 = np.cross(n, e1)
    origin = a[:, 0]
    flat_a = np.stack([np.einsum("pcx,px->pc", a - origin[:, None], e) for e in (e1, e2)], axis=2)
    flat_b = np.stack([np.einsum("pcx,px->pc", b - origin[:, None], e) for e in (e1, e2)], axis=2)
    # delta(u, v) = d0 + du u + dv v; at the origin o_A is h0, for it is a corner of A.
    d0 = (law.h0 + np.sum(n_b * (b[:, 0] - origin), axis=1) + law.h0) / c
    du = -np.sum((n_a + n_b) * e1, axis=1) / c
    dv = -np.sum((n_a + n_b) * e2, axis=1) / c
    at_corners = d0[:, None] + du[:, None] * flat_a[..., 0] + dv[:, None] * flat_a[..., 1]
    highest = at_corners.max(axis=1)
    boxes_meet = np.all(
        (flat_a.min(axis=1) <= flat_b.max(axis=1)) & (flat_b.min(axis=1) <= flat_a.max(axis=1)),
        axis=1,
    )

    pairs = []
    n_nodes = len(x_a)
    for p in np.nonzero((highest >= 0) & boxes_meet)[0]:
        triangle_a = [tuple(corner) for corner in flat_a[p].tolist()]
        triangle_b = [tuple(corner) for corner in flat_b[p].tolist()]
        for flat, corners in ((triangle_a, a[p]), (triangle_b, b[p])):
            own = np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0]))
            if abs(twice_area(*flat)) < SMALLEST_PROJECTION * own:
                break
        else:
            k0, ku, kv = float(d0[p]), float(du[p]), float(dv[p])
            found = contact_in_plane(
                triangle_a, triangle_b, lambda x: k0 + ku * x[0] + kv * x[1], law
            )
            if found:
                nodes_a = tuple(cell_a * n_nodes + triangles[A[p]])
                nodes_b = tuple(cell_b * n_nodes + triangles[B[p]])
                pairs.append(Pair(cell_a, cell_b, nodes_a, nodes_b, n[p], *found))
    return pairs
