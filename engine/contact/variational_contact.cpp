// The law `variational` on one side of a contact: distances of the samples, energies of the parts,
// and the pairs and films that they make. See variational_search.hpp for the equations.
#include "engine/base/error.hpp"
#include "engine/base/index.hpp"
#include "engine/contact/closest_point.hpp"
#include "engine/contact/overlap_integral.hpp"
#include "engine/contact/variational_search.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace spheroscope {
namespace {

/// The point of the other surface that is nearest to a sample.
struct Nearest {
    int triangle = -1;  // of the other cell; -1: the sample is not near it
    std::array<double, 3> weight{};
    bool on_face = false;      // neither on an edge nor on a node
    Vec3 away = Vec3::Zero();  // u, along which d grows
    double overlap_um = 0.0;
};

/// Bounding spheres are tested with this much slack, so that rounding cannot leave out a triangle
/// that ties for the nearest: then the result would depend on the age of the lists.
constexpr double k_slack = 1.0 + 1e-9;

/// Sums over the samples of a triangle that see the same face, weighted by their areas; finish()
/// turns them into the means that a ContactPair holds.
void add_sample(ContactPair& pair, double area_um2, double force_nN,
                const std::array<double, 3>& of_a, const std::array<double, 3>& of_b,
                double overlap_um) {
    pair.area_um2 += area_um2;
    pair.overlap_um += static_cast<float>(area_um2 * overlap_um);
    pair.largest_overlap_um = std::fmax(pair.largest_overlap_um, static_cast<float>(overlap_um));
    for (std::size_t i = 0; i < 3; ++i) {
        pair.lambda[i] += area_um2 * of_a[i];
        pair.mu[i] += area_um2 * of_b[i];
        pair.force_a_nN[i] += force_nN * of_a[i];
        pair.force_b_nN[i] += force_nN * of_b[i];
    }
}

void finish(ContactPair& pair) {
    pair.overlap_um /= static_cast<float>(pair.area_um2);
    for (std::size_t i = 0; i < 3; ++i) {
        pair.lambda[i] /= pair.area_um2;
        pair.mu[i] /= pair.area_um2;
    }
}

ContactPair empty_pair(int triangle_a, int triangle_b, const Vec3& normal) {
    ContactPair pair{};
    pair.triangle_a = triangle_a;
    pair.triangle_b = triangle_b;
    pair.normal = normal;
    pair.largest_overlap_um = -std::numeric_limits<float>::infinity();
    return pair;
}

/// The other surface, as the search for the nearest point reads it.
struct OtherSurface {
    const MeshTopology& mesh;
    std::span<const Vec3> x_um, normal, centre_um, volume_gradient_um2;
    std::span<const double> reach_um;

    /// Precondition: `candidates` are not empty, ascending.
    [[nodiscard]] Nearest nearest(const Vec3& p, std::span<const int> candidates,
                                  const ContactLaw& law) const {
        Nearest result;
        double distance_um = std::numeric_limits<double>::infinity();
        Vec3 point = Vec3::Zero();
        for (const int t : candidates) {
            const double range = (distance_um + reach_um[idx(t)]) * k_slack;
            if ((p - centre_um[idx(t)]).squaredNorm() > range * range) continue;
            const auto& [i, j, k] = mesh.triangles[idx(t)];
            const Vec3 &a = x_um[idx(i)], &b = x_um[idx(j)], &c = x_um[idx(k)];
            const auto weight = closest_barycentric(p, a, b, c);
            const Vec3 q = weight[0] * a + weight[1] * b + weight[2] * c;
            const double d = (p - q).norm();
            if (d >= distance_um) continue;
            distance_um = d;
            point = q;
            result.triangle = t;
            result.weight = weight;
        }
        const auto& w = result.weight;
        result.on_face = w[0] > 0.0 && w[1] > 0.0 && w[2] > 0.0;
        if (result.on_face) {
            result.away = normal[idx(result.triangle)];
            result.overlap_um = 2.0 * law.h0_um - result.away.dot(p - point);
            return result;
        }
        // On an edge or a node the side is that of the nodes' own normals dV/dx, which all
        // triangles around it share.
        const auto& [i, j, k] = mesh.triangles[idx(result.triangle)];
        const Vec3 outward = w[0] * volume_gradient_um2[idx(i)] +
                             w[1] * volume_gradient_um2[idx(j)] +
                             w[2] * volume_gradient_um2[idx(k)];
        const double sign = outward.dot(p - point) < 0.0 ? -1.0 : 1.0;
        result.away = distance_um > 0.0 ? Vec3((sign / distance_um) * (p - point))
                                        : Vec3(outward.normalized());
        result.overlap_um = 2.0 * law.h0_um - sign * distance_um;
        return result;
    }
};

/// The nearest points of a list of samples, by sample; a member of the pool has one.
class NearestPoints {
  public:
    void clear(std::size_t n_samples, std::size_t n_listed) {
        listed_.resize(n_listed);
        place_.assign(n_samples, -1);
    }
    void set(std::size_t s, int sample, const Nearest& nearest) {
        listed_[s] = nearest;
        place_[idx(sample)] = static_cast<int>(s);
    }
    [[nodiscard]] const Nearest& operator[](int sample) const {
        static const Nearest none;
        return place_[idx(sample)] < 0 ? none : listed_[idx(place_[idx(sample)])];
    }

  private:
    std::vector<Nearest> listed_;
    std::vector<int> place_;  // of a sample in `listed_`, or -1
};

/// The law over one triangle, in shares of its area.
struct TriangleIntegral {
    std::vector<double> pressure_kPa, share;  ///< [samples of the triangle]
    double energy_fJ_per_um2 = 0.0;
    bool touches = false;

