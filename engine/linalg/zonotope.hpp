/// Zonotopes {H b : |b_j| <= 1} about the origin, H: p x columns (its columns are the generators). Specification
/// (replay), section 8.2.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace vigil {

/// A zonotope of at most max(order, p) generators that contains H's. More than `order` are sorted by falling length
/// (equal ones stay in their order), the first order - p kept and the rest replaced by the box around them.
Eigen::MatrixXd reduce(const Eigen::Ref<const Eigen::MatrixXd>& H, int order);
/// The same into the first columns of `reduced` (p x at least max(order, p), no part of H); returns how many. Allocates
/// nothing where `places` has room for H's columns.
Eigen::Index reduce(const Eigen::Ref<const Eigen::MatrixXd>& H, int order, Eigen::MatrixXd& reduced,
                    std::vector<Eigen::Index>& places);

/// Half the width along each axis: the row sums of |H|; p.
Eigen::VectorXd half_widths(const Eigen::Ref<const Eigen::MatrixXd>& H);

/// The least t with z in t H, z: p: zero for z = 0, at most 1 inside, infinity where no multiple contains z (off the
/// plane of a flat zonotope, by more than 1e-9 of the generators' size). Exact: the largest |n'z| / sum_j |n'H_j| over
/// the normals n of facets, found for p > 2 by a linear program. NaN where an input is not finite. Allocates only where
/// p > 2.
double ratio(const Eigen::Ref<const Eigen::MatrixXd>& H, const Eigen::Ref<const Eigen::VectorXd>& z);

/// ratio <= 1 + 1e-9; false where an input is not finite.
bool contains(const Eigen::Ref<const Eigen::MatrixXd>& H, const Eigen::Ref<const Eigen::VectorXd>& z);

}  // namespace vigil
