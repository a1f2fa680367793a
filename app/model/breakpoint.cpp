#include "model/breakpoint.h"

#include <utility>

namespace isorelax::model {

Breakpoint make_breakpoint(std::string text, BreakAction action) {
  Breakpoint made;
  made.text = std::move(text);
  made.action = action;
  try {
    made.predicate = std::make_shared<const Predicate>(made.text);
  } catch (const PredicateError& error) {
    made.mistake_column = error.column();
    made.mistake = error.reason();
  }
  return made;
}

}  // namespace isorelax::model
