#pragma once

#include <vector>

namespace spheroscope::viewer {

/// A value with its earlier values: every change can be undone. A drag is many changes and one
/// step: begin_drag() ... change() ... end_drag().
template <class T> class History {
  public:
    explicit History(T first) : values_{std::move(first)} {}

    [[nodiscard]] const T& now() const { return values_[at_]; }
    void change(T value) {
        if (value == now()) return;
        if (is_dragging_ && has_moved_) {
            values_[at_] = std::move(value);
            return;
        }
        has_moved_ = true;
        values_.resize(at_ + 1, now());
        values_.push_back(std::move(value));
        ++at_;
    }
    void begin_drag() {
        is_dragging_ = true;
        has_moved_ = false;
    }
    void end_drag() { is_dragging_ = false; }
    [[nodiscard]] bool is_dragging() const { return is_dragging_; }
    /// A click is a drag that goes nowhere.
    [[nodiscard]] bool is_being_moved() const { return is_dragging_ && has_moved_; }

    [[nodiscard]] bool can_undo() const { return at_ > 0; }
    [[nodiscard]] bool can_redo() const { return at_ + 1 < values_.size(); }
    void undo() {
        if (can_undo()) --at_;
    }
    void redo() {
        if (can_redo()) ++at_;
    }

  private:
    std::vector<T> values_;
    std::size_t at_ = 0;
    bool is_dragging_ = false, has_moved_ = false;
};

}  // namespace spheroscope::viewer
