#pragma once

#include "engine/stages/stage.hpp"

namespace spheroscope {

/// A spherical frictionless wall about the origin falls linearly from touching to R_th (the radius
/// of the sphere with the volume of all cells) in the stage's duration. It stops at the first of:
/// the cells fill `volume_fraction` of it; the contact fraction rises slower than
/// `contact_rate_per_s`; R_th. The paper compresses 'briefly until confluent' and prints no more.
class Compaction final : public Stage {
  public:
    using Stage::Stage;
    void begin(StageContext& context) const override;
    [[nodiscard]] StageEnd after_step(StageContext& context) const override;
};

/// The wall stays where it is.
class Hold final : public Stage {
  public:
    using Stage::Stage;
    void begin(StageContext& context) const override;
};

/// The wall opens linearly to where it first touched, then it is gone.
class Release final : public Stage {
  public:
    using Stage::Stage;
    void begin(StageContext& context) const override;
    void end(StageContext& context) const override;
};

}  // namespace spheroscope
