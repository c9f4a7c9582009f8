#pragma once

#include "engine/base/vec3.hpp"
#include "render/image.hpp"

#include <memory>

class vtkActor;

namespace spheroscope::render {

/// Tubes and balls of one colour each as one mesh: what layers of lines in space are made of.
class Tubes {
  public:
    Tubes();
    ~Tubes();

    void clear();
    void add_ball(const Vec3& centre, double radius_um, Rgb colour);
    /// Its ends are open: there are balls, or nothing is seen of them.
    void add_tube(const Vec3& from, const Vec3& to, double radius_um, Rgb colour);
    /// A tube with flat ends.
    void add_rod(const Vec3& from, const Vec3& to, double radius_um, Rgb colour);
    /// After the last addition: the actor has all of them.
    void finish();

    [[nodiscard]] vtkActor* actor();

  private:
    struct Hidden;
    std::unique_ptr<Hidden> hidden_;
};

}  // namespace spheroscope::render