    void compute(const SurfaceSamples& surface, std::span<const int> samples,
                 const NearestPoints& nearest, const ContactLaw& law);
};

void TriangleIntegral::compute(const SurfaceSamples& surface, std::span<const int> samples,
                               const NearestPoints& nearest, const ContactLaw& law) {
    pressure_kPa.assign(samples.size(), 0.0);
    share.assign(samples.size(), 0.0);
    energy_fJ_per_um2 = 0.0;
    touches = false;
    const double area_of_part = 1.0 / static_cast<double>(surface.parts.size());
    for (const auto& part : surface.parts) {
        std::array<double, 3> overlap_um{};
        bool part_touches = false, is_near = true, is_shallow = true;
        for (std::size_t c = 0; c < 3; ++c) {
            const Nearest& corner = nearest[samples[idx(part[c])]];
            overlap_um[c] = corner.overlap_um;
            is_near = is_near && corner.triangle >= 0;
            is_shallow = is_shallow && overlap_um[c] <= law.largest_overlap_um;
            part_touches = part_touches || (corner.triangle >= 0 && overlap_um[c] > 0.0);
        }
        if (!part_touches || !is_shallow) continue;
        SPHEROSCOPE_ASSERT(is_near, "the lists reach as far as the parts of a contact");
        const OverlapIntegral integral = integrate_overlap(overlap_um, law);
        energy_fJ_per_um2 += area_of_part * integral.energy_fJ_per_um2;
        touches = true;
        for (std::size_t c = 0; c < 3; ++c) {
            pressure_kPa[idx(part[c])] += area_of_part * integral.pressure_kPa[c];
            share[idx(part[c])] += area_of_part * integral.share[c];
        }
    }
}

/// Adds the pairs of a triangle with those of the other cell that its samples see.
void add_pairs(int triangle, bool is_a, double half_area_um2, const TriangleIntegral& integral,
               const SurfaceSamples& surface, const NearestPoints& nearest,
               std::vector<ContactPair>& pairs) {
    const std::span<const int> samples = surface.samples_of(triangle);
    const std::size_t first = pairs.size();
    thread_local std::vector<char> on_face;  // of the pairs from `first` on
    on_face.clear();
    for (std::size_t s = 0; s < samples.size(); ++s) {
        const double area_um2 = half_area_um2 * integral.share[s];
        if (area_um2 <= 0.0) continue;
        const Nearest& at = nearest[samples[s]];
        // Samples over one face have the same normal: they are one pair.
        std::size_t pair = first;
        while (pair < pairs.size() &&
               !(at.on_face && on_face[pair - first] != 0 &&
                 (is_a ? pairs[pair].triangle_b : pairs[pair].triangle_a) == at.triangle))
            ++pair;
        if (pair == pairs.size()) {
            pairs.push_back(is_a ? empty_pair(triangle, at.triangle, at.away)
                                 : empty_pair(at.triangle, triangle, -at.away));
            on_face.push_back(at.on_face ? 1 : 0);
        }
        const auto& own_weight = surface.local_weights[s];
        add_sample(pairs[pair], area_um2, half_area_um2 * integral.pressure_kPa[s],
                   is_a ? own_weight : at.weight, is_a ? at.weight : own_weight, at.overlap_um);
    }
    for (std::size_t pair = first; pair < pairs.size(); ++pair) finish(pairs[pair]);
}

}  // namespace

void VariationalSearch::evaluate(const View& view, const Side& side, bool is_a,
                                 Group& group) const {
    const Model& model = view.model;
    const Geometry& geometry = view.geometry;
    const OtherSurface other{
        *model.topology,
        view.other_um,
        model.cell_triangles(std::span<const Vec3>(geometry.normal), view.other),
        model.cell_triangles(std::span<const Vec3>(geometry.centroid_um), view.other),
        model.cell_nodes(std::span<const Vec3>(geometry.volume_gradient_um2), view.other),
        model.cell_triangles(std::span<const double>(geometry.reach_um), view.other)};

    thread_local NearestPoints nearest;
    nearest.clear(samples_.samples.size(), side.samples.size());
    for (std::size_t s = 0; s < side.samples.size(); ++s) {
        const auto& [nodes, weight] = samples_.samples[idx(side.samples[s])];
        const Vec3 p = weight[0] * view.own_um[idx(nodes[0])] +
                       weight[1] * view.own_um[idx(nodes[1])] +
                       weight[2] * view.own_um[idx(nodes[2])];
        const auto begin = idx(side.first[s]), end = idx(side.first[s + 1]);
        const Nearest found =
            other.nearest(p, std::span(side.candidates).subspan(begin, end - begin), law_);
        nearest.set(s, side.samples[s], found);
        if (found.overlap_um > law_.largest_overlap_um) ++group.too_deep;
    }
    group.candidates += static_cast<std::int64_t>(side.candidates.size());

    const auto own_area =
        model.cell_triangles(std::span<const double>(geometry.area_um2), view.own);
    std::vector<ContactFilm>& films = is_a ? group.found.films_a : group.found.films_b;
    thread_local TriangleIntegral integral;
    for (const int triangle : side.triangles) {
        integral.compute(samples_, samples_.samples_of(triangle), nearest, law_);
        if (!integral.touches) continue;
        // Both cells' sides count by half.
        const double half_area_um2 = 0.5 * own_area[idx(triangle)];
        films.push_back({triangle, 0.5 * integral.energy_fJ_per_um2,
                         half_area_um2 * integral.energy_fJ_per_um2});
        add_pairs(triangle, is_a, half_area_um2, integral, samples_, nearest, group.found.pairs);
    }
}

}  // namespace spheroscope
