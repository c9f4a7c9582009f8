"""Makes twin_variational.h5: the contact law `variational` on stored shapes, and cells at rest.

    OPENBLAS_NUM_THREADS=1 python3 run_variational.py ../twin_variational.h5
"""

import sys
import time

import h5py
import numpy as np

from mesh import Mesh
from model import Parameters
from run_twin import deformed, placed, put, put_measures, put_provenance, random_rotation
from variational import (
    TooDeep,
    VariationalModel,
    are_inside,
    mean_energies,
    nearest_features,
    subdivision,
)

LARGEST_MOVE_UM = 0.01  # of a node in one step of the descent
AT_REST_NN = 1e-6  # largest nodal force


def parameters():
    """The paper's case A with the volume controller that has an energy, and nothing that rubs
    between the cells: rest does not depend on friction."""
    return Parameters(
        T_I_s=np.inf,
        T_d_s=0.0,
        friction_normal_kPa_s_per_um=0.0,
        friction_tangential_kPa_s_per_um=0.0,
    )


# The program's own checks. ----------------------------------------------------------------------


def check_parts(law, random):
    """A part and the four that it is cut into have the same energy: other cases of the cut."""
    weights, parts = subdivision(2)
    delta = random.uniform(-1, 1, size=(200, 3))
    whole = mean_energies(delta, law).real
    fine = mean_energies((delta @ weights.T)[:, parts].reshape(-1, 3), law).real
    return np.abs(fine.reshape(200, 4).mean(axis=1) - whole).max() / np.abs(whole).max()


def check_distances(mesh, random):
    """Nearest points against a search among many points of every triangle (never nearer, and not
    much farther), and insides against the planes of a convex polyhedron."""
    corners = mesh.unit_shape[mesh.triangles]
    p = random.uniform(-1.3, 1.3, size=(100, 3))
    distance, triangle, _ = nearest_features(p, corners)
    weights, _ = subdivision(60)
    points = np.einsum("sc,tcx->tsx", weights, corners)
    found = np.array([np.linalg.norm(points - q, axis=2).min() for q in p])
    assert (distance < found + 1e-12).all() and (found - distance < 0.01).all()
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    heights = np.einsum("tx,ptx->pt", normals, p[:, None] - corners[None, :, 0])
    assert (are_inside(p, corners) == (heights < 0).all(axis=1)).all()


def check_forces(model, x, random):
    """Against the slope of the energy, and what a law between two bodies may not do: push or turn
    both of them together."""
    contacts = model.contact_pairs(x)
    force = model.contact_force(x, contacts)
    size = np.linalg.norm(force)
    direction, step = random.normal(size=x.shape), 1e-6
    before, after = (model.contact_energy(x + sign * step * direction) for sign in (-1, 1))
    errors = [abs(np.sum(force * direction) + (after - before) / (2 * step)) / size]
    for contact in contacts:
        a, b = contact.force_a, contact.force_b
        own = np.abs(a).sum()
        torque = np.cross(x[contact.cell_a], a).sum(axis=0)
        torque += np.cross(x[contact.cell_b], b).sum(axis=0)
        errors += [np.abs((a.sum(axis=0) + b.sum(axis=0))).max() / own]
        errors += [np.abs(torque).max() / own / model.radius[0]]
    return max(errors)


# Rest. ------------------------------------------------------------------------------------------


def follow(model, x, duration_s, step_s, stages):
    """The motion Gamma v = F, by the explicit method of first order with Chebyshev's polynomials
    (van der Houwen and Sommeijer 1980): stable up to steps of 1.9 stages^2 over the fastest rate.

    A contact that grows catches on the mesh, and can rest in many places, whose areas differ by
    percents. The motion decides in which; a descent straight from the start may find another one.
    """
    w0 = 1 + 0.05 / stages**2
    T, slope = [1.0, w0], [0.0, 1.0]  # Chebyshev's polynomials at w0
    for _ in range(2, stages + 1):
        slope.append(2 * T[-1] + 2 * w0 * slope[-1] - slope[-2])
        T.append(2 * w0 * T[-1] - T[-2])
    w1 = T[stages] / slope[stages]
    no_integral = np.zeros(model.n_cells)
    for _ in range(round(duration_s / step_s)):
        before, now = x, x + step_s * w1 / w0 * model.rates(x, no_integral)[0]
        for j in range(2, stages + 1):
            v, _ = model.rates(now, no_integral)
            after = (2 * w0 * T[j - 1] * now - T[j - 2] * before) / T[j]
            before, now = now, after + 2 * w1 * step_s * T[j - 1] / T[j] * v
        x = now
    return x


