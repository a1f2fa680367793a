#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trace/predicate.h"

namespace isorelax::model {

/// What happens where a predicate holds.
enum class BreakAction : std::uint8_t { stop, log };

/// A condition on the iterations of a run, as typed, and what was wrong with it.
struct Breakpoint {
  std::string text;
  BreakAction action = BreakAction::stop;
  bool enabled = true;
  std::shared_ptr<const Predicate> predicate;  ///< null while the text cannot be read
  std::size_t mistake_column = 0;              ///< from 1; 0: none
  std::string mistake;                         ///< what was expected there
};
/// Reads the text.
[[nodiscard]] Breakpoint make_breakpoint(std::string text, BreakAction action);

/// An iteration at which a predicate held.
struct BreakHit {
  unsigned branch = 0;
  unsigned iteration = 0;
  std::string text;  ///< the predicate
  BreakAction action = BreakAction::log;
};

}  // namespace isorelax::model
