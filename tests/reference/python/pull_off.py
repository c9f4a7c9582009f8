"""Where the pull-off force of two rigid spheres is lost: which projection of the triangles.

Two spheres that adhere over h0 should pull with Derjaguin's force, pi R' W with R' = R + h0. The
program's pairs of triangles are projected along the pair's own normal n; the paper prints 'along
the partner's normal'. This script takes both, on the same meshes, and says how much of the force
and of the area comes out:

    OPENBLAS_NUM_THREADS=1 python3 pull_off.py [subdivisions] [orientations]
"""

import sys

import numpy as np
from contact import ContactLaw, clip, twice_area
from mesh import areas_and_normals, icosahedron, subdivided

R, H0, W = 9.0, 0.3, 0.5


def rotation(random):
    q = random.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def flat(points, origin, e1, e2):
    return [(float((p - origin) @ e1), float((p - origin) @ e2)) for p in points]


def frame(n):
    e1 = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    e1 /= np.linalg.norm(e1)
    return e1, np.cross(n, e1)


def pair_load(a, b, n_a, n_b, law, onto):
    """(force along the axis z, clip area on the contact plane) of one pair of triangles.

    onto: 'n' projects both along the pair's normal; 'b' projects A along B's normal into B's plane;
    'a' the other way round. The pressure is the program's in all of them.
    """
    m = n_b - n_a
    c = np.linalg.norm(m) / 2
    n = m / (2 * c)
    o_a, o_b = n_a @ a[0] + law.h0, n_b @ b[0] + law.h0
    direction = {"n": n, "a": n_a, "b": n_b}[onto]
    origin = {"n": a[0], "a": a[0], "b": b[0]}[onto]
    e1, e2 = frame(direction)
    plane = (o_b - o_a) / (2 * c)

    def delta(p):
        x = origin + p[0] * e1 + p[1] * e2
        x = x + (plane - n @ x) * n  # along n into the contact plane
        return (o_a + o_b - (n_a + n_b) @ x) / c

    flat_a, flat_b = flat(a, origin, e1, e2), flat(b, origin, e1, e2)
    polygon = flat_a
    sign = 1.0 if twice_area(*flat_b) > 0 else -1.0
    for k in range(3):
        p, q = flat_b[k], flat_b[(k + 1) % 3]
        polygon = clip(polygon, lambda x, p=p, q=q: sign * twice_area(p, q, x))
    polygon = clip(polygon, delta)
    force = area = 0.0
    on_contact_plane = abs(direction @ n)
    for k in range(1, len(polygon) - 1):
        corners = (polygon[0], polygon[k], polygon[k + 1])
        part = 0.5 * abs(twice_area(*corners)) * on_contact_plane
        area += part
        for i in range(3):
            p, q = corners[i], corners[(i + 1) % 3]
            middle = (0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]))
            force += part / 3 * (law.k * delta(middle) - law.P0)
    return force * n[2], area


def spheres(subdivisions, overlap, random):
    points, faces = icosahedron()
    for _ in range(subdivisions):
        points, faces = subdivided(points, faces)
    points, faces = np.array(points), np.array(faces)
    volume = np.sum(
        np.cross(points[faces[:, 0]], points[faces[:, 1]]) * points[faces[:, 2]]
    ) / 6
    points = points * (4 / 3 * np.pi / volume) ** (1 / 3) * R
    half = (2 * R + 2 * H0 - overlap) / 2
    lower = points @ rotation(random).T - [0, 0, half]
    upper = points @ rotation(random).T + [0, 0, half]
    return lower, upper, faces


def total(lower, upper, faces, law, onto):
    _, normals_a = areas_and_normals(lower, faces)
    _, normals_b = areas_and_normals(upper, faces)
    a, b = lower[faces], upper[faces]
    centre_a, centre_b = a.mean(axis=1), b.mean(axis=1)
    reach = 2 * np.linalg.norm(a[0] - centre_a[0], axis=1).max() + 2.0
    A = np.nonzero(centre_a[:, 2] > -2.0)[0]
    B = np.nonzero(centre_b[:, 2] < 2.0)[0]
    force = area = 0.0
    for i in A:
        for j in B[np.linalg.norm(centre_b[B] - centre_a[i], axis=1) < reach]:
            f, s = pair_load(a[i], b[j], normals_a[i], normals_b[j], law, onto)
            force += f
            area += s
    return force, area


def main(subdivisions=3, orientations=4):
    law = ContactLaw(H0, W / H0, W / (2 * H0**2), 0.0, 2 * H0 + 1)
    overlap = 2 * H0  # P vanishes on the axis: the largest pull
    derjaguin = np.pi * (R + H0) * W
    print(
        f"{10 * 4**subdivisions + 2} nodes, {orientations} orientations; Derjaguin {derjaguin:.2f} nN"
    )
    print("projection          pull over Derjaguin     clip area, um^2")
    results = {"n": [], "a": [], "b": []}
    for seed in range(orientations):
        random = np.random.default_rng(seed)
        lower, upper, faces = spheres(subdivisions, overlap, random)
        for onto, values in results.items():
            values.append(total(lower, upper, faces, law, onto))
    names = {"n": "along n", "a": "along n_A", "b": "along n_B"}
    for onto, values in results.items():
        force, area = np.array(values).T
        ratio = np.abs(force) / derjaguin
        error = ratio.std(ddof=1) / len(ratio) ** 0.5
        print(f"{names[onto]:<16} {ratio.mean():10.4f} +- {error:.4f} {area.mean():16.3f}")


if __name__ == "__main__":
    main(*[int(word) for word in sys.argv[1:]])
