/// What a run emits: signals described once, then frames of plain numbers, and marks between them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/core/json.hpp"

namespace vigil {

enum class SignalKind { scalar, boolean, category };

/// One column of every frame. Names follow the contract, section 3. Empty `lane`, `node` or `link`: not of one.
struct Signal {
  int id = 0;  ///< position in Frame::values
  std::string name;
  std::string unit;
  SignalKind kind = SignalKind::scalar;
  std::string lane;
  std::string node;
  std::string link;                                 ///< "from-to"
  std::vector<std::pair<int, std::string>> labels;  ///< of a category: value and its English word
};

Json to_json(const Signal& signal);

/// The signals of one run, in frame order. Does not change after the run was made.
class Catalogue {
 public:
  /// Appends a signal (its id is set here) and returns the id. The name must be new.
  int add(Signal signal);
  /// The id, or -1.
  int find(std::string_view name) const;
  const Signal& operator[](int id) const { return signals_[static_cast<std::size_t>(id)]; }
  int size() const { return static_cast<int>(signals_.size()); }
  const std::vector<Signal>& all() const { return signals_; }

 private:
  std::vector<Signal> signals_;
  std::unordered_map<std::string, int> ids_;
};

/// One tick of a run. A value that is missing (or was not finite: then a fault says so) is NaN.
struct Frame {
  std::int64_t k = 0;
  double t = 0;                ///< s
  std::vector<double> values;  ///< in catalogue order
};

enum class MarkType { attack, alarm, fault, command, state, note };
enum class MarkEdge { none, begin, end };

/// Something that happened between numbers. Never dropped on its way to the log or a viewer.
struct Mark {
  std::int64_t k = 0;
  MarkType type = MarkType::note;
  MarkEdge edge = MarkEdge::none;
  std::string id;  ///< of an attack or command; may be empty
  std::string lane;
  std::string node;
  std::string link;
  std::string code;    ///< attack type, fault code, new state, …
  std::string detail;  ///< one sentence in English; may be empty
};

std::string_view to_string(MarkType type);
std::string_view to_string(MarkEdge edge);  ///< "" for none
/// {"k","type","edge" (or null),"id","lane","node","link","code","detail"}; empty fields are left out.
Json to_json(const Mark& mark);
/// The inverse. Throws InputError on an unknown type or edge.
Mark mark_from_json(const Json& json);

/// Where a run's output goes. Called on the thread that steps the run; the references live only for the call.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void frame(const Frame& frame) = 0;
  virtual void mark(const Mark& mark) = 0;
};

}  // namespace vigil
