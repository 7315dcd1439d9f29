/// Eigen's heavy templates for MatrixXd, compiled once, in instances.cpp, and not in every file that multiplies or
/// decomposes: a third of the time of a build. Part of the precompiled header; nothing includes it by hand.
#pragma once

#include <Eigen/Dense>

#ifndef VIGIL_INSTANCE
#define VIGIL_INSTANCE extern template
#endif

namespace Eigen {

VIGIL_INSTANCE class LLT<MatrixXd>;
VIGIL_INSTANCE class LDLT<MatrixXd>;
VIGIL_INSTANCE class PartialPivLU<MatrixXd>;
VIGIL_INSTANCE class FullPivLU<MatrixXd>;
VIGIL_INSTANCE class HouseholderQR<MatrixXd>;
VIGIL_INSTANCE class ColPivHouseholderQR<MatrixXd>;
VIGIL_INSTANCE class ColPivHouseholderQR<MatrixXcd>;
VIGIL_INSTANCE class CompleteOrthogonalDecomposition<MatrixXd>;
VIGIL_INSTANCE class JacobiSVD<MatrixXd>;
VIGIL_INSTANCE class JacobiSVD<MatrixXcd>;
VIGIL_INSTANCE class HessenbergDecomposition<MatrixXd>;
VIGIL_INSTANCE class RealSchur<MatrixXd>;
VIGIL_INSTANCE class EigenSolver<MatrixXd>;
VIGIL_INSTANCE class SelfAdjointEigenSolver<MatrixXd>;
VIGIL_INSTANCE SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&,
                                                                                           int);
VIGIL_INSTANCE EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);

namespace internal {

using OneColumnMapper = blas_data_mapper<double, long, 0, 0, 1>;
using ColumnMapper = const_blas_data_mapper<double, long, ColMajor>;
using RowMapper = const_blas_data_mapper<double, long, RowMajor>;
VIGIL_INSTANCE struct gebp_kernel<double, double, long, OneColumnMapper, 4, 4, false, false>;
VIGIL_INSTANCE struct general_matrix_vector_product<long, double, ColumnMapper, ColMajor, false, double, ColumnMapper,
                                                    false>;
VIGIL_INSTANCE struct general_matrix_vector_product<long, double, ColumnMapper, ColMajor, false, double, RowMapper,
                                                    false>;
VIGIL_INSTANCE struct general_matrix_vector_product<long, double, RowMapper, RowMajor, false, double, ColumnMapper,
                                                    false>;
VIGIL_INSTANCE struct general_matrix_vector_product<long, double, RowMapper, RowMajor, false, double, RowMapper, false>;
VIGIL_INSTANCE struct general_matrix_matrix_product<long, double, ColMajor, false, double, ColMajor, false, ColMajor,
                                                    1>;
VIGIL_INSTANCE struct general_matrix_matrix_product<long, double, RowMajor, false, double, ColMajor, false, ColMajor,
                                                    1>;
VIGIL_INSTANCE struct general_matrix_matrix_product<long, double, ColMajor, false, double, RowMajor, false, ColMajor,
                                                    1>;
VIGIL_INSTANCE struct general_matrix_matrix_product<long, double, RowMajor, false, double, RowMajor, false, ColMajor,
                                                    1>;
VIGIL_INSTANCE void evaluateProductBlockingSizesHeuristic<double, double, 1, long>(long&, long&, long&, long);
VIGIL_INSTANCE void evaluateProductBlockingSizesHeuristic<double, double, 4, long>(long&, long&, long&, long);

using InnerBlock = Block<MatrixXd, Dynamic, Dynamic, false>;
using RowMajorXd = Matrix<double, Dynamic, Dynamic, RowMajor>;
VIGIL_INSTANCE void apply_block_householder_on_the_left(InnerBlock&, const InnerBlock&,
                                                        const VectorBlock<const VectorXd>&, bool);
VIGIL_INSTANCE void make_block_householder_triangular_factor(RowMajorXd&, const InnerBlock&,
                                                             const VectorBlock<const VectorXd>&);
VIGIL_INSTANCE void make_block_householder_triangular_factor(RowMajorXd&, const InnerBlock&,
                                                             const Block<const VectorXd, Dynamic, 1, false>&);

}  // namespace internal

using ConstColumnBlock = Block<const MatrixXd, Dynamic, 1, false>;
VIGIL_INSTANCE void MatrixBase<internal::InnerBlock>::applyHouseholderOnTheLeft(const ConstColumnBlock&, const double&,
                                                                                double*);
VIGIL_INSTANCE void MatrixBase<internal::InnerBlock>::applyHouseholderOnTheRight(const ConstColumnBlock&, const double&,
                                                                                 double*);

}  // namespace Eigen