def descend(model, x):
    """The last part of the way down the energy to a state without forces, by the method L-BFGS
    (Nocedal 1980) with the friction matrix as its first guess of the stiffness and steps of bounded
    length."""
    inverse = np.linalg.inv(model.scalar_friction_matrix([]))

    def eased(gradient):
        return (inverse @ gradient.reshape(-1, 3)).reshape(gradient.shape)

    no_integral = np.zeros(model.n_cells)
    moves, changes = [], []
    forces = model.forces(x, no_integral)
    gradient, energy = -forces.total, model.energy(x, forces)
    evaluations = 1
    while np.linalg.norm(gradient, axis=-1).max() > AT_REST_NN:
        assert evaluations < 3000, "no rest was found"
        way, shares = gradient.copy(), []
        for move, change in zip(moves[::-1], changes[::-1]):
            shares.append(np.sum(move * way) / np.sum(move * change))
            way -= shares[-1] * change
        scale = 0.002  # s
        if moves:
            scale = np.sum(moves[-1] * changes[-1]) / np.sum(changes[-1] * eased(changes[-1]))
        way = scale * eased(way)
        for move, change, share in zip(moves, changes, shares[::-1]):
            way += move * (share - np.sum(change * way) / np.sum(move * change))
        step = min(1.0, LARGEST_MOVE_UM / np.linalg.norm(way, axis=-1).max())
        slope = -np.sum(gradient * way)
        while True:
            there = x - step * way
            evaluations += 1
            try:
                forces_there = model.forces(there, no_integral)
            except TooDeep:
                step /= 2
                continue
            energy_there = model.energy(there, forces_there)
            # Near rest rounding of the energy (1e-13 of it) hides its fall.
            if energy_there <= energy + 1e-4 * step * slope + 1e-12 * abs(energy) or step < 1e-4:
                break
            step /= 2
        move, change = there - x, -forces_there.total - gradient
        if step < 1e-4:
            moves, changes = [], []  # a kink: start anew
        elif np.sum(move * change) > 0:
            moves, changes = (moves + [move])[-20:], (changes + [change])[-20:]
        x, forces, gradient, energy = there, forces_there, -forces_there.total, energy_there
    return x, forces, evaluations


def fitted_sphere(points):
    """Least squares of |p|^2 = 2 p.c + (R^2 - |c|^2), linear in its unknowns (Coope 1993)."""
    origin = points.mean(axis=0)
    p = points - origin
    table = np.hstack([2 * p, np.ones((len(p), 1))])
    solved = np.linalg.lstsq(table, np.sum(p**2, axis=1), rcond=None)[0]
    centre = solved[:3]
    return origin + centre, np.sqrt(solved[3] + centre @ centre)


CAP_SHARE = 0.55  # of a cell's nodes: those farthest from the other cell are its free cap


def caps(x):
    """(contact radius, contact angle) of two cells: spheres through their free caps meet in a
    circle of this radius; the angle is the mean of those of the caps with the circle's plane."""
    axis = x[1].mean(axis=0) - x[0].mean(axis=0)
    spheres = []
    for cell, outward in ((0, -axis), (1, axis)):
        order = np.argsort(-(x[cell] @ outward))
        spheres.append(fitted_sphere(x[cell][order[: round(CAP_SHARE * len(order))]]))
    (c0, R0), (c1, R1) = spheres
    D = np.linalg.norm(c1 - c0)
    h0 = (D**2 + R0**2 - R1**2) / (2 * D)  # from the first centre to the plane
    angles = np.arccos([h0 / R0, (D - h0) / R1])
    return np.sqrt(R0**2 - h0**2), angles.mean()


# The file. --------------------------------------------------------------------------------------


