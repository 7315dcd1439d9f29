/// Covariances: checks on what a user gives, and square roots for sampling.
#pragma once

#include <Eigen/Core>
#include <string>

#include "engine/core/json.hpp"

namespace vigil {

enum class Definiteness { semidefinite, definite };

/// Reads an n x n covariance from [[..]], a diagonal or a number, symmetrised. Throws InputError at `pointer` where it
/// is not symmetric (to 1e-9 relative) or not positive (semi)definite.
Eigen::MatrixXd read_covariance(const Json& value, int n, const std::string& pointer, Definiteness kind);
/// Throws as read_covariance does; for matrices already read.
void check_covariance(const Eigen::MatrixXd& matrix, const std::string& pointer, Definiteness kind);

/// The symmetric square root of a positive semidefinite matrix: legal where a Cholesky factor is not.
Eigen::MatrixXd symmetric_root(const Eigen::MatrixXd& matrix);
/// The lower Cholesky factor of a positive semidefinite matrix; the column of a zero pivot is zero.
Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& matrix);
/// Of a symmetric matrix, n >= 1; its lower triangle is read.
double least_eigenvalue(const Eigen::MatrixXd& matrix);

}  // namespace vigil
