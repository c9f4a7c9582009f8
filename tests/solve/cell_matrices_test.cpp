#include "engine/solve/cell_matrices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

namespace spheroscope {
namespace {

/// Numbers between 0 and 1.
class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double uniform() { return std::uniform_real_distribution(0.0, 1.0)(engine_); }

  private:
    std::mt19937 engine_;
};

/// Elements of all kinds with arbitrary numbers, and a wall.
CellStiffness some_stiffness(const MeshTopology& mesh, Random& random) {
    CellStiffness K;
    const auto vector = [&random] {
        return Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    };
    for (const MeshTopology::Edge& e : mesh.edges) {
        K.edges.emplace_back(e.i, e.j, random.uniform(), random.uniform(), vector().normalized());
        const HingeSlope slope{vector(), vector(), random.uniform(), random.uniform()};
        K.hinges.emplace_back(std::array<int, 4>{e.i, e.j, e.a, e.b}, slope, random.uniform());
    }
    for (const MeshTopology::Triangle& t : mesh.triangles) {
        const Vec3 a = vector(), b = vector();
        K.triangles.emplace_back(t, std::array<Vec3, 3>{a, b, -(a + b)}, random.uniform());
        K.normals.emplace_back(
            t, std::array<double, 3>{random.uniform(), random.uniform(), random.uniform()},
            vector().normalized());
    }
    for (int node = 0; node < mesh.n_nodes(); node += 5)
        K.nodes.emplace_back(node, random.uniform(), vector().normalized());
    return K;
}

std::vector<Vec3> some_vectors(std::size_t n, Random& random) {
    std::vector<Vec3> u(n);
    for (Vec3& v : u) v = Vec3(random.uniform(), random.uniform(), random.uniform());
    return u;
}

/// Nine cells: two teams of four and one that is left.
class CellMatricesOfNine : public testing::Test {
  protected:
    static constexpr int n_cells = 9;
    CellMatricesOfNine() : couplings(*mesh) {
        matrices.allocate(couplings, n_cells);
        for (int cell = 0; cell < n_cells; ++cell) {
            stiffness.push_back(some_stiffness(*mesh, random));
            CellMatrix& matrix = of_cell.emplace_back();
            matrix.clear(couplings);
            matrix.add(stiffness.back(), 0.5);
        }
        for (int team = 0; team < matrices.teams().n_teams(); ++team) {
            const CellTeams::Range cells = matrices.teams().cells_of(team);
            matrices.set(team, std::span(of_cell).subspan(
                                   static_cast<std::size_t>(cells.begin),
                                   static_cast<std::size_t>(cells.end - cells.begin)));
        }
    }
    template <class Vector>
    std::vector<Vector> product_of(const CellMatrices& all, const std::vector<Vector>& u) const {
        std::vector<Vector> out(u.size(), VectorTraits<Vector>::zero());
        for (int team = 0; team < all.teams().n_teams(); ++team) {
            const CellTeams::Range cells = all.teams().cells_of(team);
            const std::size_t first = static_cast<std::size_t>(cells.begin) * n_nodes;
            const std::size_t n = static_cast<std::size_t>(cells.end - cells.begin) * n_nodes;
            all.add_product(team, std::span(u).subspan(first, n), std::span(out).subspan(first, n));
        }
        return out;
    }

