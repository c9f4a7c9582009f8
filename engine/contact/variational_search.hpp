#pragma once

#include "engine/base/workers.hpp"
#include "engine/contact/contact_law.hpp"
#include "engine/contact/contact_search.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/contact/surface_samples.hpp"
#include "engine/model/geometry.hpp"
#include "engine/model/model.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope {

/// Contacts of the law `variational`: the force is -dE/dx of
///
///   E = 1/2 sum over both cells of integral over its own surface of e(delta) dS,
///   delta(x) = 2 h0 - d(x),   d(x): signed distance from x to the other cell's surface.
///
///      other cell's surface   ----c--.          c: point nearest to the sample p; d grows along
///                                 |u  '.        u, away from that surface. The force on p is
///      own surface, samples   +---p---+---+     P share u; its reaction goes to the corners of
///                                               c's triangle by c's barycentric coordinates.
///
/// d is exact at the samples (surface_samples.hpp) and affine between them, so that the energy of
/// every part is a closed form whose derivative is continuous (overlap_integral.hpp). The
/// derivative has two parts. Through delta: a force along u at p and its reaction at c, on one line
/// (`pairs`). Through dS: an in-plane tension of each triangle (`films`), -W/2 where the contact is
/// mature, which makes a contact angle obey Young and Dupre. Net force and torque of every pair and
/// of every film vanish by construction.
///
/// Why not the energy of pairs of triangles, with which the law `traction` computes: their polygons
/// tile a bent contact with gaps and overlaps, which that energy rewards, and it never comes to
/// rest. Why not quadrature points: the rim of a contact is narrower than their distance, and
/// catches on each of them. engine/README.md, 'The law variational', has the numbers.
///
/// What acts is distance alone; no pair is rejected for its angle. A sample deeper inside than the
/// law's largest overlap is left out and counted, like in `traction`. Where the nearest point jumps
/// (seen from inside a valley) the energy has a kink; its size falls with the distance of samples.
class VariationalSearch {
  public:
    explicit VariationalSearch(const ContactLaw& law, double skin_um = 0.3)
        : law_(law), skin_um_(skin_um) {}

    /// Fills `contacts`. `geometry` holds triangles and volumes of exactly x_um [all nodes]. The
    /// result does not depend on the age of the lists nor on the number of threads.
    void find(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
              Workers& workers, Contacts& contacts);

    /// candidates: triangles that were looked at for being nearest to a sample.
    [[nodiscard]] const ContactSearch::Counts& counts() const { return counts_; }
    [[nodiscard]] std::int64_t list_builds() const { return list_builds_; }
    [[nodiscard]] const SurfaceSamples& samples() const { return samples_; }

  private:
    /// Lists of one cell against another one.
    struct Side {
        std::vector<int> samples;     // near the other cell, ascending
        std::vector<int> first;       // [n + 1] into `candidates`
        std::vector<int> candidates;  // triangles of the other cell that may be nearest, ascending
        std::vector<int> triangles;   // own ones with at least one sample of the list, ascending
    };
    struct Group {
        Contacts::Group found;  // its cells, and what the last evaluation gave
        Side of_a, of_b;
        std::int64_t candidates = 0, too_deep = 0;
    };
    /// A configuration, from one cell's side.
    struct View {
        const Model& model;
        const Geometry& geometry;
        std::span<const Vec3> own_um, other_um;  // nodes
        int own, other;                          // cells
    };

    [[nodiscard]] bool lists_are_valid(const Model& model, std::span<const Vec3> x_um) const;
    void build_lists(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
                     Workers& workers);
    /// Unsigned distance up to which a sample may matter before the next rebuild, um.
    [[nodiscard]] double listed_distance_um(const View& view) const;
    void list_side(const View& view, Side& side) const;
    void evaluate(const View& view, const Side& side, bool is_a, Group& group) const;

    ContactLaw law_;
    double skin_um_;
    SurfaceSamples samples_;         // made at the first find
    std::vector<Vec3> listed_x_um_;  // positions at the last build
    std::vector<Group> groups_;
    std::size_t n_groups_ = 0;  // groups in use; the others keep their memory
    ContactSearch::Counts counts_;
    std::int64_t list_builds_ = 0;
};

}  // namespace spheroscope
