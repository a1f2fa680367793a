#include "editor/partner.h"

#include <chrono>
#include <exception>
#include <new>
#include <utility>

namespace isorelax::editor {
namespace {

bool fits(const model::DocumentPtr& file, const model::DocumentPtr& document) {
  return file && document && same_triangles(file->mesh(), document->mesh());
}

template <typename T>
bool has_ended(const std::future<T>& reading) {
  return reading.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void Partner::remember(const model::Session& session, ui::Comparison& comparison) {
  remembered_ = session.current;
  comparison.remembers = true;
  comparison.remembered = "Iteration " + std::to_string(session.current->iteration);
}

void Partner::read(const std::filesystem::path& path) {
  std::erase_if(unwanted_, [](const std::future<FromFile>& reading) { return has_ended(reading); });
  if (reading_.valid()) unwanted_.push_back(std::move(reading_));
  reading_ = std::async(std::launch::async, [path] {
    FromFile file;
    file.document = model::read_document(path);
    auto state = std::make_shared<model::MeshState>();
    state->geometry = model::measure_geometry(*file.document, file.document->mesh().positions);
    file.state = std::move(state);
    return file;
  });
}

std::optional<model::Message> Partner::take_over(ui::Comparison& comparison) {
  if (!reading_.valid() || !has_ended(reading_)) return {};
  const auto failed = [](const std::string& text) {
    return model::Message{model::MessageKind::error, text, model::Topic::comparison};
  };
  try {
    file_ = reading_.get();
  } catch (const std::bad_alloc&) {
    return failed("not enough memory to read the mesh to compare with");
  } catch (const std::exception& error) {
    return failed(error.what());
  }
  file_fits_ = fits(file_.document, document_);
  comparison.file = file_.document->path.filename().string();
  comparison.with = ui::CompareWith::file;
  return model::Message{model::MessageKind::info, "Read " + comparison.file + " to compare with",
                        model::Topic::comparison};
}

void Partner::follow(const model::Session& session, ui::Comparison& comparison) {
  if (document_ != session.document) {
    document_ = session.document;
    file_fits_ = fits(file_.document, document_);
    remembered_.reset();
    comparison.remembers = false;
  }
  const bool is_there = comparison.with == ui::CompareWith::remembered ? remembered_ != nullptr
                        : comparison.with == ui::CompareWith::file     ? file_.document != nullptr
                        : comparison.with == ui::CompareWith::beside   ? !session.shown_branches.empty()
                                                                       : true;
  if (!is_there) comparison.with = ui::CompareWith::original;
}

std::optional<model::Message> Partner::require_change(const model::Session& session,
                                                      ui::Comparison& comparison) const {
  if (comparison.mode != ui::CompareMode::change || is_comparable(session, comparison)) return {};
  comparison.with = ui::CompareWith::original;
  return model::Message{model::MessageKind::error,
                        comparison.file + ": has other vertices or triangles than " +
                            session.document->path.filename().string() + ", so there is no change from it",
                        model::Topic::comparison};
}

bool Partner::is_comparable(const model::Session& session, const ui::Comparison& comparison) const {
  return comparison.with == ui::CompareWith::file ? file_fits_ : shown(session, comparison).state != nullptr;
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
