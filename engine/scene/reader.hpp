#pragma once

#include "engine/scene/keys.hpp"

namespace spheroscope::scene {

/// Reads every table and key of the document into a draft: types, dimensions, ranges, words, what
/// is required, what does not apply. What follows from several keys together is left to resolve().
/// Throws Error with the place of the first mistake; unknown names are looked for first, because
/// they explain what then seems to be missing. `document` must outlive the draft.
[[nodiscard]] Draft read_draft(const Document& document);

/// Where several keys exclude each other (E and Et_over_omega), an override of one replaces the
/// others of the file.
void drop_alternatives(Document& document, const Override& override_);

}  // namespace spheroscope::scene
