"""Makes twin.h5: problems, each at a stored configuration and after a stretch of time.

    OPENBLAS_NUM_THREADS=1 python3 run_twin.py ../twin.h5
"""

import platform
import sys
import time

import h5py
import numpy as np

from contact import clip, twice_area
from mesh import Mesh, volume
from model import Model, Parameters


def random_rotation(random):
    """Shoemake 1992: a unit quaternion, uniform on the sphere of rotations."""
    w, x, y, z = (q := random.normal(size=4)) / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def placed(model, centres, rotations):
    """Rest shapes, turned, at these centres [cells, nodes, 3]."""
    return np.array(
        [
            centre + R * model.mesh.unit_shape @ rotation.T
            for centre, R, rotation in zip(centres, model.radius, rotations)
        ]
    )


def deformed(x, random):
    """Each cell stretched, sheared and rough: nothing in the forces is zero by symmetry."""
    result = x.copy()
    for cell in range(len(x)):
        centre = x[cell].mean(axis=0)
        strain = np.eye(3) + 0.02 * random.normal(size=(3, 3))
        result[cell] = centre + (x[cell] - centre) @ strain.T
    return result + 0.08 * random.normal(size=x.shape)


def check(model, x, random):
    """Conservative forces against differences of their energies; pairs against Newton's third law;
    the clip against an area known in closed form. Returns the largest relative error."""
    errors = []
    R, step = model.radius[0], 1e-4
    direction = random.normal(size=x[0].shape)

    def energies(shape):
        return np.array(
            [
                model.elastic_energy(shape, R),
                model.bending_energy(shape),
                model.tension_energy(shape),
                volume(shape, model.mesh.triangles)[0],
            ]
        )

    slope = (energies(x[0] + step * direction) - energies(x[0] - step * direction)) / (2 * step)
    forces = [
        -model.elastic_force(x[0], R),
        -model.bending_force(x[0]),
        -model.tension_force(x[0]),
        volume(x[0], model.mesh.triangles)[1],
    ]
    for difference, gradient in zip(slope, forces):
        exact = np.sum(gradient * direction)
        errors.append(abs(difference - exact) / np.abs(gradient * direction).sum())

    flat = x.reshape(-1, 3)
    for pair in model.contact_pairs(x):
        rows = list(zip(pair.nodes_a, pair.f)) + [(k, -g) for k, g in zip(pair.nodes_b, pair.g)]
        size = sum(abs(f) for _, f in rows)
        origin = flat[pair.nodes_a[0]]
        torque = sum(np.cross(flat[node] - origin, f * pair.normal) for node, f in rows)
        errors += [abs(sum(f for _, f in rows)) / size, np.linalg.norm(torque) / size]

    # A square of side 1 cut by x + y <= 1/2: a corner of area 1/8.
    square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    corner = clip(square, lambda p: 0.5 - p[0] - p[1])
    fan = range(1, len(corner) - 1)
    area = sum(twice_area(corner[0], corner[n], corner[n + 1]) / 2 for n in fan)
    errors.append(abs(area - 1 / 8))
    return max(errors)


def put(group, name, values, unit):
    values = np.asarray(values)
    data = group.create_dataset(name, data=values, compression="gzip", shuffle=True)
    data.attrs["unit"] = unit


def put_measures(group, model, x, forces):
    put(group, "volume", forces.volume, "um^3")
    sigma = model.hydrostatic_stress(x, forces.pairs, forces.volume)
    put(group, "sigma_h", sigma, "kPa")
    areas = model.contact_areas(forces.pairs)
    put(group, "contact_cells", np.array([row[:2] for row in areas], dtype=np.int32), "index")
    put(group, "contact_area", np.array([row[2] for row in areas]), "um^2")
    return sigma


def put_configuration(group, model, x, integral, random):
    """Everything that one configuration says; also products with a random velocity field."""
    forces = model.forces(x, integral)
    put(group, "x", x, "um")
    put(group, "volume_integral", integral, "s")
    for name in ("elastic", "bending", "tension", "cytosol", "contact", "total"):
        put(group, "force/" + name, getattr(forces, name), "nN")
    put_measures(group, model, x, forces)
    u = random.normal(size=x.shape)
    put(group, "friction/u", u, "um/s")
    parts = model.medium_and_cortex_product(u)
    put(group, "friction/medium_and_cortex", parts, "nN")
    p = model.parameters
    equal = p.friction_normal_kPa_s_per_um, p.friction_tangential_kPa_s_per_um
    contact = model.contact_friction_product(u, forces.pairs, *equal)
    put(group, "friction/contact", contact, "nN")
    unequal = model.contact_friction_product(u, forces.pairs, 0.08, 0.03)
    put(group, "friction/contact_unequal", unequal, "nN")
    group["friction/contact_unequal"].attrs["normal_kPa_s_per_um"] = 0.08
    group["friction/contact_unequal"].attrs["tangential_kPa_s_per_um"] = 0.03
    volumes = model.volume_friction_product(u, forces.volume_gradient)
    put(group, "friction/total", parts + contact + volumes, "nN")
    v = model.velocity(forces)
    put(group, "v", v, "um/s")

    residual = model.medium_and_cortex_product(v) - forces.total
    residual += model.contact_friction_product(v, forces.pairs, *equal)
    residual += model.volume_friction_product(v, forces.volume_gradient)
    print(f"  {len(forces.pairs)} pairs, solver residual {np.abs(residual).max():.1e} nN")


