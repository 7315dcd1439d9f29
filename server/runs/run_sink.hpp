/// A run's output on its way to the log and to the viewers.
#pragma once

#include "db/writer.hpp"
#include "server/hub/hub.hpp"

namespace vigil {

/// Used by the run's own thread alone.
class RunSink : public Sink {
 public:
  RunSink(RunId run, LogWriter& log, Hub& hub) : run_(run), log_(log), hub_(hub) {}
  void frame(const Frame& frame) override;
  void mark(const Mark& mark) override;
  double time() const { return time_; }  ///< s, of the newest frame

 private:
  RunId run_;
  LogWriter& log_;
  Hub& hub_;
  double time_ = 0;
};

}  // namespace vigil
