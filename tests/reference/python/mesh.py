"""The mesh of a cell: a subdivided icosahedron, and what its rest shape says."""

import numpy as np


def icosahedron():
    """Twelve corners on the unit sphere and twenty faces, counter-clockwise seen from outside."""
    golden = (1 + 5**0.5) / 2
    corners = []
    for one in (-1, 1):
        for g in (-golden, golden):
            corners += [(0, one, g), (one, g, 0), (g, 0, one)]
    corners = np.array(corners, dtype=float)
    faces = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                p, q, r = corners[i], corners[j], corners[k]
                sides = [np.linalg.norm(p - q), np.linalg.norm(q - r), np.linalg.norm(r - p)]
                if max(sides) < 2.1:  # all edges have length 2; the next distance is 2 golden
                    outward = np.dot(np.cross(q - p, r - p), p) > 0
                    faces.append((i, j, k) if outward else (i, k, j))
    assert len(faces) == 20
    return corners / np.linalg.norm(corners[0]), faces


def subdivided(points, faces):
    """Cuts every triangle in four; the new corners go onto the unit sphere."""
    points = [np.array(p) for p in points]
    middle_of = {}

    def middle(i, j):
        key = (min(i, j), max(i, j))
        if key not in middle_of:
            m = points[i] + points[j]
            points.append(m / np.linalg.norm(m))
            middle_of[key] = len(points) - 1
        return middle_of[key]

    finer = []
    for i, j, k in faces:
        ij, jk, ki = middle(i, j), middle(j, k), middle(k, i)
        finer += [(i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki)]
    return np.array(points), finer


def volume(x, triangles):
    """Of a closed mesh, and its derivative by every corner: V = 1/6 sum x_i . (x_j x x_k)."""
    p, q, r = x[triangles[:, 0]], x[triangles[:, 1]], x[triangles[:, 2]]
    gradient = np.zeros_like(x)
    np.add.at(gradient, triangles[:, 0], np.cross(q, r) / 6)
    np.add.at(gradient, triangles[:, 1], np.cross(r, p) / 6)
    np.add.at(gradient, triangles[:, 2], np.cross(p, q) / 6)
    return np.sum(p * np.cross(q, r)) / 6, gradient


def areas_and_normals(x, triangles):
    p, q, r = x[triangles[:, 0]], x[triangles[:, 1]], x[triangles[:, 2]]
    m = np.cross(q - p, r - p)
    length = np.linalg.norm(m, axis=1)
    return length / 2, m / length[:, None]


class Mesh:
    """Connectivity of a cell, and its rest shape for a radius of 1 um (volume 4/3 pi).

    edges: rows (i, j, a, b): the triangles on both sides are (i, j, a) and (j, i, b).
    """

    def __init__(self, subdivisions):
        points, faces = icosahedron()
        for _ in range(subdivisions):
            points, faces = subdivided(points, faces)
        self.triangles = np.array(faces)
        points *= (4 / 3 * np.pi / volume(points, self.triangles)[0]) ** (1 / 3)
        self.unit_shape = points
        opposite = {}  # of a directed edge: third corner and triangle
        for t, (i, j, k) in enumerate(faces):
            opposite[i, j], opposite[j, k], opposite[k, i] = (k, t), (i, t), (j, t)
        once = [(i, j) for i, j in opposite if i < j]
        self.edges = np.array([(i, j, opposite[i, j][0], opposite[j, i][0]) for i, j in once])
        self.sides = np.array([(opposite[i, j][1], opposite[j, i][1]) for i, j in once])
        # Rest lengths, areas, angles.
        i, j, a, b = self.edges.T
        self.edge_length = np.linalg.norm(points[j] - points[i], axis=1)
        self.area, _ = areas_and_normals(points, self.triangles)
        self.angle, _ = hinges(points, self.edges)
        self.node_area = np.zeros(len(points))
        for corner in range(3):
            np.add.at(self.node_area, self.triangles[:, corner], self.area / 3)

    @property
    def n_nodes(self):
        return len(self.unit_shape)


def hinges(x, edges):
    """Angle between the two triangles of every edge (0 flat, > 0 convex) and its derivatives.

    With e = x_j - x_i and the triangles' area vectors m_a = e x (x_a - x_i), m_b = (x_b - x_i) x e,
    moving a along its normal turns its triangle: d theta / d x_a = -|e| m_a / |m_a|^2. Moving i or
    j follows from the rigid motions, which do not change the angle. Returns theta [edges] and
    gradients for (i, j, a, b) [4][edges, 3].
    """
    i, j, a, b = (x[edges[:, n]] for n in range(4))
    e = j - i
    length = np.linalg.norm(e, axis=1)
    m_a, m_b = np.cross(e, a - i), np.cross(b - i, e)
    sine = np.sum(np.cross(m_a, m_b) * e, axis=1) / length
    cosine = np.sum(m_a * m_b, axis=1)
    by_a = -(length / np.sum(m_a**2, axis=1))[:, None] * m_a
    by_b = -(length / np.sum(m_b**2, axis=1))[:, None] * m_b
    u_a = (np.sum((a - i) * e, axis=1) / length**2)[:, None]
    u_b = (np.sum((b - i) * e, axis=1) / length**2)[:, None]
    by_j = -u_a * by_a - u_b * by_b
    by_i = -(1 - u_a) * by_a - (1 - u_b) * by_b
    return np.arctan2(sine, cosine), (by_i, by_j, by_a, by_b)