    std::shared_ptr<const MeshTopology> mesh = make_icosphere(42);
    std::size_t n_nodes = 42;
    NodeCouplings couplings;
    Random random{3};
    std::vector<CellStiffness> stiffness;
    std::vector<CellMatrix> of_cell;
    CellMatrices matrices;
};

TEST_F(CellMatricesOfNine, AreTheSumsOfTheirElements) {
    const std::vector<Vec3> u = some_vectors(n_cells * n_nodes, random);
    const std::vector<Vec3> product = product_of(matrices, u);
    double largest = 0.0;
    for (const Vec3& y : product) largest = std::max(largest, y.norm());
    for (std::size_t cell = 0; cell < n_cells; ++cell) {
        std::vector<Vec3> twin(n_nodes, Vec3::Zero());
        stiffness[cell].add_product(0.5, std::span(u).subspan(cell * n_nodes, n_nodes), twin);
        for (std::size_t i = 0; i < n_nodes; ++i)
            EXPECT_LE((product[cell * n_nodes + i] - twin[i]).norm(), 1e-6 * largest);
    }
}

TEST_F(CellMatricesOfNine, HaveTheProductsOfEachCellAloneToTheBit) {
    std::vector<Lanes> u;
    for (const Vec3& v : some_vectors(n_cells * n_nodes, random)) u.emplace_back(v);
    const std::vector<Lanes> product = product_of(matrices, u);
    std::vector<Vec3> u_double(u.size());
    std::transform(u.begin(), u.end(), u_double.begin(), [](const Lanes& v) { return v.vec3(); });
    const std::vector<Vec3> product_double = product_of(matrices, u_double);
    for (std::size_t cell = 0; cell < n_cells; ++cell) {
        CellMatrices alone;
        alone.allocate(couplings, 1);
        alone.set(0, std::span(of_cell).subspan(cell, 1));
        std::vector<Lanes> twin(n_nodes);
        alone.add_product(0, std::span(u).subspan(cell * n_nodes, n_nodes), twin);
        EXPECT_EQ(std::memcmp(twin.data(), &product[cell * n_nodes], n_nodes * sizeof(Lanes)), 0)
            << cell;
        std::vector<Vec3> twin_double(n_nodes, Vec3::Zero());
        alone.add_product(0, std::span<const Vec3>(u_double).subspan(cell * n_nodes, n_nodes),
                          twin_double);
        EXPECT_EQ(std::memcmp(twin_double.data(), &product_double[cell * n_nodes],
                              n_nodes * sizeof(Vec3)),
                  0)
            << cell;
        EXPECT_EQ(alone.against_translation(0),
                  matrices.against_translation(static_cast<int>(cell)));
    }
}

TEST(CellMatrix, ForgetsWhereTheBlocksOfAnotherMeshWere) {
    Random random{5};
    CellMatrix used;
    for (const int n_nodes : {162, 42, 162}) {
        const auto mesh = make_icosphere(n_nodes);
        const NodeCouplings couplings(*mesh);
        const CellStiffness K = some_stiffness(*mesh, random);
        used.clear(couplings);
        used.add(K, 1.0);
        CellMatrix fresh;
        fresh.clear(couplings);
        fresh.add(K, 1.0);
        ASSERT_EQ(used.blocks().size(), fresh.blocks().size());
        EXPECT_EQ(
            std::memcmp(used.blocks().data(), fresh.blocks().data(), used.blocks().size_bytes()),
            0);
    }
}

TEST(CellTeams, HoldEveryCellOnce) {
    for (const int n_cells : {1, 2, 7, 8, 9, 13, 150}) {
        const CellTeams teams(n_cells);
        int next = 0;
        for (int team = 0; team < teams.n_teams(); ++team) {
            const CellTeams::Range cells = teams.cells_of(team);
            EXPECT_EQ(cells.begin, next);
            for (int cell = cells.begin; cell < cells.end; ++cell)
                EXPECT_EQ(teams.team_of(cell), team) << n_cells;
            next = cells.end;
        }
        EXPECT_EQ(next, n_cells);
    }
    EXPECT_EQ(CellTeams(7).n_teams(), 7);
    EXPECT_EQ(CellTeams(13).n_teams(), 4);
}

TEST(CellTeams, AreSharedAmongTheMembersOfARegion) {
    for (const int n_threads : {1, 2, 3, 16})
        for (const int n_cells : {1, 7, 13, 55, 150}) {
            Workers workers(n_threads);
            const CellTeams teams(n_cells);
            std::vector<CellTeams::Range> shares(static_cast<std::size_t>(n_threads), {0, 0});
            workers.region([&](Workers::Member& member) {
                shares[static_cast<std::size_t>(member.index())] = teams.share(member);
            });
            int next = 0;
            for (const CellTeams::Range& share : shares) {
                if (share.begin == share.end) continue;
                EXPECT_EQ(share.begin, next) << n_threads << " threads, " << n_cells << " cells";
                next = share.end;
            }
            EXPECT_EQ(next, teams.n_teams()) << n_threads << " threads, " << n_cells << " cells";
        }
}

}  // namespace
}  // namespace spheroscope
