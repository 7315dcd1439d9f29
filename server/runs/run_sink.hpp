/// A run's output on its way to the log and to the viewers.
#pragma once

#include "db/writer.hpp"
#include "server/alarms/announcer.hpp"
#include "server/hub/hub.hpp"
#include "server/webhook/webhooks.hpp"

namespace vigil {

/// Used by the run's own thread alone.
class RunSink : public Sink {
 public:
  /// `announcer`: null for none.
  RunSink(RunId run, LogWriter& log, Hub& hub, Webhooks& webhooks, Announcer* announcer)
      : run_(run), log_(log), hub_(hub), webhooks_(webhooks), announcer_(announcer) {}
  void frame(const Frame& frame) override;
  void mark(const Mark& mark) override;
  double time() const { return time_; }  ///< s, of the newest frame

 private:
  RunId run_;
  LogWriter& log_;
  Hub& hub_;
  Webhooks& webhooks_;
  Announcer* announcer_;
  double time_ = 0;
};

}  // namespace vigil
