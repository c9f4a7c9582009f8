#pragma once

#include "engine/stages/stage.hpp"

namespace spheroscope {

/// The loading of Cuvelier et al. 2021, Appendix G: a convex hull is put around the cells as they
/// are, open above, and a stiff bead is pressed into them with a constant force.
///
/// until = rest ends when for 2 s: the bead is slower than 5e-4 um/s, and the force on it, and the
/// sum of all forces on the cells (hull, bead, and what should cancel between them), are within a
/// thousandth of the wanted one.
class Indentation final : public Stage {
  public:
    using Stage::Stage;
    /// Throws Error when the hull does not contain the cells, or when the probe would start inside
    /// a cell or meet none.
    void begin(StageContext& context) const override;
    [[nodiscard]] double latest_end_s(const StageContext& context) const override;
    [[nodiscard]] StageEnd after_step(StageContext& context) const override;
    [[nodiscard]] double progress(const StageContext& context) const override;
};

}  // namespace spheroscope