def put_end(group, model, x, duration, n_steps):
    """Where the cells are after `duration`, and how far off that is when half as many steps are
    made. That is three times the error of a method of second order; less where the force jumps
    (a pair of triangles turns through reject_cos), but not less than the error."""
    begin = time.process_time()
    coarse, _ = model.integrate(x, duration, n_steps // 2)
    fine, integral = model.integrate(x, duration, n_steps)
    forces = model.forces(fine, integral)
    put(group, "x", fine, "um")
    put(group, "volume_integral", integral, "s")
    put(group, "v", model.velocity(forces), "um/s")
    sigma = put_measures(group, model, fine, forces)
    before = model.forces(coarse, integral)
    sigma_before = model.hydrostatic_stress(coarse, before.pairs, before.volume)
    area = sum(row[2] for row in model.contact_areas(forces.pairs))
    area_before = sum(row[2] for row in model.contact_areas(before.pairs))
    group.attrs["time_s"] = duration
    group.attrs["n_steps"] = n_steps
    group.attrs["x_change_by_halving_um"] = np.abs(fine - coarse).max()
    group.attrs["sigma_h_change_by_halving"] = (
        np.abs(sigma - sigma_before).max() / np.abs(sigma).mean()
    )
    group.attrs["area_change_by_halving"] = abs(area - area_before) / area
    group.attrs["cpu_s"] = time.process_time() - begin
    for name in sorted(group.attrs):
        print(f"  {name} = {group.attrs[name]:.4g}")
    print(f"  contact area {area:.4f} um^2, sigma_h {sigma[0]:.6f} kPa (first cell)")
    print(f"  fastest node {np.abs(model.velocity(forces)).max():.2e} um/s")


def put_problem(file, name, model, centres, start_centres, duration, n_steps, random):
    print(name)
    group = file.create_group(name)
    for key, value in model.parameters.attributes().items():
        group.attrs[key] = value
    put(group, "mesh/unit_shape", model.mesh.unit_shape, "1")
    put(group, "mesh/triangles", model.mesh.triangles.astype(np.int32), "index")
    put(group, "radius", model.radius, "um")
    rotations = np.array([random_rotation(random) for _ in model.radius])
    put(group, "rotation", rotations, "1")
    x = deformed(placed(model, centres, rotations), random)
    error = check(model, x, random)
    assert error < 1e-6, error
    group.attrs["largest_error_of_own_checks"] = error
    integral = 0.002 * random.normal(size=model.n_cells)
    put_configuration(group.create_group("configuration"), model, x, integral, random)
    start = placed(model, start_centres, rotations)
    put(group, "start/x", start, "um")
    put_end(group.create_group("end"), model, start, duration, n_steps)


def put_provenance(file, command):
    """How the file is made again, with which versions, and the CPU time that it took."""
    file.attrs["command"] = "OPENBLAS_NUM_THREADS=1 python3 " + command
    file.attrs["python"] = platform.python_version()
    file.attrs["numpy"] = np.__version__
    file.attrs["h5py"] = h5py.__version__
    file.attrs["hdf5"] = h5py.version.hdf5_version
    file.attrs["cpu_s"] = time.process_time()
    print(f"{file.attrs['cpu_s']:.0f} s of CPU time")


def main(path):
    mesh, fine_mesh = Mesh(1), Mesh(2)
    two = np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]])
    # One cell in the middle and twelve around it, somewhat pressed together.
    shell = mesh.unit_shape[:12] / np.linalg.norm(mesh.unit_shape[0])
    thirteen = 17.4 * np.vstack([np.zeros((1, 3)), shell])
    with h5py.File(path, "w") as file:
        random = np.random.default_rng(2021)
        model = Model(mesh, [9.0, 8.2], Parameters())
        put_problem(file, "doublet", model, 8.35 * two, 8.75 * two, 20.0, 2000, random)
        model = Model(mesh, np.full(13, 9.0), Parameters())
        put_problem(file, "thirteen", model, thirteen, thirteen, 2.0, 400, random)
        model = Model(fine_mesh, [9.0, 8.2], Parameters())
        put_problem(file, "fine_doublet", model, 8.35 * two, 8.5 * two, 2.0, 400, random)
        put_provenance(file, "run_twin.py ../twin.h5")


if __name__ == "__main__":
    main(sys.argv[1])
