"""Deformable cells, written from Cuvelier et al., Soft Matter 2021, 17, 6603. Slow and obvious.

A second program for the same model, to hold the fast one against: nothing here was translated from
it. Units: um, s, nN (so kPa = nN/um^2). Arrays of nodes are [cells, nodes, 3] or, flat, [all, 3].
Where the print contradicts itself the choices are those of engine/README.md, 'Departures'.
"""

from dataclasses import asdict, dataclass

import numpy as np

from contact import ContactLaw, contacts_of_cells
from mesh import areas_and_normals, hinges, volume


@dataclass
class Parameters:
    E_kPa: float = 20.0
    thickness_um: float = 0.2
    poisson: float = 1 / 3
    gamma_nN_per_um: float = 0.5
    K_kPa: float = 5.0
    T_I_s: float = 0.2 / 3**0.5  # zeta = eta t / sqrt(3) / (2 gamma)
    T_d_s: float = 2 / 3**0.5  # 10 zeta
    eta_kPa_s: float = 1.0
    eta_f_kPa_s: float = 0.05
    omega_nN_per_um: float = 0.5
    h0_um: float = 0.3
    reject_cos: float = 0.0
    friction_normal_kPa_s_per_um: float = 0.05
    friction_tangential_kPa_s_per_um: float = 0.05

    def contact_law(self):
        """Eqn (5), read so that the work of adhesion is omega and the surfaces touch at rest:
        P0 = omega/h0, k = P0/(2 h0), W = P0^2/(2 k) = omega."""
        P0 = self.omega_nN_per_um / self.h0_um
        deepest = 2 * self.h0_um + 1.0
        return ContactLaw(self.h0_um, P0, P0 / (2 * self.h0_um), self.reject_cos, deepest)

    def attributes(self):
        law = self.contact_law()
        return asdict(self) | {"P0_kPa": law.P0, "k_kPa_per_um": law.k}


@dataclass
class Forces:
    """All terms at one configuration, nN [cells, nodes, 3], and what they were made of."""

    elastic: np.ndarray
    bending: np.ndarray
    tension: np.ndarray
    cytosol: np.ndarray
    contact: np.ndarray
    pairs: list
    volume: np.ndarray  # um^3 [cells]
    volume_gradient: np.ndarray  # S = dV/dx, um^2 [cells, nodes, 3]
    strain: np.ndarray  # eps [cells]

    @property
    def total(self):
        return self.elastic + self.bending + self.tension + self.cytosol + self.contact


