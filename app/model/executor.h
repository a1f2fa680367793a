#pragma once

#include "model/command.h"

namespace isorelax::model {

/// Carries commands and events out on a session. Private to this room.
class Executor {
 public:
  explicit Executor(Session& session) : s_(session) {}

  void operator()(const OpenFile& command);
  void operator()(const SaveFile& command);
  void operator()(const SetSmoothing& command);
  void operator()(const EndEdit& command);
  void operator()(const SetView& command);
  void operator()(const Run& command);
  void operator()(const Pause& command);
  void operator()(const Step& command);
  void operator()(const Reset& command);
  void operator()(const StepBack& command);
  void operator()(const Undo& command);
  void operator()(const Redo& command);
  void operator()(const Cancel& command);
  void operator()(const SelectNextWorst& command);
  void operator()(const ClearSelection& command);
  void operator()(const CopyCommandLine& command);
  void operator()(const Say& command);
  void operator()(const SetRecent& command);
  void operator()(const Collect& command);

  void operator()(Loaded& event);
  void operator()(EnergyMeasured& event);
  void operator()(Iterated& event);
  void operator()(RunEnded& event);
  void operator()(Saved& event);
  void operator()(Failed& event);
  void operator()(RunFailed& event);

 private:
  void say(MessageKind kind, std::string text);
  void start_run(unsigned iterations);
  void end_run();
  bool wait_for_run(std::function<void(Session&)> then);
  void measure_energy_if_changed();
  void show(const MeshStatePtr& state);
  void apply(const UndoEntry& entry, bool forward);
  void remember_recent(const std::filesystem::path& path);

  Session& s_;
};

}  // namespace isorelax::model
