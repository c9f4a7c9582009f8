#pragma once

#include "engine/cli/verb.hpp"

#include <span>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// The manual page, section 1, in the man macros: verbs and options as `--help` has them.
[[nodiscard]] std::string man_page(std::span<const Verb> verbs, const std::string& version);
/// A completion for bash: verbs, then the verb's options, then files.
[[nodiscard]] std::string bash_completion(std::span<const Verb> verbs);

/// `man` and `completion` print them. They keep the reference: `verbs` is the whole table, these
/// two included, and lives as long as the program.
[[nodiscard]] Verb man_verb(const std::vector<Verb>& verbs);
[[nodiscard]] Verb completion_verb(const std::vector<Verb>& verbs);

}  // namespace spheroscope::cli