class Model:
    def __init__(self, mesh, radius_um, parameters):
        self.mesh = mesh
        self.radius = np.asarray(radius_um, dtype=float)
        self.parameters = parameters
        self.law = parameters.contact_law()
        self.target_volume = 4 / 3 * np.pi * self.radius**3  # the unit mesh has 4/3 pi

    @property
    def n_cells(self):
        return len(self.radius)

    # Forces. --------------------------------------------------------------------------------

    def spring_constants(self):
        """Eqn (8), of the rest shape: k = E t (S_A + S_B)/d*^2 (Van Gelder 1998); no size in it."""
        both_sides = self.mesh.area[self.mesh.sides].sum(axis=1)
        return self.parameters.E_kPa * self.parameters.thickness_um * both_sides / (
            self.mesh.edge_length**2
        )

    def elastic_force(self, x, R):
        i, j = self.mesh.edges[:, 0], self.mesh.edges[:, 1]
        e = x[j] - x[i]
        d = np.linalg.norm(e, axis=1)
        pull = self.spring_constants() * (d - R * self.mesh.edge_length)
        force = np.zeros_like(x)
        np.add.at(force, i, (pull / d)[:, None] * e)
        np.add.at(force, j, -(pull / d)[:, None] * e)
        return force

    def elastic_energy(self, x, R):
        d = np.linalg.norm(x[self.mesh.edges[:, 1]] - x[self.mesh.edges[:, 0]], axis=1)
        return np.sum(self.spring_constants() * (d - R * self.mesh.edge_length) ** 2) / 2

    def bending_constant(self):
        """Eqn (10): the rigidity of a plate."""
        p = self.parameters
        return p.E_kPa * p.thickness_um**3 / (12 * (1 - p.poisson**2))

    def bending_force(self, x):
        """Eqn (9): U = k (1 - cos(theta - theta*)) on every edge."""
        theta, gradients = hinges(x, self.mesh.edges)
        moment = self.bending_constant() * np.sin(theta - self.mesh.angle)
        force = np.zeros_like(x)
        for corner in range(4):
            np.add.at(force, self.mesh.edges[:, corner], -moment[:, None] * gradients[corner])
        return force

    def bending_energy(self, x):
        theta, _ = hinges(x, self.mesh.edges)
        return self.bending_constant() * np.sum(1 - np.cos(theta - self.mesh.angle))

    def tension_force(self, x):
        """Eqn (11): every corner is pulled towards the opposite side, F_i = gamma/2 (k - j) x n."""
        triangles = self.mesh.triangles
        _, n = areas_and_normals(x, triangles)
        force = np.zeros_like(x)
        for corner in range(3):
            j = x[triangles[:, (corner + 1) % 3]]
            k = x[triangles[:, (corner + 2) % 3]]
            pull = self.parameters.gamma_nN_per_um / 2 * np.cross(k - j, n)
            np.add.at(force, triangles[:, corner], pull)
        return force

    def tension_energy(self, x):
        return self.parameters.gamma_nN_per_um * areas_and_normals(x, self.mesh.triangles)[0].sum()

    def offset_pressure(self, cell):
        """2 gamma/R of the polyhedron: (2 gamma/3) A/V of the rest mesh."""
        area = self.radius[cell] ** 2 * self.mesh.area.sum()
        return 2 * self.parameters.gamma_nN_per_um / 3 * area / self.target_volume[cell]

    def pressure(self, cell, strain, integral):
        """Eqns (12), (13) without the derivative part, which is a friction here."""
        p = self.parameters
        return self.offset_pressure(cell) - p.K_kPa * strain - p.K_kPa / p.T_I_s * integral

    def contact_pairs(self, x):
        triangles = self.mesh.triangles
        normals = [areas_and_normals(cell, triangles)[1] for cell in x]
        centre = x.mean(axis=1)
        radius = np.linalg.norm(x - centre[:, None], axis=2).max(axis=1)
        pairs = []
        for a in range(self.n_cells):
            for b in range(a + 1, self.n_cells):
                gap = np.linalg.norm(centre[a] - centre[b]) - radius[a] - radius[b]
                if gap < 4 * self.law.h0:
                    pairs += contacts_of_cells(
                        a, b, x[a], x[b], normals[a], normals[b], triangles, self.law
                    )
        return pairs

    def contact_force(self, x, pairs):
        """Eqns (6), (7): what each pair's pressure does at the six corners."""
        force = np.zeros((x.size // 3, 3))
        for pair in pairs:
            for node, size in zip(pair.nodes_a, pair.f):
                force[node] += size * pair.normal
            for node, size in zip(pair.nodes_b, pair.g):
                force[node] -= size * pair.normal
        return force.reshape(x.shape)

    def forces(self, x, integral):
        """x [cells, nodes, 3]; integral [cells], the time integral of eps."""
        elastic, bending, tension, cytosol = (np.zeros_like(x) for _ in range(4))
        volumes, gradient = np.zeros(self.n_cells), np.zeros_like(x)
        for cell in range(self.n_cells):
            elastic[cell] = self.elastic_force(x[cell], self.radius[cell])
            bending[cell] = self.bending_force(x[cell])
            tension[cell] = self.tension_force(x[cell])
            volumes[cell], gradient[cell] = volume(x[cell], self.mesh.triangles)
            strain = volumes[cell] / self.target_volume[cell] - 1
            cytosol[cell] = self.pressure(cell, strain, integral[cell]) * gradient[cell]
        pairs = self.contact_pairs(x)
        contact = self.contact_force(x, pairs)
        strain = volumes / self.target_volume - 1
        return Forces(elastic, bending, tension, cytosol, contact, pairs, volumes, gradient, strain)

    # Friction. ------------------------------------------------------------------------------

    def drag(self):
        """Eqn (14): 3 eta_f/(2 R) times the node's share of the rest surface [cells, nodes]."""
        return 1.5 * self.parameters.eta_f_kPa_s * np.outer(self.radius, self.mesh.node_area)

    def edge_friction(self):
        """Eqns (15), (16), eta t/sqrt(3): with it a regular lattice has surface viscosity eta t."""
        return self.parameters.eta_kPa_s * self.parameters.thickness_um / 3**0.5

    def medium_and_cortex_product(self, u):
        out = self.drag()[:, :, None] * u
        for cell in range(self.n_cells):
            for i, j, _, _ in self.mesh.edges:
                exchange = self.edge_friction() * (u[cell, i] - u[cell, j])
                out[cell, i] += exchange
                out[cell, j] -= exchange
        return out

    def contact_friction_product(self, u, pairs, normal, tangential):
        """Eqns (17), (18) with weights (lambda_i + mu_k)/6, which sum to one."""
        flat = u.reshape(-1, 3)
        out = np.zeros_like(flat)
        for pair in pairs:
            along = np.outer(pair.normal, pair.normal)
            gamma = pair.area * (normal * along + tangential * (np.eye(3) - along))
            for i, lam in zip(pair.nodes_a, pair.lam):
                for k, mu in zip(pair.nodes_b, pair.mu):
                    exchange = (lam + mu) / 6 * gamma @ (flat[i] - flat[k])
                    out[i] += exchange
                    out[k] -= exchange
        return out.reshape(u.shape)

    def volume_friction_product(self, u, gradient):
        """The controller's derivative part, - K T_d eps' S, as a friction: eps' = S.u/V*."""
        out = np.zeros_like(u)
        for cell in range(self.n_cells):
            rate = np.sum(gradient[cell] * u[cell]) / self.target_volume[cell]
            out[cell] = self.parameters.K_kPa * self.parameters.T_d_s * rate * gradient[cell]
        return out

    def scalar_friction_matrix(self, pairs):
        """Drag, cortex and contacts as one matrix for x, y and z alike [all, all]; needs equal
        normal and tangential contact friction."""
        p = self.parameters
        assert p.friction_normal_kPa_s_per_um == p.friction_tangential_kPa_s_per_um
        matrix = np.diag(self.drag().ravel())

        def connect(i, j, friction):
            matrix[i, i] += friction
            matrix[j, j] += friction
            matrix[i, j] -= friction
            matrix[j, i] -= friction

        for cell in range(self.n_cells):
            for i, j, _, _ in self.mesh.edges + cell * self.mesh.n_nodes:
                connect(i, j, self.edge_friction())
        for pair in pairs:
            for i, lam in zip(pair.nodes_a, pair.lam):
                for k, mu in zip(pair.nodes_b, pair.mu):
                    connect(i, k, (lam + mu) / 6 * pair.area * p.friction_normal_kPa_s_per_um)
        return matrix

    def velocity(self, forces):
        """Gamma v = F, eqn (1). The controller's part is of rank one per cell: with the matrix L
        of the rest, L v = F - sum_a c_a S_a (S_a.v), and the numbers S_a.v solve a small system."""
        matrix = self.scalar_friction_matrix(forces.pairs)
        n_all, n_cells = len(matrix), self.n_cells
        S = np.zeros((n_cells, n_all, 3))
        for cell in range(n_cells):
            first = cell * self.mesh.n_nodes
            S[cell, first : first + self.mesh.n_nodes] = forces.volume_gradient[cell]
        right = np.concatenate([forces.total.reshape(n_all, 3), *S], axis=1)
        solved = np.linalg.solve(matrix, right)
        free, answers = solved[:, :3], solved[:, 3:].reshape(n_all, n_cells, 3).swapaxes(0, 1)
        c = self.parameters.K_kPa * self.parameters.T_d_s / self.target_volume
        coupling = np.einsum("anx,bnx->ab", S, answers)
        rates = np.linalg.solve(
            np.eye(n_cells) + coupling * c[None, :], np.einsum("anx,nx->a", S, free)
        )
        v = free - np.einsum("a,anx->nx", c * rates, answers)
        return v.reshape(forces.total.shape)

    # Measures. ------------------------------------------------------------------------------

    def hydrostatic_stress(self, x, pairs, volumes):
        """Eqn (4) from nodal forces: 3 V sigma = sum F_i.(x_i - x_a) + half of each pair's virial
        Y = - sum F_i.x_i over both cells. Tension positive; x_a: mean of the cell's nodes. kPa."""
        flat, centre = x.reshape(-1, 3), x.mean(axis=1)
        virial = np.zeros(self.n_cells)
        for pair in pairs:
            own = 0.0
            sides = (pair.cell_a, pair.nodes_a, pair.f, 1), (pair.cell_b, pair.nodes_b, pair.g, -1)
            for cell, nodes, sizes, sign in sides:
                for node, size in zip(nodes, sizes):
                    force = sign * size * pair.normal
                    virial[cell] += force @ (flat[node] - centre[cell])
                    own -= force @ (flat[node] - centre[pair.cell_a])
            virial[pair.cell_a] += own / 2
            virial[pair.cell_b] += own / 2
        return virial / (3 * volumes)

    def contact_areas(self, pairs):
        """Rows (cell, cell, um^2) of all pairs of cells that touch, ascending."""
        areas = {}
        for pair in pairs:
            key = (pair.cell_a, pair.cell_b)
            areas[key] = areas.get(key, 0.0) + pair.area
        return sorted((a, b, area) for (a, b), area in areas.items())

    # Motion. --------------------------------------------------------------------------------

    def rates(self, x, integral):
        forces = self.forces(x, integral)
        return self.velocity(forces), forces.strain

    def integrate(self, x, duration_s, n_steps):
        """The trapezoidal rule of Heun from rest shapes, integral of eps included."""
        integral = np.zeros(self.n_cells)
        dt = duration_s / n_steps
        for _ in range(n_steps):
            v0, eps0 = self.rates(x, integral)
            v1, eps1 = self.rates(x + dt * v0, integral + dt * eps0)
            x = x + dt / 2 * (v0 + v1)
            integral = integral + dt / 2 * (eps0 + eps1)
        return x, integral
