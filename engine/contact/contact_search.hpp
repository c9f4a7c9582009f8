#pragma once

#include "engine/base/workers.hpp"
#include "engine/contact/contact_law.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/model/geometry.hpp"
#include "engine/model/model.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope {

/// Finds all contacts of a configuration.
///
///   boxes of cells -> pairs of cells -> candidate pairs of triangles -> contact_of_triangles ->
///   Contacts
///                     (lists, rebuilt when a node has moved half the skin)     (every evaluation)
///
/// The lists only save time: a pair that is left out cannot overlap before the next rebuild, and
/// pairs are evaluated and stored in one canonical order. So the contacts, to the bit, depend on
/// the configuration alone: not on the age of the lists, and not on the number of threads.
class ContactSearch {
  public:
    ContactSearch(const ContactLaw& law, double skin_um) : law_(law), skin_um_(skin_um) {}

    /// Counts since construction; a part of the run's report.
    struct Counts {
        std::int64_t list_builds = 0;
        std::int64_t candidates = 0;  ///< candidate pairs evaluated
        std::int64_t active_pairs = 0;
        std::int64_t too_deep = 0;  ///< left out as passed-through surfaces
    };

    /// Fills `contacts`. `geometry` holds triangles of exactly x_um [all nodes].
    void find(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
              Workers& workers, Contacts& contacts);

    [[nodiscard]] const ContactLaw& law() const { return law_; }
    [[nodiscard]] const Counts& counts() const { return counts_; }

  private:
    struct Candidate {
        int triangle_a, triangle_b;
    };
    struct CandidateGroup {
        int cell_a = 0, cell_b = 0;
        std::vector<Candidate> candidates;
        std::vector<ContactPair> active;
        std::int64_t too_deep = 0;
    };

    [[nodiscard]] bool lists_are_valid(const Model& model, std::span<const Vec3> x_um) const;
    void build_lists(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
                     Workers& workers);
    void collect_candidates(const Model& model, const Geometry& geometry,
                            CandidateGroup& group) const;
    void evaluate(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
                  CandidateGroup& group) const;
    /// Largest distance, outside or inside each other, of two surfaces that make a contact, um.
    [[nodiscard]] double reach_um() const;

    struct Box {
        Vec3 low, high;
    };

    ContactLaw law_;
    double skin_um_;
    std::vector<Vec3> listed_x_um_;  // positions at the last build
    std::vector<Box> boxes_;         // of cells, at the last build
    std::vector<CandidateGroup> groups_;
    std::size_t n_groups_ = 0;  // groups in use; the others keep their memory
    Counts counts_;
};

}  // namespace spheroscope
