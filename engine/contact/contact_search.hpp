#pragma once

#include "engine/base/workers.hpp"
#include "engine/contact/contact_law.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/contact/packed_triangles.hpp"
#include "engine/contact/pair_kernel.hpp"
#include "engine/model/geometry.hpp"
#include "engine/model/model.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope {

/// Largest distance, outside or inside each other, of two surfaces that make a contact, um.
[[nodiscard]] double contact_reach_um(const ContactLaw& law);

/// Finds all contacts of a configuration.
///
///   boxes of cells -> pairs of cells -> SIMD kernel (pair_kernel.hpp) -> Contacts
///
/// Nothing is kept from one configuration to the next but memory, and pairs are found and stored
/// in one canonical order. So the contacts, to the bit, depend on the configuration, the precision
/// and the SIMD target alone, and not on the number of threads.
///
/// There are no lists of candidates: steps of the implicit methods move nodes so far that a list
/// would be made anew nearly every time.
class ContactSearch {
  public:
    ContactSearch(const ContactLaw& law, ContactPrecision precision)
        : law_(law), precision_(precision) {}

    /// Counts since construction; a part of the run's report.
    struct Counts {
        std::int64_t candidates = 0;  ///< pairs of triangles that were clipped
        std::int64_t active_pairs = 0;
        std::int64_t too_deep = 0;  ///< left out as passed-through surfaces
    };

    /// Fills `contacts`. `geometry` holds triangles of exactly x_um [all nodes].
    void find(const Model& model, std::span<const Vec3> x_um, const Geometry& geometry,
              Workers& workers, Contacts& contacts);

    [[nodiscard]] const ContactLaw& law() const { return law_; }
    [[nodiscard]] ContactPrecision precision() const { return precision_; }
    [[nodiscard]] const Counts& counts() const { return counts_; }

  private:
    struct CellPair {
        int cell_a, cell_b;
        KernelCounts counts;
    };

    void find_cell_pairs(const Model& model, std::span<const Vec3> x_um, Workers& workers);
    /// One group for each pair of cells; a pair that was there before keeps its memory.
    void set_groups(Contacts& contacts);
    template <class T> void fill_groups(const Model& model, std::span<const Vec3> x_um,
                                        const Geometry& geometry, Workers& workers,
                                        PackedTriangles<T>& triangles, Contacts& contacts);

    ContactLaw law_;
    ContactPrecision precision_;
    std::vector<NodeBox> boxes_;
    std::vector<CellPair> cell_pairs_;
    PackedTriangles<float> single_;  // one of the two is used
    PackedTriangles<double> double_;
    std::vector<Contacts::Group> old_groups_;
    Counts counts_;
};

}  // namespace spheroscope