def put_configuration(group, model, x):
    forces = model.forces(x, np.zeros(model.n_cells))
    put(group, "x", x, "um")
    put(group, "force/contact", forces.contact, "nN")
    put_measures(group, model, x, forces)
    group.attrs["contact_energy_fJ"] = sum(contact.energy for contact in forces.pairs)
    return forces


def put_rest(group, model, start, duration_s, step_s, stages):
    begin = time.process_time()
    x = follow(model, start, duration_s, step_s, stages)
    x, forces, evaluations = descend(model, x)
    at_start = model.energy(start, model.forces(start, np.zeros(model.n_cells)))
    put_configuration(group, model, x)
    group.attrs["motion_s"] = duration_s
    group.attrs["energy_fJ"] = model.energy(x, forces)
    group.attrs["energy_at_start_fJ"] = at_start
    group.attrs["largest_force_nN"] = np.linalg.norm(forces.total, axis=-1).max()
    group.attrs["evaluations_of_descent"] = evaluations
    group.attrs["contact_radius_um"], group.attrs["contact_angle_rad"] = caps(x)
    group.attrs["cpu_s"] = time.process_time() - begin
    for name in sorted(group.attrs):
        print(f"  {name} = {group.attrs[name]:.8g}")
    print(f"  contact area {sum(c.area for c in forces.pairs):.6f} um^2", flush=True)


def put_problem(file, name, model, centres, random):
    """centres: of the cells of every configuration [configurations, cells, 3]; each is turned and
    deformed anew."""
    print(name)
    group = file.create_group(name)
    for key, value in model.parameters.attributes().items():
        group.attrs[key] = value
    group.attrs["parts_per_edge"] = float(model.parts_per_edge)
    put(group, "mesh/unit_shape", model.mesh.unit_shape, "1")
    put(group, "mesh/triangles", model.mesh.triangles.astype(np.int32), "index")
    put(group, "radius", model.radius, "um")
    error = 0.0
    for n, of_cells in enumerate(centres):
        rotations = [random_rotation(random) for _ in model.radius]
        x = deformed(placed(model, of_cells, rotations), random)
        forces = put_configuration(group.create_group(f"configuration_{n}"), model, x)
        error = max(error, check_forces(model, x, random))
        area = sum(contact.area for contact in forces.pairs)
        assert area > 0
        print(f"  {n}: {len(forces.pairs)} contacts, area {area:.3f} um^2, error {error:.1e}")
    assert error < 1e-7, error
    group.attrs["n_configurations"] = float(len(centres))
    group.attrs["largest_error_of_own_checks"] = error
    return group


def put_start(group, model, centres, random):
    x = placed(model, centres, [random_rotation(random) for _ in model.radius])
    put(group, "start/x", x, "um")
    return x


def main(path):
    mesh, fine_mesh = Mesh(1), Mesh(2)
    axis = np.array([[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]])
    # From spheres that are 0.4 um apart, and adhere, to such that are 0.3 um inside each other.
    apart = [17.2 - overlap for overlap in (-0.4, -0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3)]
    # One cell in the middle and twelve around it.
    shell = mesh.unit_shape[:12] / np.linalg.norm(mesh.unit_shape[0])
    thirteen = np.vstack([np.zeros((1, 3)), shell])
    random = np.random.default_rng(2026)
    model = VariationalModel(mesh, [9.0, 8.2], parameters())
    error = check_parts(model.law, random)
    assert error < 1e-12, error
    check_distances(mesh, random)
    with h5py.File(path, "w") as file:
        centres = [distance * axis for distance in apart]
        group = put_problem(file, "doublet", model, centres, random)
        start = put_start(group, model, 17.0 * axis, random)
        put_rest(group.create_group("rest"), model, start, 10.0, 0.05, 5)

        model = VariationalModel(fine_mesh, [9.0, 8.2], parameters())
        group = put_problem(file, "fine_doublet", model, centres[5::2], random)
        start = put_start(group, model, 17.0 * axis, random)
        put_rest(group.create_group("rest"), model, start, 10.0, 0.05, 8)

        # Thirteen cells take too long to come to rest here.
        model = VariationalModel(mesh, np.full(13, 9.0), parameters())
        put_problem(file, "thirteen", model, [18.2 * thirteen], random)
        put_provenance(file, "run_variational.py ../twin_variational.h5")


if __name__ == "__main__":
    main(sys.argv[1])
