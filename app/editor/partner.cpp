#include "editor/partner.h"

#include <chrono>

#include "mesh/error.h"

namespace isorelax::editor {

void Partner::remember(const model::Session& session, ui::Comparison& comparison) {
  remembered_ = session.current;
  comparison.remembers = true;
  comparison.remembered = "Iteration " + std::to_string(session.current->iteration);
}

void Partner::read(const std::filesystem::path& path) {
  reading_ = std::async(std::launch::async, [path] {
    FromFile file;
    file.document = model::read_document(path);
    auto state = std::make_shared<model::MeshState>();
    state->geometry = model::measure_geometry(*file.document, file.document->mesh().positions);
    file.state = std::move(state);
    return file;
  });
}

std::string Partner::take_over(ui::Comparison& comparison) {
  if (!reading_.valid() || reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  try {
    file_ = reading_.get();
  } catch (const Error& error) {
    return error.what();
  }
  comparison.file = file_.document->path.filename().string();
  comparison.with = ui::CompareWith::file;
  return {};
}

void Partner::follow(const model::Session& session, ui::Comparison& comparison) {
  if (document_ == session.document) return;
  document_ = session.document;
  remembered_.reset();
  comparison.remembers = false;
  if (comparison.with == ui::CompareWith::remembered) comparison.with = ui::CompareWith::original;
}

Shown Partner::shown(const model::Session& session, const ui::Comparison& comparison) const {
  switch (comparison.with) {
    case ui::CompareWith::original:
      break;
    case ui::CompareWith::remembered:
      return {session.document, remembered_, {}};
    case ui::CompareWith::file:
      return {file_.document, file_.state, {}};
    case ui::CompareWith::beside:
      if (!session.other_states.empty()) return {session.document, session.other_states.front(), {}};
      break;
  }
  return {session.document, session.original, {}};
}

}  // namespace isorelax::editor
