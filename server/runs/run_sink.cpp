#include "server/runs/run_sink.hpp"

namespace vigil {

void RunSink::frame(const Frame& frame) {
  time_ = frame.t;
  for (Mark& note : webhooks_.notes(run_)) {
    note.k = frame.k;
    mark(note);
  }
  log_.frame(run_, frame);
  hub_.frame(run_, frame);
}

void RunSink::mark(const Mark& mark) {
  log_.mark(run_, mark);
  hub_.mark(run_, mark);
  if (mark.type != MarkType::alarm) return;
  webhooks_.send(run_, mark);
  if (announcer_ != nullptr) announcer_->alarm(run_, mark);
  Json alarm = to_json(mark);
  alarm["run"] = std::to_string(run_);
  hub_.publish("alarm", alarm);
}

}  // namespace vigil
