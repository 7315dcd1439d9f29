/// An adversary who knows plant, sensors, inputs and truth of one course, and makes readings that fit what the
/// receivers expect: false data that a test of innovations does not see. Liu, Ning and Reiter (2011); Murguia and Ruths
/// (2016).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/linalg/small.hpp"
#include "engine/run/course.hpp"

namespace vigil {

/// A value, one a course. It costs nothing before the first reading that it shapes, and allocates then only.
class Insider {
 public:
  /// Changes `reading` (channels), of `node` at tick k, as `how` says:
  /// - moved: by h(x + c) - h(x) at the true x, so that all nodes moved alike agree on a state that is off by c;
  /// - direction d: it becomes h(x^-) + sqrt(budget) L d, where x^- is what an extended Kalman filter at this node
  ///   predicts and L L' its innovation covariance S: the innovation's square r' S^-1 r is exactly the budget. The
  ///   filter starts at the truth with the covariance of the process noise when the attack does, and then hears what
  ///   the receiver hears.
  /// Angles are wrapped. Leaves it as it is where the truth is not known (a trace without it) or S is singular.
  void shape(std::int64_t k, const World& world, const Course& course, int node, const Shaping& how,
             Eigen::Ref<Eigen::VectorXd> reading);

 private:
  struct Filter {
    BoundedVector x;
    BoundedMatrix P;
    std::int64_t k = -1;  ///< the tick of its newest reading
  };
  static void move(const World& world, const Course& course, int node, const Shaping& how,
                   Eigen::Ref<Eigen::VectorXd> reading);
  static void predict(const World& world, const Course& course, bool fresh, Filter& filter);

  std::vector<Filter> filters_;  ///< one a node
};

}  // namespace vigil
